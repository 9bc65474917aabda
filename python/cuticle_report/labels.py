"""Names beside the ends of curves, instead of a legend: each where it covers no other name and as few points as may be."""
import math

from . import look

LETTER_PIXELS, LINE_PIXELS = 6.6, 14
EDGE = 6  # pixels that letters of a file may be wider than those measured here
# Right of the end, above, below, left of it, then farther away: across, up and how the text is anchored.
PLACES = [(9, 0, "left"), (7, 13, "left"), (7, -13, "left"), (0, 15, "center"), (0, -15, "center"), (-9, 0, "right"), (-7, 13, "right"), (-7, -13, "right"),
          (10, 26, "left"), (10, -26, "left"), (-9, 26, "right"), (-9, -26, "right"), (12, 40, "left"), (12, -40, "left")]


def box(x, y, text, place):
    """Left, right, bottom, top of a text at a place beside (x, y), in pixels."""
    across, up, anchor = place
    width = LETTER_PIXELS * len(text) + 2
    left = x + across - {"left": 0, "center": width / 2, "right": width}[anchor]
    return left, left + width, y + up - LINE_PIXELS / 2, y + up + LINE_PIXELS / 2


def overlap(a, b):
    return a[0] < b[1] and b[0] < a[1] and a[2] < b[3] and b[2] < a[3]


def holds(area, x, y):
    return area[0] - 3 < x < area[1] + 3 and area[2] - 3 < y < area[3] + 3


def choose(ends, points, width, height, margin):
    """For each end (x, y, text) its place; all in pixels from the lower left corner, the margin is what is free at the right."""
    taken, chosen = [], []
    for x, y, text in ends:
        def cost(place):
            area = box(x, y, text, place)
            outside = area[0] < 0 or area[1] > width + margin or area[2] < 0 or area[3] > height
            return 20 * sum(overlap(area, other) for other in taken) + 10 * outside + sum(holds(area, *point) for point in points) + 0.01 * PLACES.index(place)
        chosen.append(min(PLACES, key=cost))
        taken.append(box(x, y, text, chosen[-1]))
    return chosen


class Scale:
    """An axis of `pixels`, linear or logarithmic, with room around the values."""

    def __init__(self, values, pixels, logarithmic, room=0.06):
        self.logarithmic, self.pixels = logarithmic, pixels
        seen = [self.position(value) for value in values if value is not None and math.isfinite(value) and (value > 0 or not logarithmic)] or [0.0]
        span = max(max(seen) - min(seen), 0.3 if logarithmic else 1e-12)
        self.low, self.high = min(seen) - room * span, max(seen) + room * span

    def position(self, value):
        return math.log10(max(value, 1e-300)) if self.logarithmic else float(value)

    def __call__(self, value):
        return (self.position(value) - self.low) / (self.high - self.low) * self.pixels

    @property
    def range(self):
        return [self.low, self.high]


def annotate(figure, ends, across, up, points, margin):
    """Names at the ends (x, y, text, colour) of a plotly figure's curves, whose axes have these scales."""
    places = choose([(across(x), up(y), text) for x, y, text, _ in ends], [(across(x), up(y)) for x, y in points], across.pixels, up.pixels, margin)
    for (x, y, text, color), (shift, lift, anchor) in zip(ends, places):
        figure.add_annotation(x=across.position(x), y=up.position(y), text=text, showarrow=False, xanchor=anchor, xshift=shift, yshift=lift, font={"color": color, "size": 12})


def annotate_printed(axes, ends, points, size=6):
    """The same on a matplotlib figure, by what its letters really cover."""
    look.lay_out(axes.figure)
    taken, inside = [], axes.figure.bbox
    dots = [axes.transData.transform(point) for point in points]
    for x, y, text, color in ends:
        best = None
        for number, (across, up, anchor) in enumerate(PLACES):
            note = axes.annotate(text, (x, y), xytext=(0.5 * across, 0.5 * up), textcoords="offset points", color=color, fontsize=size, ha=anchor, va="center", annotation_clip=False)
            note.set_in_layout(False)
            extent = note.get_window_extent()
            cost = 20 * sum(extent.overlaps(other) for other in taken) + 10 * (extent.x1 > inside.x1 - EDGE or extent.x0 < axes.bbox.x0) \
                + 10 * (extent.y0 < axes.bbox.y0 or extent.y1 > inside.y1) + sum(extent.padded(1).contains(*dot) for dot in dots) + 0.01 * number
            if best is None or cost < best[0]:
                if best:
                    best[1].remove()
                best = (cost, note, extent)
            else:
                note.remove()
        taken.append(best[2])
