"""Plots that a study brings along as curves: over an axis, or polar over an angle in degrees (study/README.md)."""
import math

import plotly.graph_objects as plotly

from . import look

DECADES = 5  # shown of a polar plot, below its largest value
MARKS = [("o", "circle"), ("s", "square"), ("^", "triangle-up"), ("D", "diamond")]  # of matplotlib and of plotly: hollow, each larger than the one before, so that all show where they coincide
PLOT_PIXELS, LABEL_PIXELS = 340, 14  # heights of the axis and of a name


def looks_of(plot):
    """Colour and dash of each curve: a lobe has its own colour, as has what is expected of it, dashed. Of more than six curves six have a colour, the rest are grey."""
    colored = dict(zip(lowest(plot) if is_crowded(plot) else range(look.MOST_CURVES), look.COLORS))
    looks = []
    for place, curve in enumerate(plot["curves"]):
        lobe, _, rest = curve["name"].partition(" ")
        is_lobe = lobe in look.LOBE_COLORS and not is_crowded(plot)
        looks.append((look.LOBE_COLORS[lobe], "dash" if rest else "solid") if is_lobe else (colored.get(place, look.OTHERS), "solid"))
    if any(curve["name"] == "measurement" for curve in plot["curves"]):
        return [(look.SUBJECT_COLORS.get(curve["name"], found[0]), found[1]) for curve, found in zip(plot["curves"], looks)]
    return looks


def is_crowded(plot):
    return len(plot["curves"]) > look.MOST_CURVES


def radii(values, largest):
    """Decades above the floor of a polar plot; 0 for what lies below it."""
    return [max(0.0, math.log10(max(value, 1e-300) / largest) + DECADES) for value in values]


def is_logarithmic(plot, axis):
    """Whether its axis "x" or "y" is logarithmic."""
    return bool(plot.get("logarithmic") or plot.get(f"logarithmic_{axis}"))


def counts_of(plot):
    """The values of x where they are a few whole numbers, as modes are: the only ticks; else none."""
    values = sorted({value for curve in plot["curves"] for value in curve["x"]})
    return values if not is_logarithmic(plot, "x") and len(values) <= 8 and all(value == round(value) for value in values) else []


def largest_of(plot):
    return max((max(curve["y"], default=0) for curve in plot["curves"]), default=0) or 1


def polar_labels(largest):
    return [f"{largest * 10.0 ** (decade - DECADES):.1g}" for decade in range(1, DECADES + 1)]


def lowest(plot):
    """Places of the six curves that end lowest: the most exact, where errors are drawn."""
    ends = [curve["y"][-1] if curve["y"] else math.inf for curve in plot["curves"]]
    return sorted(range(len(ends)), key=ends.__getitem__)[:look.MOST_CURVES]


def label_ends(figure, plot, colors):
    """The name of each curve right of the axis at the height of its last point, moved so far up or down that no name covers another."""
    logarithmic = is_logarithmic(plot, "y")
    scale = (lambda value: math.log10(max(value, 1e-300))) if logarithmic else float
    values = [scale(value) for curve in plot["curves"] for value in curve["y"] if value > 0 or not logarithmic] or [0.0]
    per_pixel = (max(values) - min(values) or 1) / PLOT_PIXELS
    ends = sorted((max(scale(curve["y"][-1]), min(values)), place) for place, curve in enumerate(plot["curves"]) if curve["y"])
    reached = -math.inf
    for value, place in ends:
        height = max(value / per_pixel, reached + LABEL_PIXELS)
        reached = height
        figure.add_annotation(x=1, xref="paper", y=value, text=plot["curves"][place]["name"], font={"color": colors[place], "size": 11}, showarrow=False,
                              xanchor="left", xshift=4, yshift=height - value / per_pixel)


def label_peaks(figure, plot, colors, largest):
    """The name of each curve of a polar plot outside its farthest point; of those that stand farthest at one place side by side."""
    taken = {}
    for curve, color in zip(plot["curves"], colors):
        peak = max(range(len(curve["y"])), key=curve["y"].__getitem__)
        angle, radius = curve["x"][peak], radii(curve["y"], largest)[peak]
        row = taken[round(angle / 30) % 12] = taken.get(round(angle / 30) % 12, 0) + 1
        figure.add_scatterpolar(theta=[angle + 5 * (row - 1)], r=[radius + 0.25 + 0.3 * (row - 1)], mode="text", text=[curve["name"]], textfont={"color": color, "size": 13},
                                hoverinfo="skip", cliponaxis=False)


def polar(plot):
    figure, largest, looks = plotly.Figure(), largest_of(plot), looks_of(plot)
    for (color, dash), curve in zip(looks, plot["curves"]):
        figure.add_scatterpolar(theta=curve["x"], r=radii(curve["y"], largest), name=curve["name"], mode="lines", line={"color": color, "dash": dash, "width": 2})
    look.dress(figure, 440, 60, 45, 35)
    label_peaks(figure, plot, [color for color, _ in looks], largest)
    figure.add_annotation(x=0, y=1.08, xref="paper", yref="paper", xanchor="left", showarrow=False, text=f"{plot['y_label']} (logarithmic) over {plot['x_label']}")
    figure.update_layout(polar={"bgcolor": look.CLEAR, "angularaxis": {"gridcolor": look.GRID, "linecolor": look.GRID, "ticksuffix": "°"},
                                "radialaxis": {"range": [0, DECADES + 0.6], "tickvals": list(range(1, DECADES + 1)), "ticktext": polar_labels(largest), "gridcolor": look.GRID,
                                               "linecolor": look.GRID, "angle": 90, "tickangle": 90, "tickfont": {"size": 10}}})
    return figure


def interactive(plot):
    """The same as a plotly figure, every curve with its name beside it."""
    if plot["polar"]:
        return polar(plot)
    figure, looks = plotly.Figure(), looks_of(plot)
    for place, ((color, dash), curve) in enumerate(zip(looks, plot["curves"])):
        width = 1.2 if color == look.OTHERS else 2
        marks = {"symbol": f"{MARKS[place % len(MARKS)][1]}-open", "color": color, "size": 7 + 2 * place, "line": {"width": 1.5}}
        figure.add_scatter(x=curve["x"], y=curve["y"], name=curve["name"], mode="markers" if curve.get("marks") else "lines", line={"color": color, "dash": dash, "width": width},
                           marker=marks)
    look.dress(figure, 420, 20 + 7 * max(len(curve["name"]) for curve in plot["curves"]))
    label_ends(figure, plot, [color for color, _ in looks])
    for update, label, along in ((figure.update_xaxes, plot["x_label"], "x"), (figure.update_yaxes, plot["y_label"], "y")):
        scale = "log" if is_logarithmic(plot, along) else "linear"
        update(title=label, type=scale, **(look.log_ticks([value for curve in plot["curves"] for value in curve[along]]) if scale == "log" else {}))
    if counts_of(plot):
        figure.update_xaxes(tickvals=counts_of(plot))
    return figure
