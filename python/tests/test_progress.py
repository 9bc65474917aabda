"""Every long call says how far it is, to tqdm or to a function."""
import inspect
import threading

import numpy
import pytest

import cuticle

STRANDS = cuticle.make_groom(numpy.linspace(0, 0.1, 24).reshape(2, 4, 3))
SCENE = {"strand_count": 10, "lights": []}
POINT = {"theta_i_deg": 10, "theta_o_deg": 20, "phi_deg": 30, "h": 0.1}
GUESSED = {"values": numpy.full(5, 0.1), "free": ["sigma_a"], "theta_i_deg": 10, "theta_o_deg": numpy.arange(5.0), "phi_deg": 30}

# What may take longer than a second, and a call of it that does not.
LONG = {
    "eval": lambda **p: cuticle.eval("karis", "S", **POINT, **p),
    "conformance": lambda **p: cuticle.conformance("karis", **p),
    "sample": lambda **p: cuticle.sample("karis", 0.0, numpy.full((2, 8), 0.5), **p),
    "gradients": lambda **p: cuticle.gradients("karis", **POINT, **p),
    "check_model": lambda **p: cuticle.check_model(lambda theta_i, theta_o, phi, h: numpy.full(len(phi), 0.01), quick=True, **p),
    "bake": lambda **p: cuticle.bake("karis", size=16, **p),
    "check_tables": lambda folder, **p: (cuticle.bake("karis", size=16, out=folder), cuticle.check_tables(folder, **p)),
    "fit_analytic": lambda **p: cuticle.fit_analytic(**p),
    "fit": lambda **p: cuticle.fit("kajiya_kay", GUESSED["values"], ["diffuse"], theta_i_deg=10, theta_o_deg=GUESSED["theta_o_deg"], phi_deg=30, **p),
    "grow": lambda **p: cuticle.grow({"strands": {"share": 0.001}}, **p),
    "hair_of": lambda **p: cuticle.hair_of(SCENE, **p),
    "make_cards": lambda **p: cuticle.make_cards(cuticle.grow({"strands": {"share": 0.001}}), {"cards": 4}, **p),
    "shadows.transmittance": lambda **p: cuticle.shadows.transmittance(STRANDS, points=[[0, -1, 0]], **p),
    "shadows.truth": lambda **p: cuticle.shadows.truth(STRANDS, points=[[0, -1, 0]], rays=4, **p),
    "Simulation.step": lambda **p: cuticle.simulate(STRANDS, "exact").step(3, **p),
    "Simulation.at_rest": lambda **p: cuticle.simulate(STRANDS, "rod").at_rest(**p),
    "render": lambda **p: cuticle.render(SCENE, "reference", size=(8, 8), samples=2, **p),
    "study": lambda **p: cuticle.study("skinning", quick=True, **p),
    "sweep": lambda folder, **p: cuticle.sweep({"task": "eval", "fixed": {"model": "karis", "quantity": "S", **POINT}, "vary": {"theta_i_deg": [1, 2]}}, folder, **p),
}

@pytest.mark.parametrize("name", LONG)
def test_LongCall_WithAFunction_TellsItHowFarItIs(name, tmp_path):
    told = []
    call = LONG[name]
    folder = {"folder": str(tmp_path / "made")} if "folder" in inspect.signature(call).parameters else {}
    call(**folder, progress=lambda task, done, total: told.append((task, done, total)))
    assert told, name
    assert all(isinstance(task, str) and 0 <= done <= total for task, done, total in told), told
    assert told[-1][1] == told[-1][2] > 0, "it ends at the whole"


def test_CallsThatTakeProgress_AreTheLongOnes():
    """A function of the package that takes `progress` is called above; and the other way round."""
    taking = {name for name in cuticle.__all__ if inspect.isfunction(getattr(cuticle, name)) and "progress" in inspect.signature(getattr(cuticle, name)).parameters}
    assert taking == {name for name in LONG if "." not in name}


def test_LongCall_WithTqdm_ShowsABar(capsys):
    cuticle.shadows.transmittance(STRANDS, points=[[0, -1, 0]], progress=True)
    cuticle.simulate(STRANDS, "exact").step(3, progress=True)
    shown = capsys.readouterr().err
    assert "deep_opacity: 100%" in shown and "simulate: 100%" in shown and "3/3" in shown


def test_LongCall_OfAProgressThatRaises_EndsByIt():
    def stop(task, done, total):
        raise KeyError(task)

    with pytest.raises(KeyError, match="simulate"):
        cuticle.simulate(STRANDS, "exact").step(100000, progress=stop)
    with pytest.raises(KeyError, match="bake|chiang"):
        cuticle.bake("chiang", "nalu_theta", size=128, progress=stop)


def test_LongCall_InAnotherThread_TellsToo():
    told = []
    thread = threading.Thread(target=lambda: cuticle.grow({"strands": {"share": 0.01}}, progress=lambda *call: told.append(call)))
    thread.start()
    thread.join()
    assert told[-1] == ("grow", 1, 1)
