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
# # Marschner's model as printed, and as it has to be
#
# The paper of 2003 is the root of every hair shader, and not all that is printed in it holds. The variant `as_published` evaluates it word by
# word; `corrected` is what it has to be. Two differences can be measured without trusting either:
#
# - **Energy.** A fibre that absorbs nothing gives back what it receives: the albedo is 1. The printed S is M N / cos^2 theta_d with a
#   Gaussian M of unit area in theta_h. But theta_h is half the sum of two angles, so that the area over theta_i is 2; and 1 / cos^2
#   theta_d has no bound. The corrected M is d'Eon's, which integrates to 1 over the sphere.
# - **The path inside the fibre.** The printed absorption takes a crossing by 2 (1 + cos 2 gamma_t), the square of the chord; the corrected
#   one takes the chord itself, 2 cos gamma_t.

# %%
import os
import pathlib

import matplotlib.pyplot as pyplot
import numpy

import cuticle

figures = pathlib.Path(os.environ.get("CUTICLE_FIGURES", "figures"))
figures.mkdir(parents=True, exist_ok=True)
VARIANTS = {"as_published": "#bf3845", "corrected": "#3378bf"}
WHITE = {"sigma_a": 0, "alpha": 0}

# %% [markdown]
# ## The area of M
#
# The integral of M cos theta_i over theta_i must be 1 for each theta_o, but for what widening past the ends of the fibre loses.

# %%
theta = numpy.linspace(-90, 90, 3601)
step = numpy.radians(theta[1] - theta[0])
viewers = numpy.array([0, 30, 60, 80, 88])


def area(variant, lobe, viewer):
    values = cuticle.eval("marschner", "M", lobe, {**WHITE, "variant": variant}, theta_i_deg=theta, theta_o_deg=viewer)[:, 0]
    return float((values * numpy.cos(numpy.radians(theta))).sum() * step)


areas = {variant: [area(variant, "R", viewer) for viewer in viewers] for variant in VARIANTS}
figure, (left, right) = pyplot.subplots(1, 2, figsize=(9.5, 3.8), layout="constrained")
for variant, color in VARIANTS.items():
    left.plot(viewers, areas[variant], "o-", color=color, label=variant)
left.axhline(1, color="black", linestyle=":", linewidth=1)
left.set(xlabel="theta_o, degrees", ylabel="integral of M cos theta_i", title="Energy of M (R)", ylim=(0, None))
left.legend()

# %% [markdown]
# ## The albedo of a fibre that absorbs nothing
#
# The printed model gives back more than it receives, most at grazing angles, where 1 / cos^2 theta_d grows without bound. The corrected one
# stays below 1: paths of higher orders than TRT are missing, and its lobes take Fresnel's shares at theta_d, which differs from one incident
# direction to the next; that is reciprocal. `attenuation_angle=theta_o` takes them at the viewer's angle instead: that loses
# the higher orders alone, and is not reciprocal.

# %%
grazing = numpy.linspace(0, 85, 18)
albedo = {variant: cuticle.albedo("marschner", grazing, {**WHITE, "variant": variant})[:, 0] for variant in VARIANTS}
albedo["at theta_o"] = cuticle.albedo("marschner", grazing, {**WHITE, "attenuation_angle": "theta_o"})[:, 0]
for variant, color in {**VARIANTS, "at theta_o": "#5a9e4b"}.items():
    right.semilogy(grazing, albedo[variant], color=color, label=variant)
right.axhline(1, color="black", linestyle=":", linewidth=1)
right.set(xlabel="theta_o, degrees", ylabel="albedo without absorption", title="A white fibre must give 1")
right.legend()
figure.savefig(figures / "energy.png", dpi=130)

# %% [markdown]
# ## The colour of the path inside
#
# A crossing at offset h = 0 is two radii long, so that TT takes away exp(-2 sigma_a) but for Fresnel's (1 - F)^2. The printed formula
# takes exp(-4 sigma_a): hair comes out twice as dark as its absorption says.

# %%
sigma = numpy.linspace(0, 1.5, 31)
fresnel = ((1.55 - 1) / (1.55 + 1)) ** 2
crossing = {variant: [cuticle.eval("marschner", "A", "TT", {"sigma_a": s, "variant": variant}, theta_d_deg=0, h=0)[0] for s in sigma] for variant in VARIANTS}
figure, axes = pyplot.subplots(figsize=(6, 3.8), layout="constrained")
for variant, color in VARIANTS.items():
    axes.plot(sigma, crossing[variant], color=color, label=variant)
axes.plot(sigma, (1 - fresnel) ** 2 * numpy.exp(-2 * sigma), "k:", label="(1 - F)^2 exp(-2 sigma_a)")
axes.set(xlabel="sigma_a, 1/radius", ylabel="A of TT at h = 0", title="What one crossing leaves", ylim=(0, 1))
axes.legend()
figure.savefig(figures / "absorption.png", dpi=130)

# %% [markdown]
# ## What must hold

# %%
print({variant: numpy.round(values, 3) for variant, values in areas.items()})
print({variant: numpy.round(values[[0, -1]], 3) for variant, values in albedo.items()})
assert numpy.abs(numpy.array(areas["corrected"]) - 1).max() < 0.01
assert areas["as_published"][0] > 1.5
assert albedo["as_published"].max() > 2 and max(albedo["at theta_o"].max(), albedo["corrected"].max()) < 1.001
assert albedo["corrected"][-1] < albedo["at theta_o"][-1] < 1
assert numpy.abs(albedo["corrected"][grazing < 50] - 1).max() < 0.05
assert numpy.allclose(crossing["corrected"], (1 - fresnel) ** 2 * numpy.exp(-2 * sigma), rtol=1e-9)
assert crossing["as_published"][-1] < 0.5 * crossing["corrected"][-1]
