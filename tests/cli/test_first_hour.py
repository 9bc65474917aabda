"""What a newcomer types in the first hour, mistakes included: each answer names what was meant."""
import csv
import json

import pytest

from program import ROOT, refused, rows, run


def test_Version_IsPrinted():
    done = run("--version")
    assert done.returncode == 0 and done.stdout.startswith("cuticle 0.")


@pytest.mark.parametrize("arguments, meant", [
    (["rendr", "scenes/still.json"], "cuticle render"),
    (["render", "--frams", "0:3", "scenes/still.json"], "--frames"),
    (["study", "lobs", "--out", "x"], "cuticle study lobes"),
    (["--device", "cpu", "metods"], "cuticle methods"),
    (["eval", "--quantity", "n", "--theta-d", "0", "--phi", "0"], "did you mean N?"),
    (["eval", "--model", "Marschner"], "did you mean marschner?"),
    (["eval", "--set", "etta=1.5", "--theta-i", "0"], "did you mean eta?"),
    (["bake", "--preset", "blonde", "--out", "x"], "did you mean blond?"),
    (["eval", "--hair", "blonde", "--theta-i", "0"], "did you mean blond?"),
])
def test_Misspelt_IsAnsweredWithTheNearest(arguments, meant):
    assert f"cuticle: try: {meant}" in refused(2, *arguments)


def test_UnknownOptionFarFromAll_PointsToHelp():
    assert "try: cuticle render --help" in refused(2, "render", "--xylophone", "scenes/still.json")


def test_DegreesTypedAsRadians_AreHinted():
    message = refused(2, "eval", "--set", "beta=7.5", "--quantity", "M", "--lobe", "R", "--theta-i", "30", "--theta-o", "-30")
    assert "7.5 degrees is beta_deg=7.5 or beta=0.1309" in message


def test_RadiansTypedAsDegrees_AreHinted():
    place = ["--quantity", "M", "--lobe", "R", "--theta-o", "0"]
    assert "angles are in degrees" in run("eval", *place, "--theta-i", "0.5236").stderr
    assert run("eval", *place, "--theta-i", "30").stderr == "" and run("eval", *place, "--theta-i", "0").stderr == ""


def test_HairAndPreset_HaveTheSameNames():
    assert rows("eval", "--preset", "blond", "--quantity", "A", "--lobe", "TT", "--theta-d", "0", "--h", "0") != []
    assert rows("eval", "--hair", "blond", "--quantity", "A", "--lobe", "TT", "--theta-d", "0", "--h", "0") != []


def test_Numbers_AreShort():
    done = run("eval", "--models", "marschner", "--hair", "blond", "--theta-i", "10", "--theta-o", "0", "--phi", "0")
    assert "sigma_a=0.1257/0.2091/0.411," in done.stderr


@pytest.fixture
def scene(tmp_path):
    text = (ROOT / "scenes/still.json").read_text()
    return lambda change: (tmp_path / "scene.json").write_text(change(text)) and tmp_path / "scene.json"


def test_SceneWithComments_IsRead(scene):
    assert run("plan", scene(lambda text: "// a scene\n" + text.replace("{", "{ /* here */", 1))).returncode == 0


def test_SceneKeyWithoutItsUnit_IsNamedWithLineAndColumn(scene):
    path = scene(lambda text: text.replace('"fov_deg"', '"fov"'))
    line = next(i for i, text in enumerate(path.read_text().splitlines(), 1) if '"fov"' in text)
    message = refused(3, "plan", path)
    assert f"scene.json:{line}:" in message and "write 'fov_deg'" in message


def test_FolderAsAGroom_SaysWhatItHolds(tmp_path):
    assert "is a folder without a groom in it" in refused(3, "info", tmp_path)
    assert run("grow", "--strands", "vertices=8", "--share", "0.002", "--out", tmp_path / "a.hair").returncode == 0
    message = refused(3, "info", tmp_path)
    assert "it holds a.hair" in message and f"try: {tmp_path}/a.hair" in message


def test_Shadows_LayersThatAMethodDoesNotTake_AreNamed(tmp_path):
    groom = tmp_path / "a.hair"
    assert run("grow", "--strands", "vertices=8", "--share", "0.05", "--out", groom).returncode == 0
    done = run("shadows", groom, "--radius", "0.0005", "--methods", "opacity_map,deep_opacity", "--layers", "4,64", "--resolution", "32", "--quick", "--rays", "16")
    assert done.returncode == 0 and "deep_opacity: layers 64 left out, it takes 1 .. 16" in done.stderr


def test_Telemetry_NamesItsUnits(tmp_path):
    done = run("simulate", ROOT / "scenes/still.json", "--frames", "0:0", "--out", tmp_path)
    assert done.returncode == 0, done.stderr
    columns = next(csv.reader((tmp_path / "telemetry.csv").open()))
    assert {"time_s", "max_tension_m2_per_s2", "max_curvature_per_m", "wall_ms"} <= set(columns)


def test_LobeNames_AreThoseOfEveryModel():
    known = {"R", "TT", "TRT", "residual", "TTs", "TRTs", "diffuse", "specular", "primary", "secondary"}
    assert {lobe for model in json.loads(run("models", "--json").stdout) for lobe in model["lobes"]} <= known
