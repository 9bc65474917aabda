"""The items of a plan on the workers of Dask distributed."""
import collections
import time

from .._errors import Error
from .run import Done, Failure, block_length, run_block

WINDOW = 3  # blocks a worker thread has or waits for
DEVICE = "cuticle_device"  # a resource that workers may state: --resources cuticle_device=1


def _distributed():
    try:
        import distributed
    except ImportError:
        raise Error("a cluster needs the package distributed, which is not here", "usage", "pip install 'cuticle[sweep]'") from None
    return distributed


class _Block:
    def __init__(self, indices, attempt=1, avoid=None):
        self.indices, self.attempt, self.avoid = indices, attempt, avoid


class Cluster:
    """Blocks of items as tasks, a few ahead of what each worker does; what a lost worker had goes to another."""

    def __init__(self, client, workers, block_seconds):
        self._client, self._workers, self._block_seconds = client, workers, block_seconds

    def run(self, plan, folder, todo, retries, advance):
        """Yields Done after Done."""
        distributed = _distributed()
        if self._client is not None:
            yield from self._run(distributed, self._client, plan, str(folder), todo, retries, advance)
            return
        with distributed.LocalCluster(n_workers=self._workers, threads_per_worker=1, processes=True, dashboard_address=":0") as cluster:
            with distributed.Client(cluster) as client:
                yield from self._run(distributed, client, plan, str(folder), todo, retries, advance)

    def _run(self, distributed, client, plan, folder, todo, retries, advance):
        self._plan, self._folder, self._options = plan, folder, self._placement(client, plan)
        self._mean, self._place, self._todo, self._again = None, 0, todo, collections.deque()
        flying, results = {}, distributed.as_completed()
        try:
            self._fill(client, flying, results)
            while flying:
                future = next(results)
                block = flying.pop(future)
                yield self._take(distributed, future, block, retries, advance)
                self._fill(client, flying, results)
        finally:
            for future in list(flying):
                future.cancel()

    @staticmethod
    def _placement(client, plan):
        """Where workers say that they have a device, tasks that need one go there, one at a time."""
        states = client.scheduler_info(n_workers=-1)["workers"].values()
        has_device = any(DEVICE in state.get("resources", {}) for state in states)
        return {"resources": {DEVICE: 1}} if plan.task.needs_device and has_device else {}

    def _next(self, threads):
        """Blocks become shorter towards the end, so that no worker is left with a long one alone."""
        if self._again:
            return self._again.popleft()
        length = min(block_length(self._mean, self._block_seconds), max(1, (len(self._todo) - self._place) // (2 * threads)))
        indices = [int(index) for index in self._todo[self._place:self._place + length]]
        self._place += len(indices)
        return _Block(indices) if indices else None

    def _fill(self, client, flying, results):
        threads = max(1, sum(client.nthreads().values()))
        while len(flying) < WINDOW * threads and (block := self._next(threads)):
            others = [worker for worker in client.nthreads() if worker != block.avoid] if block.avoid else None
            where = {"workers": others, "allow_other_workers": True} if others else {}
            future = client.submit(_work, self._plan, self._folder, block.indices, block.attempt, self._block_seconds, pure=False, **where, **self._options)
            flying[future] = block
            results.add(future)

    def _take(self, distributed, future, block, retries, advance):
        try:
            done, worker = future.result()
        except distributed.KilledWorker as error:
            return self._killed(block, error, advance)
        if done.indices:
            took = done.seconds / len(done.indices)
            self._mean = took if self._mean is None else 0.7 * self._mean + 0.3 * took
        final = []
        for failure in done.failures:
            if failure.retryable and failure.tries <= retries:
                self._again.append(_Block([failure.index], failure.tries + 1, worker))
            else:
                final.append(failure)
        advance(len(done.indices) + len(final))
        return Done(done.indices, final, done.seconds)

    def _killed(self, block, error, advance):
        """Workers died of this block again and again: its items are tried one by one, to find which it is."""
        if len(block.indices) > 1:
            self._again.extend(_Block([index]) for index in block.indices)
            return Done([], [], 0.0)
        advance(1)
        return Done([], [Failure(block.indices[0], f"its workers ended: {error}", block.attempt, str(error.last_worker.address), True)], 0.0)


def _work(plan, folder, indices, attempt, block_seconds):
    """On a worker: the block, and who did it."""
    import distributed
    return run_block(plan, folder, indices, attempt, block_seconds=block_seconds), distributed.get_worker().address
