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
# # Tables for an engine, and their error
#
# Engines look hair up in textures: M over (sin theta_i, sin theta_o), N over (cos phi, cos theta_d). What does the table lose? Each texel is exact; the error
# lies between them, where the sampler interpolates. It falls with the square of the texel's width where the function is smooth, and
# far slower at the caustic of TRT, where N is infinite and no table follows.

# %%
import os
import pathlib

import matplotlib.pyplot as pyplot
import numpy

import cuticle

figures = pathlib.Path(os.environ.get("CUTICLE_FIGURES", "figures"))
figures.mkdir(parents=True, exist_ok=True)
HAIR = {"eta": 1.55, "sigma_a": 0.2}
SIZES = (16, 32, 64, 128)
tables = {size: cuticle.bake("marschner", layout="nalu", size=size, set=HAIR) for size in SIZES}
print({name: values.shape for name, values in tables[128].items() if name != "manifest"})

# %% [markdown]
# ## The tables

# %%
shown = {"M": (..., slice(0, 3)), "N_TT_R": (..., slice(0, 3)), "N_TRT": (..., slice(0, 3))}
figure, row = pyplot.subplots(1, 3, figsize=(10, 3.6), layout="constrained")
for axes, (name, channels) in zip(row, shown.items()):
    table = tables[128][name][channels]
    axes.imshow(numpy.clip(table / numpy.percentile(table, 99), 0, 1) ** 0.5, interpolation="nearest")
    axes.set(title=name, xticks=[], yticks=[])
figure.get_layout_engine().set(w_pad=0.1, h_pad=0.1)
figure.savefig(figures / "tables.png", dpi=130)

# %% [markdown]
# ## The error between texels
#
# Points off the grid, looked up as an engine does (bilinear, clamped), against the model itself. TT is smooth but at its edge; TRT has
# the caustic.

# %%
chance = numpy.random.default_rng(1)
cos_phi, cos_theta_d = chance.uniform(-0.999, 0.999, 20000), chance.uniform(0.3, 1, 20000)
phi_deg, theta_d_deg = numpy.degrees(numpy.arccos(cos_phi)), numpy.degrees(numpy.arccos(cos_theta_d))


def looked_up(table, u, v):
    size = len(table)
    x, y = numpy.clip(u, 0, 1) * (size - 1), numpy.clip(v, 0, 1) * (size - 1)
    left, top = (numpy.minimum(a.astype(int), size - 2) for a in (x, y))
    a, b = (x - left)[:, None], (y - top)[:, None]
    corner = lambda i, j: table[top + i, left + j]
    return (corner(0, 0) * (1 - a) + corner(0, 1) * a) * (1 - b) + (corner(1, 0) * (1 - a) + corner(1, 1) * a) * b


lobes = {"TT": ("N_TT_R", slice(0, 3)), "TRT": ("N_TRT", slice(0, 3))}
errors = {}
for lobe, (name, channels) in lobes.items():
    exact = cuticle.eval("marschner", "N", lobe, HAIR, phi_deg=phi_deg, theta_d_deg=theta_d_deg)
    scale = numpy.sqrt((numpy.minimum(exact, numpy.percentile(exact, 99)) ** 2).mean())
    for size in SIZES:
        difference = numpy.abs(looked_up(tables[size][name][..., channels], (cos_phi + 1) / 2, cos_theta_d) - exact)
        errors[lobe, size] = float(difference.mean() / scale), float(numpy.percentile(difference, 99) / scale)

figure, axes = pyplot.subplots(figsize=(6.4, 4), layout="constrained")
for lobe, color in (("TT", "#ed9921"), ("TRT", "#bf3845")):
    for place, (style, what) in enumerate((("o-", "mean"), ("o:", "99 in 100 below"))):
        axes.loglog(SIZES, [errors[lobe, size][place] for size in SIZES], style, color=color, label=f"{lobe}, {what}")
axes.set(xlabel="texels a side", ylabel="error over the lobe's rms", title="Between the texels")
axes.set_xticks(SIZES, [str(size) for size in SIZES])
axes.minorticks_off()
axes.legend(loc="lower left")
figure.savefig(figures / "error.png", dpi=130)

# %% [markdown]
# ## What must hold

# %%
for lobe in lobes:
    print(lobe, {size: tuple(round(e, 5) for e in errors[lobe, size]) for size in SIZES})
gain = {lobe: errors[lobe, 16][0] / errors[lobe, 128][0] for lobe in lobes}
assert gain["TT"] > 20 and 2 < gain["TRT"] < gain["TT"] / 4
assert errors["TT", 128][0] < 0.001 and errors["TRT", 128][0] > 10 * errors["TT", 128][0]
