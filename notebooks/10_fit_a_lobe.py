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
# # Fit a measured lobe, with uncertainties
#
# A goniometer gives a few hundred noisy numbers. Which parameters made them, how well are they known, and which cannot be told apart at all? Here the
# measurement is simulated, by a model whose parameters are known, so that each answer can be checked.

# %%
import os
import pathlib

import matplotlib.pyplot as pyplot
import numpy

import cuticle

figures = pathlib.Path(os.environ.get("CUTICLE_FIGURES", "figures"))
figures.mkdir(parents=True, exist_ok=True)
TRUTH = {"beta": 0.18, "sigma_a": (0.15, 0.3, 0.6), "alpha": -0.05}
chance = numpy.random.default_rng(7)
count = 240
ANGLES = dict(theta_i_deg=numpy.repeat([-30.0, 0.0, 30.0], count // 3), theta_o_deg=chance.uniform(-60, 60, count), phi_deg=chance.uniform(0, 180, count))
exact = cuticle.eval("marschner", "S", set=TRUTH, **ANGLES)
sigma = 0.01 * exact.max()
measured = exact + chance.normal(0, sigma, exact.shape)

# %% [markdown]
# ## The fit
#
# Least squares within the parameters' ranges, with derivatives from the formulas themselves.

# %%
FREE = ["beta", "alpha", "sigma_a"]
fit = cuticle.fit("marschner", measured, FREE, {"beta": 0.35, "sigma_a": 0.1}, sigma=sigma, **ANGLES)
truth = {"beta": TRUTH["beta"], "alpha": TRUTH["alpha"], **{f"sigma_a.{c}": value for c, value in zip("rgb", TRUTH["sigma_a"])}}
for name, parameter in fit.parameters.items():
    print(f"{name:10} {parameter.value:8.4f} +- {parameter.sigma:.4f}   truth {truth[name]:.4f}   {abs(parameter.value - truth[name]) / parameter.sigma:.1f} sigma off")
print(f"rms residual {fit.residual:.2f} sigma")

order = numpy.flatnonzero(ANGLES["theta_i_deg"] == 30)
order = order[numpy.argsort(ANGLES["theta_o_deg"][order])]
figure, (lobe_axes, residual_axes) = pyplot.subplots(1, 2, figsize=(11, 4.2), layout="constrained")
found = cuticle.eval("marschner", "S", set=fit.settings, **ANGLES)
bright = order[found[order, 0] > 2 * sigma]
lobe_axes.errorbar(found[bright, 0], measured[bright, 0], sigma, fmt="o", markersize=3, linewidth=0.8, color="#bf3845")
ends = [2 * sigma, found[bright, 0].max()]
lobe_axes.loglog(ends, ends, color="black", linewidth=0.8)
lobe_axes.xaxis.set_minor_formatter("")
lobe_axes.set(xlabel="S of the fit, red, 1/sr", ylabel="S measured", title="Light from 30 degrees, S above 2 sigma")
residual_axes.hist(((measured - found) / sigma).ravel(), 40, density=True, color="#3378bf", alpha=0.7)
at = numpy.linspace(-4, 4, 200)
residual_axes.plot(at, numpy.exp(-0.5 * at**2) / numpy.sqrt(2 * numpy.pi), color="black", linewidth=1)
residual_axes.set(xlabel="residual, in sigma", ylabel="share", title="What is left is the noise that was put in")
figure.savefig(figures / "fit.png", dpi=130)

# %% [markdown]
# ## Do the intervals hold what they promise?
#
# The same measurement with other noise, 100 times. A 95 % interval should hold the truth in 95 of them.

# %%
inside = {name: 0 for name in truth}
beta = []
for repeat in range(100):
    again = cuticle.fit("marschner", exact + numpy.random.default_rng(100 + repeat).normal(0, sigma, exact.shape), FREE, fit.settings, sigma=sigma, **ANGLES)
    beta.append((again.parameters["beta"].value, *again.parameters["beta"].interval_95))
    for name, value in truth.items():
        low, high = again.parameters[name].interval_95
        inside[name] += low <= value <= high
print({name: f"{number} of 100 intervals hold the truth" for name, number in inside.items()})
beta = numpy.array(sorted(beta))
figure, axes = pyplot.subplots(figsize=(8, 3.8), layout="constrained")
missed = (beta[:, 1] > TRUTH["beta"]) | (beta[:, 2] < TRUTH["beta"])
for rows, color in ((~missed, "#3378bf"), (missed, "#bf3845")):
    axes.errorbar(numpy.flatnonzero(rows), beta[rows, 0], [beta[rows, 0] - beta[rows, 1], beta[rows, 2] - beta[rows, 0]], fmt="o", markersize=2.5, linewidth=0.8, color=color)
axes.axhline(TRUTH["beta"], color="black", linewidth=0.8)
axes.set(xlabel="repeated measurement, sorted", ylabel="beta, radians", title=f"95 % intervals of beta: {missed.sum()} of 100 miss the truth (red)")
figure.savefig(figures / "intervals.png", dpi=130)

# %% [markdown]
# ## What the data cannot tell
#
# R alone does not pass through the fibre: it says nothing about absorption. And a fit by the wrong model leaves more than the noise.

# %%
surface = cuticle.eval("marschner", "S", "R", TRUTH, **ANGLES)
refused = cuticle.fit("marschner", surface, ["beta", "sigma_a"], lobe="R", sigma=sigma, **ANGLES)
print(f"from R alone these data do not depend on {', '.join(name for group in refused.inseparable for name in group)}")
wrong = cuticle.fit("karis", measured, ["roughness"], sigma=sigma, **ANGLES)
print(f"karis, roughness free: rms residual {wrong.residual:.1f} sigma, AIC {wrong.aic - fit.aic:.0f} above")

# %% [markdown]
# ## What must hold

# %%
assert fit.converged and all(abs(parameter.value - truth[name]) < 4 * parameter.sigma for name, parameter in fit.parameters.items())
assert 0.9 < fit.residual < 1.1 and all(86 <= number <= 100 for number in inside.values())
assert any("sigma_a" in name for group in refused.inseparable for name in group) and not refused.parameters
assert wrong.residual > 3 * fit.residual
