"""Many items, one plan: on this machine, in a job array, or on a Dask cluster, with the same results.

    results = cuticle.sweep({"task": "eval", "fixed": {"model": "chiang", "quantity": "albedo"},
                             "vary": {"set.beta_m": [0.1, 0.3, 0.5], "theta_o_deg": "-80:80:9"}}, "albedo")
    results.table()

docs/scale.md says how it works and what it costs.
"""
from .plan import Plan
from .run import Failure, Results, sweep
from .store import Store
from .tasks import Task, tasks

__all__ = ["Failure", "Plan", "Results", "Store", "Task", "sweep", "tasks"]
