"""Plots that a study brings along as curves: over an axis, or polar over an angle in degrees (study/README.md)."""
import math
import os

from matplotlib import pyplot
import plotly.graph_objects as plotly

from . import ReportError, page
from .figures import COLORS, LOBE_COLORS

DECADES = 5  # shown of a polar plot, below its largest value
LEGEND_ROWS = 22  # that a PNG has room for
DASHES = {"-": "solid", "--": "dash", ":": "dot", "-.": "dashdot"}  # matplotlib's names, plotly's names
LOOKS = [(color, dash) for dash in DASHES for color in COLORS]  # of a plot's curves, in turn


def looks_of(plot):
    """Colour and dash of each curve: a lobe has its own colour, as has what is expected of it, dashed."""
    looks = []
    for place, curve in enumerate(plot["curves"]):
        lobe, _, rest = curve["name"].partition(" ")
        looks.append((LOBE_COLORS[lobe], "--" if rest else "-") if lobe in LOBE_COLORS else LOOKS[place % len(LOOKS)])
    return looks


def radii(values, largest):
    """Decades above the floor of a polar plot; 0 for what lies below it."""
    return [max(0.0, math.log10(max(value, 1e-300) / largest) + DECADES) for value in values]


def largest_of(plot):
    return max((max(curve["y"], default=0) for curve in plot["curves"]), default=0) or 1


def polar_labels(largest):
    return [f"{largest * 10.0 ** (decade - DECADES):.1g}" for decade in range(1, DECADES + 1)]


def save_png(plot, path):
    """A PNG with labelled axes and a legend beside the plot."""
    polar, largest = plot["polar"], largest_of(plot)
    columns = -(-len(plot["curves"]) // LEGEND_ROWS)
    figure, axes = pyplot.subplots(figsize=(4.8 + 2.2 * columns, 4.5), layout="constrained", subplot_kw={"projection": "polar" if polar else None})
    for (color, dash), curve in zip(looks_of(plot), plot["curves"]):
        x = [math.radians(value) for value in curve["x"]] if polar else curve["x"]
        axes.plot(x, radii(curve["y"], largest) if polar else curve["y"], color=color, linestyle=dash, linewidth=1.3, label=curve["name"])
    if polar:
        axes.set_rgrids(range(1, DECADES + 1), polar_labels(largest), fontsize=7)
        axes.set_xlabel(f"angle: {plot['x_label']}; radius: {plot['y_label']}")
    else:
        scale = "log" if plot.get("logarithmic") else "linear"
        axes.set(xlabel=plot["x_label"], ylabel=plot["y_label"], xscale=scale, yscale=scale)
        axes.grid(alpha=0.3)
    axes.set_title(plot["title"], fontsize=11)
    figure.legend(loc="outside right upper", fontsize=8, ncols=max(columns, 1))
    temporary = path.with_name(f".{path.stem}.{os.getpid()}.png")
    try:
        figure.savefig(temporary, dpi=110)
        temporary.replace(path)
    finally:
        pyplot.close(figure)
        temporary.unlink(missing_ok=True)


def interactive(plot):
    """The same as a plotly figure."""
    figure, largest = plotly.Figure(), largest_of(plot)
    for (color, dash), curve in zip(looks_of(plot), plot["curves"]):
        line = {"color": color, "dash": DASHES[dash]}
        if plot["polar"]:
            figure.add_scatterpolar(theta=curve["x"], r=radii(curve["y"], largest), name=curve["name"], mode="lines", line=line)
        else:
            figure.add_scatter(x=curve["x"], y=curve["y"], name=curve["name"], mode="lines", line=line)
    figure.update_layout(template="plotly_white", height=420, title=plot["title"], margin={"l": 70, "r": 20, "t": 60, "b": 60})
    if plot["polar"]:
        figure.update_layout(polar={"radialaxis": {"tickvals": list(range(1, DECADES + 1)), "ticktext": polar_labels(largest)}})
    else:
        scale = "log" if plot.get("logarithmic") else "linear"
        figure.update_xaxes(title=plot["x_label"], type=scale)
        figure.update_yaxes(title=plot["y_label"], type=scale)
    return figure


def landmark_section(raw):
    rows = [[mark["model"], mark["what"], round(mark["expected_deg"], 3), round(mark["measured_deg"], 3)] for mark in raw["landmarks"]]
    return page.Section("Places that the literature names", "", columns=["model", "what", "expected, degrees", "measured, degrees"], rows=rows)


def sections(raw, folder):
    """Sections for the curves and landmarks that the study has; their PNGs go into the folder."""
    plots = [plot for plot in raw.get("plots", []) if plot["curves"]]
    for plot in plots:
        if not {"name", "title", "x_label", "y_label", "polar"} <= plot.keys():
            raise ReportError(f"study.json: plot {plot.get('name', '?')}: a key is missing")
        save_png(plot, folder / f"{plot['name']}.png")
    found = [landmark_section(raw)] if raw.get("landmarks") else []
    return found + ([page.Section("Curves", "", figures=[interactive(plot) for plot in plots])] if plots else [])
