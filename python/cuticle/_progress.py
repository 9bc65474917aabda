"""Progress of long work: tqdm's bar, or a function of the caller's."""
import contextlib
import functools

from . import _cuticle


class _Bar:
    """tqdm's bar of the task at hand; a new one where the task changes. It is gone when it goes out of use."""

    def __init__(self):
        import tqdm.auto
        self._make, self._bar, self._task = tqdm.auto.tqdm, None, None

    def __call__(self, task, done, total):
        if self._bar is None or task != self._task:
            self.close()
            self._bar, self._task = self._make(desc=task, total=total), task
        self._bar.total = total
        self._bar.update(done - self._bar.n)
        self._bar.refresh()

    def close(self):
        if self._bar is not None:
            self._bar.close()
        self._bar = None

    __del__ = close


def progress_of(wanted):
    """A function of task, done and total: the caller's own, or for True tqdm's bar; None for none."""
    if wanted is None or wanted is False:
        return None
    return wanted if callable(wanted) else _Bar()


@contextlib.contextmanager
def ticking(wanted, task):
    """Around a call that cannot say how far it is: 0 of 1 of the task ten times a second, then 1 of 1."""
    call = progress_of(wanted)
    if call is None:
        yield
        return
    tick = functools.partial(call, task, 0, 1)
    tick()
    _cuticle.set_ticker(tick)
    try:
        yield
    finally:
        _cuticle.set_ticker(None)
    call(task, 1, 1)
