"""Tables, fits and studies from Python."""
import numpy
import pytest

import cuticle


@pytest.mark.parametrize("format", ["exr", "png8", "ktx2"])
def test_Tables_WrittenAndRead_AreTheSameValues(tmp_path, format):
    baked = cuticle.bake("marschner", layout="nalu", size=16, format=format, out=tmp_path, targets=["three"])
    read = cuticle.read_tables(tmp_path)
    assert set(read) == set(baked) and (tmp_path / "three").is_dir()
    for name in set(baked) - {"manifest"}:
        assert read[name] == pytest.approx(baked[name], rel=1e-6, abs=1e-6 * float(baked[name].max()))
    assert cuticle.check_tables(tmp_path)["passed"]


def test_Tables_FittedTexels_HaveTheSmallerError():
    def error(tables):
        return tables["manifest"]["scattering"]["S.r"]["rms"]

    assert error(cuticle.bake("marschner", size=32, fit="texels")) < error(cuticle.bake("marschner", size=32))


def test_CheckTables_AfterAGammaCurve_NamesTheMistake(tmp_path):
    from matplotlib import image
    cuticle.bake("marschner", layout="nalu", size=16, format="png8", out=tmp_path)
    pixels = image.imread(tmp_path / "M.png")
    image.imsave(tmp_path / "M.png", numpy.dstack([pixels[..., :3] ** (1 / 2.2), pixels[..., 3]]))
    verdict = next(table for table in cuticle.check_tables(tmp_path)["tables"] if table["table"] == "M")
    assert not verdict["passed"] and "sRGB" in str(verdict)


@pytest.mark.parametrize("dialect", cuticle.table_choices()["dialects"])
def test_Snippet_OfEachLanguage_ReadsEveryTable(tmp_path, dialect):
    cuticle.bake("marschner", layout="nalu", size=16, out=tmp_path)
    text = cuticle.snippet(tmp_path, dialect)
    assert all(f"cuticle_read_{name}" in text for name in ("M", "N_TT_R", "N_TRT")) and "cuticle_hair_scattering" in text


def test_FitAnalytic_Code_HasAFunctionForEachLobe():
    fit = cuticle.fit_analytic(set={"sigma_a": 0.2})
    assert all(f"cuticle_N_{lobe}" in fit.code for lobe in ("R", "TT", "TRT")) and len(fit.lobes) == 3


@pytest.mark.parametrize("call, words", [
    (lambda: cuticle.bake("marschner", size=16, format="jpg"), ["jpg", "exr"]), (lambda: cuticle.bake("marschner", size=16, fit="best"), ["best", "texels"]),
    (lambda: cuticle.bake("marschner", size=16, targets=["unity"]), ["targets", "folder"]), (lambda: cuticle.read_tables("/nowhere"), ["/nowhere"]),
    (lambda: cuticle.snippet("/nowhere", "msl"), ["msl", "glsl"])])
def test_Tables_BadInput_SaysWhat(call, words):
    with pytest.raises(cuticle.Error) as error:
        call()
    assert all(word in str(error.value) for word in words)


def measured(noise, count=300):
    chance = numpy.random.default_rng(5)
    angles = dict(theta_i_deg=chance.uniform(-60, 60, count), theta_o_deg=chance.uniform(-60, 60, count), phi_deg=chance.uniform(0, 180, count))
    values = cuticle.eval("marschner", "S", set={"beta": 0.2, "sigma_a": (0.1, 0.2, 0.4)}, **angles)
    sigma = noise * values.max()
    return values + chance.normal(0, sigma, values.shape), sigma, angles


def test_Fit_OfNoisyValues_HoldsTheTruthWithinItsUncertainties():
    values, sigma, angles = measured(0.01)
    fit = cuticle.fit("marschner", values, ["beta", "sigma_a"], sigma=sigma, **angles)
    truth = {"beta": 0.2, "sigma_a.r": 0.1, "sigma_a.g": 0.2, "sigma_a.b": 0.4}
    assert set(fit.parameters) == set(truth) and fit.converged and fit.correlations.shape == (4, 4)
    assert all(abs(fit.parameters[name].value - value) < 4 * fit.parameters[name].sigma for name, value in truth.items())
    assert fit.residual == pytest.approx(1, abs=0.15)


def test_Fit_OfWhatCannotBeToldApart_SaysWhich():
    values, sigma, angles = measured(0.01)
    fit = cuticle.fit("marschner", values, ["delta_eta", "beta"], sigma=sigma, **angles)
    assert ["delta_eta"] in fit.inseparable and not fit.parameters


@pytest.mark.parametrize("change, word", [(dict(lobe=["R"] * 3), "lobe"), (dict(values=numpy.zeros((4, 2))), "values"), (dict(free=["etta"]), "etta"),
                                          (dict(loss="cubes"), "cubes")])
def test_Fit_BadInput_SaysWhat(change, word):
    values, _, angles = measured(0.01)
    with pytest.raises(cuticle.Error, match=word):
        cuticle.fit(**{"model": "marschner", "values": values, "free": ["beta"], **angles, **change})


def test_Study_Skinning_IsATable():
    study = cuticle.study("skinning")
    assert {row["method"] for row in study.rows()} == {"linear_blend", "dual_quaternion"}
    table = study.table()
    assert table.num_rows == 2 and min(table["seconds"].to_pylist()) > 0 and "linear_blend" in study.curves("volume")


def test_Study_UnknownNames_SayWhich():
    with pytest.raises(cuticle.Error, match="skining.*skinning"):
        cuticle.study("skining")
    with pytest.raises(cuticle.Error, match="twists"):
        cuticle.study("skinning", twists=3)
    with pytest.raises(KeyError, match="volume"):
        cuticle.study("skinning").curves("area")


class OnlyByDlpack:
    """What PyTorch and JAX share with numpy, and nothing else."""

    def __init__(self, array):
        self._array = array

    def __dlpack__(self, **arguments):
        return self._array.__dlpack__(**arguments)

    def __dlpack_device__(self):
        return self._array.__dlpack_device__()


def test_Arrays_ByDlpack_AreTakenAndGiven():
    points = numpy.random.default_rng(1).random((3, 4, 3)).astype(numpy.float32)
    groom = cuticle.make_groom(OnlyByDlpack(points))
    assert numpy.array_equal(numpy.from_dlpack(groom.positions), points.reshape(-1, 3))
    theta = numpy.array([0.0, 10.0, 20.0])
    angles = dict(theta_i_deg=5.0, phi_deg=30.0)
    assert numpy.array_equal(cuticle.eval("karis", "S", theta_o_deg=OnlyByDlpack(theta), **angles), cuticle.eval("karis", "S", theta_o_deg=theta, **angles))


def test_Threads_Limited_GiveTheSameBits():
    angles = dict(theta_i_deg=numpy.linspace(-80, 80, 5000), theta_o_deg=20.0, phi_deg=30.0, precision="f32")
    all_of_them = cuticle.eval("marschner", "S", **angles)
    cuticle.set_threads(1)
    try:
        assert numpy.array_equal(cuticle.eval("marschner", "S", **angles), all_of_them)
    finally:
        cuticle.set_threads(0)
