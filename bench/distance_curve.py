"""The distance curve: what fewer segments cost at the distance where a strand is an eighth of a pixel wide.

Strands are left out by chance, the rest as much wider; vertices are left out evenly along each strand. Each picture is drawn
by `tiles` and compared with that of all strands: relative mean squared error of the luminance, light, coverage. --levels draws by the
level of detail as well (tile_lists.full_px), with the time of a frame, and moves the camera away in steps of a hundredth: what a step changes, there and in
hair that is complete, and says where the error of the last level lies and what is left of it without shadows. The last line says what hair that is complete, but lies a third of a pixel aside, differs by.

  PYTHONPATH=build/release/python python bench/distance_curve.py [--groom FILE] [--density ROOTS_PER_M2] [--pixels N]
                                                                 [--levels] [--figure FILE.png]

512 pixels hold a whole head, 128 the middle of one. Radii are given by the scene (groom.radius_m), because those above .5 mm in a file
are taken for a mistake.
"""
import argparse
import math
import pathlib
import tempfile
import time

import numpy

import cuticle

PIXELS_OF_A_STRAND, DISTANCE = 1 / 8, 1.5
TARGET = numpy.array([0.0, 0.10, 0.06])
# Share of the strands, and of the segments of each.
CHOICES = [(1, 1 / 2), (1, 1 / 4), (1, 1 / 8), (1, 1 / 16), (1 / 2, 1), (1 / 2, 1 / 2), (1 / 2, 1 / 4), (1 / 2, 1 / 8), (1 / 4, 1), (1 / 4, 1 / 4), (1 / 8, 1 / 2), (1 / 16, 1)]


def thinned(points, order, strands, segments):
    """(strands, vertices, 3) with these shares of both."""
    chosen = points[order[:max(1, round(len(points) * strands))]]
    vertices = max(2, round((points.shape[1] - 1) * segments) + 1)
    at = numpy.linspace(0, points.shape[1] - 1, vertices)
    low = numpy.minimum(at.astype(int), points.shape[1] - 2)
    share = (at - low)[:, None]
    return chosen[:, low] * (1 - share) + chosen[:, low + 1] * share


def half_width(radius, pixels):
    """Of what the camera sees at the target, metres."""
    return 2 * radius / PIXELS_OF_A_STRAND * pixels / 2


def opened(points, radius, pixels, full_px=0, farther=1, seen=False, shadow="deep_opacity"):
    """To be drawn by `tiles`. radius: as drawn, and that of the complete hair. shadow: or none."""
    eye, half = TARGET + [0, 0, DISTANCE * farther], half_width(radius[1], pixels)
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "strands.hair"
        cuticle.write(cuticle.make_groom(points.astype(numpy.float32)), file)
        return cuticle.Renderer({
            "groom": {"file": str(file), "metres_per_unit": 1, "radius_m": radius[0]}, "head": {"present": False},
            "lights": [{"to_light": [0.6, 0.9, 0.8], "irradiance": [15, 14, 13]}],
            "material": {"model": {"marschner": {"eta": 1.55, "sigma_a": [0.02, 0.06, 0.17], "beta": 0.14, "alpha": -0.0524}}},
            "shadow": {"method": {shadow: {"layers": 16, "resolution": 1024} if shadow != "none" else {}}},
            "passes": {"tile_lists": {"budget_mib": 2000, "full_px": full_px}},
            "camera": {"position_m": eye.tolist(), "target_m": TARGET.tolist(), "fov_deg": math.degrees(2 * math.atan(half / DISTANCE)), "near_m": 0.2,
                       "far_m": 5, "resolution_px": [pixels, pixels]}}, method="tiles", seen=seen)


def picture(*of, **options):
    return opened(*of, **options).frame()


def drawn_and_timed(*of):
    """A picture, the seconds that drawing it again takes, and the number of the last strand that is seen."""
    renderer = opened(*of)
    image, start = renderer.frame(), time.perf_counter()
    renderer.frame()
    seconds, telling = time.perf_counter() - start, opened(*of, seen=True)
    telling.frame()
    return image, seconds, telling.seen["strand"].max() + 1


def covered_pixels(points, radius, pixels):
    """As a level of detail counts them: an ellipse in the box that the hair's bounds have in the picture."""
    corners = numpy.array(numpy.meshgrid(*[(axis.min(), axis.max()) for axis in points.reshape(-1, 3).T])).reshape(3, -1).T - TARGET
    seen = corners[:, :2] / (DISTANCE - corners[:, 2:]) * DISTANCE / half_width(radius, pixels)
    sides = numpy.minimum(seen.max(0), 1) - numpy.maximum(seen.min(0), -1)
    return sides.prod() / 4 * pixels**2 * math.pi / 4


def compared(found, truth):
    """Relative mean squared error of the luminance, light, coverage."""
    light = [image[..., :3].mean(-1) for image in (found, truth)]
    return float(((light[0] - light[1]) ** 2).mean() / (light[1] ** 2).mean()), light[0].mean() / light[1].mean(), found[..., 3].mean()


def levels(points, radius, pixels, truth):
    """Share of the strands that a level draws, and its error."""
    rows, covered, of = [], covered_pixels(points, radius, pixels), (points, (radius, radius), pixels)
    for share in (1, 1 / 2, 1 / 4, 1 / 8, 1 / 16):
        # Levels go in steps of the fourth root of 2; bounds of drawn hair are somewhat larger.
        full_px = 1.15 * covered / share if share < 1 else 0
        image, seconds, strands = drawn_and_timed(*of, full_px)
        error, light, coverage = compared(image, truth)
        rows.append((strands / len(points), error))
        print(f"a level     1/{len(points) / strands:<4.1f} {error:15.4f} {light:9.3f} {coverage:8.4f}   {seconds:.2f} s", flush=True)
    print("of this error: " + ", ".join(f"{share:.2f} {where}" for where, share in error_by_place(image, truth).items()))
    error, light, _ = compared(picture(*of, full_px, shadow="none"), picture(*of, shadow="none"))
    print(f"the same level without shadows {error:8.4f} {light:9.3f}", flush=True)
    return rows[1:]


def error_by_place(found, truth):
    """Shares of the squared error where the complete hair covers nothing, a part of the pixel, and all of it."""
    error, covered = (found[..., :3].mean(-1) - truth[..., :3].mean(-1)) ** 2, truth[..., 3]
    places = {"beside the hair": covered < 0.02, "on its outline": (covered >= 0.02) & (covered < 0.98), "within it": covered >= 0.98}
    return {where: float(error[at].sum() / error.sum()) for where, at in places.items()}


def dolly(points, radius, pixels):
    """What a step of a hundredth away changes, relative mean squared: at most and in the middle, by a level of detail and by all strands."""
    far, full_px = 1 + 0.01 * numpy.arange(6), 6 * covered_pixels(points, radius, pixels)
    for name, full in (("a level", full_px), ("all", 0)):
        seen = [picture(points, (radius, radius), pixels, full, farther) for farther in far]
        steps = [compared(after, before)[0] for before, after in zip(seen, seen[1:])]
        print(f"a step away, {name:8s} in the middle {numpy.median(steps):.4f}, at most {max(steps):.4f}", flush=True)


def draw(rows, of_levels, file):
    import matplotlib
    matplotlib.use("agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(figsize=(3.4, 2.5), layout="constrained")
    lines = {"all strands": ([row for row in rows if row[0] == 1], "#1b5fa8", "o"), "half of them": ([row for row in rows if row[0] == 1 / 2], "#2a8f4d", "s"),
             "a quarter": ([row for row in rows if row[0] == 1 / 4], "#8a4fa3", "^"), "all segments": ([row for row in rows if row[1] > 0.99], "#b5452c", "D")}
    for name, (of, color, marker) in lines.items():
        at = sorted((strands * segments, error) for strands, segments, error in of)
        axes.plot(*zip(*at), marker, color=color, linestyle="-", markerfacecolor="none", markersize=4, linewidth=1)
        aside = {"half of them": 4, "all strands": -4}.get(name, 0)
        axes.annotate(name, at[0], xytext=(-4, aside), textcoords="offset points", color=color, fontsize=7, ha="right", va="center")
    axes.plot(*zip(*of_levels), "*-", color="#111111", markersize=5, linewidth=1.2)
    axes.annotate("level of detail", of_levels[-1], xytext=(-6, 0), textcoords="offset points", color="#111111", fontsize=7, ha="right", va="center")
    axes.plot([1 / 16], [0.014], "P", color="#555555")
    axes.annotate("goal", (1 / 16, 0.014), xytext=(-5, 0), textcoords="offset points", fontsize=7, color="#555555", ha="right", va="center")
    axes.set(xscale="log", yscale="log", xlabel="share of the segments", ylabel="relative mean squared error", xlim=(1 / 48, 0.7))
    axes.set_xticks([1 / 32, 1 / 16, 1 / 8, 1 / 4, 1 / 2], ["1/32", "1/16", "1/8", "1/4", "1/2"])
    axes.set_yticks([0.01, 0.1, 1], ["0.01", "0.1", "1"])
    axes.minorticks_off()
    figure.savefig(file, dpi=200)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--groom")
    parser.add_argument("--density", type=float, default=180000)
    parser.add_argument("--pixels", type=int, default=128)
    parser.add_argument("--levels", action="store_true")
    parser.add_argument("--figure", help="with --levels")
    options = parser.parse_args()
    hair = cuticle.load_groom(options.groom, metres_per_unit=1) if options.groom else cuticle.grow({"schema_version": 1, "strands": {"density": options.density, "vertices": 32}})
    points, radius = hair.positions.reshape(len(hair), -1, 3), float(hair.radii.mean())
    order = numpy.random.default_rng(1).permutation(len(hair))
    truth = picture(points, (radius, radius), options.pixels)
    print(f"{len(hair)} strands of {points.shape[1]} vertices, {options.pixels} x {options.pixels} pixels, a strand {PIXELS_OF_A_STRAND} pixels wide")
    print("strands  segments  share  relative MSE  light  coverage")
    rows = []
    for strands, segments in CHOICES:
        thin = thinned(points, order, strands, segments)
        error, light, coverage = compared(picture(thin, (radius * len(hair) / len(thin), radius), options.pixels), truth)
        kept = thin.shape[0] * (thin.shape[1] - 1) / (points.shape[0] * (points.shape[1] - 1))
        rows.append((strands, kept / strands, error))
        print(f"1/{1 / strands:<5.0f}  1/{1 / segments:<6.0f}  1/{1 / kept:<4.1f} {error:11.4f} {light:9.3f} {coverage:8.4f}", flush=True)
    of_levels = levels(points, radius, options.pixels, truth) if options.levels else []
    if options.levels:
        dolly(points, radius, options.pixels)
    aside = points + [2 * radius / PIXELS_OF_A_STRAND / 3, 0, 0]
    print("a third of a pixel aside    {:11.4f} {:9.3f} {:8.4f}".format(*compared(picture(aside, (radius, radius), options.pixels), truth)))
    if options.figure:
        draw(rows, of_levels, options.figure)


if __name__ == "__main__":
    main()
