"""Error against time of a group: interactive (plotly), and as PDF and SVG at column width (matplotlib)."""
import io
import itertools

from matplotlib import pyplot
import plotly.graph_objects as plotly

from . import results
from .figures import COLORS

MOST_CURVES = 6
CAPTION = "Bars: 95 % intervals. Broad grey line: the front of all points."
COLUMN_INCHES = 3.33
PRINT = {"font.size": 7, "axes.labelsize": 7, "xtick.labelsize": 6, "ytick.labelsize": 6, "pdf.fonttype": 42, "svg.fonttype": "path", "svg.hashsalt": "cuticle"}


def curves(group):
    """At most six methods, by name, each with its points by time: those with most points on the front, then the most exact."""
    methods = {}
    for point in group.drawable():
        methods.setdefault(point.method, []).append(point)
    front = group.front

    def rank(name):
        points = methods[name]
        return -sum(point.name in front for point in points), min(point.error(group.metric)["value"] for point in points)
    chosen = sorted(methods, key=rank)[:MOST_CURVES]
    return {name: sorted(methods[name], key=lambda point: point.seconds["value"]) for name in methods if name in chosen}


def others(group):
    shown = curves(group)
    return [point for point in group.drawable() if point.method not in shown]


def front_of(group):
    return sorted((point for point in group.drawable() if point.name in group.front), key=lambda point: point.seconds["value"])


def bars(points, values, factor):
    """Lengths of the intervals, up and down; none where there is no interval."""
    up = [max(0, (value["high"] - value["value"]) * factor) if value["high"] is not None else 0 for value in values]
    down = [max(0, (value["value"] - value["low"]) * factor) if value["high"] is not None else 0 for value in values]
    return up, down


def hover(point, group, factor, unit):
    error = point.error(group.metric)
    interval = f" ({results.shown(error['low'])} .. {results.shown(error['high'])})" if error["high"] is not None else ""
    lines = [f"<b>{point.method}</b>"] + [f"{name} = {value}" for name, value in point.knobs.items()]
    lines += [f"error {results.shown(error['value'])}{interval}", f"time {results.shown(point.seconds['value'] * factor)} {unit}, {point.samples} samples"]
    return "<br>".join(lines + ([f"{point.bytes:,.0f} bytes"] if point.bytes else []))


def tick_step(values):
    """Every power of ten where there are many, 1, 2 and 5 too where there are few, plotly's own within one."""
    span = max(values, default=1) / max(min(values, default=1), 1e-300)
    return 1 if span > 300 else "D2" if span > 8 else None


def interactive(group, cost_label):
    """A plotly figure: curves labelled at their ends, the rest as grey points, the front as a broad line."""
    figure = plotly.Figure()
    factor, unit = results.unit_of([point.seconds["value"] for point in group.drawable()])
    front = front_of(group)
    figure.add_scatter(x=[p.seconds["value"] * factor for p in front], y=[p.error(group.metric)["value"] for p in front], mode="lines", hoverinfo="skip",
                       line={"color": "rgba(128,128,128,0.3)", "width": 9, "shape": "hv"}, showlegend=False)
    rest = others(group)
    figure.add_scatter(x=[p.seconds["value"] * factor for p in rest], y=[p.error(group.metric)["value"] for p in rest], mode="markers", showlegend=False,
                       marker={"color": "rgba(128,128,128,0.5)", "size": 5}, hovertext=[hover(p, group, factor, unit) for p in rest], hoverinfo="text")
    sides = itertools.cycle(("bottom right", "top right"))  # beside an interval's bar, not on it
    for color, side, (name, points) in zip(COLORS, sides, curves(group).items()):
        seconds, errors = [p.seconds for p in points], [p.error(group.metric) for p in points]
        (right, left), (up, down) = bars(points, seconds, factor), bars(points, errors, 1)
        figure.add_scatter(x=[s["value"] * factor for s in seconds], y=[e["value"] for e in errors], mode="lines+markers+text", name=name, showlegend=False,
                           line={"color": color, "width": 2}, marker={"size": 7},
                           text=[""] * (len(points) - 1) + [name], textposition=side, textfont={"color": color, "size": 12}, cliponaxis=False,
                           error_x={"array": right, "arrayminus": left, "thickness": 1, "width": 2},
                           error_y={"array": up, "arrayminus": down, "thickness": 1, "width": 2},
                           hovertext=[hover(p, group, factor, unit) for p in points], hoverinfo="text")
    figure.update_layout(height=440, margin={"l": 75, "r": 170, "t": 15, "b": 55}, paper_bgcolor="rgba(0,0,0,0)", plot_bgcolor="rgba(0,0,0,0)", modebar={"bgcolor": "rgba(0,0,0,0)", "color": "rgba(128,128,128,0.6)"})
    figure.update_xaxes(title=f"{cost_label}, {unit}", type="log", gridcolor="rgba(128,128,128,0.2)", exponentformat="power",
                        dtick=tick_step([point.seconds["value"] for point in group.drawable()]))
    figure.update_yaxes(title=group.raw["metrics"][0]["label"], type="log", gridcolor="rgba(128,128,128,0.2)", exponentformat="power",
                        dtick=tick_step([point.error(group.metric)["value"] for point in group.drawable()]))
    return figure


def printed(group, cost_label):
    """The same at column width: the bytes of a PDF with its fonts embedded, and of an SVG with its letters as outlines."""
    factor, unit = results.unit_of([point.seconds["value"] for point in group.drawable()])
    with pyplot.rc_context(PRINT):
        figure, axes = pyplot.subplots(figsize=(COLUMN_INCHES, 2.4), layout="constrained")
        front = front_of(group)
        axes.step([p.seconds["value"] * factor for p in front], [p.error(group.metric)["value"] for p in front], where="post", color="#cccccc", linewidth=4, zorder=0)
        for color, (name, points) in zip(COLORS, curves(group).items()):
            x, y = [p.seconds["value"] * factor for p in points], [p.error(group.metric)["value"] for p in points]
            axes.plot(x, y, "o-", color=color, linewidth=1, markersize=2.5)
            axes.annotate(name, (x[-1], y[-1]), xytext=(3, 0), textcoords="offset points", color=color, fontsize=6, va="center", annotation_clip=False)
        axes.set(xscale="log", yscale="log", xlabel=f"{cost_label}, {unit}", ylabel=group.raw["metrics"][0]["label"])
        axes.margins(x=0.2)
        axes.spines[["top", "right"]].set_visible(False)
        files = {}
        for kind, metadata in (("pdf", {"CreationDate": None}), ("svg", {"Date": None})):
            buffer = io.BytesIO()
            figure.savefig(buffer, format=kind, metadata=metadata)
            files[kind] = buffer.getvalue()
        pyplot.close(figure)
    return files
