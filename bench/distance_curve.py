"""The distance curve: what fewer segments cost at the distance where a strand is an eighth of a pixel wide.

Strands are left out in random order, the rest as much wider; vertices are left out evenly along each strand. Each picture is drawn
by `tiles` and compared with that of all strands: relative mean squared error of the luminance, light, coverage. The last line says what
hair that is complete, but lies a third of a pixel aside, differs by.

  PYTHONPATH=build/release/python python bench/distance_curve.py [--groom FILE] [--density ROOTS_PER_M2] [--pixels N]
                                                                 [--levels] [--figure FILE.png]

512 pixels hold a whole head, 128 the middle of one. --levels draws by the level of detail as well (tile_lists.full_px).
"""
import argparse
import math

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


def picture(points, radius, pixels, full_px=0):
    half = 2 * radius[1] / PIXELS_OF_A_STRAND * pixels / 2
    groom = cuticle.make_groom(points.astype(numpy.float32), radii=radius[0])
    return cuticle.render({
        "groom": groom, "lights": [{"to_light": [0.6, 0.9, 0.8], "irradiance": [15, 14, 13]}],
        "material": {"model": {"marschner": {"eta": 1.55, "sigma_a": [0.02, 0.06, 0.17], "beta": 0.14, "alpha": -0.0524}}},
        "shadow": {"method": {"deep_opacity": {"layers": 16, "resolution": 1024}}},
        "passes": {"tile_lists": {"budget_mib": 2000, "full_px": full_px}},
        "camera": {"position_m": (TARGET + [0, 0, DISTANCE]).tolist(), "target_m": TARGET.tolist(), "fov_deg": math.degrees(2 * math.atan(half / DISTANCE)), "near_m": 0.2,
                   "far_m": 5, "resolution_px": [pixels, pixels]}}, method="tiles")


def compared(found, truth):
    """Relative mean squared error of the luminance, light, coverage."""
    light = [image[..., :3].mean(-1) for image in (found, truth)]
    return float(((light[0] - light[1]) ** 2).mean() / (light[1] ** 2).mean()), light[0].mean() / light[1].mean(), found[..., 3].mean()


def draw(rows, file):
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
    axes.plot([1 / 16], [0.014], "*", color="#555555")
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
    parser.add_argument("--figure")
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
    for full_px in (3e5, 6e5, 2.4e6) if options.levels else ():
        error, light, coverage = compared(picture(points, (radius, radius), options.pixels, full_px), truth)
        print(f"full_px {full_px:<12.0f} {error:15.4f} {light:9.3f} {coverage:8.4f}", flush=True)
    aside = points + [2 * radius / PIXELS_OF_A_STRAND / 3, 0, 0]
    print("a third of a pixel aside    {:11.4f} {:9.3f} {:8.4f}".format(*compared(picture(aside, (radius, radius), options.pixels), truth)))
    if options.figure:
        draw(rows, options.figure)


if __name__ == "__main__":
    main()
