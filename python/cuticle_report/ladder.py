"""The ladder of a scene: what each rung adds to the picture and to its light, and how far the picture is from the truth after it."""
import math

from matplotlib import pyplot
import plotly.graph_objects as plotly

from . import look, results
from .pareto import files_of

CAPTION = ("Relative MSE, without what the noise of path tracing adds; bars are 95 % intervals over tiles of 8 x 8 pixels. An arrow: not told from zero, it stands at the end of the "
           "interval. Light: the same of the tiles' means, so of where how much light is, whatever single pixels show. Above: time of one frame.")
SHOWN = {"added": ("a rung adds to pixels", "#1f5fa8", "circle", "o", 0.0), "light": ("a rung adds to light", "#d9730d", "diamond", "D", 0.18), "picture": ("against the truth", "#a8324a", "line-ew", "s", 0.0)}
LEAST = 1e-5  # of the axis: what is below is nothing


def is_ladder(group):
    return any(metric["name"] == "added" for metric in group.raw["metrics"])


def metrics(group):
    return [name for name in SHOWN if any(metric["name"] == name for metric in group.raw["metrics"])]


def names(group):
    return [point.method.replace("_", " ") for point in group.points]


def is_told(error):
    """Whether the interval leaves out zero."""
    return error["value"] is not None and error["value"] > LEAST and (error["low"] or 0) > 0


def places(group, metric):
    """Of each rung the height, the lengths of the interval up and down, and whether it is told from zero."""
    found = []
    for point in group.points:
        error = point.error(metric)
        high = error["high"] or error["value"] or 0
        if is_told(error):
            found.append((error["value"], high - error["value"], error["value"] - max(error["low"], 0.2 * error["value"]), True))
        else:
            found.append((max(high, LEAST), 0, 0, False))
    return found


def times(group):
    found = []
    for point in group.points:
        seconds = point.seconds["value"] if point.seconds else None
        factor, unit = (1, "s") if seconds is None or seconds >= 1 else results.unit_of([seconds])
        found.append(f"{results.shown(seconds * factor, 2)} {unit}" if seconds else "")
    return found


def strip(study, group):
    """The pictures of a ladder from the truth on: file, name of the rung, time of a frame, relative MSE so far in words."""
    files = {picture["title"]: picture["file"] for picture in study.raw["pictures"]}
    steps = [("path_tracing", "", "truth")]
    for point, time in zip(group.points, times(group)):
        error = point.error("picture")
        told = f"MSE {results.shown(error['value'], 2)}" if is_told(error) else "within the noise"
        steps.append((point.method, time, told))
    found = [(files.get(f"{group.raw['name']}: {name}"), name.replace("_", " "), time, told) for name, time, told in steps]
    return found if all(file for file, *_ in found) else []


def hover(group, metric, point):
    error = point.error(metric)
    return (f"<b>{point.method.replace('_', ' ')}</b><br>{SHOWN[metric][0]}: {results.shown(error['value'])} ({results.shown(error['low'])} .. {results.shown(error['high'])})")


def bounds(group):
    heights = [height for metric in metrics(group) for height, _, _, _ in places(group, metric)]
    return max(LEAST, 0.5 * min(heights)), 2 * max(heights)


def named_ends(group, lines):
    """Heights, names and colours of the curves where they end, at least one of so many lines apart."""
    low, high = bounds(group)
    step = (high / low) ** (1 / lines)
    apart = []
    for height, metric in sorted((places(group, metric)[-1][0], metric) for metric in metrics(group)):
        apart.append((max(height, apart[-1][0] * step) if apart else height, SHOWN[metric][0], SHOWN[metric][1]))
    return apart


def interactive(group, _cost_label):
    figure = plotly.Figure()
    labels = names(group)
    for metric in metrics(group):
        text, color, symbol, _, shift = SHOWN[metric]
        spots = places(group, metric)
        symbols = [("circle" if metric == "picture" else symbol) if told else "triangle-down-open" for _, _, _, told in spots]
        figure.add_scatter(x=[k + shift for k in range(len(labels))], y=[spot[0] for spot in spots], name=text, mode="lines+markers" if metric == "picture" else "markers",
                           line={"color": color, "width": 1.5}, marker={"size": 9 if metric != "picture" else 6, "symbol": symbols, "color": color},
                           error_y={"array": [spot[1] for spot in spots], "arrayminus": [spot[2] for spot in spots], "thickness": 1.2, "width": 3},
                           hovertext=[hover(group, metric, point) for point in group.points], hoverinfo="text")
    look.dress(figure, 460, 160, 40, 95)
    for place, text in enumerate(times(group)):
        figure.add_annotation(x=place, y=1.05, yref="paper", text=text, showarrow=False, font={"size": 11})
    for height, text, color in named_ends(group, 22):
        figure.add_annotation(x=1, xref="paper", y=math.log10(height), text=text, showarrow=False, xanchor="left", xshift=4, font={"color": color, "size": 12})
    low, high = bounds(group)
    figure.update_xaxes(tickvals=list(range(len(labels))), ticktext=labels, tickangle=-35, range=[-0.6, len(labels) - 0.4])
    figure.update_yaxes(title="relative MSE", type="log", range=[math.log10(low), math.log10(high)], dtick=1)
    return figure


def printed(group, _cost_label):
    """The same at column width."""
    labels = names(group)
    with look.printing():
        figure, axes = pyplot.subplots(figsize=(look.COLUMN_INCHES, 2.6), layout="constrained")
        for metric in metrics(group):
            _, color, _, marker, shift = SHOWN[metric]
            spots = places(group, metric)
            across = [k + shift for k in range(len(labels))]
            if metric == "picture":
                axes.plot(across, [spot[0] for spot in spots], "-", color=color, linewidth=0.8)
            for told in (True, False):
                some = [(x, *spot[:3]) for x, spot in zip(across, spots) if spot[3] == told]
                if not some:
                    continue
                x, y, up, down = zip(*some)
                axes.errorbar(x, y, yerr=(down, up) if told else None, fmt=marker if told else "v", color=color, markersize=3 if metric != "picture" else 2, markerfacecolor=color if told else "white",
                              linewidth=0.7, markeredgewidth=0.7)
        for place, text in enumerate(times(group)):
            axes.annotate(text, (place, 1), xycoords=("data", "axes fraction"), xytext=(0, 3 + 6 * (place % 2)), textcoords="offset points", ha="center", fontsize=5)
        axes.set(yscale="log", ylabel="relative MSE", ylim=bounds(group), xlim=(-0.6, len(labels) - 0.4))
        for height, text, color in named_ends(group, 11):
            axes.annotate(text.replace(" adds to", "\nadds to").replace("against", "against\n"), (1, height), xycoords=("axes fraction", "data"), xytext=(2, 0), textcoords="offset points", fontsize=5.5, color=color, va="center")
        axes.set_xticks(range(len(labels)), labels, rotation=35, ha="right")
        return files_of(figure)
