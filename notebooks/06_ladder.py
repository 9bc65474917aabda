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
# # What accuracy costs: the ladder
#
# From path tracing to a real-time picture, one approximation at a time, each on top of those before it. Every rung is drawn of the same
# strands, light and camera, so what it adds in error and saves in time is its own. (`cuticle.study("picture")` climbs the same ladder
# with larger pictures, intervals and more rungs.)

# %%
import os
import pathlib
import time

import matplotlib.pyplot as pyplot
import numpy

import cuticle

figures = pathlib.Path(os.environ.get("CUTICLE_FIGURES", "figures"))
figures.mkdir(parents=True, exist_ok=True)
SAMPLES = 128
SCENE = {
    "name": "a brown head, small",
    "material": {"model": {"chiang": {"sigma_a": [0.35, 0.6, 1.2], "beta_m": 0.35, "beta_n": 0.4}}},
    "lights": [{"to_light": [0.6, 0.7, 0.6], "irradiance": [9, 8.6, 8]}],
    "shadow": {"method": {"deep_opacity": {"layers": 8, "resolution": 256}}, "fibre_alpha": 0.4},
    "camera": {"position_m": [0.3, 0.2, 1.1], "target_m": [0, 0.02, 0], "fov_deg": 28, "resolution_px": [96, 96]},
    "strand_count": 5000, "strand_vertices": 16, "head": {"present": False},
}
MARSCHNER = {"material": {"model": {"marschner": {"sigma_a": [0.35, 0.6, 1.2], "beta": 0.3}}, "lut_size": 64}}
FAR, SINGLE, MAPPED = {"field": "far"}, {"field": "far", "bounces": 1}, {"field": "far", "bounces": 1, "shadow": "deep_opacity"}
RUNGS = {
    "path tracing": ({}, "reference", {}),
    "far field, marschner": (MARSCHNER, "reference", FAR),
    "direct light alone": (MARSCHNER, "reference", SINGLE),
    "shadow map for rays": (MARSCHNER, "reference", MAPPED),
    "rasterised, tables": ({**MARSCHNER, "passes": {"lines": {"ambient": 0}}}, "tiles", None),
    "dual scattering added": ({**MARSCHNER, "passes": {"dual_scattering": {}, "lines": {"ambient": 0}}}, "tiles", None),
}


def drawn(change, way, traced):
    """The picture, and seconds of processor time of one frame, without what is made once."""
    scene = {**SCENE, **change}
    if traced is not None:
        scene["passes"] = {"reference": {"samples": SAMPLES, **traced}}
    renderer = cuticle.Renderer(scene, way)
    if way != "reference":
        renderer.frame(0)  # tables and buffers are made once
    begun = time.process_time()
    picture = renderer.frame(0)
    return picture, time.process_time() - begun


pictures, seconds = {}, {}
for rung, how in RUNGS.items():
    pictures[rung], seconds[rung] = drawn(*how)
other_seed, _ = drawn({}, "reference", {"seed": 1})

# %% [markdown]
# ## The pictures
#
# Light that goes from fibre to fibre makes much of the colour, even of brown hair. Left out, the head turns dark; dual scattering gives part of it back.

# %%
figure, row = pyplot.subplots(1, len(RUNGS), figsize=(1.7 * len(RUNGS), 2.1), layout="constrained")
for axes, rung in zip(row, RUNGS):
    axes.imshow(numpy.clip(cuticle.tone_map(pictures[rung], 1.5)[..., :3], 0, 1))
    axes.set_title(rung, fontsize=9)
    axes.set(xticks=[], yticks=[])
figure.savefig(figures / "pictures.png", dpi=130)

# %% [markdown]
# ## Error against time
#
# Errors are of means over 8 x 8 pixels, relative to the rms of path tracing: what remains is bias, and the noise of the samples (another seed of path
# tracing tells how much that is: the grey line).


# %%
def error(picture):
    def means(image):
        return image[..., :3].reshape(12, 8, 12, 8, 3).mean(axis=(1, 3))

    truth = means(pictures["path tracing"])
    return float(numpy.sqrt(((means(picture) - truth) ** 2).sum() / (truth**2).sum()))


errors = {rung: error(picture) for rung, picture in pictures.items() if rung != "path tracing"}
noise = error(other_seed)
figure, axes = pyplot.subplots(figsize=(8.5, 4.8), layout="constrained")
axes.axhline(noise, color="grey", linewidth=1)
axes.annotate("noise of path tracing", (1, noise), xycoords=("axes fraction", "data"), xytext=(-4, 4), textcoords="offset points", color="grey", ha="right")
axes.loglog([seconds[rung] for rung in errors], list(errors.values()), color="lightgrey", zorder=0)
for number, rung in enumerate(errors):
    axes.loglog(seconds[rung], errors[rung], "o", color="#3378bf" if RUNGS[rung][1] == "reference" else "#bf3845")
    axes.annotate(rung, (seconds[rung], errors[rung]), xytext=(7, -12 if number % 2 else 6), textcoords="offset points", fontsize=9)
axes.set(xlabel=f"seconds of processor time for a frame (traced: {SAMPLES} paths a pixel; rasterised: software Vulkan)", ylabel="rms error over the rms of path tracing",
         title="Leaving out scattering between fibres costs the most", xlim=(min(seconds.values()) / 1.6, max(seconds.values()) * 3))
figure.savefig(figures / "ladder.png", dpi=130)
for rung in errors:
    print(f"{rung:24} error {errors[rung]:.3f}   {seconds[rung]:.2f} s")
print(f"path tracing: {seconds['path tracing']:.2f} s, noise {noise:.3f}")

# %% [markdown]
# ## What must hold

# %%
brightness = {rung: float(picture[..., :3].mean()) for rung, picture in pictures.items()}
assert all(numpy.isfinite(picture).all() for picture in pictures.values())
assert errors["far field, marschner"] < errors["direct light alone"], "the model of one fibre matters less than scattering between fibres"
assert noise < errors["direct light alone"] / 1.5
assert brightness["direct light alone"] < 0.85 * brightness["path tracing"] and brightness["dual scattering added"] > brightness["rasterised, tables"]
assert seconds["direct light alone"] < seconds["path tracing"]
