"""Running the items of a plan: here one after the other, or by the workers of a cluster (cluster.py)."""
import contextlib
import fcntl
import os
import re
import socket
import tempfile
import time
import traceback
import typing

import numpy

from .._errors import Error
from .._inputs import to_json
from .._progress import progress_of
from .plan import Plan
from .store import Store
from .table_files import write_table

# A block is a share of the work that is handed out at once, of about so many seconds; its results are written twice on the way.
BLOCK_SECONDS, LARGEST_BLOCK = 2.0, 100000


class Failure(typing.NamedTuple):
    """An item that gave no result: its index, what was wrong, how often it was tried, by whom last, and whether trying again may help."""

    index: int
    message: str
    tries: int
    worker: str
    retryable: bool


class Done(typing.NamedTuple):
    """What became of a block: indices with results, failures, and seconds of the work alone."""

    indices: list
    failures: list
    seconds: float


@contextlib.contextmanager
def _device(task, parameters):
    """One task at a time has a machine's device."""
    if not task.needs_device or parameters.get("method") == "reference":
        yield
        return
    name = re.sub(r"[^A-Za-z0-9]+", "_", str(parameters.get("device") or os.environ.get("CUTICLE_DEVICE", "")))
    path = os.path.join(tempfile.gettempdir(), f"cuticle-{os.getuid()}-device-{name}.lock")
    handle = os.open(path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC, 0o600)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX)
        yield
    finally:
        os.close(handle)


def _may_help(error):
    """Whether another try may give another result: not where the program says what is wrong with the input."""
    return not (isinstance(error, (TypeError, Error)) and getattr(error, "kind", "usage") in ("usage", "bad_input"))


def _message(error):
    """The exception and the line that it came from."""
    place = traceback.extract_tb(error.__traceback__)[-1]
    return f"{type(error).__name__}: {error} ({os.path.basename(place.filename)}:{place.lineno})"


def compute(plan, store, index):
    """(row, seconds) of an item."""
    parameters = plan.parameters(index)
    started = time.perf_counter()
    with _device(plan.task, parameters):
        result = plan.task(parameters, plan.folder)
    seconds = time.perf_counter() - started
    return {"index": index, "plan": plan.digest, "key": plan.key(index), "parameters": to_json(_short(parameters)), **store.columns_of(result),
            "run_seconds": seconds, "run_worker": f"{socket.gethostname()}:{os.getpid()}"}, seconds


def _short(value):
    """Parameters for people: large arrays and objects by their kind alone."""
    if isinstance(value, dict):
        return {name: _short(part) for name, part in value.items()}
    if isinstance(value, numpy.ndarray) and value.size > 16:
        return f"array of {value.shape}"
    return value if isinstance(value, (bool, int, float, str, list, tuple, numpy.generic, numpy.ndarray, os.PathLike, type(None))) else type(value).__name__


class _Part:
    """Rows of a block on their way to the store."""

    def __init__(self, store, block, seconds):
        self._store, self._block, self._seconds = store, block, seconds
        self._rows, self._number, self._last = [], 0, time.monotonic()

    def add(self, row):
        self._rows.append(row)
        if time.monotonic() - self._last >= self._seconds:
            self.flush()

    def flush(self):
        if self._rows:
            self._store.write(f"{self._block}-{self._rows[0]['index']:010d}-{self._number}", self._rows)
            self._number += 1
        self._rows, self._last = [], time.monotonic()


def run_block(plan, folder, indices, attempt=1, notify=None, block_seconds=BLOCK_SECONDS) -> Done:
    """Computes items and writes their results. Items that a killed process wrote for the same block are not computed again; what ends
    the work on the way (Ctrl-C) loses nothing that is computed."""
    store = Store(folder)
    block = f"{plan.digest}-{indices[0]:010d}-{len(indices)}"
    kept = store.indices_of(block) if attempt == 1 else ()
    done, failures, busy, part = [], [], 0.0, _Part(store, block, block_seconds / 2)
    worker = f"{socket.gethostname()}:{os.getpid()}"
    try:
        for index in indices:
            if index in kept:
                done.append(index)
                continue
            try:
                row, seconds = compute(plan, store, index)
            except Exception as error:
                failures.append(Failure(index, _message(error), attempt, worker, _may_help(error)))
            else:
                busy += seconds
                part.add(row)
                done.append(index)
            if notify:
                notify(1)
    finally:
        part.flush()
    return Done(done, failures, busy)


class Results:
    """What a sweep has. computed, reused: items; failed: of `Failure`; seconds: of the run; busy: of the tasks' own work, in all processes."""

    def __init__(self, plan, store, computed, reused, failed, seconds, busy):
        self.plan, self.store = plan, store
        self.computed, self.reused, self.failed, self.seconds, self.busy = computed, reused, failed, seconds, busy

    def table(self, runs=False):
        """A pyarrow.Table, a row for each item that has a result, in the plan's order; see `Store.table`."""
        return self.store.table(self.plan, runs)

    def frame(self, runs=False):
        """The same as a pandas.DataFrame."""
        return self.table(runs).to_pandas()

    def array(self, name: str, index: int) -> numpy.ndarray:
        """An array of an item's result."""
        table = self.table()
        place = table["index"].to_pylist().index(index)
        return self.store.array(table.slice(place, 1).to_pylist()[0], name)

    def write(self, path):
        """The table as a file: .parquet, .csv or .json (a line an item). The same results give the same bytes."""
        write_table(self.table(), path)

    def __repr__(self):
        return f"Results of {len(self.plan)} items: {self.computed} computed in {self.seconds:.3g} s, {self.reused} reused, {len(self.failed)} failed"


def share_of(indices, shard):
    """Every N-th of the indices, from the I-th. shard: (I, N), "I/N" or None. I is 1 .. N."""
    if shard is None:
        return indices
    try:
        part, parts = (int(number) for number in (shard.split("/") if isinstance(shard, str) else shard))
    except ValueError:
        raise Error(f"shard: '{shard}' is not I/N", "usage", "1/4, 2/4, 3/4 and 4/4") from None
    if not 1 <= part <= parts:
        raise Error(f"shard: {part} is outside 1 .. {parts}", "usage")
    return indices[indices % parts == part - 1]


def block_length(seconds_of_an_item, block_seconds):
    """Items of a block; one, until it is known how long they take."""
    return 1 if seconds_of_an_item is None else max(1, min(LARGEST_BLOCK, int(block_seconds / max(seconds_of_an_item, 1e-9))))


class Serial:
    """In this process, one item after the other."""

    def __init__(self, block_seconds):
        self._block_seconds = block_seconds

    def run(self, plan, folder, todo, retries, advance):
        """Yields Done after Done."""
        place, mean = 0, None
        while place < len(todo):
            block = [int(index) for index in todo[place:place + block_length(mean, self._block_seconds)]]
            started = time.perf_counter()
            done = run_block(plan, folder, block, 1, advance, self._block_seconds)
            mean = (time.perf_counter() - started) / len(block)
            place += len(block)
            yield Done(done.indices, [], done.seconds)
            for failure in done.failures:
                yield self._again(plan, folder, failure, retries)

    @staticmethod
    def _again(plan, folder, failure, retries):
        busy = 0.0
        while failure.retryable and failure.tries <= retries:
            done = run_block(plan, folder, [failure.index], failure.tries + 1)
            busy += done.seconds
            if not done.failures:
                return Done(done.indices, [], busy)
            failure = done.failures[0]
        return Done([], [failure], busy)


def _open(plan, out, folder):
    plan = plan if isinstance(plan, Plan) else Plan(plan, folder)
    store = Store(out)
    if store.folder.exists() and not store.folder.is_dir():
        raise Error(f"{store.folder}: no folder", "bad_input")
    store.describe(plan)
    return plan, store


def sweep(plan, out, *, client=None, workers=0, shard=None, retries=2, block_seconds=BLOCK_SECONDS, progress=None,
          folder=None) -> Results:
    """Computes what a plan's items lack in the store `out` (a folder), and gives access to all of them.

    plan: a dictionary or a JSON file's path (see `cuticle.sweeps.Plan`). client: of dask.distributed; its workers must see the folder `out`.
    workers: that many processes on this machine instead. Neither: in this process. shard: "I/N", every N-th item from the I-th, of a
    job array over one store. retries: of an item that fails, elsewhere where there is an elsewhere; bad input is not tried again.
    block_seconds: work handed out at once, and what a killed process may lose is half of that. progress: True (tqdm) or a function of task, done, total. What is in the store is not computed again: a sweep that was stopped goes on.
    """
    plan, store = _open(plan, out, folder)
    started, call = time.perf_counter(), progress_of(progress)
    missing = share_of(numpy.flatnonzero(~store.done(plan)), shard)
    total, seen = len(missing), [0]

    def advance(count):
        seen[0] += count
        if call:
            call(plan.name, seen[0], total)

    if client is None and not workers:
        runner = Serial(block_seconds)
    else:
        from .cluster import Cluster
        runner = Cluster(client, workers, block_seconds)
    computed, busy, failed = 0, 0.0, []
    with contextlib.closing(runner.run(plan, store.folder, missing, retries, advance)) as blocks:
        for done in blocks:
            computed, busy = computed + len(done.indices), busy + done.seconds
            for index in done.indices:
                store.forgive(plan, index)
            for failure in done.failures:
                store.fail(plan, failure)
                failed.append(failure)
    share = len(share_of(numpy.arange(len(plan)), shard))
    return Results(plan, store, computed, share - total, sorted(failed), time.perf_counter() - started, busy)
