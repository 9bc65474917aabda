"""`cuticle models`, and `cuticle eval` of several models on one hair and on MaterialX files."""
import json

import pytest

from program import refused, rows, run

PLACE = ["--theta-i", "-10,20", "--theta-o", "15", "--phi", "30"]


def listed():
    done = run("models", "--json")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_Models_Json_SaysEverythingOfEach():
    models = listed()
    assert {"kajiya_kay", "scheuermann", "hairworks", "marschner", "chiang"} <= {model["name"] for model in models}
    for model in models:
        assert model["summary"] and model["source"] and model["lobes"], model["name"]
        assert set(model["conventions"]) == {"field", "cosine", "tilt_sign", "roughness", "absorption"}
        for parameter in model["parameters"]:
            assert {"name", "type", "unit", "default", "summary"} <= set(parameter)
            assert "range" in parameter or parameter["type"] in ("choice", "boolean")


def test_Eval_AllModelsOnOneHair_PrintsEachMapping():
    done = run("eval", "--models", "all", "--hair", "blond", *PLACE, "--h", "0.3")
    assert done.returncode == 0, done.stderr
    names = [model["name"] for model in listed() if model["maps_a_hair"]]
    assert len(names) >= 4
    for name in names:
        assert f"{name}: " in done.stderr
        assert sum(line.startswith(name + ",") for line in done.stdout.splitlines()) == 2


def test_Eval_HairAsJson_HasMappingsAndRows():
    done = run("eval", "--models", "kajiya_kay,marschner", "--hair", "brown", *PLACE, "--json")
    data = json.loads(done.stdout)
    assert [mapping["model"] for mapping in data["mappings"]] == ["kajiya_kay", "marschner"]
    assert all(mapping["settings"] and mapping["words"] for mapping in data["mappings"])
    assert len(data["rows"]) == 4


def test_Eval_MappedSettings_GiveTheSameValues():
    data = json.loads(run("eval", "--models", "kajiya_kay", "--hair", "red", *PLACE, "--json").stdout)
    direct = rows("eval", "--model", "kajiya_kay", "--set", data["mappings"][0]["settings"], *PLACE)
    assert [row["g"] for row in data["rows"]] == [float(row["g"]) for row in direct]


def test_Eval_PdfAndError_AreQuantities():
    pdf = rows("eval", "--model", "kajiya_kay", "--quantity", "pdf", *PLACE)
    error = rows("eval", "--model", "kajiya_kay", "--quantity", "error", *PLACE)
    assert all(float(row["r"]) > 0 for row in pdf) and all(float(row["r"]) == 0 for row in error)


def test_Eval_NearField_NeedsItsOffset():
    near = ["eval", "--model", "chiang", "--set", "field=near"]
    assert "--h" in refused(2, *near, *PLACE)
    assert len(rows(*near, *PLACE, "--h", "0,0.5")) == 4
    assert "--h" in refused(2, "eval", "--model", "chiang", "--set", "field=far", *PLACE, "--h", "0")


def test_Eval_PhiO_IsACoordinate():
    assert [row["phi_o"] for row in rows("eval", "--model", "kajiya_kay", *PLACE, "--phi-o", "0:90:3")][:3] == ["0", "45", "90"]


@pytest.mark.parametrize("arguments, words", [
    (["--hair", "blonde"], ["blonde", "blond", "black"]),
    (["--hair", "blond", "--preset", "black"], ["--hair", "--preset"]),
    (["--material", "x.mtlx", "--model", "kajiya_kay"], ["x.mtlx"]),
])
def test_Eval_BadSource_IsRefused(arguments, words):
    code = 3 if "--material" in arguments else 2
    message = refused(code, "eval", *arguments, *PLACE)
    for word in words:
        assert word in message


def test_Eval_PigmentsByTable_AreTheirAbsorption():
    for table, sigma in (("deon_pbrt", "0.838/1.394/2.74"), ("blender", "1.012/1.682/3.306")):
        by_table = rows("eval", "--pigments", f"{table}:2/0", *PLACE)
        direct = rows("eval", "--set", f"sigma_a={sigma}", *PLACE)
        for one, other in zip(by_table, direct):
            assert [float(one[c]) for c in "rgb"] == pytest.approx([float(other[c]) for c in "rgb"], rel=1e-12)


def test_Eval_ColourOfAFibre_IsItsAlbedo():
    row = rows("eval", "--color", "fibre:0.7/0.5/0.3", "--quantity", "albedo", "--theta-o", "0")[0]
    assert [float(row[c]) for c in "rgb"] == pytest.approx([0.7, 0.5, 0.3], abs=1e-9)
    assembly = rows("eval", "--color", "assembly:0.7/0.5/0.3", "--quantity", "albedo", "--theta-o", "0")[0]
    assert float(assembly["b"]) > 0.5


@pytest.mark.parametrize("code, arguments, words", [
    (2, ["--pigments", "pbrt:1/0"], ["pbrt", "deon_pbrt"]),
    (2, ["--pigments", "blender:1"], ["blender:1", "2 numbers"]),
    (3, ["--pigments", "blender:-1/0"], ["eumelanin", "-1"]),
    (3, ["--pigments", "blender:100/0"], ["sigma_a", "100"]),
    (2, ["--color", "tint:1/1/1"], ["tint", "assembly, fibre"]),
    (3, ["--color", "fibre:0.9/2/0.5"], ["color.g", "2", "albedos"]),
    (2, ["--color", "fibre:1/1/1", "--model", "kajiya_kay"], ["kajiya_kay", "sigma_a"]),
    (2, ["--color", "assembly:1/1/1", "--pigments", "blender:1/0"], ["--pigments", "--color"]),
])
def test_Eval_BadAbsorption_IsRefusedByName(code, arguments, words):
    message = refused(code, "eval", *arguments, *PLACE)
    for word in words:
        assert word in message


def test_MaterialX_Exported_EvaluatesAsTheModel(tmp_path):
    settings, path = "eta=1.5,sigma_a=0.1/0.4/1,beta_m=0.25,beta_n=0.4,alpha_deg=2", tmp_path / "hair.mtlx"
    done = run("models", "--export", "chiang", "--set", settings, "--out", path)
    assert done.returncode == 0, done.stderr
    text = path.read_text()
    assert "chiang_hair_bsdf" in text and "surfacematerial" in text
    direct = rows("eval", "--model", "chiang", "--set", settings, *PLACE)
    read = rows("eval", "--material", path, *PLACE)
    for one, other in zip(direct, read):
        assert float(one["g"]) == pytest.approx(float(other["g"]), rel=1e-9)


def test_MaterialX_BadValue_NamesFileNodeInputAndRange(tmp_path):
    path = tmp_path / "bad.mtlx"
    path.write_text('<materialx version="1.39"><chiang_hair_bsdf name="h" type="BSDF"><input name="ior" type="float" value="9"/></chiang_hair_bsdf></materialx>')
    message = refused(3, "eval", "--material", path, *PLACE)
    for word in ("bad.mtlx", "'h'", "ior", "9", "1.05 .. 3"):
        assert word in message


def test_MaterialX_OtherModel_CannotBeExported(tmp_path):
    assert "chiang" in refused(2, "models", "--export", "kajiya_kay", "--out", tmp_path / "x.mtlx")
