"""Frames of one scene in two states, as with a feature and without it: what each takes, and how much the cheaper one saves."""
from matplotlib import pyplot
import plotly.graph_objects as plotly

from . import look, results
from .pareto import files_of

CAPTION = "A line for each thing that a scene may have, from the frame without it (ring) to the frame with it (disc); bars are 95 % intervals. Beside it: the share of the frame that is saved without it, or how many times as long the frame takes without it."
WITH, WITHOUT = look.COLORS[0], look.COLORS[1]


def is_of_states(group):
    return bool(group.points) and all(set(point.knobs) == {"state"} and point.seconds for point in group.points)


def pairs(group):
    """Of each method the point with and the point without (of other states the dearer first), those that save most first; methods of one state are left out."""
    by_method = {}
    for point in group.points:
        by_method.setdefault(point.method, []).append(point)
    found = [sorted(points, key=lambda point: (point.knobs["state"] == "off", -point.seconds["value"])) for points in by_method.values() if len(points) == 2]
    return sorted(found, key=saved, reverse=True)


def saved(pair):
    """The share of the first frame's time that the second does not take; below 0: it takes more."""
    return 1 - pair[1].seconds["value"] / pair[0].seconds["value"]


def is_told(pair):
    """Whether the intervals of the two times leave each other out."""
    cheap, dear = sorted((point.seconds for point in pair), key=lambda seconds: seconds["value"])
    return None not in (dear["low"], cheap["high"]) and cheap["high"] < dear["low"]


def label(pair):
    if not is_told(pair):
        return "not told apart"
    return f"{results.shown(100 * saved(pair), 2)} %" if saved(pair) > 0 else f"{results.shown(1 - saved(pair), 2)} times"


def name(pair):
    words = pair[0].method.replace("_", " ")
    states = {point.knobs["state"] for point in pair}
    return words if states == {"on", "off"} else f"{words}: {pair[0].knobs['state']} / {pair[1].knobs['state']}"


def unit(group):
    return results.unit_of([point.seconds["value"] for point in group.points])


def table(study, group):
    factor, shown_unit = unit(group)
    columns = ["thing", "state", f"{study.raw['cost_label']}, {shown_unit}", "low", "high", "state", f"{study.raw['cost_label']}, {shown_unit}", "low", "high", "saved",
               "dispatches and draws", "without", "bytes", "without"]
    rows = []
    for pair in pairs(group):
        row = [pair[0].method.replace("_", " ")]
        for point in pair:
            row += [point.knobs["state"], *[results.shown(point.seconds[key] and point.seconds[key] * factor) for key in ("value", "low", "high")]]
        ran = [f"{point.error(group.metric)['value'] or 0:.0f}" for point in pair]
        rows.append([*row, label(pair), *ran, *[f"{point.bytes:.0f}" for point in pair]])
    return columns, rows


def sentences(group):
    told = [pair for pair in pairs(group) if is_told(pair)]
    if not told or saved(told[0]) <= 0 or any(pair[0].knobs["state"] not in ("on", "off") for pair in told):
        return []
    return [f"Of {len(pairs(group))} features, {len(told)} change the time of a frame for certain; most is saved without {name(told[0])}: {label(told[0])} of the frame."]


def spots(points, factor):
    middles = [point.seconds["value"] * factor for point in points]
    up = [(point.seconds["high"] or point.seconds["value"]) * factor - x for point, x in zip(points, middles)]
    down = [x - (point.seconds["low"] or point.seconds["value"]) * factor for point, x in zip(points, middles)]
    return middles, up, down


def interactive(group, cost_label):
    factor, shown_unit = unit(group)
    rows = pairs(group)
    heights = list(range(len(rows), 0, -1))
    figure = plotly.Figure()
    for height, pair in zip(heights, rows):
        figure.add_scatter(x=[point.seconds["value"] * factor for point in pair], y=[height, height], mode="lines", line={"color": look.OTHERS, "width": 3}, hoverinfo="skip")
    for which, color, symbol in ((1, WITHOUT, "circle-open"), (0, WITH, "circle")):
        points = [pair[which] for pair in rows]
        x, up, down = spots(points, factor)
        figure.add_scatter(x=x, y=heights, mode="markers", marker={"size": 9, "color": color, "symbol": symbol, "line": {"width": 2}},
                           error_x={"array": up, "arrayminus": down, "thickness": 1, "width": 3},
                           hovertext=[f"<b>{name(pair)}</b><br>{point.knobs['state']}: {results.shown(point.seconds['value'] * factor)} {shown_unit}" for pair, point in zip(rows, points)], hoverinfo="text")
    look.dress(figure, 60 + 26 * max(4, len(rows)), 120)
    for height, pair in zip(heights, rows):
        figure.add_annotation(x=1, xref="paper", y=height, text=label(pair), showarrow=False, xanchor="left", xshift=6, font={"size": 12})
    figure.update_layout(margin={"l": 30 + 7 * max(len(name(pair)) for pair in rows)})
    figure.update_xaxes(title=f"{cost_label}, {shown_unit}", rangemode="tozero")
    figure.update_yaxes(tickvals=heights, ticktext=[name(pair) for pair in rows], range=[0.3, len(rows) + 0.7])
    return figure


def printed(group, cost_label):
    """The same at column width."""
    factor, shown_unit = unit(group)
    rows = pairs(group)
    heights = list(range(len(rows), 0, -1))
    with look.printing():
        figure, axes = pyplot.subplots(figsize=(look.COLUMN_INCHES, 0.5 + 0.16 * max(4, len(rows))), layout="constrained")
        for height, pair in zip(heights, rows):
            axes.plot([point.seconds["value"] * factor for point in pair], [height, height], "-", color="#bbbbbb", linewidth=1.5, zorder=0)
            axes.annotate(label(pair), (1, height), xycoords=("axes fraction", "data"), xytext=(3, 0), textcoords="offset points", fontsize=5.5, va="center")
        for which, color, face in ((1, WITHOUT, "white"), (0, WITH, WITH)):
            x, up, down = spots([pair[which] for pair in rows], factor)
            axes.errorbar(x, heights, xerr=(down, up), fmt="o", color=color, markersize=3, markerfacecolor=face, linewidth=0.7)
        axes.set(xlabel=f"{cost_label}, {shown_unit}", ylim=(0.3, len(rows) + 0.7))
        axes.set_xlim(left=0)
        axes.set_yticks(heights, [name(pair) for pair in rows])
        return files_of(figure)
