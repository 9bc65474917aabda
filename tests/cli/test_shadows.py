"""Shadow methods from the command line, on a small groom written here."""
import json
import struct

import pytest
from program import refused, rows, run


@pytest.fixture(scope="module")
def groom(tmp_path_factory):
    """Cem Yuksel's format: 900 strands of 4 vertices, 1 mm thick, standing 3 cm high on a square of 3 cm, leaning over."""
    path = tmp_path_factory.mktemp("groom") / "patch.hair"
    points = []
    for s in range(900):
        x, z = s % 30 * 0.001, s // 30 * 0.001
        points += [(x + 0.02 * t * t, 0.03 * t, z + 0.003 * (s * 7 % 11) * t) for t in (0, 1 / 3, 2 / 3, 1)]
    header = struct.pack("<4sIIIIff3f88s", b"HAIR", 900, 3600, 2, 3, 0.0005, 0.0, 0.5, 0.5, 0.5, b"")
    path.write_bytes(header + b"".join(struct.pack("<3f", *p) for p in points))
    return path


def options(groom):
    return ["shadows", groom, "--metres-per-unit", "1", "--radius", "0.0002", "--receivers", "60", "--rays", "64", "--resolution", "64"]


def test_Shadows_MoreLayers_LessError(groom):
    table = rows(*options(groom), "--layers", "3,48")
    errors = {row["settings"]: float(row["mean_error"]) for row in table if row["method"] == "opacity_map"}
    coarse, fine = errors.values()
    assert fine < coarse
    assert fine < float(table[1]["mean_error"]) and table[1]["method"] == "best constant"


def test_Shadows_AnErrorThatCanBeMet_NamesTheCheapest(groom):
    done = run(*options(groom), "--layers", "3,48", "--max-error", "0.9", "--json")
    assert done.returncode == 0, done.stderr
    data = json.loads(done.stdout)
    assert data["choice"]["total_ms"] == min(row["total_ms"] for row in data["rows"])
    assert data["footprint_m"] > 0 and data["truth"]["mean_standard_error"] > 0


def test_Shadows_AnErrorThatCannotBeMet_NoneDoesAndTheNearestIsNamed(groom):
    said = refused(1, *options(groom), "--layers", "3,48", "--max-error", "0.000001")
    assert "none does: nearest is opacity_map" in said and "slices=48" in said and "more than 1e-06" in said
    assert "because it takes" in refused(1, *options(groom), "--methods", "opacity_map", "--budget-ms", "1e-9")


def test_Shadows_AllMethods_EachHasItsRows(groom):
    known = {entry["name"] for entry in json.loads(run("methods", "--json").stdout)} - {"truth"}
    table = rows(*options(groom), "--methods", "all", "--layers", "1,4", "--quick")
    assert {row["method"] for row in table} == known | {"best constant"}
    assert all(float(row["mean_error"]) <= float(row["max_error"]) for row in table)


def test_Shadows_FiltersAndSpacings_AreSwept(groom):
    table = rows(*options(groom), "--methods", "deep_opacity", "--filter", "0.5,2", "--spacing", "equal,geometric")
    assert len({row["settings"] for row in table}) == 4 + 1, "and the baselines without any"


def test_Shadows_AParameterThatIsSet_IsThatOfItsMethodAlone(groom):
    given = rows(*options(groom), "--methods", "deep_opacity,opacity_map", "--set", "deep_opacity.layer_range=map")
    usual = rows(*options(groom), "--methods", "deep_opacity,opacity_map")
    errors = lambda table: {row["method"]: row["mean_error"] for row in table}
    assert errors(given)["opacity_map"] == errors(usual)["opacity_map"]
    assert errors(given)["deep_opacity"] != errors(usual)["deep_opacity"]
    assert any("layer_range=map" in row["settings"] for row in given)


@pytest.mark.parametrize("settings, said", [("deep_opacity.layer_rang=map", "layer_range"), ("layer_range=map", "METHOD.NAME=VALUE"),
                                            ("deep_opacity.layer_range=all", "layer_range"), ("voxel.resolution=64", "not among the methods")])
def test_Shadows_ASettingThatNoMethodTakes_IsRefused(groom, settings, said):
    assert said in refused(2, *options(groom), "--methods", "deep_opacity", "--set", settings)


def test_Shadows_Camera_ErrorFallsWithResolutionAndSoDoesTheFirstPlot(groom, tmp_path):
    folder = tmp_path / "out"
    command = ["shadows", groom, "--metres-per-unit", "1", "--radius", "0.0002", "--camera", "0,1,1", "--light", "1,1,0.3", "--receivers", "300",
               "--rays", "64", "--methods", "opacity_map,deep_opacity,exact_list", "--layers", "16", "--resolution", "32,128,512", "--out", folder]
    errors, left = {}, {}
    for row in rows(*command)[2:]:
        errors.setdefault(row["method"], []).append(float(row["mean_error"]))
        left.setdefault(row["method"], []).append(float(row["light_left"]))
    assert set(errors) == {"opacity_map", "deep_opacity", "exact_list"}
    for method, of in errors.items():
        assert of == sorted(of, reverse=True), f"{method}: {of}"
    study = json.loads((folder / "study.json").read_text())
    assert study["x"]["key"] == "resolution" and study["y"]["key"] == "mean_error"
    for method, of in left.items():
        assert abs(of[-1] - study["truth"]["light_left"]) < 0.02, f"{method}: {of}"


def test_Shadows_AtPoints_OneColumnAMethod(groom, tmp_path):
    points = tmp_path / "points.csv"
    points.write_text("x,y,z\n0.02,0.5,0.015\n0.02,-0.01,0.015\n")
    above, below = rows(*options(groom), "--light", "0,1,0", "--methods", "none,opacity_map,truth", "--at", points)
    assert list(above) == ["x", "y", "z", "none", "opacity_map", "truth"]
    assert float(above["truth"]) == 1 and float(above["opacity_map"]) == 1 and float(above["none"]) == 1
    assert 0 <= float(below["truth"]) < 0.5 and abs(float(below["opacity_map"]) - float(below["truth"])) < 0.1


def test_Shadows_OpacityOfEachChannel_OneColumnEach(groom, tmp_path):
    points = tmp_path / "points.csv"
    points.write_text("x,y,z\n0.02,-0.01,0.015\n")
    light = ["--light", "0,1,0", "--methods", "opacity_map", "--at", points]
    row, = rows(*options(groom), *light, "--alpha-rgb", "0,0.4,0.9")
    grey, = rows(*options(groom), *light, "--alpha", "0.4")
    assert list(row) == ["x", "y", "z", "opacity_map.R", "opacity_map.G", "opacity_map.B"]
    assert row["opacity_map.R"] == "1" and row["opacity_map.G"] == grey["opacity_map"]
    assert float(row["opacity_map.B"]) < float(row["opacity_map.G"]) < 1


def test_Shadows_Folder_HoldsTheStudysData(groom, tmp_path):
    folder = tmp_path / "out"
    rows(*options(groom), "--out", folder)
    assert json.loads((folder / "study.json").read_text())["rows"]
    assert (folder / "study.csv").read_text().startswith("method,settings,")
    assert (folder / "receivers.csv").read_text().startswith("x,y,z,truth,standard_error,none ")
    bands = (folder / "contact.csv").read_text().splitlines()
    assert bands[0] == "method,settings,from_mm,to_mm,receivers,mean_error,mean_interval,bias" and len(bands) > 2
    assert (folder / "index.html").exists() and (folder / "hair.png").exists()


def test_StudyShadows_Marks_EndWithOneWhereOneIsNotMet(tmp_path):
    marks = tmp_path / "marks.json"
    setting = {"method": "opacity_map", "settings": [{"resolution": ["32"]}]}
    text = {"name": "small", "alpha": 0.4, "rays": 16, "receivers": 60, "lights": [[0, 1, 0]], "hair": {"coat_strands": 1000, "fibre_radius_m": 0.0005}}
    for code, error in ((0, 1), (1, 1e-9)):
        marks.write_text(json.dumps(text | {"marks": [setting | {"name": "a mark", "error": error}]}))
        done = run("study", "shadows", "--marks", marks, "--out", tmp_path / "out")
        assert done.returncode == code and "a mark" in done.stdout, done.stderr
        assert json.loads((tmp_path / "out" / "marks.json").read_text())["marks"][0]["met"] == (code == 0)


@pytest.mark.parametrize("code,extra,word", [
    (2, ["--light", "0,0,0"], "light"), (2, ["--light", "1,0"], "--light"), (2, ["--methods", "opacity_mop"], "opacity_map"),
    (2, ["--layers", "1"], "slices"), (2, ["--layers", "2.5"], "--layers"), (2, ["--filter", "-1"], "--filter"),
    (2, ["--methods", "deep_opacity", "--spacing", "linear"], "geometric"), (3, ["--at", "missing.csv"], "missing.csv"),
    (2, ["--alpha-rgb", "0.1,0.2,0.3"], "--at"),
])
def test_Shadows_BadInput_IsRefused(groom, code, extra, word):
    assert word in refused(code, *options(groom), *extra)


def test_Methods_Json_ListsParametersWithRanges():
    done = run("methods", "--json")
    methods = {entry["name"]: entry for entry in json.loads(done.stdout)}
    assert {"none", "opacity_map"} <= set(methods)
    assert "slices" in json.dumps(methods["opacity_map"]["parameters"])
