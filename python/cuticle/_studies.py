"""Studies of what accuracy costs in time, as tables."""
import json
import os
import pathlib

from . import _cuticle
from ._progress import progress_of


def studies() -> list:
    """The registered studies: dictionaries with name, summary, options (name, default, help), seconds and quick_seconds."""
    return json.loads(_cuticle.studies())


def _share():
    """The folder of the files that travel with the program (scenes), where it can be found."""
    candidates = [os.environ.get("CUTICLE_SHARE"), *pathlib.Path(__file__).resolve().parents[:4]]
    return next((str(folder) for folder in candidates if folder and (pathlib.Path(folder) / "scenes").is_dir()), "")


class Study:
    """What a study found. result, times, conclusions: dictionaries, as the files of `cuticle study` hold them (study/README.md)."""

    def __init__(self, result, times, conclusions):
        self.result, self.times, self.conclusions = result, times, conclusions

    @property
    def name(self) -> str:
        return self.result["name"]

    def rows(self) -> list:
        """A dictionary for each method at each setting: group, method, its knobs, error (mean of the group's first metric), its 95 % interval
        as error_low and error_high, quantiles, bytes, and seconds of one evaluation."""
        rows = []
        for group, times in zip(self.result["groups"], self.times["groups"]):
            for point, time in zip(group["points"], times["points"]):
                rows.append({"group": group["name"], "method": point["method"], **point["knobs"], **_errors(group, point), "bytes": point["bytes"],
                             **_seconds(time)})
        return rows

    def table(self):
        """The rows as a pyarrow.Table; `.to_pandas()` where pandas is."""
        import pyarrow
        rows = self.rows()
        return pyarrow.table({name: [row.get(name) for row in rows] for name in dict.fromkeys(name for row in rows for name in row)})

    def curves(self, plot: str) -> dict:
        """The curves of one of the study's plots: name -> (x, y), lists."""
        found = {entry["name"]: entry for entry in self.result["plots"]}
        if plot not in found:
            raise KeyError(f"'{plot}' is not one of {', '.join(found)}")
        return {curve["name"]: (curve["x"], curve["y"]) for curve in found[plot]["curves"]}

    def __repr__(self):
        return f"Study '{self.name}': {len(self.rows())} points in {len(self.result['groups'])} groups"


def _errors(group, point):
    columns = {}
    for place, error in enumerate(point["errors"]):
        prefix = "error" if place == 0 else f"{error['metric']}_error"
        columns |= {prefix: error["mean"]["value"], f"{prefix}_low": error["mean"]["low"], f"{prefix}_high": error["mean"]["high"],
                    f"{prefix}_median": error["median"], f"{prefix}_max": error["max"]}
    return columns


def _seconds(time):
    seconds = time.get("seconds")
    return {"seconds": seconds["value"] if isinstance(seconds, dict) else seconds}


def study(name: str, quick: bool = True, *, device: str = "", share=None, progress=None, **options) -> Study:
    """Runs a registered study (`cuticle.studies()`) with its options by name. quick: its reduced form. share: the folder that holds `scenes`,
    where a study needs them. Ctrl-C ends it between points."""
    text = _cuticle.run_study(name, bool(quick), {key: str(value) for key, value in options.items()}, device, str(share or _share()), progress_of(progress))
    return Study(**json.loads(text))
