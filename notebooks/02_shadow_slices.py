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
# # How many slices does an opacity shadow map need?
#
# An opacity shadow map stores, for slices through the hair along the light, how much hair lies in front of each slice. More slices follow the
# hair's depth more closely and cost more. Here the error of its transmittance against ray-traced truth is drawn over the number of
# slices, beside two answers that need no map at all: no shadow (T = 1), and the one constant that fits best.
#
# The numbers come from `cuticle study shadows --quick`, run here unless CUTICLE_STUDY names a folder that holds its study.csv.

# %%
import csv
import os
import pathlib
import subprocess
import tempfile

import matplotlib.pyplot as pyplot

figures = pathlib.Path(os.environ.get("CUTICLE_FIGURES", "figures"))
figures.mkdir(parents=True, exist_ok=True)
folder = os.environ.get("CUTICLE_STUDY")
if not folder:
    folder = tempfile.mkdtemp()
    subprocess.run([os.environ.get("CUTICLE_PROGRAM", "cuticle"), "study", "shadows", "--quick", "--out", folder], check=True, stdout=subprocess.DEVNULL)
with open(pathlib.Path(folder) / "study.csv", newline="") as file:
    rows = list(csv.DictReader(file))
baselines = {row["method"]: float(row["mean_error"]) for row in rows if row["method"] in ("none (T = 1)", "the best constant")}
maps = [row for row in rows if row["method"] == "opacity_map"]
print(f"{len(maps)} settings of the opacity map; baselines {baselines}")

# %%
resolutions = sorted({int(row["resolution"]) for row in maps})
curves = {r: sorted((int(row["slices"]), float(row["mean_error"]), float(row["p95_error"])) for row in maps if int(row["resolution"]) == r) for r in resolutions}

figure, axes = pyplot.subplots(figsize=(8, 4.6), layout="constrained")
for marker, (r, curve) in zip("osD^v" * 2, curves.items()):
    (line,) = axes.plot([p[0] for p in curve], [p[1] for p in curve], marker + "-", markersize=9, fillstyle="none", label=f"{r} x {r}, mean")
    axes.plot([p[0] for p in curve], [p[2] for p in curve], ":", color=line.get_color(), label=f"{r} x {r}, 95th percentile")
for (name, value), style in zip(baselines.items(), ("--", "-.")):
    axes.axhline(value, color="black", linestyle=style, linewidth=1, label=f"{name}: {value:.3f}")
slices = sorted({int(row["slices"]) for row in maps})
axes.set(xlabel="slices", ylabel="|error| of transmittance", xscale="log", ylim=(0, None), title="Opacity map against ray-traced truth, 0.05 < T < 0.95")
axes.set_xticks(slices, [str(s) for s in slices])
axes.minorticks_off()
axes.grid(alpha=0.3)
figure.legend(loc="outside right upper", fontsize=8)
figure.savefig(figures / "shadow_slices.png", dpi=130)

# %% [markdown]
# ## What must hold
#
# More slices never make the mean error much worse, many slices beat few, and the best map beats both answers without one.

# %%
for r, curve in curves.items():
    errors = [p[1] for p in curve]
    print(f"{r} x {r}: " + ", ".join(f"{s} slices {e:.4f}" for s, e, _ in curve))
    assert errors[-1] < errors[0]
    assert all(later < 1.25 * earlier for earlier, later in zip(errors, errors[1:]))
best = min(float(row["mean_error"]) for row in maps)
assert best < baselines["the best constant"] < baselines["none (T = 1)"]
