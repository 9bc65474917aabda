"""The ladder of a scene: what each rung adds, and how far the picture is from the truth after it."""
import math

from matplotlib import pyplot
import plotly.graph_objects as plotly

from . import look, results
from .pareto import files_of

CAPTION = "Bars: what a rung adds (against the rung before). Points: the picture against the truth. Dotted: noise of the truth. Above: time of the frame."
ADDED, BAR_NAME, AGAINST, SLOW = "#9db8d6", "#4f7cab", "#a8324a", "#777777"


def is_ladder(group):
    return any(metric["name"] == "added" for metric in group.raw["metrics"])


def values(group):
    """Names of the rungs, what they add with its interval, and the error against the truth."""
    names = [point.method.replace("_", " ") for point in group.points]
    return names, [point.error("added") for point in group.points], [point.error("picture") for point in group.points]


def times(group):
    found = []
    for point in group.points:
        factor, unit = results.unit_of([point.seconds["value"]]) if point.seconds else (1, "")
        found.append(f"{results.shown(point.seconds['value'] * factor, 2)} {unit}" if point.seconds else "")
    return found


def whiskers(errors):
    return [(error["high"] or error["value"]) - error["value"] for error in errors], [error["value"] - error["low"] for error in errors]


def interactive(group, _cost_label):
    names, added, against = values(group)
    figure = plotly.Figure()
    up, down = whiskers(added)
    figure.add_bar(x=names, y=[error["value"] for error in added], name="adds", marker={"color": ADDED}, error_y={"array": up, "arrayminus": down, "thickness": 1, "width": 3})
    up, down = whiskers(against)
    figure.add_scatter(x=names, y=[error["value"] for error in against], name="against the truth", mode="lines+markers", line={"color": AGAINST, "width": 2}, marker={"size": 8},
                       error_y={"array": up, "arrayminus": down, "thickness": 1, "width": 3})
    figure.add_scatter(x=names, y=[group.raw["floor"]] * len(names), name="noise of the truth", mode="lines", line={"color": SLOW, "dash": "dot", "width": 1}, hoverinfo="skip")
    look.dress(figure, 440, 150, 40, 90)
    for name, text in zip(names, times(group)):
        figure.add_annotation(x=name, y=1.04, yref="paper", text=text, showarrow=False, font={"size": 11})
    for height, text, color in named_ends(group, 40):
        figure.add_annotation(x=1, xref="paper", y=math.log10(height), text=text, showarrow=False, xanchor="left", xshift=4, font={"color": color, "size": 12})
    figure.update_yaxes(title="relative MSE of the picture", type="log", dtick=look.tick_step([error["value"] for error in added + against if error["value"]]))
    return figure


def named_ends(group, lines):
    """Heights, names and colours of what stands at the right end, at least one line of so many apart."""
    _, added, against = values(group)
    every = [error["value"] for error in added + against if error["value"] > 0] + [group.raw["floor"]]
    step = (max(every) / min(every)) ** (1 / lines) * 1.35
    ends = sorted((height, text, color) for height, text, color in ((added[-1]["value"], "adds", BAR_NAME), (against[-1]["value"], "against the truth", AGAINST),
                                                                    (group.raw["floor"], "noise of the truth", SLOW)) if height > 0)
    apart = []
    for height, text, color in ends:
        apart.append((max(height, apart[-1][0] * step) if apart else height, text, color))
    return apart


def printed(group, _cost_label):
    """The same at column width."""
    names, added, against = values(group)
    with pyplot.rc_context(look.PRINT):
        figure, axes = pyplot.subplots(figsize=(look.COLUMN_INCHES, 2.5), layout="constrained")
        places = range(len(names))
        axes.bar(places, [error["value"] for error in added], color=ADDED)
        axes.plot(places, [error["value"] for error in against], "o-", color=AGAINST, linewidth=1, markersize=3)
        axes.axhline(group.raw["floor"], color=SLOW, linestyle=":", linewidth=0.8)
        for place, text in zip(places, times(group)):
            axes.annotate(text, (place, 1), xycoords=("data", "axes fraction"), xytext=(0, 2), textcoords="offset points", ha="center", fontsize=5)
        axes.set(yscale="log", ylabel="relative MSE of the picture")
        for height, text, color in named_ends(group, 20):
            axes.annotate(text, (1, height), xycoords=("axes fraction", "data"), xytext=(2, 0), textcoords="offset points", fontsize=6, color=color, va="center")
        axes.set_xticks(places, names, rotation=35, ha="right")
        return files_of(figure)
