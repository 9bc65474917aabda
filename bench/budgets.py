#!/usr/bin/env python3
"""Scenes that the table of errors was not measured on, each with budgets: the settings chosen, and the errors and the time measured afterwards.

    bench/budgets.py PROGRAM [--scenes a.json b.json] [--error .05] [--frame-ms 5 500] > bench/results/budgets.txt
"""
import argparse
import json
import pathlib
import subprocess
import tempfile

SCENES = pathlib.Path(__file__).resolve().parents[1] / "scenes"
UNSEEN = ("ponytail_cmu", "red_hair", "frostbite", "still")


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def chosen(text):
    """What the program says of its choice, or why there is none."""
    lines = text.splitlines()
    return [line for line in lines if "expected" in line]


def frame_time(program, scene, folder):
    """The passes of a frame, in the mean of four."""
    code, out, errors = run(program, "--json", "render", scene, "--frames", "0:4", "--out", f"{folder}/frames")
    if code:
        return errors.strip()
    return f"{sum(one['timestamp_ms_per_frame'] for one in json.loads(out)['passes']):.3g} ms measured"


def report(program, name, budgets, folder):
    scene = f"{folder}/{name}.json"
    pathlib.Path(scene).write_text(json.dumps({"$include": str(SCENES / f"{name}.json"), "budgets": budgets}))
    print(f"{name}, {json.dumps(budgets)}")
    code, out, errors = run(program, "plan", scene, "--measure")
    if code:
        print(f"  refused: {errors.strip().splitlines()[-1]}\n", flush=True)
        return
    for line in chosen(errors) + [line for line in out.splitlines() if "measured on this hair" in line]:
        print(f"  {line}")
    print(f"  frame     {frame_time(program, scene, folder)}\n", flush=True)


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
