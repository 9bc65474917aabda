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
# # The lobes of a hair fibre
#
# Light that meets a hair leaves it in three ways: reflected at the surface (R), through the fibre (TT), or reflected once inside it (TRT).
# Marschner et al. (2003) give each way a longitudinal term M(theta_i, theta_o) and an azimuthal term N(theta_d, phi);
# the scattering function is S = sum of M N. The model here is the corrected variant: no division by cos^2 theta_d, exact roots, and the true
# length of the path inside the fibre. Neither M, N nor S includes the cosine of the incident angle.

# %%
import os
import pathlib

import matplotlib.pyplot as pyplot
import numpy

import cuticle

figures = pathlib.Path(os.environ.get("CUTICLE_FIGURES", "figures"))
figures.mkdir(parents=True, exist_ok=True)
HAIR = {"eta": 1.55, "sigma_a": 0.2}
LOBES = {"R": "#3378bf", "TT": "#ed9921", "TRT": "#bf3845"}

# %% [markdown]
# ## Longitudinal: where along the fibre
#
# The scales of the cuticle tilt the surface, so the peaks leave the mirror direction theta_o = -theta_i: R one way, TT and TRT the other.
# TT is half as wide as R, TRT twice.

# %%
theta_o = numpy.linspace(-89, 89, 713)
longitudinal = {lobe: cuticle.eval("marschner", "M", lobe, HAIR, theta_i_deg=30, theta_o_deg=theta_o)[:, 0] for lobe in LOBES}

figure, axes = pyplot.subplots(figsize=(7.5, 4.2), layout="constrained")
for lobe, color in LOBES.items():
    axes.plot(theta_o, longitudinal[lobe], color=color, label=lobe)
axes.axvline(-30, color="black", linestyle=":", linewidth=1, label="mirror direction")
axes.set(xlabel="theta_o, degrees", ylabel="M, 1/rad", title="Longitudinal terms for light from theta_i = 30 degrees", xlim=(-90, 90), ylim=(0, None))
axes.legend()
figure.savefig(figures / "longitudinal.png", dpi=130)

# %% [markdown]
# ## Azimuthal: where around the fibre
#
# For a smooth circular fibre N follows from the paths alone. With the effective index eta' at theta_d, a path that enters at offset h leaves at
# phi(h) = 4 asin(h / eta') - 2 asin(h) after one inner reflection. Where phi(h) turns around, at h_c^2 = (4 - eta'^2) / 3, many paths leave
# together: the caustic, where N_TRT is infinite but its integral is not.


# %%
def effective_index(eta, theta_d_deg):
    """eta' of Bravais: the index in the plane across the fibre."""
    theta_d = numpy.radians(theta_d_deg)
    return numpy.sqrt(eta**2 - numpy.sin(theta_d) ** 2) / numpy.cos(theta_d)


def caustic_azimuth(eta, theta_d_deg):
    """Azimuth of the TRT caustic in degrees; nan where eta' >= 2 and there is none."""
    index = effective_index(eta, theta_d_deg)
    offset = numpy.sqrt(numpy.where(index < 2, (4 - index**2) / 3, numpy.nan))
    return numpy.degrees(4 * numpy.arcsin(offset / index) - 2 * numpy.arcsin(offset))


phi = numpy.linspace(-180, 180, 7201)
azimuthal = {lobe: cuticle.eval("marschner", "N", lobe, HAIR, theta_d_deg=0, phi_deg=phi)[:, 0] for lobe in LOBES}
phi_c = float(caustic_azimuth(HAIR["eta"], 0.0))

figure, axes = pyplot.subplots(figsize=(7.5, 4.2), layout="constrained")
for lobe, color in LOBES.items():
    axes.semilogy(phi, numpy.maximum(azimuthal[lobe], 1e-9), color=color, label=lobe)
for sign in (-1, 1):
    axes.axvline(sign * phi_c, color="grey", linestyle="--", linewidth=1)
axes.annotate(f"caustic at phi = {phi_c:.2f} degrees", (phi_c, 0.6), xytext=(50, 0.9), arrowprops={"arrowstyle": "->"}, fontsize=10)
axes.set(xlabel="phi, degrees (0: back toward the light)", ylabel="N, 1/rad", title="Azimuthal terms at theta_d = 0", xlim=(-180, 180), ylim=(1e-4, 3))
axes.legend(loc="lower right")
figure.savefig(figures / "azimuthal.png", dpi=130)

# %% [markdown]
# The caustic moves toward phi = 0 as theta_d grows, and is gone where eta' reaches 2.

# %%
theta_d = numpy.linspace(0, 60, 121)
around = numpy.linspace(0.02, 40, 2000)
map_of_trt = cuticle.eval("marschner", "N", "TRT", HAIR, theta_d_deg=theta_d[:, None], phi_deg=around)[..., 0]

figure, axes = pyplot.subplots(figsize=(7.5, 4.2), layout="constrained")
shown = axes.pcolormesh(around, theta_d, numpy.log10(numpy.maximum(map_of_trt, 1e-4)), vmin=-3, vmax=0.5, cmap="magma", rasterized=True)
axes.plot(caustic_azimuth(HAIR["eta"], theta_d), theta_d, "--", color="white", linewidth=1.5, label="analytic caustic")
axes.set(xlabel="phi, degrees", ylabel="theta_d, degrees", title="N_TRT and its caustic")
axes.legend(loc="upper right", facecolor="black", labelcolor="white")
figure.colorbar(shown, ax=axes, label="log10 N_TRT, 1/rad")
figure.savefig(figures / "caustic.png", dpi=130)

# %% [markdown]
# ## S in the plane of the light
#
# A polar plot of S over theta_o for phi = 0 (the light's side, right half) and phi = 180 degrees (left half). The radius is logarithmic.

# %%
angle = numpy.linspace(-89.5, 89.5, 721)
figure, axes = pyplot.subplots(figsize=(6.2, 6.2), subplot_kw={"projection": "polar"}, layout="constrained")
for lobe, color in LOBES.items():
    front = cuticle.eval("marschner", "S", lobe, HAIR, theta_i_deg=30, theta_o_deg=angle, phi_deg=5)[:, 0]
    back = cuticle.eval("marschner", "S", lobe, HAIR, theta_i_deg=30, theta_o_deg=angle, phi_deg=180)[:, 0]
    direction = numpy.radians(numpy.concatenate([angle, 180 - angle[::-1]]))
    axes.plot(direction, numpy.maximum(3 + numpy.log10(numpy.maximum(numpy.concatenate([front, back[::-1]]), 1e-12)), 0), color=color, label=lobe)
axes.annotate("light, 30 degrees", (numpy.radians(30), 3.2), xytext=(-6, 8), textcoords="offset points", ha="right", color="goldenrod")
axes.plot([numpy.radians(30)] * 2, [0, 3.2], color="goldenrod", linewidth=2)
axes.set_rticks([0, 1, 2, 3], ["", "0.01", "0.1", "1 /rad$^2$"])
axes.set_rlabel_position(75)
axes.set_title("S over theta_o, phi = 5 and 180 degrees\n0: normal plane, 90: tip of the fibre")
axes.set_rmax(3.5)
axes.legend(loc="lower right", bbox_to_anchor=(1.12, -0.08))
figure.savefig(figures / "polar.png", dpi=130)

# %% [markdown]
# ## What must hold

# %%
peaks = {lobe: theta_o[longitudinal[lobe].argmax()] for lobe in LOBES}
print(f"peaks of M at theta_o = {peaks}, mirror direction -30")
assert (peaks["R"] + 30) * (peaks["TT"] + 30) < 0 and (peaks["TRT"] + 30) * (peaks["TT"] + 30) > 0
assert abs(peaks["R"] + 30) > abs(peaks["TT"] + 30)

positive = phi > 1
strongest = phi[positive][azimuthal["TRT"][positive].argmax()]
print(f"strongest N_TRT at {strongest:.3f} degrees, analytic caustic at {phi_c:.3f}")
assert abs(strongest - phi_c) < 0.06
assert abs(phi_c - 18.62) < 0.01

rows = theta_d < 45
assert numpy.abs(around[map_of_trt[rows].argmax(axis=1)] - caustic_azimuth(HAIR["eta"], theta_d[rows])).max() < 0.1

# Energy: the integral of N over phi is half the integral of A over h, for the smooth lobes by the trapezium rule here.
step = numpy.radians(phi[1] - phi[0])
h = (numpy.arange(4000) + 0.5) / 2000 - 1
for lobe in ("R", "TT"):
    attenuation = cuticle.eval("marschner", "A", lobe, HAIR, theta_d_deg=0, h=h)[:, 0].mean()
    energy = azimuthal[lobe].sum() * step
    print(f"{lobe}: integral of N {energy:.5f}, half the integral of A {attenuation:.5f}")
    assert abs(energy / attenuation - 1) < 2e-3
