"""Runs the built program."""
import csv
import io
import os
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("CUTICLE_PROGRAM", str(ROOT / "build/release/bin/cuticle"))
DATA = os.environ.get("CUTICLE_TEST_DATA", "")


def run(*arguments, timeout=200):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=timeout)


def rows(*arguments):
    """The CSV that a command prints, as dictionaries."""
    done = run(*arguments)
    assert done.returncode == 0, done.stderr
    return list(csv.DictReader(io.StringIO(done.stdout)))


def refused(code, *arguments):
    """The message of a command that must fail with this exit code."""
    done = run(*arguments)
    assert done.returncode == code, f"exit {done.returncode}: {done.stderr}"
    assert done.stdout == "" or code == 1
    return done.stderr
