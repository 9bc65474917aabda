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
# # Four ways to draw strands, against the reference
#
# Lines, quads, tiles and cards draw the same scene; `reference` follows light paths through it and is the truth for what a renderer
# should show. Where no Vulkan device is found, software Vulkan draws; where there is none at all, the calls say so.

# %%
import os
import pathlib
import time

import matplotlib.pyplot as pyplot
import numpy

import cuticle

figures = pathlib.Path(os.environ.get("CUTICLE_FIGURES", "figures"))
figures.mkdir(parents=True, exist_ok=True)
SCENE = {
    "name": "red hair by one light",
    "material": {"model": {"marschner": {"sigma_a": [0.15, 0.5, 0.9]}}, "lut_size": 64},
    "lights": [{"to_light": [0.5, 0.7, 1], "irradiance": [5, 5, 5]}],
    "shadow": {"method": {"deep_opacity": {"layers": 8, "resolution": 256}}},
    "camera": {"position_m": [0.3, 0.2, 1.1], "target_m": [0, 0.02, 0], "fov_deg": 28, "resolution_px": [128, 144]},
    "strand_count": 2000,
    "head": {"present": False},
    "strand_vertices": 20,
}
LIMITED = {**SCENE, "passes": {"reference": {"bounces": 1, "shadow": "deep_opacity"}}}
DIRECT = {**SCENE, "passes": {"lines": {"ambient": 0}}}
WAYS = {"lines": SCENE, "quads": SCENE, "tiles": SCENE, "cards": SCENE, "tiles, direct": DIRECT, "reference, direct": LIMITED, "reference": SCENE}
pictures, seconds = {}, {}
for way, scene in WAYS.items():
    traced = way.startswith("reference")
    renderer = cuticle.Renderer(scene, way.split(",")[0], samples=128 if traced else None)
    begun = time.process_time()
    pictures[way] = renderer.frame(0)
    seconds[way] = time.process_time() - begun
print({way: f"{seconds[way]:.1f} s of processor time" for way in WAYS})

# %%
figure, row = pyplot.subplots(1, 7, figsize=(14, 2.9), layout="constrained")
for axes, way in zip(row, WAYS):
    axes.imshow(numpy.clip(cuticle.tone_map(pictures[way])[..., :3], 0, 1))
    axes.set(title=way, xticks=[], yticks=[])
figure.savefig(figures / "pictures.png", dpi=130)

# %% [markdown]
# ## How far off, and in what
#
# The mean tells whether a picture is too bright; the correlation, whether what it draws lies where it should. Light that was scattered by several
# hairs is a guess in real time (`ambient` of the pass `lines`); the reference follows it. So two more pictures leave it
# out: `tiles` without that guess, and the reference limited to one scattering and to the same deep opacity map. They should agree.

# %%
mean, matching = {}, {}
truth = pictures["reference"][..., :3]
for way in list(WAYS)[:-1]:
    picture = pictures[way][..., :3]
    mean[way] = float(picture.mean() / truth.mean())
    matching[way] = float(numpy.corrcoef(picture.mean(axis=2).ravel(), truth.mean(axis=2).ravel())[0, 1])
figure, (left, right) = pyplot.subplots(1, 2, figsize=(12.5, 3.4), layout="constrained")
left.bar(list(mean), list(mean.values()), color="#3378bf")
left.axhline(1, color="black", linestyle=":")
left.set(title="mean brightness over the reference's")
right.bar(list(matching), list(matching.values()), color="#ed9921")
right.set(title="correlation with the reference", ylim=(0, 1))
for axes in (left, right):
    axes.set_xticks(range(len(mean)), [way.replace(", ", ",\n") for way in mean])
figure.savefig(figures / "against_reference.png", dpi=130)

# %% [markdown]
# ## What must hold

# %%
print({way: (round(mean[way], 3), round(matching[way], 3)) for way in mean})
assert all(numpy.isfinite(picture).all() for picture in pictures.values())
assert all(0.8 < mean[way] < 1.7 for way in ("lines", "quads", "tiles", "cards"))
direct = [pictures[way][..., :3].mean() for way in ("tiles, direct", "reference, direct")]
print(f"direct light: tiles over reference {direct[0] / direct[1]:.3f}")
assert 0.8 < direct[0] / direct[1] < 1.25 and mean["reference, direct"] < 0.7
assert min(matching[way] for way in ("lines", "quads", "tiles")) > 0.8
