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
# # What a scene asks for is what runs
#
# Each pass states which facts of the scene demand it. The plan follows, with a reason for every pass that runs and for every one that
# does not. Here a scene grows, fact by fact, and the plan with it.

# %%
import os
import pathlib

import matplotlib.pyplot as pyplot
import numpy

import cuticle

figures = pathlib.Path(os.environ.get("CUTICLE_FIGURES", "figures"))
figures.mkdir(parents=True, exist_ok=True)
STEPS = {
    "bare hair": {"lights": [], "strand_count": 2000},
    "+ a light": {"lights": [{"to_light": [0.4, 0.8, 1], "irradiance": [6, 6, 6]}]},
    "+ shadows": {"shadow": {"method": {"deep_opacity": {}}}},
    "+ gravity": {"simulation": {"solver": {"exact": {}}, "effects": {"gravity": {}}}},
    "+ colliders": {"simulation": {"solver": {"exact": {}}, "effects": {"gravity": {}, "colliders": {}}}, "colliders": {"head": True}},
    "+ wind": {"simulation": {"solver": {"exact": {}}, "effects": {"gravity": {}, "colliders": {}, "wind": {}}}},
}
scene, plans = {}, {}
for name, change in STEPS.items():
    scene = {**scene, **change}
    plans[name] = cuticle.plan(scene)
names = list(dict.fromkeys(planned.name for plan in plans.values() for planned in plan.passes))
for planned in plans["+ wind"].passes:
    print(f"{planned.name:22} {planned.dispatches:3} dispatches {planned.draws:2} draws  {planned.reason}")

# %%
runs = numpy.array([[name in [planned.name for planned in plan.passes] for plan in plans.values()] for name in names], float)
figure, axes = pyplot.subplots(figsize=(8, 0.3 * len(names) + 1.6), layout="constrained")
axes.imshow(runs, cmap="Blues", vmin=0, vmax=1.3, aspect="auto")
axes.set_xticks(range(len(plans)), list(plans))
axes.set_yticks(range(len(names)), names)
axes.set_xticks(numpy.arange(len(plans)) - 0.5, minor=True)
axes.set_yticks(numpy.arange(len(names)) - 0.5, minor=True)
axes.grid(which="minor", color="white", linewidth=2)
axes.tick_params(which="minor", length=0)
axes.set_title("Which passes run")
figure.savefig(figures / "passes.png", dpi=130)

# %% [markdown]
# ## Why not
#
# What is left out has a reason too.

# %%
for name in ("wind", "water", "deep_opacity", "velocity"):
    print(f"{name}: {plans['bare hair'].why(name)}")

# %% [markdown]
# ## What each way of drawing costs, in work handed to the device

# %%
work = {}
for way in cuticle.render_methods():
    plan = cuticle.plan(scene, method=way)
    work[way] = (len(plan.passes), sum(planned.dispatches for planned in plan.passes), sum(planned.draws for planned in plan.passes))
figure, axes = pyplot.subplots(figsize=(8, 3.6), layout="constrained")
for place, what in enumerate(("passes", "dispatches", "draws")):
    axes.bar(numpy.arange(len(work)) + 0.27 * (place - 1), [counts[place] for counts in work.values()], 0.25, label=what)
axes.set_xticks(range(len(work)), list(work))
axes.set_title("A frame of the last scene")
axes.legend()
figure.savefig(figures / "cost.png", dpi=130)

# %% [markdown]
# ## What must hold

# %%
counts = [len(plan.passes) for plan in plans.values()]
print(dict(zip(plans, counts)), work)
assert counts == sorted(counts) and counts[-1] > counts[0]
assert plans["bare hair"].why("deep_opacity").startswith("left out") and "deep_opacity" in [p.name for p in plans["+ shadows"].passes]
assert "wind" in plans["+ wind"].why("wind") and plans["+ colliders"].why("wind").startswith("left out")
