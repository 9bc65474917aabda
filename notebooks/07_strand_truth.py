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
# # A strand's truth: chains, the heavy elastica, stability
#
# A strand solver is right when it agrees with mechanics, and useful when it stays so at the time step of a game. Here the three solvers are held
# against closed forms and against an elastica solved to twelve digits, then provoked.

# %%
import os
import pathlib

import matplotlib.pyplot as pyplot
import numpy

import cuticle

figures = pathlib.Path(os.environ.get("CUTICLE_FIGURES", "figures"))
figures.mkdir(parents=True, exist_ok=True)
COLORS = {"classic": "#bf3845", "exact": "#3378bf", "rod": "#2d8f4e"}
GRAVITY = 9.81

# %% [markdown]
# ## Errors against closed forms, by the time step
#
# The study `motion` compares periods of pendulums and chains, free fall, and the height of a bending fibre with what mechanics says.

# %%
study = cuticle.study("motion")
SHOWN = {"pendulum, 90 degrees: period (exact)": "pendulum from 90 degrees: period", "hanging chain, lowest mode: period (exact)": "hanging chain: period",
         "free fall: shape after 0.5 s, over L (rod)": "free fall: shape (rod)", "heavy elastica, Gamma 10: H/W (rod)": "heavy elastica (rod)"}
figure, axes = pyplot.subplots(figsize=(8, 4.6), layout="constrained")
for (name, words), color in zip(SHOWN.items(), ("#3378bf", "#ed9921", "#8b5fbf", "#2d8f4e")):
    step, error = (numpy.array(values, float) for values in study.curves("truths")[name])
    axes.loglog(step, numpy.maximum(error, 1e-6), "o-", color=color, markersize=4)
    axes.annotate(words, (step.max(), error[step.argmax()]), xytext=(6, 4 if "pendulum" in words else -4 if "chain" in words else 0), textcoords="offset points", color=color, va="center", fontsize=9)
axes.set(xlabel="time step", ylabel="relative error", title="Dynamics: errors fall with the time step; at rest (elastica) the step does not matter")
axes.set_xlim(right=axes.get_xlim()[1] * 3)
axes.set_xticks(step, [f"1/{round(1 / value)} s" for value in step])
axes.minorticks_off()
figure.savefig(figures / "truths.png", dpi=130)

# %% [markdown]
# ## The heavy elastica
#
# A fibre that is clamped level and bends under its own weight: EI theta'' = w (L - s) cos(theta) with theta(0) = 0 and theta'(L) = 0, where w is the weight over
# length. Gamma = w L^3 / EI says how heavy it is. The truth: shooting for theta'(0) with a Runge-Kutta method of fourth order.


# %%
def elastica(gamma, steps=4000):
    """Places (steps + 1, 2) over the length L = 1: along, and down."""
    step = 1 / steps

    def slopes(s, theta, bend):
        return bend, gamma * (1 - s) * numpy.cos(theta)

    def shoot(bend):
        angles, theta = [0.0], 0.0
        for i in range(steps):
            s = i * step
            a1, b1 = slopes(s, theta, bend)
            a2, b2 = slopes(s + step / 2, theta + step / 2 * a1, bend + step / 2 * b1)
            a3, b3 = slopes(s + step / 2, theta + step / 2 * a2, bend + step / 2 * b2)
            a4, b4 = slopes(s + step, theta + step * a3, bend + step * b3)
            theta, bend = theta + step / 6 * (a1 + 2 * a2 + 2 * a3 + a4), bend + step / 6 * (b1 + 2 * b2 + 2 * b3 + b4)
            angles.append(theta)
        return bend, numpy.array(angles)

    low, high = -gamma, 0.0  # with a bend of 0 at the clamp, the end's is positive
    for _ in range(36):
        middle = 0.5 * (low + high)
        if shoot(middle)[0] > 0:
            high = middle
        else:
            low = middle
    angles = -shoot(0.5 * (low + high))[1]
    middle = 0.5 * (angles[1:] + angles[:-1])
    return numpy.vstack([[0, 0], numpy.cumsum(numpy.stack([numpy.cos(middle), numpy.sin(middle)], -1) * step, axis=0)])


def settled(gamma, vertices=33, length=0.1, density=1300.0, radius=35e-6):
    """The same by the solver `rod`, at rest: places over the length."""
    weight = density * numpy.pi * radius**2 * GRAVITY
    young_modulus = weight * length**3 / gamma / (numpy.pi * radius**4 / 4)
    points = numpy.zeros((1, vertices, 3))
    points[0, :, 0] = numpy.linspace(0, length, vertices)
    motion = cuticle.simulate(cuticle.make_groom(points), "rod", ["gravity"], sag_free=False, young_modulus=young_modulus, shear_modulus=young_modulus / 3,
                              clamped_vertices=1, damping=30, inner_step=1 / 960, double_precision=True)
    places = motion.step(150).positions / length
    return numpy.stack([places[:, 0], -places[:, 1]], -1)


figure, axes = pyplot.subplots(figsize=(7.5, 4.6), layout="constrained")
ends = {}
for gamma, color in ((3, "#3378bf"), (10, "#ed9921"), (40, "#bf3845")):
    truth, found = elastica(gamma), settled(gamma)
    axes.plot(truth[:, 0], -truth[:, 1], color=color)
    axes.plot(found[::2, 0], -found[::2, 1], "o", fillstyle="none", color=color, markersize=5)
    axes.annotate(f"Gamma = {gamma}", (truth[-1, 0], -truth[-1, 1]), xytext=(6, -4), textcoords="offset points", color=color)
    ends[gamma] = float(numpy.linalg.norm(truth[-1] - found[-1]))
axes.set(xlabel="along the clamp, over L", ylabel="height, over L", title="A fibre bends under its weight: line, the elastica; circles, the solver rod", aspect="equal", xlim=(-0.05, 1.2))
figure.savefig(figures / "elastica.png", dpi=130)
print({gamma: f"end off by {100 * end:.2f} % of the length" for gamma, end in ends.items()})

# %% [markdown]
# ## Stability
#
# A quarter turn of the head within one frame, frames from a millisecond to a second: what must not happen is that hair gets longer, or is not finite.

# %%
curl = numpy.stack([numpy.stack([0.01 * numpy.cos(12 * t), -0.2 * t, 0.01 * numpy.sin(12 * t)], -1) for t in [numpy.linspace(0, 1, 24)] * 8])
curl[:, :, 0] += 0.02 * numpy.arange(8)[:, None]
turn = numpy.array([[0, 0, 1, 0], [0, 1, 0, 0], [-1, 0, 0, 0], [0, 0, 0, 1]], float)
frames = numpy.array([1e-3, 1 / 120, 1 / 30, 0.1, 0.3, 1.0])
stretch = {name: [] for name in COLORS}
for name in COLORS:
    for seconds in frames:
        motion = cuticle.simulate(cuticle.make_groom(curl), name, ["gravity"])
        largest = 0.0
        for frame in range(12):
            state = motion.step(head=turn if frame % 4 < 2 else numpy.eye(4), seconds=float(seconds))
            assert numpy.isfinite(state.positions).all()
            largest = max(largest, float(motion.stretch().max()) - 1)
        stretch[name].append(largest)
figure, axes = pyplot.subplots(figsize=(7.5, 4.2), layout="constrained")
for name, values in stretch.items():
    axes.loglog(frames, numpy.maximum(values, 1e-8), "o-", color=COLORS[name], markersize=4)
    axes.annotate(name, (frames[-1], max(values[-1], 1e-8)), xytext=(6, -7 if name == "exact" else 5), textcoords="offset points", color=COLORS[name], va="center")
axes.set(xlabel="duration of a frame, s", ylabel="largest stretch, share of the length", title="The head turns by 90 degrees within a frame: who keeps the length?", xlim=(frames[0] / 1.5, frames[-1] * 3))
figure.savefig(figures / "stretch.png", dpi=130)

# %% [markdown]
# ## What must hold

# %%
assert max(ends.values()) < 0.003
assert max(stretch["exact"]) < 1e-4 and max(stretch["rod"]) < 1e-2
step, error = study.curves("truths")["pendulum, 90 degrees: period (exact)"]
assert min(error) < 0.02 and error[step.index(min(step))] <= max(error)
