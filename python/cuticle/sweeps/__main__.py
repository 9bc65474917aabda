"""python -m cuticle.sweeps PLAN --out DIR: what `cuticle sweep` runs."""
import argparse
import json
import os
import shlex
import signal
import sys

from .._cuticle import set_threads
from .._errors import Error
from . import Plan, Store, sweep
from .run import BLOCK_SECONDS, share_of
from .table_files import write_table

EXIT_OF = {"usage": 2, "bad_input": 3, "no_device": 4, "out_of_memory": 5, "internal": 5}


def options():
    parser = argparse.ArgumentParser(prog="cuticle sweep", description="Computes the items of a plan: on this machine, in a job array, or on a cluster.")
    parser.add_argument("plan", help="JSON file (docs/scale.md)")
    parser.add_argument("--out", required=True, help="folder of the results; what is in it is not computed again")
    where = parser.add_mutually_exclusive_group()
    where.add_argument("--workers", type=int, default=0, help="processes on this machine; 0: in this process")
    where.add_argument("--scheduler", help="address of a Dask scheduler, tcp://host:8786")
    parser.add_argument("--shard", help="I/N: every N-th item from the I-th, I from 1")
    parser.add_argument("--emit-commands", type=int, metavar="N", help="print N commands that together compute the plan, and end")
    parser.add_argument("--block-seconds", type=float, default=BLOCK_SECONDS, help="work handed out at once; half of it may be lost by a kill")
    parser.add_argument("--threads", type=int, default=0, help="threads of an item's own work; 0: all")
    parser.add_argument("--retries", type=int, default=2, help="of an item that fails")
    parser.add_argument("--table", help="write the results so far: .parquet, .csv or .json")
    parser.add_argument("--dry-run", action="store_true", help="print what would be computed, and end")
    parser.add_argument("--json", action="store_true", help="the report as JSON")
    parser.add_argument("--quiet", action="store_true", help="no progress")
    return parser


def emit(given):
    if given.emit_commands < 1:
        raise Error(f"--emit-commands: {given.emit_commands} is below 1", "usage")
    for part in range(1, given.emit_commands + 1):
        print(shlex.join(["cuticle", "sweep", os.path.abspath(given.plan), "--out", os.path.abspath(given.out), "--shard", f"{part}/{given.emit_commands}"]))


def show_plan(plan, given):
    done = Store(given.out).done(plan)
    share = share_of((~done).nonzero()[0], given.shard)
    print(f"{plan!r}\n{int(done.sum())} are in {given.out}, {len(share)} would be computed")
    for index in share[:3]:
        print(f"{index}: {json.dumps(plan.changes(int(index)), default=str)}")


def report(results, given):
    if given.json:
        print(json.dumps({"items": len(results.plan), "computed": results.computed, "reused": results.reused, "seconds": results.seconds,
                          "busy_seconds": results.busy, "failed": [failure._asdict() for failure in results.failed]}, indent=2))
    else:
        print(repr(results))
    for failure in results.failed[:20]:
        print(f"cuticle: item {failure.index}: {failure.message} ({failure.tries} tries)", file=sys.stderr)


def run(given):
    if given.emit_commands is not None:
        return emit(given)
    plan = Plan(given.plan)
    if given.dry_run:
        return show_plan(plan, given)
    set_threads(given.threads)
    client = None
    if given.scheduler:
        from .cluster import _distributed
        client = _distributed().Client(given.scheduler)
        print(f"cuticle: dashboard {client.dashboard_link}", file=sys.stderr)
    results = sweep(plan, given.out, client=client, workers=given.workers, shard=given.shard, retries=given.retries, block_seconds=given.block_seconds,
                    progress=not given.quiet and sys.stderr.isatty())
    report(results, given)
    if given.table:
        write_table(results.table(), given.table)
    return 1 if results.failed else 0


def interrupted(*_):
    raise KeyboardInterrupt


def main():
    given = options().parse_args()
    signal.signal(signal.SIGTERM, interrupted)  # a job array's end: what is computed is written first
    signal.signal(signal.SIGINT, interrupted)
    try:
        return run(given) or 0
    except Error as error:
        print(f"cuticle: {error}", file=sys.stderr)
        return EXIT_OF.get(error.kind, 5)
    except KeyboardInterrupt:
        print(f"cuticle: stopped; what is computed is in {given.out}, and the same command goes on", file=sys.stderr)
        return 130


if __name__ == "__main__":
    sys.exit(main())
