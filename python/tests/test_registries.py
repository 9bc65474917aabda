"""Everything that the program's registries hold is reachable from Python, under the same name."""
import json
import os
import pathlib
import subprocess

import numpy
import pytest

import cuticle

PROGRAM = os.environ.get("CUTICLE_PROGRAM") or pathlib.Path(__file__).resolve().parents[2] / "build/release/bin/cuticle"
STRANDS = cuticle.make_groom(numpy.linspace(0, 0.1, 24).reshape(2, 4, 3))


def of_the_program(command):
    listed = json.loads(subprocess.run([PROGRAM, command, "--json"], capture_output=True, text=True, check=True).stdout)
    return {entry["name"]: entry for entry in (listed if isinstance(listed, list) else listed["models"])}


@pytest.mark.parametrize("command, here", [("models", cuticle.models), ("methods", cuticle.methods), ("passes", cuticle.passes),
                                           ("effects", lambda: cuticle.solvers() + cuticle.effects())])
def test_Registries_WhatTheProgramLists_IsHere(command, here):
    listed = of_the_program(command)
    assert listed and set(listed) == {entry["name"] for entry in here()}


def refused(call):
    """The message of an error; it may not be that the name is unknown."""
    try:
        call()
    except cuticle.Error as error:
        assert "is not one of" not in str(error) and "not known" not in str(error) and "unknown" not in str(error), error
        return str(error)
    return None


@pytest.mark.parametrize("model", of_the_program("models"))
def test_Models_EachOfThem_EvaluatesBakesAndSamples(model):
    assert numpy.isfinite(cuticle.eval(model, "S", theta_i_deg=10, theta_o_deg=20, phi_deg=30, h=0.1)).all()
    assert numpy.isfinite(cuticle.Batch(model).eval([[0], [1], [0]], [[0], [1], [0]], [0.1])).all()
    refused(lambda: cuticle.sample(model, 0.0, numpy.full((2, 8), 0.5)))


@pytest.mark.parametrize("method", of_the_program("methods"))
def test_Methods_EachOfThem_ShadowsPoints(method):
    assert cuticle.shadows.transmittance(STRANDS, points=[[0, -1, 0]], method=method).shape == (1,)


@pytest.mark.parametrize("name", of_the_program("effects"))
def test_SolversAndEffects_EachOfThem_Simulates(name):
    solvers = [entry["name"] for entry in cuticle.solvers()]
    if name in solvers:
        assert cuticle.simulate(STRANDS, name).step().positions.shape == (8, 3)
        return
    assert any(refused(lambda: cuticle.simulate(STRANDS, solver, effects={name: {}}).step()) is None for solver in solvers) or name == "cloth"


@pytest.mark.parametrize("name", of_the_program("passes"))
def test_Passes_EachOfThem_IsTakenByAScene(name):
    plan = cuticle.plan({"strand_count": 10, "lights": [], "passes": {name: {}}})
    assert plan.why(name)


@pytest.mark.parametrize("method", cuticle.render_methods())
def test_RenderMethods_EachOfThem_IsPlanned(method):
    assert cuticle.plan({"strand_count": 10, "lights": []}, method=method).passes


@pytest.mark.parametrize("name", [entry["name"] for entry in cuticle.shapings()])
def test_Shapings_EachOfThem_ShapesAGroom(name):
    assert len(cuticle.shape(STRANDS, {name: {}})) == 2


def test_Formats_OfTheProgramsHelp_AreHere():
    help_text = subprocess.run([PROGRAM, "convert", "--help"], capture_output=True, text=True, check=True).stdout
    endings = {ending for entry in cuticle.formats() for ending in entry["extensions"] + entry["read_only"]}
    named = {word.strip(".,:;()") for word in help_text.split() if word.startswith(".") and word.strip(".,:;()").isalnum()}
    assert named - endings <= {"usd", "usdc", "usdz", "abc", "glb"} and endings & named


def test_Write_Glb_IsBinaryGltf(tmp_path):
    """Which is written alone, and stands beside the formats."""
    cuticle.write(STRANDS, tmp_path / "strands.glb")
    assert (tmp_path / "strands.glb").read_bytes()[:4] == b"glTF"


def test_Layouts_EachOfThem_IsTakenByBake():
    """Its size is the only thing refused."""
    for entry in cuticle.layouts():
        assert "16 .. 1024" in refused(lambda: cuticle.bake("marschner", entry["name"], 4))


# What reaches each subcommand's work from here: names of the package, with dots.
REACHED = {"absorption": ["absorption_of_fibre", "absorption_of_assembly", "absorption_of_pigments"], "bake": ["bake", "fit_analytic"], "bind": ["bind", "carry"],
           "cards": ["make_cards"], "conformance": ["conformance"], "check": ["check_model", "check_tables", "check_groom"], "convert": ["load_groom", "write"], "demo": ["sweep", "render", "study"],
           "effects": ["effects", "solvers"], "eval": ["eval", "Batch", "sample", "gradients"], "fit": ["fit"], "gallery": ["render"], "grow": ["grow", "shape"],
           "info": ["load_groom", "check_groom"], "methods": ["methods"], "models": ["models"], "passes": ["passes"], "plan": ["plan"], "play": ["Renderer"],
           "render": ["render", "Renderer"], "shadows": ["shadows.transmittance", "shadows.truth"], "simulate": ["simulate"], "study": ["study", "studies"],
           "sweep": ["sweep"], "view": [],  # views: below
           "viewer": ["view.page"]}


def subcommands(*words):
    """Names below a command, from its help."""
    text = subprocess.run([PROGRAM, *words, "--help"], capture_output=True, text=True, check=True).stdout
    lines = text.split("Subcommands:")[1].splitlines() if "Subcommands:" in text else []
    return [line.split()[0] for line in lines if line.startswith("  ") and not line.startswith("   ")]


def test_Subcommands_OfTheProgram_AreReachableFromHere():
    assert set(subcommands()) == set(REACHED) & set(subcommands()), "a new subcommand needs its entry in REACHED"
    for names in REACHED.values():
        for name in names:
            value = cuticle
            for part in name.split("."):
                value = getattr(value, part)
            assert callable(value) and value.__doc__, name


def test_Views_OfTheProgram_AreHere():
    views = subcommands("view")
    assert len(views) >= 6 and set(views) <= set(cuticle.view.__all__)


def test_Studies_OfTheProgram_AreHere():
    beside = {"all", "compare"}  # all of them at once; two results side by side
    assert set(subcommands("study")) - beside == {entry["name"] for entry in cuticle.studies()}


def test_Bake_ItsFormatsAndTargets_AreHere():
    text = subprocess.run([PROGRAM, "bake", "--help"], capture_output=True, text=True, check=True).stdout
    choices = cuticle.table_choices()
    assert all(name in text for name in choices["formats"] + choices["targets"]) and {"glsl", "hlsl", "wgsl"} == set(choices["dialects"])


def test_FormerName_OfAChoice_IsReadWithAWarning():
    angles = {"theta_i_deg": 10, "theta_o_deg": 20, "phi_deg": 30}
    with pytest.warns(UserWarning, match="'literal' is called 'as_published' now"):
        former = cuticle.eval("marschner", "S", set={"variant": "literal"}, **angles)
    assert (former == cuticle.eval("marschner", "S", set={"variant": "as_published"}, **angles)).all()
