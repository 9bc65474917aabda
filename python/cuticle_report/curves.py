"""Plots that a study brings along as curves: over an axis, or polar over an angle in degrees (study/README.md)."""
import math

import plotly.graph_objects as plotly

from .figures import COLORS, LOBE_COLORS

DECADES = 5  # shown of a polar plot, below its largest value
MOST_COLORED, OTHERS = 6, "#9a9a9a"  # curves of a plot
PLOT_PIXELS, LABEL_PIXELS = 340, 14  # heights of the axis and of a name
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


def lowest(plot):
    """Places of the six curves that end lowest: the most exact, where errors are drawn."""
    ends = [curve["y"][-1] if curve["y"] else math.inf for curve in plot["curves"]]
    return sorted(range(len(ends)), key=ends.__getitem__)[:MOST_COLORED]


def label_ends(figure, plot, colors):
    """The name of each curve beside its last point, moved so far up or down that no name covers another."""
    scale = (lambda value: math.log10(max(value, 1e-300))) if plot.get("logarithmic") else float
    values = [scale(value) for curve in plot["curves"] for value in curve["y"] if value > 0 or not plot.get("logarithmic")]
    per_pixel = (max(values) - min(values) or 1) / PLOT_PIXELS
    ends = sorted((scale(curve["y"][-1]), place) for place, curve in enumerate(plot["curves"]) if curve["y"])
    reached = -math.inf
    for value, place in ends:
        height = max(value / per_pixel, reached + LABEL_PIXELS)
        reached = height
        figure.add_annotation(x=1, xref="paper", y=value, text=plot["curves"][place]["name"], font={"color": colors[place], "size": 11}, showarrow=False,
                              xanchor="left", xshift=4, yshift=height - value / per_pixel)
    figure.update_layout(showlegend=False, margin={"r": 20 + 7 * max(len(curve["name"]) for curve in plot["curves"])})


def interactive(plot):
    """The same as a plotly figure. Of more than six curves six have a colour, the rest are grey, and all have their names at their ends."""
    figure, largest, looks = plotly.Figure(), largest_of(plot), looks_of(plot)
    is_crowded = len(plot["curves"]) > MOST_COLORED and not plot["polar"]
    if is_crowded:
        colored = dict(zip(lowest(plot), COLORS))
        looks = [(colored.get(place, OTHERS), "solid") for place in range(len(looks))]
    for (color, dash), curve in zip(looks, plot["curves"]):
        line = {"color": color, "dash": dash}
        if plot["polar"]:
            figure.add_scatterpolar(theta=curve["x"], r=radii(curve["y"], largest), name=curve["name"], mode="lines", line=line)
        else:
            figure.add_scatter(x=curve["x"], y=curve["y"], name=curve["name"], mode="lines", line=line)
    figure.update_layout(template="plotly_white", height=420, title=plot["title"], margin={"l": 70, "r": 20, "t": 60, "b": 60})
    if is_crowded:
        label_ends(figure, plot, [color for color, _ in looks])
    if plot["polar"]:
        figure.update_layout(polar={"radialaxis": {"tickvals": list(range(1, DECADES + 1)), "ticktext": polar_labels(largest)}})
    else:
        scale = "log" if plot.get("logarithmic") else "linear"
        figure.update_xaxes(title=plot["x_label"], type=scale)
        figure.update_yaxes(title=plot["y_label"], type=scale)
    return figure
