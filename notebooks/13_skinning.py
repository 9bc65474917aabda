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
# # What a twist does to skin, and to the hair on it
#
# Linear blend skinning mixes matrices. Half way between a joint and one that is turned by an angle a about the limb, the mixed matrix is no
# rotation: it shrinks the limb to |1 - t + t exp(ia)| of its radius, to a line at half a turn. Dual quaternions mix rigid motions, and keep
# it round. Roots of hair on the limb go where the skin goes.
#
# The numbers are those of the study `skinning`.

# %%
import os
import pathlib

import matplotlib.pyplot as pyplot

import cuticle

figures = pathlib.Path(os.environ.get("CUTICLE_FIGURES", "figures"))
figures.mkdir(parents=True, exist_ok=True)
study = cuticle.study("skinning", quick=False)
plots = {plot: study.curves(plot) for plot in ("volume", "sections")}
analytic = {"linear_blend": plots["volume"]["linear blend, analytic"][1], "dual_quaternion": [1] * len(plots["volume"]["dual_quaternion"][0])}
kept = {method: list(zip(*plots["volume"][method], analytic[method])) for method in analytic}
print({method: f"{curve[-1][1]:.5f} of the volume kept at half a turn" for method, curve in kept.items()})

# %%
figure, (volume, radius) = pyplot.subplots(1, 2, figsize=(9, 3.8), layout="constrained")
for (method, curve), marker in zip(kept.items(), "os"):
    (line,) = volume.plot([p[0] for p in curve], [p[1] for p in curve], marker, fillstyle="none", label=method.replace("_", " "))
    volume.plot([p[0] for p in curve], [p[2] for p in curve], "-", color=line.get_color(), linewidth=1, label="analytic")
volume.set(xlabel="twist, degrees", ylabel="volume over that at rest", ylim=(0, 1.08), xticks=range(0, 181, 30))
for name, style in (("linear_blend", "-"), ("dual_quaternion", "-"), ("linear blend, analytic", "k:")):
    radius.plot(*plots["sections"][name], style, label=name.replace("_", " "))
radius.set(xlabel="place along the tube", ylabel="radius over that at rest", ylim=(0, 1.08), title="half a turn")
for axes in (volume, radius):
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8)
figure.savefig(figures / "skinning.png", dpi=130)

# %% [markdown]
# ## What must hold

# %%
assert all(abs(p[1] - p[2]) < 1e-4 for curve in kept.values() for p in curve)
assert abs(kept["linear_blend"][-1][1] - 1 / 3) < 1e-4
