"""Plots that a study brings along as curves: over an axis, or polar over an angle in degrees (study/README.md)."""
import math

import plotly.graph_objects as plotly

from .figures import COLORS, LOBE_COLORS

DECADES = 5  # shown of a polar plot, below its largest value
DASHES = ("solid", "dash", "dot", "dashdot")
LOOKS = [(color, dash) for dash in DASHES for color in COLORS]  # of a plot's curves, in turn


def looks_of(plot):
    """Colour and dash of each curve: a lobe has its own colour, as has what is expected of it, dashed."""
    looks = []
    for place, curve in enumerate(plot["curves"]):
        lobe, _, rest = curve["name"].partition(" ")
        looks.append((LOBE_COLORS[lobe], "dash" if rest else "solid") if lobe in LOBE_COLORS else LOOKS[place % len(LOOKS)])
    return looks


def radii(values, largest):
    """Decades above the floor of a polar plot; 0 for what lies below it."""
    return [max(0.0, math.log10(max(value, 1e-300) / largest) + DECADES) for value in values]


def largest_of(plot):
    return max((max(curve["y"], default=0) for curve in plot["curves"]), default=0) or 1


def polar_labels(largest):
    return [f"{largest * 10.0 ** (decade - DECADES):.1g}" for decade in range(1, DECADES + 1)]


def interactive(plot):
    """The same as a plotly figure."""
    figure, largest = plotly.Figure(), largest_of(plot)
    for (color, dash), curve in zip(looks_of(plot), plot["curves"]):
        line = {"color": color, "dash": dash}
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
