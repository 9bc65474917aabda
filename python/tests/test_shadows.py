"""Every shadow method on arrays of points, against formulas and the truth."""
import signal
import subprocess
import sys
import time

import numpy
import pytest

import cuticle


def sheet(layers=1, count=200, radius=1e-4):
    """Layers of straight hairs side by side that touch, 20 mm apart from layer to layer, along x."""
    z = (numpy.arange(count) - count / 2) * 2 * radius
    x = numpy.linspace(-0.02, 0.02, 3)
    points = [[[a, -0.02 * layer, b] for a in x] for layer in range(layers) for b in z]
    return cuticle.make_groom(numpy.array(points), radii=radius)


BELOW = numpy.array([[0.001 * k, -0.1, 0.0] for k in range(-3, 4)], numpy.float32)
METHODS = [entry["name"] for entry in cuticle.methods()]
HAS_TRUTH = "truth" in METHODS


@pytest.mark.parametrize("method", METHODS)
def test_Transmittance_EveryMethodBehindThreeSheets_IsThePower(method):
    """Each ray crosses three fibres; methods that spread hair over depth or texels stay within 0.1."""
    expected = 1.0 if method == "none" else 0.6**3
    found = cuticle.shadows.transmittance(sheet(3), (0, 1, 0), BELOW, method, alpha=0.4)
    assert found.dtype == numpy.float32 and found.shape == (7,)
    assert ((0 <= found) & (found <= 1)).all()
    assert found.mean() == pytest.approx(expected, abs=0.1) or method == "shadow_map"


def test_Transmittance_AboveTheHair_IsOne():
    assert cuticle.shadows.transmittance(sheet(), (0, 1, 0), -BELOW, "deep_opacity", layers=16, resolution=64) == pytest.approx(numpy.ones(7))


@pytest.mark.skipif(not HAS_TRUTH, reason="built without Embree")
def test_Truth_BehindASheet_IsOneCrossingWithItsNoise():
    values, noise = cuticle.shadows.truth(sheet(), (0, 1, 0), BELOW, alpha=0.4, rays=256)
    assert values == pytest.approx(numpy.full(7, 0.6), abs=1e-6) and noise.shape == (7,) and noise.max() < 1e-6


def test_Transmittance_OfThreeOpacities_IsThatOfEach():
    groom = sheet(2)
    colours = cuticle.shadows.transmittance(groom, (0, 1, 0), BELOW, "opacity_map", alpha=(0.2, 0.4, 0.6), slices=32)
    assert colours.shape == (7, 3)
    alone = cuticle.shadows.transmittance(groom, (0, 1, 0), BELOW, "opacity_map", alpha=0.4, slices=32)
    assert colours[:, 1] == pytest.approx(alone, abs=1e-3)


def test_Transmittance_WithoutPoints_IsThatOfTheVertices():
    details = cuticle.shadows.transmittance(sheet(), method="deep_opacity", details=True)
    assert details["values"].shape == (600,) and details["bytes"] > 0 and details["build_ms"] >= 0 and "cpu" in details["device"]


@pytest.mark.skipif(not HAS_TRUTH, reason="built without Embree")
def test_Transmittance_AtWhatACameraSees_LeavesTheLightOfTheTruth():
    groom = sheet(3)
    seen = cuticle.shadows.transmittance(groom, (0.2, 1, 0.1), camera=(0.1, 1, 0.2), receivers=400, alpha=1, details=True)
    true, _ = cuticle.shadows.truth(groom, (0.2, 1, 0.1), camera=(0.1, 1, 0.2), receivers=400, alpha=1, rays=16, footprint_radius_mm=0.02)
    assert seen["points"].shape == (seen["values"].size, 3) and seen["values"].shape == true.shape
    assert seen["values"].mean() == pytest.approx(true.mean(), abs=0.02) and true.mean() > 0.9


def test_Transmittance_SeenFromEitherSide_IsThatOfTheSideSeen():
    lit, dark = (cuticle.shadows.transmittance(sheet(), (0, 1, 0), seen_from=(0, y, 0), alpha=1, resolution=1024).mean() for y in (1, -1))
    assert lit > 0.95 and lit >= dark


def test_Transmittance_OfStrandsThatStandForManyFibres_LeavesOutWhatLiesWithinAFibre():
    """A tress whose wide strands lie within each other: more of it is in front of a fibre than of a strand's surface."""
    roots = numpy.random.default_rng(1).uniform(-0.01, 0.01, (400, 3)) * [0, 1, 1]
    tress = cuticle.make_groom(roots[:, None] + numpy.linspace(-0.02, 0.02, 5)[:, None] * [1, 0, 0], radii=1e-3)
    seen = {"seen_from": (0, 1, 0.2), "alpha": 0.2, "resolution": 512}
    strands, fibres = (cuticle.shadows.transmittance(tress, (0, 1, 0), fibre_width=width, **seen).mean() for width in (1, 0.1))
    assert 0 < fibres < 0.9 * strands
    with pytest.raises(cuticle.Error, match="fibre_width = 2: outside 0 .. 1"):
        cuticle.shadows.transmittance(sheet(), fibre_width=2)


def test_Transmittance_OfThreeOpacities_AtWhatACameraSees():
    assert cuticle.shadows.transmittance(sheet(), camera=(0, 1, 0), receivers=50, alpha=(0.2, 0.4, 0.6)).shape[1] == 3


def test_Transmittance_OfAPointLight_DependsOnItsPlace():
    lit, dark = (cuticle.shadows.transmittance(sheet(), (0, y, 0), BELOW, "deep_opacity", point_light=True).mean() for y in (-1, 1))
    assert dark < lit


@pytest.mark.parametrize("arguments, words", [
    (dict(method="deep_opacty"), ["deep_opacty", "deep_opacity"]), (dict(layers=0), ["layers", "0", "1"]), (dict(layer=3), ["layer", "layers"]),
    (dict(alpha=2), ["alpha", "2", "1"]), (dict(light=(0, 0, 0)), ["light"]), (dict(light=(0, 1)), ["light", "(3,)"]),
    (dict(points=[[0, 1]]), ["points", "(1, 2)", "(n, 3)"]), (dict(points=BELOW, camera=(0, 1, 0)), ["points", "camera"]),
    (dict(camera=(0, 0, 0), points=None), ["camera"]), (dict(camera=(0, 1, 0), points=None, receivers=0), ["receivers", "0"]), (dict(points=[[0, numpy.nan, 1]]), ["finite"]),
])
def test_Transmittance_BadInput_SaysWhat(arguments, words):
    with pytest.raises(cuticle.Error) as error:
        cuticle.shadows.transmittance(sheet(), **{"light": (0, 1, 0), "points": BELOW, **arguments})
    assert all(word in str(error.value) for word in words), str(error.value)


@pytest.mark.skipif(not HAS_TRUTH, reason="built without Embree")
def test_Interrupt_Truth_Ends():
    program = """
import cuticle
groom = cuticle.grow({'strands': {'density': 30000}})
print('begun', flush=True)
try:
    cuticle.shadows.truth(groom, rays=65536)
    print('ended')
except KeyboardInterrupt:
    print('stopped')
"""
    with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "begun\n"
        time.sleep(1)
        process.send_signal(signal.SIGINT)
        assert process.communicate(timeout=100)[0] == "stopped\n"
