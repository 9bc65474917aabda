"""The ladder of a scene: what each rung adds to the picture and to its light, and how far the picture is from the truth after it."""
import math

from matplotlib import pyplot
import plotly.graph_objects as plotly

from . import look, results
from .pareto import files_of

CAPTION = ("Relative MSE, without what the noise of path tracing adds; bars are 95 % intervals over tiles of 8 x 8 pixels. An open triangle: not told from zero, it stands at the end of the "
           "interval. Light: the same of the tiles' means, so of where how much light is, whatever single pixels show. At the right: time of one frame, and mean FLIP from the truth, with what noise is left in both.")
SHOWN = {"added": ("added to pixels", "#1f5fa8", "circle", "o", -0.12), "light": ("added to light", "#d9730d", "diamond", "D", 0.18), "picture": ("against the truth", "#a8324a", "square", "s", 0.0)}
LEAST = 1e-5  # of the axis: what is below is nothing
TRUTH = "path_tracing"


def is_ladder(group):
    return any(metric["name"] == "added" for metric in group.raw["metrics"])


def metrics(group):
    return [name for name in SHOWN if any(metric["name"] == name for metric in group.raw["metrics"])]


def rungs(group):
    """The points but the truth itself."""
    return [point for point in group.points if point.method != TRUTH]


def truth(group):
    return next((point for point in group.points if point.method == TRUTH), None)


def names(group):
    return [TRUTH.replace("_", " ")] + [point.method.replace("_", " ") for point in rungs(group)]


def flips(study, group, means):
    """Mean FLIP by rung, of the pictures beside the truth's."""
    files = {picture["title"]: picture["file"] for picture in study.raw["pictures"]}
    found = {point.method: means.get(files.get(f"{group.raw['name']}: {point.method}")) for point in rungs(group)}
    return {name: mean for name, mean in found.items() if mean is not None}


def is_told(error):
    """Whether the interval leaves out zero."""
    return error["value"] is not None and error["value"] > LEAST and (error["low"] or 0) > 0


def places(group, metric):
    """Of each rung the height, the lengths of the interval up and down, and whether it is told from zero."""
    found = []
    for point in rungs(group):
        error = point.error(metric)
        high = error["high"] or error["value"] or 0
        if is_told(error):
            found.append((error["value"], high - error["value"], error["value"] - max(error["low"], 0.2 * error["value"]), True))
        else:
            found.append((max(high, LEAST), 0, 0, False))
    return found


def time_of(point):
    if point is None or not point.seconds:
        return ""
    seconds = point.seconds["value"]
    factor, unit = (1, "s") if seconds >= 1 else results.unit_of([seconds])
    return f"{results.shown(seconds * factor, 2)} {unit}"


def times(group):
    """Of the truth, then of every rung."""
    return [time_of(point) for point in (truth(group), *rungs(group))]


def flip_words(group):
    return [""] + [results.shown(group.flips[point.method], 2) if point.method in group.flips else "" for point in rungs(group)]


def strip(study, group):
    """The pictures of a ladder from the truth on: file, name of the rung, time of a frame, errors so far in words."""
    files = {picture["title"]: picture["file"] for picture in study.raw["pictures"]}
    told = ["truth"]
    for point, flip in zip(rungs(group), flip_words(group)[1:]):
        error = point.error("picture")
        words = f"MSE {results.shown(error['value'], 2)}" if is_told(error) else "MSE within the noise"
        told.append(words + (f", FLIP {flip}" if flip else ""))
    found = [(files.get(f"{group.raw['name']}: {name.replace(' ', '_')}"), name, time, words) for name, time, words in zip(names(group), times(group), told)]
    return found if all(file for file, *_ in found) else []


def hover(metric, point):
    error = point.error(metric)
    return f"<b>{point.method.replace('_', ' ')}</b><br>{SHOWN[metric][0]}: {results.shown(error['value'])} ({results.shown(error['low'])} .. {results.shown(error['high'])})"


def bounds(group):
    """Ends of the axis: marks and their intervals lie between them."""
    spots = [spot for metric in metrics(group) for spot in places(group, metric)]
    low, high = min(height - down for height, _, down, _ in spots), max(height + up for height, up, _, _ in spots)
    return max(0.5 * LEAST, 0.6 * low), 1.2 * high


def interactive(group, _cost_label):
    """A row for each rung, from the truth down; at the right time and FLIP."""
    figure = plotly.Figure()
    labels = names(group)
    for metric in metrics(group):
        text, color, symbol, _, shift = SHOWN[metric]
        spots = places(group, metric)
        symbols = [symbol if told else "triangle-left-open" for _, _, _, told in spots]
        figure.add_scatter(y=[k + 1 + shift for k in range(len(spots))], x=[spot[0] for spot in spots], name=text, mode="lines+markers" if metric == "picture" else "markers",
                           line={"color": color, "width": 1.5}, marker={"size": 9 if metric != "picture" else 6, "symbol": symbols, "color": color},
                           error_x={"array": [spot[1] for spot in spots], "arrayminus": [spot[2] for spot in spots], "thickness": 1.2, "width": 3},
                           hovertext=[hover(metric, point) for point in rungs(group)], hoverinfo="text")
    look.dress(figure, 130 + 30 * len(labels), 160, 50)
    for shift, words in ((0.1, ["one frame", *times(group)]), (0.85, ["FLIP", *flip_words(group)])):
        for row, text in enumerate(words):
            figure.add_annotation(x=1, xref="paper", y=row - 1, text=text, showarrow=False, xanchor="left", xshift=110 * shift, font={"size": 12})
    for k, metric in enumerate(metrics(group)):
        text, color, *_ = SHOWN[metric]
        figure.add_annotation(x=k / len(SHOWN), xref="paper", y=1, yref="paper", text={"added": "● ", "light": "◆ ", "picture": "■ "}[metric] + text, showarrow=False, xanchor="left", yanchor="bottom", yshift=10,
                              font={"color": color, "size": 13})
    low, high = bounds(group)
    figure.update_yaxes(tickvals=list(range(len(labels))), ticktext=labels, range=[len(labels) - 0.5, -1.4], automargin=True)
    figure.update_xaxes(title="relative MSE", type="log", range=[math.log10(low), math.log10(high)], dtick=1)
    return figure


def printed(group, _cost_label):
    """The same at column width."""
    labels = names(group)
    with look.printing():
        figure, axes = pyplot.subplots(figsize=(look.COLUMN_INCHES, 0.8 + 0.17 * len(labels)))
        figure.subplots_adjust(left=0.235, right=0.775, top=0.93, bottom=0.36 / (0.8 + 0.17 * len(labels)))
        for metric in metrics(group):
            _, color, _, marker, shift = SHOWN[metric]
            spots = places(group, metric)
            down = [k + 1 + shift for k in range(len(spots))]
            if metric == "picture":
                axes.plot([spot[0] for spot in spots], down, "-", color=color, linewidth=0.8)
            for told in (True, False):
                some = [(y, *spot[:3]) for y, spot in zip(down, spots) if spot[3] == told]
                if not some:
                    continue
                y, x, up, low = zip(*some)
                axes.errorbar(x, y, xerr=(low, up) if told else None, fmt=marker if told else "<", color=color, markersize=3 if metric != "picture" else 2, markerfacecolor=color if told else "white",
                              linewidth=0.7, markeredgewidth=0.7)
        for place, words in ((1.22, ["frame", *times(group)]), (1.41, ["FLIP", *flip_words(group)])):
            for row, text in enumerate(words):
                axes.annotate(text, (place, row - 1), xycoords=("axes fraction", "data"), ha="right", va="center", fontsize=5.5, annotation_clip=False)
        for k, metric in enumerate(metrics(group)):
            text, color, _, marker, _ = SHOWN[metric]
            axes.plot([0.03 + 0.3 * k], [0.965], marker, color=color, markersize=3, transform=figure.transFigure, clip_on=False)
            axes.annotate(text, (0.05 + 0.3 * k, 0.965), xycoords="figure fraction", va="center", fontsize=6, color=color)
        axes.grid(axis="x", color="#dddddd", linewidth=0.4)
        axes.set_axisbelow(True)
        axes.set(xscale="log", xlabel="relative MSE", xlim=bounds(group), ylim=(len(labels) - 0.5, -1.5))
        axes.set_yticks(range(len(labels)), labels)
        axes.tick_params(axis="y", length=0)
        return files_of(figure)
