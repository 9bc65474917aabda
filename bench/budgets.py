#!/usr/bin/env python3
"""Scenes that the table of errors was not measured on, each with budgets: the settings chosen, and the errors and the time measured afterwards.

    bench/budgets.py PROGRAM [--scenes a.json b.json] [--error .05] [--frame-ms 5 500] > bench/results/budgets.txt
"""
import argparse
import json
import pathlib
import re
import subprocess
import tempfile

SCENES = pathlib.Path(__file__).resolve().parents[1] / "scenes"
UNSEEN = ("ponytail_cmu", "red_hair", "frostbite", "still")


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def chosen(text):
    """What the program says of its choice."""
    return [line for line in text.splitlines() if " expected, " in line]


def numbers(line):
    return [float(word) for word in re.findall(r"\b\d[\d.]*(?:e[+-]?\d+)?", line)]


def verdict(promised, measured):
    """Whether a measured line keeps what was promised: 'A expected, below B with 95 %[, C allowed]'."""
    value, (_, below, *rest) = numbers(measured)[-1], numbers(promised.split(": error")[-1].split("frame")[-1])
    words = [f"{'below' if value <= below else 'ABOVE'} {below:g}"]
    if len(rest) > 1:  # after the 95 of '95 %'
        words.append(f"{'within' if value <= rest[1] else 'OVER'} {rest[1]:g}")
    return ", ".join(words)


def report(program, name, budgets, folder):
    scene = f"{folder}/{name}.json"
    pathlib.Path(scene).write_text(json.dumps({"$include": str(SCENES / f"{name}.json"), "budgets": budgets}))
    print(f"{name}, {json.dumps(budgets)}")
    code, out, errors = run(program, "plan", scene, "--measure")
    if code:
        print(f"  refused: {errors.strip().splitlines()[-1]}\n", flush=True)
        return
    promised = {line.split()[0]: line for line in chosen(errors)}
    for line in promised.values():
        print(f"  {line}")
    for line in out.splitlines():
        if "measured on this hair" in line:
            part = line.split()[0]
            print(f"  {line}{': ' + verdict(promised[part], line) if part in promised else ''}")
    print(flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--scenes", nargs="*", default=UNSEEN, help="names in scenes/")
    parser.add_argument("--error", type=float, default=0.02, help="of shadows")
    parser.add_argument("--frame-ms", nargs="*", type=float, default=[5, 500])
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        for name in given.scenes:
            for budgets in [{"error": {"shadow": given.error}}, *({"frame_ms": ms} for ms in given.frame_ms)]:
                report(given.program, name, budgets, folder)


if __name__ == "__main__":
    main()
