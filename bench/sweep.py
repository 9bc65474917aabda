"""What a sweep costs beside its work, and how it grows with workers.

    .venv/bin/python bench/sweep.py [--items 200]

Items that sleep for 100 ms tell the overhead of the sweep itself, on a machine with fewer cores than workers too: the processor time of client, scheduler and
workers for each item, which other work does not change, and the wall clock of the median of --rounds. Items of 100 ms of arithmetic tell what the cores give.
The goal is 5 % for both. docs/scale.md holds the model that these figures go into.
"""
import argparse
import os
import resource
import statistics
import sys
import tempfile
import time

import cuticle

SECONDS = 0.1


def sleeping(number):
    time.sleep(SECONDS)
    return {"square": number * number}


def working(number):
    """So much processor time, in one thread."""
    end = time.process_time() + SECONDS
    total = 0.0
    while time.process_time() < end:
        total += sum(k * 0.5 for k in range(1000))
    return {"square": number * number}


def empty(number):
    return {"square": number * number}


def cpu():
    return sum(resource.getrusage(who).ru_utime + resource.getrusage(who).ru_stime for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))


def of_workers():
    """Processor seconds of the processes that this one started and that still run."""
    import psutil
    return sum(times.user + times.system for times in (child.cpu_times() for child in psutil.Process().children(recursive=True)))


def run(task, items, **options):
    """(seconds, seconds of the tasks, processor seconds of this process)."""
    with tempfile.TemporaryDirectory() as folder:
        began, used = time.perf_counter(), cpu()
        results = cuticle.sweep({"task": task, "vary": {"number": {"first": 0, "last": items - 1}}}, folder, **options)
        assert results.computed == items
        return time.perf_counter() - began, results.busy, cpu() - used


def on_cluster(task, items, workers):
    """As run; the processor seconds are those of the workers too."""
    import distributed
    with distributed.LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None) as cluster, distributed.Client(cluster) as client:
        run(task, 2 * workers, client=client)  # the workers import what they need
        before = of_workers()
        seconds, busy, used = run(task, items, client=client)
        return seconds, busy, used + of_workers() - before


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--items", type=int, default=200)
    parser.add_argument("--rounds", type=int, default=3)
    options = parser.parse_args()
    items = options.items
    print(f"{os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}; items of {1000 * SECONDS:.0f} ms")
    seconds, busy, _ = run(sleeping, items)
    print(f"in this process: {items} sleeping items {seconds:.2f} s, overhead {100 * (seconds / busy - 1):.2f} %")
    seconds, _, used = run(empty, 20000)
    print(f"in this process: {seconds / 20000 * 1e6:.0f} us an empty item ({used / 20000 * 1e6:.0f} us of processor time)")
    for task in (sleeping, working):
        for workers in (1, 2, 4):
            rounds = sorted(on_cluster(task, items, workers) for _ in range(options.rounds))
            seconds, busy, _ = rounds[len(rounds) // 2]
            work = 0 if task is sleeping else SECONDS
            used = statistics.median(round[2] for round in rounds) / items - work
            print(f"{task.__name__}: {workers} workers {seconds:.2f} s, of the work alone {busy / workers:.2f}, overhead {100 * (seconds * workers / busy - 1):.1f} % of the clock "
                  f"({', '.join(f'{100 * (s * workers / b - 1):.1f}' for s, b, _ in rounds)}), {100 * used / SECONDS:.1f} % of processor time ({used * 1e3:.2f} ms an item); "
                  f"{items * SECONDS / seconds:.2f} times one core, {os.getloadavg()[0]:.1f} load")
            sys.stdout.flush()


if __name__ == "__main__":
    main()
