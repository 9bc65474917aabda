"""Tasks of test_sweeps.py, and a sweep that runs in a process of its own."""
import os
import pathlib
import signal
import sys
import time

import numpy

import cuticle


def slow(number):
    """Takes the seconds that the environment says, and counts its calls in a file, a byte each; at one of them a signal comes."""
    time.sleep(float(os.environ.get("SWEEP_SECONDS", 0.02)))
    if log := os.environ.get("SWEEP_LOG"):
        with open(log, "ab") as file:
            file.write(b".")
        if os.environ.get("SWEEP_END_AT") == str(os.stat(log).st_size):
            os.kill(os.getpid(), int(os.environ["SWEEP_SIGNAL"]))
    values = numpy.random.default_rng(number).random(5)
    return {"square": number * number, "values": values, "run_pid": os.getpid()}


def fails_at_first(number, folder_of_marks):
    """Item 3 fails until it was tried twice."""
    mark = pathlib.Path(folder_of_marks) / str(number)
    tries = len(mark.read_text()) if mark.exists() else 0
    mark.write_text("x" * (tries + 1))
    if number == 3 and tries < 2:
        raise OSError("the disk was away")
    if number == 5:
        raise cuticle.Error("number: 5 is not allowed", "bad_input")
    return {"number": number}


def ends_its_process(number):
    if number == 4:
        os.kill(os.getpid(), signal.SIGKILL)
    return {"number": number}


if __name__ == "__main__":
    plan = {"task": "sweep_tasks:slow", "vary": {"number": "0:59"}}
    print("begun", flush=True)
    print(cuticle.sweep(plan, sys.argv[1]).computed, flush=True)
