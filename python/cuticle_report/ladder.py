"""The ladder of a scene: what each rung adds, and how far the picture is from the truth after it."""
import io

from matplotlib import pyplot
import plotly.graph_objects as plotly

from . import results
from .pareto import COLUMN_INCHES, PRINT, tick_step

CAPTION = "Bars: what a rung adds (against the rung before). Points: the picture against the truth. Dotted: noise of the truth. Above: time of the frame."
ADDED, AGAINST, SLOW = "#9db8d6", "#a8324a", "#777777"


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
    for name, text in zip(names, times(group)):
        figure.add_annotation(x=name, y=1.04, yref="paper", text=text, showarrow=False, font={"size": 11})
    figure.update_layout(height=440, margin={"l": 75, "r": 20, "t": 40, "b": 90}, paper_bgcolor="rgba(0,0,0,0)", plot_bgcolor="rgba(0,0,0,0)", legend={"orientation": "h", "y": -0.25},
                         modebar={"bgcolor": "rgba(0,0,0,0)", "color": "rgba(128,128,128,0.6)"})
    figure.update_yaxes(title="relative MSE of the picture", type="log", gridcolor="rgba(128,128,128,0.2)", dtick=tick_step([error["value"] for error in added + against if error["value"]]))
    return figure


def printed(group, _cost_label):
    """The same at column width: the bytes of a PDF with its fonts embedded, and of an SVG with its letters as outlines."""
    names, added, against = values(group)
    with pyplot.rc_context(PRINT):
        figure, axes = pyplot.subplots(figsize=(COLUMN_INCHES, 2.5), layout="constrained")
        places = range(len(names))
        axes.bar(places, [error["value"] for error in added], color=ADDED, label="adds")
        axes.plot(places, [error["value"] for error in against], "o-", color=AGAINST, linewidth=1, markersize=3, label="against the truth")
        axes.axhline(group.raw["floor"], color=SLOW, linestyle=":", linewidth=0.8, label="noise of the truth")
        for place, text in zip(places, times(group)):
            axes.annotate(text, (place, 1), xycoords=("data", "axes fraction"), xytext=(0, 2), textcoords="offset points", ha="center", fontsize=5)
        axes.set(yscale="log", ylabel="relative MSE of the picture")
        axes.set_xticks(places, names, rotation=35, ha="right")
        axes.spines[["top", "right"]].set_visible(False)
        axes.legend(fontsize=5, frameon=False)
        files = {}
        for kind, metadata in (("pdf", {"CreationDate": None}), ("svg", {"Date": None})):
            buffer = io.BytesIO()
            figure.savefig(buffer, format=kind, metadata=metadata)
            files[kind] = buffer.getvalue()
        pyplot.close(figure)
    return files
