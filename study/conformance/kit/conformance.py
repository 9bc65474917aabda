"""Runs a table of `cuticle conformance` against another implementation of the model. Needs Python 3.9 and nothing else.

  python conformance.py TABLE.csv --with adapter.py [--json] [--worst 3]

The adapter is a Python file with one function:

  def evaluate(model, settings, quantity, lobe, theta_i, theta_o, phi, h):
      "Angles in radians; settings: a dictionary of text. Returns (r, g, b), or None for what it does not offer."

Exit code: 0 where every offered value lies within its tolerance, 1 where one does not, 3 for a table or adapter that
cannot be read, or that offers nothing.
"""
import argparse
import csv
import importlib.util
import json
import math
import sys

COLUMNS = ["model", "settings", "quantity", "lobe", "theta_i_deg", "theta_o_deg", "phi_deg", "h", "r", "g", "b", "tolerance", "hard"]


class Refused(Exception):
    """A table or an adapter that cannot be used."""


class Row:
    def __init__(self, cells):
        self.model, self.quantity, self.lobe, self.hard = cells["model"], cells["quantity"], cells["lobe"], cells["hard"] == "1"
        self.settings = dict(pair.split("=", 1) for pair in cells["settings"].split(",") if pair)
        self.theta_i, self.theta_o, self.phi = (math.radians(float(cells[name])) for name in ("theta_i_deg", "theta_o_deg", "phi_deg"))
        self.h, self.tolerance = float(cells["h"]), float(cells["tolerance"])
        self.expected = tuple(float(cells[name]) for name in "rgb")
        self.words = "theta_i {theta_i_deg}, theta_o {theta_o_deg}, phi {phi_deg} degrees, h {h}".format(**cells)

    def column(self):
        near = " near field" if self.settings.get("field") == "near" else ""
        return f"{self.model}{near} {self.quantity} {self.lobe}"


def read_table(path):
    try:
        with open(path, newline="") as file:
            reader = csv.DictReader(file)
            if reader.fieldnames != COLUMNS:
                raise Refused(f"{path}: its first line is not that of a table of cuticle conformance")
            rows = []
            for cells in reader:
                try:
                    rows.append(Row(cells))
                except (TypeError, ValueError, AttributeError) as wrong:
                    raise Refused(f"{path}, line {reader.line_num}: {wrong}") from None
            return rows
    except OSError as missing:
        raise Refused(str(missing)) from None


def load_adapter(path):
    specification = importlib.util.spec_from_file_location("conformance_adapter", path)
    if specification is None:
        raise Refused(f"{path}: not a Python file")
    module = importlib.util.module_from_spec(specification)
    try:
        specification.loader.exec_module(module)
    except (OSError, ImportError, SyntaxError) as missing:
        raise Refused(f"{path}: {missing}") from None
    if not hasattr(module, "evaluate"):
        raise Refused(f"{path}: has no function evaluate(model, settings, quantity, lobe, theta_i, theta_o, phi, h)")
    return module.evaluate


def value_of(evaluate, row, **changed):
    at = {"theta_i": row.theta_i, "theta_o": row.theta_o, "phi": row.phi, "h": row.h, **changed}
    value = evaluate(row.model, row.settings, row.quantity, row.lobe, **at)
    return None if value is None else tuple(float(channel) for channel in value)


def error(value, row):
    """In tolerances; what is no number is infinitely far."""
    worst = max(abs(v - e) for v, e in zip(value, row.expected))
    return worst / row.tolerance if row.tolerance > 0 and math.isfinite(worst) else (0 if worst == 0 else math.inf)


def agrees(evaluate, rows, change=None, factor=None):
    """Whether nine of ten rows hold once the arguments are changed or the values are multiplied."""
    held = 0
    for row in rows:
        value = value_of(evaluate, row, **(change(row) if change else {}))
        scale = factor(row) if factor else 1
        held += error(tuple(v * scale for v in value), row) <= 1
    return held >= 0.9 * len(rows)


FACTORS = {"1 / cos(theta_i): a cosine of the light is included": lambda row: 1 / math.cos(row.theta_i),
           "cos(theta_i): divided by the cosine of the light": lambda row: math.cos(row.theta_i),
           "1 / cos(theta_o): a cosine of the viewer is included": lambda row: 1 / math.cos(row.theta_o),
           "2": lambda row: 2, "1/2": lambda row: 0.5, "pi": lambda row: math.pi, "1/pi": lambda row: 1 / math.pi,
           "2 pi": lambda row: 2 * math.pi, "1/(2 pi)": lambda row: 0.5 / math.pi}
CHANGES = {"the directions exchanged": lambda row: {"theta_i": row.theta_o, "theta_o": row.theta_i, "phi": -row.phi},
           "the fibre turned round (root and tip)": lambda row: {"theta_i": -row.theta_i, "theta_o": -row.theta_o},
           "phi turned by half a circle": lambda row: {"phi": row.phi - math.copysign(math.pi, row.phi)},
           "the sign of h turned": lambda row: {"h": -row.h},
           "the sign of phi turned": lambda row: {"phi": -row.phi},
           "theta as an angle from the tangent": lambda row: {"theta_i": math.pi / 2 - row.theta_i, "theta_o": math.pi / 2 - row.theta_o}}


def cause(evaluate, rows):
    """One single mistake that explains the differences, in words; None where none does."""
    rows = [row for row in rows if not row.hard][:40]
    if not rows:
        return None
    for words, factor in FACTORS.items():
        if agrees(evaluate, rows, factor=factor):
            return f"agrees once multiplied by {words}"
    for words, change in CHANGES.items():
        if agrees(evaluate, rows, change=change):
            return f"agrees with {words}"
    return None


def judge(evaluate, rows):
    """One result for each column of the table: how many rows hold, and the worst."""
    columns = {}
    for row in rows:
        value = value_of(evaluate, row)
        if value is not None:
            columns.setdefault(row.column(), []).append((error(value, row), value, row))
    results = []
    for name, judged in columns.items():
        held = sum(at[0] <= 1 for at in judged)
        result = {"column": name, "rows": len(judged), "held": held, "worst": sorted(judged, key=lambda at: -at[0])}
        result["cause"] = cause(evaluate, [row for _, _, row in judged]) if held < len(judged) else None
        results.append(result)
    return results


def show(results, worst):
    for result in results:
        print(f"{result['column']:<34} {result['held']} of {result['rows']} within tolerance")
        if result["cause"]:
            print(f"    {result['cause']}")
        for off, value, row in result["worst"][:worst]:
            if off > 1:
                print(f"    {off:.3g} tolerances off at {row.words}: {value[0]:.6g}, expected {row.expected[0]:.6g} ({','.join(f'{k}={v}' for k, v in row.settings.items())})")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("table")
    parser.add_argument("--with", dest="adapter", required=True, help="Python file with the function evaluate")
    parser.add_argument("--json", action="store_true", help="machine-readable results")
    parser.add_argument("--worst", type=int, default=2, help="rows to show of each column that does not hold (default: 2)")
    arguments = parser.parse_args()
    rows = read_table(arguments.table)
    results = judge(load_adapter(arguments.adapter), rows)
    if not results:
        raise Refused(f"{arguments.adapter}: offers none of the values of {arguments.table}")
    if arguments.json:
        kept = [{key: result[key] for key in ("column", "rows", "held", "cause")} | {"worst": min(result["worst"][0][0], 1e300)} for result in results]
        print(json.dumps(kept, indent=1))
    else:
        show(results, arguments.worst)
    return 0 if all(result["held"] == result["rows"] for result in results) else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Refused as refused:
        print(f"conformance: {refused}", file=sys.stderr)
        sys.exit(3)
