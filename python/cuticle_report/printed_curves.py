"""Curves, polar curves and heat maps at column width, as PDF and SVG; the interactive ones are in curves and report."""
import math

from matplotlib import pyplot
import numpy

from . import curves, look, processes
from .pareto import files_of

MANY = 12
DASHES = {"solid": "-", "dash": "--"}


def plot_of(plot):
    return polar(plot) if plot["polar"] else flat(plot)


def name_ends(axes, plot, colors):
    """The name of each curve right of the axes, a line apart from the next."""
    look.lay_out(axes.figure)
    lines, ends = [], []
    for curve, (color, _) in zip(plot["curves"], colors):
        if curve["y"]:
            ends.append((axes.transData.transform((curve["x"][-1], max(curve["y"][-1], axes.get_ylim()[0])))[1], curve["name"], color))
    apart = 7 * axes.figure.dpi / 72
    reached = -math.inf
    for height, name, color in sorted(ends):
        reached = max(height, reached + apart)
        lines.append((reached, name, color))
    sunk = max(0, lines[-1][0] - axes.bbox.y1) if lines else 0
    for height, name, color in lines:
        share = (height - sunk - axes.bbox.y0) / axes.bbox.height
        axes.annotate(name, (1, share), xycoords="axes fraction", xytext=(2, 0), textcoords="offset points", color=color, fontsize=6, va="center", annotation_clip=False)


def flat(plot):
    looks = curves.looks_of(plot)
    with look.printing():
        figure, axes = pyplot.subplots(figsize=(look.COLUMN_INCHES, 2.3), layout="constrained")
        for place, ((color, dash), curve) in enumerate(zip(looks, plot["curves"])):
            if curve.get("marks"):
                axes.plot(curve["x"], curve["y"], curves.MARKS[place % len(curves.MARKS)][0], color=color, markersize=3 + place, markerfacecolor="none", markeredgewidth=0.8)
            else:
                axes.plot(curve["x"], curve["y"], DASHES[dash], color=color, linewidth=0.7 if color == look.OTHERS else 1)
        scales = {axis: "log" if curves.is_logarithmic(plot, axis) else "linear" for axis in "xy"}
        axes.set(xlabel=plot["x_label"], ylabel=look.wrapped(plot["y_label"]), xscale=scales["x"], yscale=scales["y"])
        for name, axis in (("x", axes.xaxis), ("y", axes.yaxis)):
            if scales[name] == "log":
                look.plain_ticks(axis)
        if curves.counts_of(plot):
            axes.set_xticks(curves.counts_of(plot))
        name_ends(axes, plot, looks)
        return files_of(figure, ("pdf", "svg"))


def polar(plot):
    looks, largest = curves.looks_of(plot), curves.largest_of(plot)
    with look.printing():
        figure, axes = pyplot.subplots(figsize=(look.COLUMN_INCHES, 2.9), subplot_kw={"projection": "polar"}, layout="constrained")
        for (color, dash), curve in zip(looks, plot["curves"]):
            axes.plot(numpy.radians(curve["x"]), curves.radii(curve["y"], largest), DASHES[dash], color=color, linewidth=1)
        axes.set_rlim(0, curves.DECADES + 0.3)
        axes.set_rticks(range(1, curves.DECADES + 1), curves.polar_labels(largest), fontsize=5)
        axes.set_rlabel_position(90)
        axes.grid(linewidth=0.4, alpha=0.5)
        axes.set_title(f"{plot['y_label']} (logarithmic) over {plot['x_label']}", fontsize=7)
        for row, ((color, _), curve) in enumerate(zip(looks, plot["curves"])):
            axes.annotate(curve["name"], (0, 1), xycoords="axes fraction", xytext=(-8, -7 * row), textcoords="offset points", color=color, fontsize=6, va="top", ha="right", annotation_clip=False)
        return files_of(figure, ("pdf", "svg"))


def heights_of(grid):
    """Decimal logarithms, over five decades."""
    largest = max(max(row) for row in grid["values"]) or 1
    return [[math.log10(max(value, 1e-5 * largest)) for value in row] for row in grid["values"]]


def heat(grid):
    heights = heights_of(grid)
    with look.printing():
        figure, axes = pyplot.subplots(figsize=(look.COLUMN_INCHES, 2.4), layout="constrained")
        drawn = axes.pcolormesh(grid["x"], grid["y"], heights, cmap="viridis", shading="nearest", rasterized=True)
        axes.set(xlabel=grid["x_label"], ylabel=grid["y_label"])
        figure.colorbar(drawn, label=f"log10 {grid['z_label']}")
        return files_of(figure, ("pdf", "svg"))


def all_of(plots, grids):
    """The files of all of them, in their order."""
    return iter([*processes.mapped(plot_of, plots, least=MANY, chunk=4), *processes.mapped(heat, grids)])
