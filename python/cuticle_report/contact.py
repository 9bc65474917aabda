"""Error against the distance to the nearest occluder: how well a method draws the shadow where hairs touch."""
import csv
import math

import plotly.graph_objects as plotly

from . import curves, look, page

MOST_ROWS = 10000
LEAST_RECEIVERS = 5  # a mean of fewer says nothing


def read(path):
    """Rows of contact.csv as numbers where they are numbers."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = [row for _, row in zip(range(MOST_ROWS), csv.DictReader(file))]
    return [{key: value if key in ("method", "settings") else float(value) for key, value in row.items()} for row in rows]


def finest(rows, study):
    """The rows of each curve of the page's first figure at its finest map, by its name."""
    found = {}
    for name, drawn in study.curves().items():
        last = drawn[-1]
        found[name] = [row for row in rows if row["method"] == last["method"] and row["settings"] == last.get("settings", "") and row["receivers"] >= LEAST_RECEIVERS]
    return {name: of for name, of in found.items() if of}


def range_of(row):
    return f"over {row['from_mm']:g}" if math.isinf(row["to_mm"]) else f"{row['from_mm']:g} to {row['to_mm']:g}"


def figure_of(found):
    """A curve a method, with intervals, its name at its end."""
    figure = plotly.Figure()
    ranges = list({range_of(row): row["receivers"] for row in sorted((row for of in found.values() for row in of), key=lambda row: row["from_mm"])}.items())
    for color, (name, of) in zip(look.COLORS, found.items()):
        figure.add_scatter(x=[[each for each, _ in ranges].index(range_of(row)) for row in of], y=[row["mean_error"] for row in of], name=name, mode="lines+markers",
                           line={"color": color}, error_y={"type": "data", "array": [row["mean_interval"] for row in of], "thickness": 1, "width": 2})
    look.dress(figure, 420, 20 + 7 * max(map(len, found)))
    top = max(row["mean_error"] + row["mean_interval"] for of in found.values() for row in of)
    curves.label_ends(figure, {"curves": [{"name": name, "y": [0, top, *(row["mean_error"] for row in of)]} for name, of in found.items()]}, look.COLORS)
    figure.update_xaxes(title="distance to the nearest occluder, mm (points)", tickvals=list(range(len(ranges))), ticktext=[f"{each}<br>({count:.0f})" for each, count in ranges])
    figure.update_yaxes(title="mean |error| of transmittance", range=[0, top])
    figure.update_layout(showlegend=False)
    return figure


def sections(study, folder):
    """The section with the figure, where the study has such distances and is drawn along the resolution."""
    path = folder / "contact.csv"
    found = finest(read(path), study) if study.by_resolution() and path.exists() else {}
    if not found:
        return []
    return [page.Section("Near the occluder", "Shadowed points alone, by the distance to the nearest fibre towards the light; each method at its finest map of the figure above, with 95 % intervals.",
                         figures=[figure_of(found)])]
