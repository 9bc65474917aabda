#!/usr/bin/env python3
"""Breaks the guards of mutations.json one by one and runs the hard cases of their family, which must fail.

A copy of the sources is built once: each guard becomes (mutant == N ? broken : guard), and CUTICLE_MUTANT=N breaks the
Nth when the copy's test runs. The repository's own sources and builds are not touched. The copy has no GPU code.
"""

import argparse
import csv
import json
import os
import re
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
HEADER = """#pragma once
#ifdef __cplusplus
#include <cstdlib>
inline const int cuticle_mutant = std::getenv("CUTICLE_MUTANT") ? std::atoi(std::getenv("CUTICLE_MUTANT")) : 0;
#endif
"""
OPTIONS = ["-DCMAKE_BUILD_TYPE=Release", "-DCUTICLE_UNITY=ON", "-DCUTICLE_GPU=OFF", "-DCUTICLE_VTK=OFF", "-DCUTICLE_PYTHON=OFF"]
TEST = "Families/HardCasesOf.EveryCaseInEveryPrecision_Holds/"


def write_if_changed(path, data):
    """Leaves the time of what stays, so that the copy is built again only where it changed."""
    if not path.exists() or path.read_bytes() != data:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)


def place_of(text, mutation):
    """Where the guard stands in the file."""
    near, guard = mutation.get("near", mutation["from"]), mutation["from"]
    if text.count(near) != 1 or near.count(guard) != 1:
        sys.exit(f"{mutation['file']}: '{near}' is not there once: mend mutations.json")
    return text.index(near) + near.index(guard)


def with_switches(text, mutations):
    """The text with a switch for each of its guards, by number."""
    for number, mutation in sorted(mutations, key=lambda item: -place_of(text, item[1])):
        begin, guard = place_of(text, mutation), mutation["from"]
        switch = f"(cuticle_mutant == {number} ? ({mutation['to']}) : ({guard}))"
        text = text[:begin] + switch + text[begin + len(guard):]
    return text


def broken_copy(tree, mutations):
    """The tracked and new files of the repository, with a switch for each guard."""
    of_file = {}
    for number, mutation in enumerate(mutations, 1):
        of_file.setdefault(mutation["file"], []).append((number, mutation))
    files = {name: with_switches((ROOT / name).read_text(), listed) for name, listed in of_file.items()}
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT, check=True,
                            capture_output=True, text=True).stdout.split("\0")
    for name in filter(None, listed):
        path = ROOT / name
        if path.is_file():
            write_if_changed(tree / name, files[name].encode() if name in files else path.read_bytes())


def build(tree, folder):
    header = folder / "mutant.h"
    write_if_changed(header, HEADER.encode())
    environment = dict(os.environ, CCACHE_BASEDIR=str(tree), CCACHE_NOHASHDIR="1", CCACHE_SLOPPINESS="pch_defines,time_macros",
                       PATH=f"{ROOT}/.venv/bin:{os.environ['PATH']}")
    built = folder / "build"
    subprocess.run(["cmake", "-G", "Ninja", "-S", tree, "-B", built, f"-DCMAKE_CXX_FLAGS=-include {header}", *OPTIONS],
                   check=True, env=environment, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", built, "--target", "hard_cases_test", "--", "--quiet"], check=True, env=environment)
    return next(path for path in built.rglob("hard_cases_test") if path.is_file())


def run(test, number, family, seconds):
    """What failed, in words; empty: nothing."""
    environment = dict(os.environ, CUTICLE_MUTANT=str(number))
    command = [test, f"--gtest_filter={TEST}{family}"]
    try:
        done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=seconds, errors="replace")
    except subprocess.TimeoutExpired:
        return "no end"
    if done.returncode == 0:
        return ""
    if done.returncode < 0:
        return f"ended by signal {-done.returncode}"
    failed = re.findall(r"^(\S+ in (?:f32|f64)): ", done.stdout, re.MULTILINE)
    return f"{failed[0]}, {len(failed)} in all" if failed else f"exit code {done.returncode}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--folder", required=True, type=Path, help="for the copy and its build")
    parser.add_argument("--out", type=Path, help="table of the results (CSV)")
    parser.add_argument("--family", help="of these alone")
    chosen = parser.parse_args()
    mutations = json.loads((ROOT / "tests/hard_cases/mutations.json").read_text())["mutations"]
    folder = chosen.folder.resolve()
    broken_copy(folder / "tree", mutations)
    test = build(folder / "tree", folder)
    unbroken, rows = {}, []
    for number, mutation in enumerate(mutations, 1):
        family = mutation["family"]
        if chosen.family not in (None, family):
            continue
        if family not in unbroken:
            begin = time.monotonic()
            if failed := run(test, 0, family, 3600):
                sys.exit(f"{family} fails without a mutation: {failed}")
            unbroken[family] = time.monotonic() - begin
        failed = run(test, number, family, 30 + 10 * unbroken[family])
        rows.append([number, family, mutation["file"], mutation["guard"], failed or "SURVIVED"])
        print(*rows[-1], sep="  ", flush=True)
    if chosen.out:
        with chosen.out.open("w", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows([["number", "family", "file", "guard", "caught by"], *rows])
    survived = [row for row in rows if row[-1] == "SURVIVED"]
    print(f"{len(rows) - len(survived)} of {len(rows)} mutations caught")
    return 1 if survived else 0


if __name__ == "__main__":
    sys.exit(main())
