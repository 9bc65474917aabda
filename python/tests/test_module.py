"""The compiled module against the formulas that it must give, and its errors."""
import os
import pathlib
import signal
import subprocess
import sys
import threading
import time

import numpy
import pytest

import cuticle


ROOT = pathlib.Path(__file__).resolve().parents[2]


def test_Import_ByThePythonThatSetupMakes_NeedsNoPath():
    """scripts/setup.sh tells .venv where the module is."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run([ROOT / ".venv/bin/python", "-c", "import cuticle; print(len(cuticle.models()))"], capture_output=True, text=True, env=environment)
    assert done.returncode == 0 and int(done.stdout) >= 9, done.stderr


def bessel_i0e(x):
    return numpy.i0(x) * numpy.exp(-x)


def test_Eval_LongitudinalTerm_IsTheClosedForm():
    beta, alpha = 0.2, 0.03
    theta_i, theta_o = numpy.radians(numpy.linspace(-80, 80, 9))[:, None], numpy.radians([-40.0, 25.0])[None, :]
    value = cuticle.eval("marschner", "M", "TT", {"beta": beta, "alpha": alpha}, theta_i_deg=numpy.degrees(theta_i), theta_o_deg=numpy.degrees(theta_o))
    v = (beta / 2) ** 2  # TT: half the width, shifted by -alpha in theta_i + theta_o
    results = []
    for shift in (alpha, -alpha):
        shifted = theta_o + shift
        a = numpy.cos(theta_i) * numpy.cos(shifted) / v
        results.append(bessel_i0e(a) * numpy.exp(a - (1 + numpy.sin(theta_i) * numpy.sin(shifted)) / v) / (v * (1 - numpy.exp(-2 / v))))
    assert value.shape == (9, 2, 3)
    assert min(numpy.abs(value[..., 0] / result - 1).max() for result in results) < 1e-6


def test_Eval_ReflectedAzimuth_IsTheClosedForm():
    """Without a cylinder's refraction R is F cos(phi / 2) / 4; at phi = 0, F is ((eta - 1) / (eta + 1))^2."""
    assert cuticle.eval("marschner", "N", "R", {"eta": 1.5}, theta_d_deg=0, phi_deg=0) == pytest.approx(numpy.full(3, 0.04 / 4), rel=1e-12)


def test_Eval_Broadcasting_FollowsNumpy():
    shape = cuticle.eval("marschner", "S", theta_i_deg=numpy.zeros((4, 1, 1)), theta_o_deg=numpy.zeros((3, 1)), phi_deg=numpy.zeros(2)).shape
    assert shape == (4, 3, 2, 3)
    phi = numpy.linspace(0, 170, 5)
    both = cuticle.eval("marschner", "N", "TT", theta_d_deg=numpy.array([[0.0], [30.0]]), phi_deg=phi)
    assert numpy.array_equal(both[1], cuticle.eval("marschner", "N", "TT", theta_d_deg=30, phi_deg=phi))


def test_Eval_Precisions_AgreeToFloat():
    phi = numpy.linspace(100, 170, 50)
    single, double = (cuticle.eval("marschner", "N", "TT", theta_d_deg=0, phi_deg=phi, precision=p) for p in ("f32", "f64"))
    assert not numpy.array_equal(single, double)
    assert numpy.abs(single - double).max() < 2e-5 * double.max()


def test_Eval_PresetAndSet_SetGoesOver():
    blond = cuticle.eval("marschner", "A", "TT", preset="blond", theta_d_deg=0, h=0)
    clear = cuticle.eval("marschner", "A", "TT", "sigma_a=0", preset="blond", theta_d_deg=0, h=0)
    assert blond[0] > blond[2] and clear[0] == clear[2] > blond[0]


def test_Eval_Hair_IsTheMappingsSettings():
    settings, words = cuticle.hair_mapping("kajiya_kay", "blond")
    angles = dict(theta_i_deg=[-40.0, 10.0], theta_o_deg=20.0, phi_deg=30.0)
    assert "exponent" in words and "blond" in cuticle.hairs()
    assert numpy.array_equal(cuticle.eval("kajiya_kay", "S", hair="blond", **angles), cuticle.eval("kajiya_kay", "S", set=settings, **angles))
    other = cuticle.eval("kajiya_kay", "S", set={"exponent": 1000}, hair="blond", **angles)
    assert not numpy.array_equal(other, cuticle.eval("kajiya_kay", "S", hair="blond", **angles))


def test_Absorption_OfAFibresColour_GivesItsAlbedo():
    sigma_a = cuticle.absorption_of_fibre("marschner", (0.8, 0.5, 0.2), {"eta": 1.5})
    assert cuticle.eval("marschner", "albedo", set={"eta": 1.5, "sigma_a": sigma_a}, theta_o_deg=0) == pytest.approx([0.8, 0.5, 0.2], abs=1e-9)
    assert max(cuticle.absorption_of_assembly((0.8, 0.5, 0.2))) < max(sigma_a)


def test_Absorption_OfPigments_DependsOnTheTable():
    assert cuticle.absorption_of_pigments("deon_pbrt", 2) == pytest.approx((0.838, 1.394, 2.74))
    assert cuticle.absorption_of_pigments("blender", 0, 1) == pytest.approx((0.343, 0.733, 1.924))
    with pytest.raises(ValueError, match="deon_pbrt"):
        cuticle.absorption_of_pigments("pbrt", 1)


def test_Eval_PdfErrorAndPhiO_AreTaken():
    phi_o = numpy.array([0.0, 45.0, 90.0])
    assert cuticle.eval("kajiya_kay", "pdf", theta_i_deg=0, theta_o_deg=0, phi_deg=0, phi_o_deg=phi_o).shape == (3, 3)
    assert (cuticle.eval("kajiya_kay", "error", theta_i_deg=0, theta_o_deg=0, phi_deg=0, phi_o_deg=phi_o) == 0).all()


@pytest.mark.parametrize("arguments, words", [
    (dict(model="kajiya_kay", quantity="S", hair="blonde"), ["blonde", "blond"]),
    (dict(model="kajiya_kay", quantity="S", hair="blond", preset="black"), ["preset", "hair"]),
    (dict(model="marschnr", quantity="S"), ["marschnr", "marschner"]),
    (dict(model="marschner", quantity="Q"), ["Q", "albedo"]),
    (dict(model="marschner", quantity="S", lobe="TTT", theta_i_deg=0, theta_o_deg=0, phi_deg=0), ["TTT", "TRT"]),
    (dict(model="marschner", quantity="S", set={"eta": 9}), ["eta", "9", "1.05"]),
    (dict(model="marschner", quantity="S", set={"etta": 1.5}), ["etta", "eta"]),
    (dict(model="marschner", quantity="S", precision="f16", theta_i_deg=0, theta_o_deg=0, phi_deg=0), ["f16", "f32"]),
    (dict(model="marschner", quantity="S", theta_i_deg=[0, 1], theta_o_deg=0, phi_deg=[0, 1, 2]), ["2", "3", "broadcast"]),
    (dict(model="marschner", quantity="S", theta_i_deg=float("nan"), theta_o_deg=0, phi_deg=0), ["theta_i_deg", "nan"]),
    (dict(model="marschner", quantity="S", theta_i_deg=0, theta_o_deg=[0, 91], phi_deg=0), ["theta_o_deg", "91", "-90 .. 90"]),
    (dict(model="marschner", quantity="S", theta_i_deg=0), ["S of marschner", "theta_o_deg, phi_deg"]),
    (dict(model="marschner", quantity="M", theta_i_deg=numpy.zeros((200000, 1)), theta_o_deg=numpy.zeros(200000)), ["200000 x 200000", "MiB"]),
])
def test_Eval_BadInput_IsAValueErrorThatSaysWhat(arguments, words):
    with pytest.raises(ValueError) as error:
        cuticle.eval(**arguments)
    for word in words:
        assert word in str(error.value)


@pytest.mark.parametrize("value", [None, "3", True, numpy.datetime64("2026-01-01"), [1, None], {"a": 1}, 1j])
def test_Eval_WhatIsNoNumber_IsATypeErrorThatNamesTheArgument(value):
    if value is None:
        with pytest.raises(ValueError, match="needs theta_o_deg"):
            cuticle.eval("marschner", "albedo", theta_o_deg=value)
        return
    with pytest.raises(TypeError, match="theta_o_deg"):
        cuticle.eval("marschner", "albedo", theta_o_deg=value)


@pytest.mark.parametrize("arguments, word", [(dict(size="128"), "size"), (dict(size=16.5), "size"), (dict(size=True), "size"),
                                             (dict(layout=3), "layout"), (dict(preset=3), "preset")])
def test_Bake_WrongTypes_AreNamedAsTheArgumentsAre(arguments, word):
    with pytest.raises(TypeError) as error:
        cuticle.bake("marschner", **arguments)
    assert str(error.value).startswith(f"{word}: ") and "arg0" not in str(error.value)


def test_LoadGroom_PathObject_IsTaken(tmp_path):
    with pytest.raises(ValueError, match="absent.hair"):
        cuticle.load_groom(tmp_path / "absent.hair")


@pytest.mark.parametrize("work", ["cuticle.check_model('chiang')", "cuticle.bake('chiang', 'nalu_theta', size=512)", "cuticle.fit_analytic('marschner')",
                                  "cuticle.eval('huang', 'albedo', theta_o_deg=numpy.linspace(-80, 80, 2000000))",
                                  "cuticle.eval('huang', 'S', theta_i_deg=numpy.linspace(-80, 80, 1000000), theta_o_deg=0, phi_deg=20)",
                                  "cuticle.study('lobes', quick=False)"])
def test_Interrupt_LongWork_EndsWithKeyboardInterrupt(work):
    """Each would go on for minutes; how soon it ends is the machine's affair (a second where it is idle)."""
    program = f"import cuticle, numpy\nprint('begun', flush=True)\ntry:\n    {work}\nexcept KeyboardInterrupt:\n    print('stopped')\nelse:\n    print('ended')"
    with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "begun\n"
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        assert process.communicate(timeout=100)[0] == "stopped\n"


def test_Models_Marschner_HasItsParameters():
    marschner = next(model for model in cuticle.models() if model["name"] == "marschner")
    assert {"eta", "sigma_a", "beta", "alpha"} <= {parameter["name"] for parameter in marschner["parameters"]}
    assert cuticle.lobes("marschner") == ["R", "TT", "TRT"] == marschner["lobes"]


def test_Models_EachOfThem_SaysWhatAResearcherAsks():
    for model in cuticle.models():
        assert model["lobes"] and model["source"] and set(model["conventions"]) == {"field", "cosine", "tilt_sign", "roughness", "absorption"}
        assert all({"check", "why", "when"} == set(exception) for exception in model["exceptions"])
    assert {"white_furnace"} <= {exception["check"] for model in cuticle.models() if model["name"] == "kajiya_kay" for exception in model["exceptions"]}


def test_Bake_Tables_HoldTheModelsValues():
    tables = cuticle.bake("marschner", layout="nalu", size=16, set={"sigma_a": 0.3})
    assert set(tables) == {"M", "N_TT_R", "N_TRT", "manifest"}
    assert tables["N_TT_R"].shape == (16, 16, 4)
    phi, theta_d = numpy.degrees(numpy.arccos(numpy.linspace(-1, 1, 16))), numpy.degrees(numpy.arccos(9 / 15))
    expected = cuticle.eval("marschner", "N", "TT", {"sigma_a": 0.3}, theta_d_deg=theta_d, phi_deg=phi)
    assert tables["N_TT_R"][9, :, :3] == pytest.approx(expected, rel=1e-3, abs=1e-6)
    assert tables["manifest"]["parameters"]["sigma_a"] == [0.3, 0.3, 0.3]


def test_Bake_WrongSize_IsAValueError():
    with pytest.raises(ValueError, match="16 .. 1024"):
        cuticle.bake("marschner", size=4)


def test_Bake_OtherThreads_RunMeanwhile():
    """The interpreter is free while tables are baked: a thread counts on."""
    counted, done = [0], threading.Event()

    def count():
        while not done.is_set():
            counted[0] += 1
            done.wait(0.001)

    counter = threading.Thread(target=count)
    counter.start()
    before = counted[0]
    cuticle.bake("marschner", size=64)
    during = counted[0] - before
    done.set()
    counter.join()
    assert during > 5


def yuksel_file(path):
    """Two strands of three and two points, without other arrays (cemyuksel.com/research/hairmodels)."""
    header = bytearray(128)
    header[0:4] = b"HAIR"
    header[4:16] = numpy.array([2, 5, 1 | 2], "<u4").tobytes()
    header[16:20] = numpy.array([2], "<u4").tobytes()
    header[20:40] = numpy.array([0.02, 0, 1, 1, 1], "<f4").tobytes()
    points = numpy.arange(15, dtype="<f4")
    path.write_bytes(bytes(header) + numpy.array([2, 1], "<u2").tobytes() + points.tobytes())
    return points.reshape(5, 3)


def test_LoadGroom_Arrays_AreTheFiles(tmp_path):
    points = yuksel_file(tmp_path / "two.hair")
    groom = cuticle.load_groom(str(tmp_path / "two.hair"), metres_per_unit=0.01)
    assert len(groom) == 2 and groom.offsets.tolist() == [0, 3, 5]
    assert groom.positions == pytest.approx(points * 0.01)
    assert groom.radii.shape == (5,) and groom.root_uv.shape == (0, 2)


def test_LoadGroom_Arrays_ShareMemoryAndOutliveTheGroom(tmp_path):
    yuksel_file(tmp_path / "two.hair")
    groom = cuticle.load_groom(str(tmp_path / "two.hair"), metres_per_unit=0.01)
    positions = groom.positions
    assert numpy.shares_memory(positions, groom.positions)
    with pytest.raises(ValueError):
        positions[0, 0] = 1
    copy = positions.copy()
    del groom
    assert numpy.array_equal(positions, copy)


def test_LoadGroom_MissingFile_NamesIt():
    with pytest.raises(ValueError, match="/nonexistent/a.hair"):
        cuticle.load_groom("/nonexistent/a.hair")


@pytest.mark.skipif(not os.environ.get("CUTICLE_TEST_DATA"), reason="CUTICLE_TEST_DATA names no real grooms")
def test_LoadGroom_RealPonytail_HasItsStrands():
    path = pathlib.Path(os.environ["CUTICLE_TEST_DATA"]) / "strands/tressfx/ponytail/side.tfx"
    groom = cuticle.load_groom(str(path))
    assert len(groom) == 3066 and numpy.isfinite(groom.positions).all()


def verdicts(report):
    return {check["check"]: check["verdict"] for check in report["checks"]}


def test_CheckModel_EvenSphereOfAFunction_KeepsItsEnergy():
    even = lambda theta_i, theta_o, phi, h: numpy.full_like(phi, 1 / (4 * numpy.pi))
    report = cuticle.check_model(even, white=True, complete=True, quick=True)
    assert verdicts(report)["white_furnace"] == "pass" and verdicts(report)["chi_square"] == "-"


def test_CheckModel_AFunctionWithAFactorOfPiTooFew_IsNamed():
    dim = lambda theta_i, theta_o, phi, h: numpy.full_like(phi, 1 / (4 * numpy.pi**2))
    report = cuticle.check_model(dim, white=True, complete=True, quick=True)
    assert report["cause"] == "spurious_one_over_pi" and not report["sound"]


def test_CheckModel_ASamplerOfTheEvenSphere_FollowsItsDensity():
    even = lambda theta_i, theta_o, phi, h: numpy.full_like(phi, 1 / (4 * numpy.pi))

    def sample(theta_o, h, u):
        one = numpy.ones_like(h)
        return numpy.arcsin(2 * u[:, 0] - 1), 2 * numpy.pi * u[:, 1] - numpy.pi, one / (4 * numpy.pi), one

    report = cuticle.check_model(even, pdf=even, sample=sample, white=True, complete=True, quick=True)
    assert report["sound"], report
    assert verdicts(report)["chi_square"] == "pass" and verdicts(report)["sample_weights"] == "pass"


def test_CheckModel_WithAFunctionOfTheWrongLength_IsAValueError():
    with pytest.raises(ValueError, match="points"):
        cuticle.check_model(lambda theta_i, theta_o, phi, h: numpy.ones(2), quick=True)
