# ---
# jupyter:
#   jupytext:
#     formats: py:percent
#   kernelspec:
#     display_name: Python 3
#     language: python
#     name: python3
# ---

# %% [markdown]
# # Opacity maps against deep opacity maps
#
# An opacity shadow map stores, for slices through the hair that are planes across the light, how much hair lies in front of each. A deep
# opacity map starts its slices at the nearest fibre of each texel, so that a few follow the hair's shape. How many does each need? And
# is either better than the two answers that need no map: no shadow (T = 1), and the one constant that fits best?

# %%
import os
import pathlib

import matplotlib.pyplot as pyplot
import numpy

import cuticle

figures = pathlib.Path(os.environ.get("CUTICLE_FIGURES", "figures"))
figures.mkdir(parents=True, exist_ok=True)
LIGHT, ALPHA = (1, 1, 0.3), 0.4
grown = cuticle.grow({"strands": {"density": 30000, "vertices": 16}}, share=0.25)
hair = cuticle.make_groom(grown.positions, numpy.diff(grown.offsets), radii=4e-4)  # as wide as the fibres that they stand for
truth, noise = cuticle.shadows.truth(hair, LIGHT, alpha=ALPHA, rays=256)  # at the vertices, where a fibre does not shadow itself
RADIUS = 1e3 * cuticle.shadows.footprint_radius(hair)  # of the disc that the truth is a mean over; the maps are filtered as widely
print(f"{len(hair)} strands, {len(truth)} points, transmittance {truth.mean():.3f} on average, noise at most {noise.max():.3f}")

# %%
COUNTS = (2, 4, 8, 16)
METHODS = {"opacity_map": "slices", "deep_opacity": "layers"}


def error(method, **settings):
    found = cuticle.shadows.transmittance(hair, LIGHT, method=method, alpha=ALPHA, resolution=256, filter_radius_mm=RADIUS, **settings)
    return float(numpy.abs(found - truth).mean())


errors = {method: [error(method, **{name: count}) for count in COUNTS] for method, name in METHODS.items()}
many = error("opacity_map", slices=128)
baselines = {"no shadow (T = 1)": float(numpy.abs(1 - truth).mean()), "the best constant": float(numpy.abs(numpy.median(truth) - truth).mean())}

figure, axes = pyplot.subplots(figsize=(8, 4.4), layout="constrained")
for method, color in (("opacity_map", "#3378bf"), ("deep_opacity", "#bf3845")):
    axes.plot(COUNTS, errors[method], "o-", color=color, label=method)
axes.axhline(many, color="#3378bf", linestyle=":", label="opacity_map, 128 slices")
for (name, value), style in zip(baselines.items(), ("--", "-.")):
    axes.axhline(value, color="black", linestyle=style, linewidth=1, label=name)
axes.set(xlabel="slices or layers", ylabel="mean |error| of transmittance", xscale="log", ylim=(0, None), title="Against ray-traced truth")
axes.set_xticks(COUNTS, [str(count) for count in COUNTS])
axes.minorticks_off()
figure.legend(loc="outside right upper", fontsize=8)
figure.savefig(figures / "counts.png", dpi=130)

# %% [markdown]
# ## Where the error is
#
# Planes that cut the hair's surface at a slant give bands: all points of a slice share its shadow. Each dot is one point.

# %%
figure, row = pyplot.subplots(1, 2, figsize=(9, 4.2), layout="constrained", sharex=True, sharey=True)
for axes, (method, name) in zip(row, METHODS.items()):
    found = cuticle.shadows.transmittance(hair, LIGHT, method=method, alpha=ALPHA, resolution=256, filter_radius_mm=RADIUS, **{name: 4})
    axes.plot(truth[::5], found[::5], ".", markersize=3, alpha=0.5)
    axes.plot([0, 1], [0, 1], "k:")
    axes.set(title=f"{method}, 4 {name}", xlabel="transmittance, truth", ylabel="transmittance, map")
figure.savefig(figures / "points.png", dpi=130)

# %% [markdown]
# ## What must hold

# %%
print({method: [round(e, 4) for e in values] for method, values in errors.items()}, baselines)
assert errors["deep_opacity"][1] < errors["opacity_map"][1]
assert errors["opacity_map"][-1] < errors["opacity_map"][0]
assert max(errors["deep_opacity"][1], many) < baselines["the best constant"] < baselines["no shadow (T = 1)"]
