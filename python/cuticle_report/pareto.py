"""Error against time of a group: interactive (plotly), and as PDF, SVG and PNG at column width (matplotlib)."""
import io

from matplotlib import pyplot
import plotly.graph_objects as plotly

from . import labels, look, results

CAPTION = "Bars: 95 % intervals. Broad grey line: the front of all points."
FEW_OTHERS = 6  # methods beside the six curves that still have their names


def by_method(group):
    methods = {}
    for point in group.drawable():
        methods.setdefault(point.method, []).append(point)
    return {name: sorted(points, key=lambda point: point.seconds["value"]) for name, points in methods.items()}


def curves(group):
    """At most six methods, by name, each with its points by time: those with most points on the front, then the most exact."""
    methods, front = by_method(group), group.front

    def rank(name):
        points = methods[name]
        return -sum(point.name in front for point in points), min(point.error(group.metric)["value"] for point in points)
    chosen = sorted(methods, key=rank)[:look.MOST_CURVES]
    return {name: methods[name] for name in methods if name in chosen}


def place_of(value):
    """Numbers by size, words behind them."""
    try:
        return 0, float(value), ""
    except ValueError:
        return 1, 0.0, value


def lines(points):
    """The points of a method in lines along the knob that has most values, in the order of its values; the other knobs stand still on a line."""
    values = {}
    for point in points:
        for name, value in point.knobs.items():
            values.setdefault(name, set()).add(value)
    along = max(values, key=lambda name: len(values[name]), default=None)
    found = {}
    for point in points:
        found.setdefault(tuple(item for item in sorted(point.knobs.items()) if item[0] != along), []).append(point)
    return [sorted(line, key=lambda point: place_of(point.knobs.get(along, ""))) for line in found.values()]


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


def places(group, points, factor):
    return [(point.seconds["value"] * factor, point.error(group.metric)["value"]) for point in points]


def named_ends(group, factor):
    """The last point of each curve, its name and colour; of the other methods too, in grey, where they are few."""
    ends = [(*places(group, points[-1:], factor)[0], name, color) for color, (name, points) in zip(look.COLORS, curves(group).items())]
    shown, methods = curves(group), by_method(group)
    rest = [(*places(group, points[-1:], factor)[0], name, look.OTHERS) for name, points in methods.items() if name not in shown]
    return ends + (rest if len(rest) <= FEW_OTHERS else [])


def interactive(group, cost_label):
    """A plotly figure: curves labelled at their ends, the rest as grey points, the front as a broad line."""
    figure = plotly.Figure()
    factor, unit = results.unit_of([point.seconds["value"] for point in group.drawable()])
    front = places(group, front_of(group), factor)  # empty where all of it is without error or time
    x, y = zip(*front) if front else ((), ())
    figure.add_scatter(x=x, y=y, mode="lines", hoverinfo="skip", line={"color": look.FRONT, "width": 9, "shape": "hv"})
    if rest := others(group):
        x, y = zip(*places(group, rest, factor))
        figure.add_scatter(x=x, y=y, mode="markers", marker={"color": "rgba(128,128,128,0.5)", "size": 5}, hovertext=[hover(p, group, factor, unit) for p in rest], hoverinfo="text")
    for color, (name, points) in zip(look.COLORS, curves(group).items()):
        for line in lines(points):
            x, y = zip(*places(group, line, factor))
            figure.add_scatter(x=x, y=y, mode="lines", hoverinfo="skip", line={"color": color, "width": 2})
        seconds, errors = [p.seconds for p in points], [p.error(group.metric) for p in points]
        (right, left), (up, down) = bars(points, seconds, factor), bars(points, errors, 1)
        x, y = zip(*places(group, points, factor))
        figure.add_scatter(x=x, y=y, mode="markers", name=name, marker={"size": 7, "color": color},
                           error_x={"array": right, "arrayminus": left, "thickness": 1, "width": 2}, error_y={"array": up, "arrayminus": down, "thickness": 1, "width": 2},
                           hovertext=[hover(p, group, factor, unit) for p in points], hoverinfo="text")
    name_axes(figure, group, factor, f"{cost_label}, {unit}")
    return figure


def name_axes(figure, group, factor, x_title):
    """Axes with units and ranges, and the names of the curves at their ends."""
    dots = places(group, group.drawable(), factor)
    ends, margin, height = named_ends(group, factor), 150, 440
    across = labels.Scale([x for x, _ in dots], look.PLOT_WIDTH, True)
    up = labels.Scale([y for _, y in dots], height - 75, True, 0.1)
    look.dress(figure, height, margin)
    labels.annotate(figure, ends, across, up, dots, margin)
    figure.update_xaxes(title=x_title, type="log", range=across.range, **look.log_ticks([x for x, _ in dots]))
    figure.update_yaxes(title=group.raw["metrics"][0]["label"], type="log", range=up.range, **look.log_ticks([y for _, y in dots]))


def printed(group, cost_label):
    """The same at column width."""
    factor, unit = results.unit_of([point.seconds["value"] for point in group.drawable()])
    with look.printing():
        figure, axes = pyplot.subplots(figsize=(look.COLUMN_INCHES, 2.4), layout="constrained")
        if front := places(group, front_of(group), factor):
            axes.step(*zip(*front), where="post", color="#cccccc", linewidth=4, zorder=0)
        if rest := others(group):
            axes.plot(*zip(*places(group, rest, factor)), "o", color="#bbbbbb", markersize=1.8)
        for color, points in zip(look.COLORS, curves(group).values()):
            for line in lines(points):
                axes.plot(*zip(*places(group, line, factor)), "o-", color=color, linewidth=1, markersize=2.5)
        axes.set(xscale="log", yscale="log", xlabel=f"{cost_label}, {unit}", ylabel=look.wrapped(group.raw["metrics"][0]["label"]))
        axes.margins(x=0.12, y=0.1)
        for axis in (axes.xaxis, axes.yaxis):
            look.plain_ticks(axis)
        labels.annotate_printed(axes, named_ends(group, factor), places(group, group.drawable(), factor))
        return files_of(figure)


def files_of(figure, kinds=("pdf", "svg", "png")):
    """The bytes of a PDF with its fonts embedded, of an SVG with its letters as outlines, and of a PNG; the figure is closed."""
    look.lay_out(figure)
    options = {"pdf": {"metadata": {"CreationDate": None}}, "svg": {"metadata": {"Date": None}}, "png": {"dpi": 300}}
    files = {}
    for kind in kinds:
        buffer = io.BytesIO()
        figure.savefig(buffer, format=kind, **options[kind])
        files[kind] = buffer.getvalue()
    pyplot.close(figure)
    return files
