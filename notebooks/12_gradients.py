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
# # Gradients: absorption and roughness from a picture of one fibre
#
# A close-up of a single fibre shows everything that its parameters do: across it, h runs from -1 to 1; along it, where the fibre bends, the inclination changes.
# `cuticle.gradients` differentiates the model by every parameter (automatic differentiation through the formulas), so a few
# Gauss-Newton steps find the parameters that made a picture.

# %%
import os
import pathlib

import matplotlib.pyplot as pyplot
import numpy

import cuticle

figures = pathlib.Path(os.environ.get("CUTICLE_FIGURES", "figures"))
figures.mkdir(parents=True, exist_ok=True)
MODEL, BY = "chiang", ["sigma_a", "beta_m", "beta_n"]
TRUTH = {"sigma_a": [0.2, 0.45, 0.9], "beta_m": 0.22, "beta_n": 0.35}
ALONG, ACROSS = 96, 24

# %% [markdown]
# ## The picture
#
# The fibre is an arc of 100 degrees, seen from the front; one light stands above it to the side. Each pixel is S cos(theta_i) at its own inclinations and offset.

# %%
bend = numpy.radians(numpy.linspace(-50, 50, ALONG))[:, None]
offset = numpy.linspace(-0.96, 0.96, ACROSS)[None, :]
tangent = numpy.stack([numpy.cos(bend), numpy.zeros_like(bend), -numpy.sin(bend)], -1)  # the viewer is at +z, the arc lies in the plane of x and z
viewer, light = numpy.array([0, 0, 1.0]), numpy.array([0.25, 0.75, 0.35]) / numpy.linalg.norm([0.25, 0.75, 0.35])


def inclination(direction):
    return numpy.degrees(numpy.arcsin(tangent @ direction))


def across(direction):
    left = direction - (tangent @ direction)[..., None] * tangent
    return left / numpy.linalg.norm(left, axis=-1, keepdims=True)


around = (numpy.cross(across(viewer), across(light)) * tangent).sum(-1), (across(viewer) * across(light)).sum(-1)
ANGLES = dict(theta_i_deg=inclination(light), theta_o_deg=inclination(viewer), phi_deg=numpy.degrees(numpy.arctan2(*around)), h=offset)
facing = numpy.cos(numpy.radians(inclination(light)))[..., None]


def settings(values):
    return {"sigma_a": values[:3], "beta_m": values[3], "beta_n": values[4], "field": "near"}


def picture(values):
    return cuticle.eval(MODEL, "S", set=settings(values), **ANGLES) * facing


truth = numpy.array([*TRUTH["sigma_a"], TRUTH["beta_m"], TRUTH["beta_n"]])
clean = picture(truth)
noise = 0.005 * clean.max()
photo = clean + numpy.random.default_rng(3).normal(0, noise, clean.shape)

# %% [markdown]
# ## Are the gradients right?
#
# Each against differences of the picture itself, of the fourth order.


# %%
def with_gradients(values):
    found = cuticle.gradients(MODEL, "S", BY, set=settings(values), **ANGLES)
    names = ["sigma_a.r", "sigma_a.g", "sigma_a.b", "beta_m", "beta_n"]
    return found.values * facing, numpy.stack([found.derivatives[name] * facing for name in names], -1)


_, derivatives = with_gradients(truth)
worst = 0.0
for k, step in enumerate(1e-3 * truth):
    at = [picture(truth + n * step * numpy.eye(5)[k]) for n in (-2, -1, 1, 2)]
    differences = (at[0] - 8 * at[1] + 8 * at[2] - at[3]) / (12 * step)
    worst = max(worst, float(numpy.abs(differences - derivatives[..., k]).max() / numpy.abs(derivatives[..., k]).max()))
print(f"gradients against differences: {worst:.1e} of the largest")

# %% [markdown]
# ## Recovery
#
# From a start far away: the picture, its derivatives, a damped step, again. Steps are taken in logarithms, which keeps every parameter above 0.

# %%
values, damping = numpy.array([0.6, 0.6, 0.6, 0.5, 0.6]), 1e-2
path, losses = [values], []
for iteration in range(25):
    image, slopes = with_gradients(values)
    residual = (photo - image).ravel() / noise
    jacobian = slopes.reshape(-1, 5) * values / noise
    losses.append(float(residual @ residual / residual.size))
    normal = jacobian.T @ jacobian
    while damping < 1e6:
        change = numpy.linalg.solve(normal + damping * numpy.diag(normal.diagonal()), jacobian.T @ residual)
        trial = numpy.clip(values * numpy.exp(numpy.clip(change, -1, 1)), 0.02, 3)
        if numpy.mean(((photo - picture(trial)) / noise) ** 2) < losses[-1]:
            values, damping = trial, damping / 5
            break
        damping *= 5
    path.append(values)
    if numpy.abs(change).max() < 1e-6:
        break
sigma = numpy.sqrt(numpy.linalg.inv(normal).diagonal()) * values
NAMES = ["sigma_a red", "sigma_a green", "sigma_a blue", "beta_m", "beta_n"]
for name, value, one_sigma, wanted in zip(NAMES, values, sigma, truth):
    print(f"{name:14} {value:.4f} +- {one_sigma:.4f}   truth {wanted}")

figure, row = pyplot.subplots(1, 3, figsize=(9, 4.2), layout="constrained")
for axes, image, words in zip(row, (photo, picture(path[0]), picture(values)), ("the picture", "the start", "recovered")):
    axes.imshow(numpy.clip(cuticle.tone_map(numpy.clip(3 * image / clean.max(), 0, None).astype(numpy.float32)), 0, 1), aspect="auto", extent=(-1, 1, -50, 50))
    axes.set(title=words, xlabel="h, across the fibre")
row[0].set_ylabel("bend, degrees")
figure.savefig(figures / "fibre.png", dpi=130)

figure, axes = pyplot.subplots(figsize=(7.5, 4.2), layout="constrained")
steps = numpy.array(path)
ends = numpy.abs(steps / truth - 1)
for k, (name, color) in enumerate(zip(NAMES, ("#bf3845", "#2d8f4e", "#3378bf", "#ed9921", "#8b5fbf"))):
    axes.semilogy(numpy.maximum(ends[:, k], 1e-4), color=color)
order = numpy.argsort(ends[-1])
for place, k in enumerate(order):  # from the nearest to the truth upwards
    axes.annotate(NAMES[k], (len(steps) - 1, 10 ** (-3.3 + 0.45 * place)), xytext=(10, 0), textcoords="offset points", color=("#bf3845", "#2d8f4e", "#3378bf", "#ed9921", "#8b5fbf")[k])
axes.set(xlabel="Gauss-Newton step", ylabel="distance from the truth, relative", title="Five parameters from one noisy picture", xlim=(0, (len(steps) - 1) * 1.35))
figure.savefig(figures / "recovery.png", dpi=130)

# %% [markdown]
# ## What must hold

# %%
assert worst < 1e-6
assert (numpy.abs(values - truth) < 4 * sigma).all() and (numpy.abs(values / truth - 1) < 0.05).all()
assert abs(losses[-1] - 1) < 0.05
