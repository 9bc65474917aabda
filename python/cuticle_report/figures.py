"""The figures of a study: error against time or against a setting, one curve a series, baselines as lines across."""
import math
import os

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot, ticker  # noqa: E402  (after the choice of back end)
import plotly.graph_objects as plotly  # noqa: E402

from . import curves as beside, look  # noqa: E402

COLORS = [*look.COLORS, "#3a8fa8", "#777777", "#7fb0e6", "#f2b27a", "#8fd0a4", "#dd8fa0",
          "#b9a5dd", "#cdb58a", "#93cfe0", "#b5b5b5"]
MOST_LABELS = 24  # of a page's figure, where the pointer shows them too
DASHES = [("--", "dash"), (":", "dot"), ("-.", "dashdot")]


def plain_numbers(axis):
    """Ticks as 0.02, 0.1, 20 and not as powers of ten; between decades 2, 3 and 5 only, and none where the axis spans many decades."""
    if axis.get_scale() != "log":
        return
    axis.set_major_formatter(ticker.FormatStrFormatter("%g"))
    lower, upper = axis.get_view_interval()
    if upper > 3e3 * lower:
        axis.set_minor_formatter(ticker.NullFormatter())
        return
    axis.set_minor_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}" if f"{value:e}"[0] in "235" else ""))
    axis.set_tick_params(which="minor", labelsize=8)


def is_setting(study, x):
    """Whether the axis has a few chosen values, which are its ticks."""
    return x.key == study.point_label or study.by_resolution()


def label_points(axes, labels):
    """Texts (x, y, text, color) beside points, each in the first corner where it covers no other; those that find none stay away."""
    axes.figure.canvas.draw()
    inside, taken = axes.get_window_extent(), []
    for x, y, text, color in labels:
        for across, up in (("left", 4), ("left", -11), ("right", 4), ("right", -11)):
            note = axes.annotate(text, (x, y), xytext=(4 if across == "left" else -4, up), textcoords="offset points", fontsize=7, color=color,
                                 ha=across)
            box = note.get_window_extent()
            if box.x0 > inside.x0 and box.x1 < inside.x1 and not any(box.overlaps(other) for other in taken):
                taken.append(box)
                break
            note.remove()


def save_png(study, x, path):
    """A PNG with labelled axes and the legend beside the plot."""
    figure, axes = pyplot.subplots(figsize=(8.5, 5), layout="constrained")
    labels = []
    for color, (name, rows) in zip(COLORS * 9, study.curves().items()):
        axes.plot([row[x.key] for row in rows], [row[study.y.key] for row in rows], "o-", color=color, markersize=4, label=name)
        labels += [(row[x.key], row[study.y.key], str(row.get(study.point_label, "")), color) for row in rows]
    if study.raw.get("pareto") and x.key == study.x.key:
        front = study.front()
        axes.step([row[x.key] for row in front], [row[study.y.key] for row in front], where="post", color="#bbbbbb", linewidth=5, zorder=0,
                  label="front of all")
    for (dash, _), (name, value) in zip(DASHES, study.baselines):
        axes.axhline(value, linestyle=dash, color="black", linewidth=1, label=f"{name}: {value:.3g}")
    axes.set(xlabel=x.label, ylabel=study.y.label, xscale=x.scale, yscale=study.y.scale)
    if is_setting(study, x):
        settings = sorted({row[x.key] for row in study.raw["rows"]})
        axes.xaxis.set_major_locator(ticker.FixedLocator(settings))
        axes.xaxis.set_minor_locator(ticker.NullLocator())
    plain_numbers(axes.xaxis)
    plain_numbers(axes.yaxis)
    axes.set_title(study.title, fontsize=11, wrap=True)
    axes.grid(alpha=0.3, which="both")
    figure.legend(loc="outside right upper", fontsize=8)
    if not is_setting(study, x):
        label_points(axes, labels)
    temporary = path.with_name(f".{path.stem}.{os.getpid()}.png")
    try:
        figure.savefig(temporary, dpi=150)
        temporary.replace(path)
    finally:
        pyplot.close(figure)
        temporary.unlink(missing_ok=True)


def hover(row):
    return "<br>".join(f"{key}: {value:.4g}" if isinstance(value, float) else f"{key}: {value}" for key, value in row.items())


def interactive(study, x):
    """The same as a plotly figure."""
    figure = plotly.Figure()
    for color, (name, rows) in zip(COLORS * 9, study.curves().items()):
        is_labelled = not is_setting(study, x) and len(study.raw["rows"]) <= MOST_LABELS
        labels = [str(row.get(study.point_label, "")) for row in rows] if is_labelled else None
        figure.add_scatter(x=[row[x.key] for row in rows], y=[row[study.y.key] for row in rows], name=name, text=labels,
                           mode="lines+markers+text" if labels else "lines+markers", textposition="top right", textfont={"size": 10},
                           line={"color": color}, hovertext=[hover(row) for row in rows], hoverinfo="text")
    if study.raw.get("pareto") and x.key == study.x.key:
        front = study.front()
        figure.add_scatter(x=[row[x.key] for row in front], y=[row[study.y.key] for row in front], mode="lines", name="front of all",
                           line={"color": "rgba(120,120,120,0.35)", "width": 7, "shape": "hv"})
    values = [row[x.key] for row in study.raw["rows"]]
    for (_, dash), (name, value) in zip(DASHES, study.baselines):
        figure.add_scatter(x=[min(values), max(values)], y=[value, value], mode="lines", name=f"{name}: {value:.3g}",
                           line={"color": look.OTHERS, "dash": dash, "width": 1.5})
    drawn = study.curves()
    if study.by_resolution():
        named = {**{name: [row[study.y.key] for row in rows] for name, rows in drawn.items()}, **{f"{name}: {value:.3g}": [value] for name, value in study.baselines}}
        look.dress(figure, 480, 20 + 7 * max(map(len, named)))
        beside.label_ends(figure, {"curves": [{"name": name, "y": values} for name, values in named.items()], "logarithmic_y": study.y.scale == "log"},
                          [*COLORS[:len(drawn)], *[look.OTHERS] * len(study.baselines)])
    else:
        look.dress(figure, 480, 20)
    figure.update_layout(showlegend=not study.by_resolution())
    errors = [row[study.y.key] for row in study.drawn_rows() + study.raw["baselines"]]
    figure.update_xaxes(title=x.label, type=x.scale, **(look.log_ticks(values) if x.scale == "log" else {}))
    figure.update_yaxes(title=study.y.label, type=study.y.scale, **(look.log_ticks(errors) if study.y.scale == "log" else {}))
    if is_setting(study, x):
        figure.update_xaxes(tickvals=sorted(set(values)), ticktext=[f"{value:g}" for value in sorted(set(values))])
    return figure
