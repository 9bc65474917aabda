"""Pictures of the hair from receivers.csv: the truth, each method and its error, side by side, as the light's side view sees them."""
import csv
import os

from matplotlib import pyplot
import numpy

from . import ReportError, page

FILE = "receivers.csv"
MOST_ERROR = 0.2  # end of the errors' colours


def read(path):
    """Names of the columns after the standard error, and all numbers."""
    with path.open(encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    if len(rows) < 2 or rows[0][:5] != ["x", "y", "z", "truth", "standard_error"]:
        raise ReportError(f"{path}: not receivers with their truth")
    try:
        return rows[0][5:], numpy.array(rows[1:], dtype=float)
    except ValueError as error:
        raise ReportError(f"{path}: {error}") from error


def seen_from_the_side(points, to_light):
    """Places in a picture that the light comes into from the left, upright where it does not come from above; far ones first."""
    light = numpy.array(to_light) / numpy.linalg.norm(to_light)
    up = numpy.array([0.0, 1, 0]) if abs(light[1]) < 0.9 else numpy.array([0.0, 0, 1])
    right = -(light - light.dot(up) * up)
    right /= numpy.linalg.norm(right)
    order = numpy.argsort(points @ numpy.cross(right, up))
    return points @ right, points @ up, order


def draw(axes, places, values, order, title, colours, most):
    dots = axes.scatter(places[0][order], places[1][order], c=values[order], s=5, cmap=colours, vmin=0, vmax=most, linewidths=0)
    axes.set_title(title, fontsize=8, wrap=True)
    axes.set_aspect("equal")
    axes.set_axis_off()
    return dots


def save_png(names, numbers, to_light, path):
    """One row a method: truth, method, error."""
    *places, order = seen_from_the_side(numbers[:, :3], to_light)
    truth = numbers[:, 3]
    figure, grid = pyplot.subplots(len(names), 3, figsize=(9, 3.1 * len(names)), layout="constrained", squeeze=False)
    for row, name in enumerate(names):
        values = numbers[:, 5 + row]
        error = numpy.abs(values - truth)
        draw(grid[row, 0], places, truth, order, "truth", "viridis", 1)
        light = draw(grid[row, 1], places, values, order, name.replace(";", ", "), "viridis", 1)
        wrong = draw(grid[row, 2], places, error, order, f"error, mean {error.mean():.4f}", "magma", MOST_ERROR)
        figure.colorbar(light, ax=grid[row, :2], shrink=0.8, label="transmittance")
        figure.colorbar(wrong, ax=grid[row, 2], shrink=0.8, extend="max", label="|error|")
    temporary = path.with_name(f".{path.stem}.{os.getpid()}.png")
    try:
        figure.savefig(temporary, dpi=110)
        temporary.replace(path)
    finally:
        pyplot.close(figure)
        temporary.unlink(missing_ok=True)


def sections(raw, folder):
    """The section with the picture, where the study has receivers and methods at them."""
    if not (folder / FILE).exists():
        return []
    names, numbers = read(folder / FILE)
    if not names:
        return []
    save_png(names, numbers, raw["to_light"], folder / "hair.png")
    caption = "Truth, each method at its best setting, and its error; the light comes from the left. Each dot is a receiver; the mean here is over all of them."
    return [page.Section("On the hair", pictures=[page.Picture(folder / "hair.png", caption)])]
