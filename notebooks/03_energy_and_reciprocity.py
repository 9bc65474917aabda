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
# # Energy and reciprocity at grazing angles: find the bug
#
# A fibre that absorbs nothing returns all light that it meets: for every direction of view the integral of S over all directions of light,
# cos(theta_i) dtheta_i dphi, is 1 (the white furnace). At grazing angles most mistakes in a fibre model show first, because cosines go to 0 there.
# The model in question is often your own, so the checks take any function.

# %%
import os
import pathlib

import matplotlib.pyplot as pyplot
import numpy

import cuticle

figures = pathlib.Path(os.environ.get("CUTICLE_FIGURES", "figures"))
figures.mkdir(parents=True, exist_ok=True)
WHITE = {"sigma_a": 0.0}

# %% [markdown]
# ## What published models return
#
# Marschner's model as printed divides by cos^2 theta_d and normalises M in theta_h: with a view along the fibre it returns many times the light
# that came in. The corrected variant has R, TT and TRT alone, so at grazing angles, where light stays longer inside, it loses a quarter; around 60 degrees
# it makes 2 %, because its tilted lobes take their shares at theta_d. d'Eon's carries the remaining orders and keeps all.

# %%
view = numpy.append(numpy.arange(0.0, 85.0, 5.0), [85.0, 87.0, 88.0, 89.0])
energy = {
    "Marschner, as printed": cuticle.albedo("marschner", view, {**WHITE, "variant": "as_published"})[:, 0],
    "Marschner, corrected": cuticle.albedo("marschner", view, WHITE)[:, 0],
    "d'Eon": cuticle.albedo("deon", view, WHITE)[:, 0],
}
figure, axes = pyplot.subplots(figsize=(7.5, 4.4), layout="constrained")
for (name, curve), color, shift in zip(energy.items(), ("#bf3845", "#3378bf", "#2d8f4e"), (14, -16, 8)):
    axes.semilogy(view, curve, color=color)
    axes.annotate(name, (view[5], curve[5]), xytext=(0, shift), textcoords="offset points", color=color, ha="center")
axes.axhline(1, color="black", linewidth=0.8, linestyle=":")
axes.set(xlabel="inclination of the view theta_o, degrees", ylabel="energy returned, of 1 (logarithmic)", xlim=(0, 90),
         title="A white fibre in an even sky: only one of these keeps all light")
figure.savefig(figures / "energy.png", dpi=130)

# %% [markdown]
# ## Energy or reciprocity
#
# Exchanging light and viewer may not change S. In a separable model the share A of each path belongs to an inclination: to theta_o, and all energy is
# kept but S is not symmetric; or to theta_d, and S is symmetric but lobes of different width mix the shares of different inclinations. No
# choice gives both. How far is each from what it gives up?

# %%
light = numpy.linspace(-80, 80, 33)[:, None]
eye = numpy.linspace(-80, 80, 33)[None, :]
given_up = {}
for share in ("theta_o", "theta_d"):
    settings = {**WHITE, "attenuation_angle": share, "alpha": 0.0}
    there, back = (cuticle.eval("deon", "S", set=settings, theta_i_deg=a, theta_o_deg=b, phi_deg=150)[..., 0] for a, b in ((light, eye), (eye, light)))
    given_up[share] = (numpy.abs(there - back) / numpy.maximum(there, back).max(), numpy.abs(cuticle.albedo("deon", view, settings)[:, 0] - 1))
figure, (map_axes, curve_axes) = pyplot.subplots(1, 2, figsize=(10, 4.2), layout="constrained")
shown = map_axes.pcolormesh(eye[0], light[:, 0], given_up["theta_o"][0], cmap="magma", vmin=0)
figure.colorbar(shown, ax=map_axes, label="|S(i, o) - S(o, i)| over the largest S")
map_axes.set(xlabel="theta_o, degrees", ylabel="theta_i, degrees", title="shares at theta_o: not symmetric (deon)", aspect="equal")
for share, color, words in (("theta_o", "#3378bf", "shares at theta_o"), ("theta_d", "#bf3845", "shares at theta_d")):
    curve_axes.semilogy(view, numpy.maximum(given_up[share][1], 1e-7), color=color)
    curve_axes.annotate(words, (view[8], max(given_up[share][1][8], 1e-7)), xytext=(0, 8), textcoords="offset points", color=color, ha="center")
curve_axes.set(xlabel="theta_o, degrees", ylabel="energy lost or made", title="shares at theta_d: energy is not kept", ylim=(3e-8, 1))
figure.savefig(figures / "reciprocity.png", dpi=130)

# %% [markdown]
# ## Find the bug
#
# Three colleagues hand in a near-field fibre as a function of theta_i, theta_o, phi and h (radians). One is right. What is wrong with the others?


# %%
def right(theta_i, theta_o, phi, h):
    angles = dict(theta_i_deg=numpy.degrees(theta_i), theta_o_deg=numpy.degrees(theta_o), phi_deg=numpy.degrees(phi), h=h)
    return cuticle.eval("chiang", "S", set={"sigma_a": 0.0, "field": "near", "alpha": 0.0}, **angles)


SUSPECTS = {"first": right, "second": lambda theta_i, *rest: right(theta_i, *rest) * numpy.cos(theta_i)[:, None], "third": lambda *points: right(*points) / numpy.pi}
reports = {name: cuticle.check_model(function, near_field=True, white=True, complete=True, quick=True) for name, function in SUSPECTS.items()}
for name, report in reports.items():
    furnace = next(check for check in report["checks"] if check["check"] == "white_furnace")
    print(f"{name:7} {furnace['verdict']:5} {furnace['words']}\n        cause: {report['cause']}: {report['cause_words']}")

# %% [markdown]
# The furnace's curve over the inclination is the mistake's signature: a factor is level, a cosine falls with the view.

# %%
chance = numpy.random.default_rng(1)
directions = 20000
sine, phi, h = chance.uniform(-1, 1, directions), chance.uniform(-numpy.pi, numpy.pi, directions), chance.uniform(-1, 1, directions)
views = numpy.radians(numpy.arange(0.0, 81.0, 10.0))
figure, axes = pyplot.subplots(figsize=(7.5, 4.2), layout="constrained")
measured = {}
for (name, function), color in zip(SUSPECTS.items(), ("#2d8f4e", "#3378bf", "#bf3845")):
    sums = [function(numpy.arcsin(sine), numpy.full(directions, at), phi, h)[:, 0] for at in views]
    measured[name] = numpy.array([4 * numpy.pi * values.mean() for values in sums])
    axes.errorbar(numpy.degrees(views), measured[name], [4 * numpy.pi * values.std() / numpy.sqrt(directions) for values in sums], color=color, capsize=2)
    axes.annotate(f"{name}: {reports[name]['cause'].replace('_', ' ').replace('none', 'no mistake')}", (numpy.degrees(views[6]), measured[name][6]), xytext=(26 if name == "second" else 0, 16), textcoords="offset points", color=color, ha="center")
axes.set(xlabel="inclination of the view theta_o, degrees", ylabel="energy returned, 20,000 directions, 1 sigma", ylim=(0, 1.2), title="Three white fibres, two mistakes")
figure.savefig(figures / "suspects.png", dpi=130)

# %% [markdown]
# ## What must hold

# %%
assert energy["Marschner, as printed"].max() > 10 and abs(energy["Marschner, corrected"][:13] - 1).max() < 0.03 and energy["Marschner, corrected"][-1] < 0.8 and numpy.abs(energy["d'Eon"] - 1).max() < 1e-3
assert given_up["theta_d"][0].max() < 1e-9 < 0.01 < given_up["theta_o"][0].max()
assert given_up["theta_o"][1].max() < 1e-3 < 0.01 < given_up["theta_d"][1].max()
assert {name: report["cause"] for name, report in reports.items()} == {"first": "none", "second": "cosine_included", "third": "spurious_one_over_pi"}
assert abs(measured["first"][:5].mean() - 1) < 0.1 and abs(measured["third"].mean() * numpy.pi / measured["first"].mean() - 1) < 0.01
