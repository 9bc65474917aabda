#!/usr/bin/env python3
"""Breaks the guards of mutations.json one by one and runs the hard cases of their family, which must fail.

A copy of the sources is built once: each guard becomes (mutant == N ? broken : guard), and CUTICLE_MUTANT=N breaks the
Nth when the copy's test runs. The repository's own sources and builds are not touched. The copy has no GPU code; guards
of shaders ("on": "device") are broken in a second copy that has, by a constant that its pipelines are given.
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
# In shaders the switch is a constant, which the copy's pipelines set from the environment.
CONSTANT = """#ifndef CUTICLE_MUTANT
#define CUTICLE_MUTANT
layout(constant_id = 1000) const int cuticle_mutant = 0;
#endif
"""
PIPELINES = "gpu/pipeline/shader.cpp"
SET_CONSTANT = (
    "  info.mapEntryCount = std::uint32_t(entries.size());",
    """  static std::deque<std::vector<std::uint32_t>> kept;
  static std::mutex keeping;
  const std::lock_guard<std::mutex> guard(keeping);
  std::vector<std::uint32_t>& values = kept.emplace_back(interface.specialization);
  values.push_back(std::getenv("CUTICLE_MUTANT") ? std::uint32_t(std::atoi(std::getenv("CUTICLE_MUTANT"))) : 0u);
  entries.push_back({1000, std::uint32_t((values.size() - 1) * sizeof(std::uint32_t)), sizeof(std::uint32_t)});
  info.mapEntryCount = std::uint32_t(entries.size());""")
SET_DATA = ("""  info.dataSize = interface.specialization.size() * sizeof(std::uint32_t);
  info.pData = interface.specialization.data();""", """  info.dataSize = values.size() * sizeof(std::uint32_t);
  info.pData = values.data();""")
OPTIONS = {False: ["-DCUTICLE_GPU=OFF", "-DCUTICLE_VTK=OFF", "-DCUTICLE_PYTHON=OFF"], True: ["-DCUTICLE_WERROR=ON"]}  # by whether on the device
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


def for_device(files):
    """Shaders with the constant, and pipelines that set it."""
    made = {name: CONSTANT + text for name, text in files.items()}
    text = "#include <cstdlib>\n#include <deque>\n#include <mutex>\n" + (ROOT / PIPELINES).read_text()
    for before, after in (SET_CONSTANT, SET_DATA):
        if text.count(before) != 1:
            sys.exit(f"{PIPELINES}: '{before}' is not there once: mend mutate.py")
        text = text.replace(before, after)
    return made | {PIPELINES: text}


def broken_copy(tree, mutations, on_device):
    """The tracked and new files of the repository, with a switch for each guard."""
    of_file = {}
    for number, mutation in mutations:
        of_file.setdefault(mutation["file"], []).append((number, mutation))
    files = {name: with_switches((ROOT / name).read_text(), listed) for name, listed in of_file.items()}
    if on_device:
        files = for_device(files)
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT, check=True,
                            capture_output=True, text=True).stdout.split("\0")
    for name in filter(None, listed):
        path = ROOT / name
        if path.is_file():
            write_if_changed(tree / name, files[name].encode() if name in files else path.read_bytes())


def build(tree, folder, on_device):
    header = folder / "mutant.h"
    write_if_changed(header, HEADER.encode())
    flags = [] if on_device else [f"-DCMAKE_CXX_FLAGS=-include {header}"]
    environment = dict(os.environ, CCACHE_BASEDIR=str(tree), CCACHE_NOHASHDIR="1", CCACHE_SLOPPINESS="pch_defines,time_macros",
                       PATH=f"{ROOT}/.venv/bin:{os.environ['PATH']}")
    built = tree / "build/release"  # where the preset builds: the compiler's cache then knows what no guard touches
    subprocess.run(["cmake", "-G", "Ninja", "-S", tree, "-B", built, "-DCMAKE_BUILD_TYPE=Release", "-DCUTICLE_UNITY=ON",
                    f"-DPython_EXECUTABLE={ROOT}/.venv/bin/python", *flags, *OPTIONS[on_device]],
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
    failed = re.findall(r"^(\S+ in (?:f32|f64|gpu)): ", done.stdout, re.MULTILINE)
    return f"{failed[0]}, {len(failed)} in all" if failed else f"exit code {done.returncode}"


def break_one_by_one(mutations, folder, on_device):
    """A row for each: number, family, file, guard, what failed."""
    broken_copy(folder / "tree", mutations, on_device)
    test = build(folder / "tree", folder, on_device)
    unbroken, rows = {}, []
    for number, mutation in mutations:
        family = mutation["family"]
        if family not in unbroken:
            begin = time.monotonic()
            if failed := run(test, 0, family, 3600):
                sys.exit(f"{family} fails without a mutation: {failed}")
            unbroken[family] = time.monotonic() - begin
        failed = run(test, number, family, 30 + 10 * unbroken[family])
        rows.append([number, family, mutation["file"], mutation["guard"], failed or "SURVIVED"])
        print(*rows[-1], sep="  ", flush=True)
    # A family that fails by now for another cause has caught nothing.
    for family in unbroken:
        if failed := run(test, 0, family, 3600):
            sys.exit(f"{family} fails without a mutation at the end: {failed}")
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--folder", required=True, type=Path, help="for the copies and their builds")
    parser.add_argument("--out", type=Path, help="table of the results (CSV)")
    parser.add_argument("--family", help="of these alone")
    parser.add_argument("--list", type=Path, default=ROOT / "tests/hard_cases/mutations.json", help="the mutations (JSON)")
    chosen = parser.parse_args()
    listed = json.loads(chosen.list.read_text())["mutations"]
    mutations = [(number, mutation) for number, mutation in enumerate(listed, 1) if chosen.family in (None, mutation["family"])]
    rows = []
    for on_device in (False, True):
        of_this = [item for item in mutations if (item[1].get("on") == "device") == on_device]
        if of_this:
            rows += break_one_by_one(of_this, chosen.folder.resolve() / ("device" if on_device else "cpu"), on_device)
    if chosen.out:
        with chosen.out.open("w", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows([["number", "family", "file", "guard", "caught by"], *rows])
    survived = [row for row in rows if row[-1] == "SURVIVED"]
    print(f"{len(rows) - len(survived)} of {len(rows)} mutations caught")
    return 1 if survived else 0


if __name__ == "__main__":
    sys.exit(main())
