"""How times grow: groups without errors, whose points have one size each, as the number of strands."""
from . import knobs, look, results

LEAST_SIZES = 3
STEEP = 1.05  # an exponent from which on a thing grows faster than its size


def knob_of(group):
    return next(iter(group.points[0].knobs))


def is_of(group):
    return not group.metric and bool(group.points) and all(list(point.knobs) == [knob_of(group)] and knobs.number(point.knobs[knob_of(group)]) and point.seconds for point in group.points) and len(sizes(group)) >= LEAST_SIZES


def sizes(group):
    return sorted({float(point.knobs[knob_of(group)]) for point in group.points})


def curves(group):
    """Seconds by size of each method."""
    found = {}
    for point in group.points:
        found.setdefault(point.method, {})[float(point.knobs[knob_of(group)])] = point.seconds["value"]
    return found


def exponents(group):
    """Of each method: exponent of time over size, and its standard error."""
    return {fit["method"]: (fit["exponent"], fit["standard_error"]) for fit in group.conclusions["growth"]}


def unit(group):
    return results.unit_of([point.seconds["value"] for point in group.points])


def table(study, group):
    """A row for each method, a column for each size, the fitted exponent last."""
    factor, name = unit(group)
    fits = exponents(group)
    columns = [f"{study.raw['cost_label']}, {name}", *[f"{size:,.0f} {knob_of(group)}" for size in sizes(group)], "exponent"]
    rows = []
    for method, seconds in curves(group).items():
        fit = fits.get(method)
        rows.append([method, *[results.shown(seconds[size] * factor) if size in seconds else "" for size in sizes(group)], f"{fit[0]:.2f} ± {fit[1]:.2f}" if fit else ""])
    return columns, rows


def plots(study):
    """Plots as a study brings them along: the six methods of each group that take longest at the largest size."""
    found = []
    for group in filter(is_of, study.groups):
        factor, name = unit(group)
        longest = sorted(curves(group).items(), key=lambda method: max(method[1].items()), reverse=True)[:look.MOST_CURVES]
        found.append({"name": group.raw["name"].replace(" ", "-"), "title": group.raw["title"], "x_label": knob_of(group), "y_label": f"{study.raw['cost_label']}, {name}", "polar": False, "logarithmic": True,
                      "curves": [{"name": method, "x": sorted(seconds), "y": [seconds[size] * factor for size in sorted(seconds)]} for method, seconds in longest]})
    return found


def steep(group):
    """Methods that grow faster than their size, by more than a standard error, with their fits."""
    return {method: fit for method, fit in exponents(group).items() if fit[0] - fit[1] > STEEP}


def sentences(group):
    if not (found := steep(group)):
        return [f"Nothing grows faster than the {STEEP} power of the {knob_of(group)}."]
    return [f"{method}: time grows with the {fit[0]:.2f} ± {fit[1]:.2f} power of the {knob_of(group)}." for method, fit in found.items()]
