"""Sampling, densities, gradients and batches against each other."""
import numpy
import pytest

import cuticle

MODELS = [entry["name"] for entry in cuticle.models()]
WITHOUT_JETS = {"huang"}


def angles(count=200, seed=1):
    chance = numpy.random.default_rng(seed)
    return dict(theta_i_deg=chance.uniform(-60, 60, count), theta_o_deg=chance.uniform(-60, 60, count), phi_deg=chance.uniform(-175, 175, count),
                h=chance.uniform(-0.9, 0.9, count))


def test_Sample_MeanOfWeights_IsTheAlbedo():
    u = numpy.random.default_rng(2).random((40000, 8))
    drawn = cuticle.sample("marschner", 20.0, u, {"sigma_a": 0.2})
    assert drawn.weight.mean(axis=0) == pytest.approx(cuticle.albedo("marschner", 20.0, {"sigma_a": 0.2}), rel=0.02)
    density = cuticle.pdf("marschner", {"sigma_a": 0.2}, theta_i_deg=drawn.theta_i_deg, theta_o_deg=20.0, phi_deg=drawn.phi_deg)
    assert density == pytest.approx(drawn.pdf, rel=1e-6)


@pytest.mark.parametrize("arguments, words", [(dict(u=numpy.zeros((3, 7))), ["u", "(3, 7)"]), (dict(u=numpy.ones((3, 8))), ["u", "1"]),
                                              (dict(u=numpy.zeros((3, 8)), precision="f16"), ["f16"])])
def test_Sample_BadInput_SaysWhat(arguments, words):
    with pytest.raises(cuticle.Error) as error:
        cuticle.sample("marschner", 0.0, **arguments)
    assert all(word in str(error.value) for word in words)


def inside(parameter):
    """A value that can be changed to both sides; an ellipse, as a circle's formulas are others."""
    if parameter["type"] == "rgb":
        return (0.1, 0.25, 0.6)
    value, (least, most) = float(parameter["default"]), parameter["range"]
    reach = 3e-3 * max(abs(value), 0.01)
    return 0.9 if parameter["name"] == "aspect" else min(max(value, least + 2 * reach), most - 2 * reach)


def difference(model, base, name, points):
    """By one parameter or component, of the fourth order."""
    parameter, _, component = name.partition(".")

    def at(shift):
        value = base[parameter]
        moved = tuple(v + shift * (c == component) for v, c in zip(value, "rgb")) if component else value + shift
        return cuticle.eval(model, "S", set={**base, parameter: moved}, **points)

    value = base[parameter]["rgb".index(component)] if component else base[parameter]
    step = 2e-5 * max(abs(value), 0.01)  # beside an ellipse's caustic longer ones miss its slope: 1e-5 at five times as much
    return (8 * (at(step) - at(-step)) - (at(2 * step) - at(-2 * step))) / (12 * step)


@pytest.mark.parametrize("model", [name for name in MODELS if name not in WITHOUT_JETS])
def test_Gradients_ByEveryParameter_AreThoseOfDifferences(model):
    """Within 2e-7 of the largest derivative, and 2e-7 of the values' own size; measured: 3.6e-8 at most."""
    points = angles(60)
    entry = next(entry for entry in cuticle.models() if entry["name"] == model)
    base = {p["name"]: inside(p) for p in entry["parameters"] if p["type"] in ("real", "rgb")}
    found = cuticle.gradients(model, set=base, **points)
    assert found.values == pytest.approx(cuticle.eval(model, "S", set=base, **points), rel=1e-12)
    assert {name.partition(".")[0] for name in found.derivatives} == set(base)
    for name, derivative in found.derivatives.items():
        expected = difference(model, base, name, points)
        assert numpy.abs(derivative - expected).max() <= 2e-7 * max(numpy.abs(expected).max(), numpy.abs(found.values).max()), name


def test_Gradients_OfAModelWithout_SayWhichHave():
    with pytest.raises(cuticle.Error, match="huang.*marschner"):
        cuticle.gradients("huang", **angles(3))
    with pytest.raises(cuticle.Error, match="etta"):
        cuticle.gradients("marschner", by=["etta"], **angles(3))


def vectors(points):
    theta_i, theta_o, phi = (numpy.radians(points[name]) for name in ("theta_i_deg", "theta_o_deg", "phi_deg"))
    to_light = numpy.stack([numpy.sin(theta_i), numpy.cos(theta_i), 0 * phi]).astype(numpy.float32)
    to_viewer = numpy.stack([numpy.sin(theta_o), numpy.cos(theta_o) * numpy.cos(phi), numpy.cos(theta_o) * numpy.sin(phi)]).astype(numpy.float32)
    return to_light, to_viewer


@pytest.mark.parametrize("model", MODELS)
def test_Batch_EveryModel_IsEval(model):
    points = angles()
    values = cuticle.eval(model, "S", precision="f32", **points)
    batch = cuticle.Batch(model)
    found = batch.eval(*vectors(points), points["h"].astype(numpy.float32))
    assert found.dtype == numpy.float32 and found.shape == (3, 200)
    assert found.T == pytest.approx(values, rel=2e-3, abs=2e-3 * values.max())
    assert batch.pdf(*vectors(points), points["h"]) == pytest.approx(cuticle.pdf(model, **points), rel=5e-3, abs=5e-3 * values.max())


def test_Batch_Out_IsWrittenInPlace():
    points, out = angles(70000), numpy.zeros((3, 70000), numpy.float32)
    arrays = vectors(points)
    assert cuticle.Batch("chiang").eval(*arrays, points["h"].astype(numpy.float32), out) is out and out.max() > 0
    drawn = cuticle.Batch("chiang").sample(arrays[1], numpy.random.default_rng(3).random((8, 70000)), points["h"])
    assert numpy.linalg.norm(drawn, axis=0) == pytest.approx(numpy.ones(70000), abs=1e-5)
    with pytest.raises(cuticle.Error, match="to_viewer.*70000"):
        cuticle.Batch("chiang").eval(arrays[0], arrays[1][:, :5], out=out)


def test_Eval_LargeAndBroadcastArrays_GiveTheSameBitsAsOneByOne():
    theta_o, phi = numpy.linspace(-80, 80, 301)[:, None], numpy.linspace(-170, 170, 57)
    all_at_once = cuticle.eval("karis", "S", theta_i_deg=10, theta_o_deg=theta_o, phi_deg=phi, h=0.3)
    some = cuticle.eval("karis", "S", theta_i_deg=10, theta_o_deg=theta_o[200, 0], phi_deg=phi[31], h=0.3)
    assert numpy.array_equal(all_at_once[200, 31], some)


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("quantity", ["S", "pdf"])
def test_Eval_InFloat_IsTheFormulasInDouble(model, quantity):
    """By the batch where the model has one; broadcast and turned by whole turns and by the viewer's azimuth as well."""
    points = {**angles(60), "phi_o_deg": numpy.array([[0.0], [40.0]])}
    points["phi_deg"] = points["phi_deg"] + 360 * 1000
    exact = cuticle.eval(model, quantity, **points)
    assert cuticle.eval(model, quantity, precision="f32", **points) == pytest.approx(exact, rel=2e-3, abs=2e-3 * exact.max())


def test_Eval_LightsTogether_AreThoseOneByOne():
    points = {"theta_i_deg": numpy.linspace(-80, 80, 60), "theta_o_deg": numpy.array([[20.0], [-40.0]]), "phi_deg": numpy.linspace(5, 175, 60)}
    together = cuticle.eval("huang", "S", set={"roughness": 0.4, "samples": 1024}, together=8, **points)
    apart = cuticle.eval("huang", "S", set={"roughness": 0.4, "samples": 2048}, **points)
    assert together.shape == apart.shape and together.sum() == pytest.approx(apart.sum(), rel=0.02)
    assert numpy.array_equal(together[1, 7], cuticle.eval("huang", "S", set={"roughness": 0.4, "samples": 1024}, together=8, theta_o_deg=-40,
                                                          theta_i_deg=points["theta_i_deg"][7], phi_deg=points["phi_deg"][7]))


@pytest.mark.parametrize("model,quantity,together,words", [("karis", "S", 1, "karis.*huang"), ("huang", "M", 1, "only S"), ("huang", "S", 0, "1 .. 256")])
def test_Eval_LightsTogetherWhereTheyAreNot_SaysWhy(model, quantity, together, words):
    with pytest.raises(cuticle.Error, match=words):
        cuticle.eval(model, quantity, theta_i_deg=0, theta_o_deg=0, phi_deg=0, together=together)


def test_Eval_InFloatOutOfRange_SaysWhat():
    with pytest.raises(cuticle.Error, match="theta_o_deg: 91"):
        cuticle.eval("karis", "S", theta_i_deg=numpy.zeros(3), theta_o_deg=[0, 91, 0], phi_deg=0, precision="f32")


def test_Conformance_HoldsForTheModelItselfInFloat():
    rows = [row for row in cuticle.conformance("karis") if row["quantity"] == "S" and row["lobe"] == "sum"]
    assert len(rows) > 100 and any(row["hard"] for row in rows)
    for settings in {row["settings"] for row in rows}:
        of_fibre = [row for row in rows if row["settings"] == settings]
        angles = {name: numpy.array([row[name] for row in of_fibre]) for name in ("theta_i_deg", "theta_o_deg", "phi_deg")}
        found = cuticle.eval("karis", "S", "sum", settings, precision="f32", **angles)
        expected = numpy.array([[row[c] for c in "rgb"] for row in of_fibre])
        assert (abs(found - expected).max(axis=1) <= [row["tolerance"] for row in of_fibre]).all()
