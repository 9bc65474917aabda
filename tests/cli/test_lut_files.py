"""`cuticle bake` and `cuticle check lut`: files read by numpy alone against `cuticle eval`; sidecars; damaged folders."""
import ast
import configparser
import csv
import hashlib
import json
import re
import shutil
import subprocess
import types

import numpy as np
import pytest

from lut_files import Tables
from program import refused, rows, run

FORMATS = ["exr", "png8", "png16", "dds", "ktx2"]
HAIR = ["--model", "marschner", "--preset", "blond"]


@pytest.fixture(scope="module")
def folders(tmp_path_factory):
    """One folder a format."""
    made = {}
    for name in FORMATS:
        made[name] = tmp_path_factory.mktemp(name)
        done = run("bake", *HAIR, "--layout", "nalu", "--size", 32, "--format", name, "--out", made[name])
        assert done.returncode == 0, done.stderr
    return made


def evaluated(tmp_path, quantity, lobe, columns, hair=HAIR):
    path = tmp_path / "points.csv"
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        writer.writerows(zip(*(np.degrees(values) for values in columns.values())))
    found = rows("eval", *hair, "--quantity", quantity, "--lobe", lobe, "--points", path)
    return np.array([[float(row[c]) for c in "rgb"] for row in found])


def stated(tables, table, channel):
    return tables.tables[table]["channels"][channel]["error"]


@pytest.mark.parametrize("name", FORMATS)
def test_Files_SampledByTheManifest_GiveEvalWithinTheStatedError(folders, name, tmp_path):
    tables, generator = Tables(folders[name]), np.random.default_rng(1)
    cos_phi, cos_theta_d = generator.uniform(-1, 1, 400), generator.uniform(0.05, 1, 400)
    exact = evaluated(tmp_path, "N", "TT", {"theta_d": np.arccos(cos_theta_d), "phi": np.arccos(cos_phi)})
    read = tables.read("N_TT_R", cos_phi, cos_theta_d)
    for channel in range(3):
        error = np.abs(read[:, channel] - exact[:, channel])
        bound = stated(tables, "N_TT_R", channel)
        assert error.max() <= 1.1 * bound["maximum"] and np.sqrt((error ** 2).mean()) <= 1.5 * bound["rms"]
    sine_i, sine_o = generator.uniform(-0.9, 0.9, 400), generator.uniform(-0.9, 0.9, 400)
    exact = evaluated(tmp_path, "M", "TRT", {"theta_i": np.arcsin(sine_i), "theta_o": np.arcsin(sine_o)})
    error = np.abs(tables.read("M", sine_i, sine_o)[:, 2] - exact[:, 0])
    assert error.max() <= 1.1 * stated(tables, "M", 2)["maximum"]


def test_CausticLayout_ReadByTheFormulaInItsManifest_IsTheModelEverywhere(tmp_path):
    done = run("bake", *HAIR, "--layout", "nalu_caustic", "--out", tmp_path / "lut")
    assert done.returncode == 0, done.stderr
    tables, generator = Tables(tmp_path / "lut"), np.random.default_rng(3)
    theta_i, theta_o = (np.arcsin(generator.uniform(-0.98, 0.98, 2000)) for _ in range(2))
    phi = generator.uniform(0, np.pi, 2000)
    exact = evaluated(tmp_path, "S", "sum", {"theta_i": theta_i, "theta_o": theta_o, "phi": phi})
    error = tables.caustic_scattering(theta_i, theta_o, phi) - exact
    assert np.sqrt((error ** 2).mean() / (exact ** 2).mean()) < 5e-3 and abs(error).max() < 2e-2 * exact.max()


@pytest.mark.parametrize("model, layout", [("karis", "karis"), ("scheuermann", "half_vector")])
def test_LayoutOfOneModel_ReadByTheFormulasInItsManifest_IsTheModelEverywhere(tmp_path, model, layout):
    done = run("bake", "--model", model, "--out", tmp_path / "lut")
    assert done.returncode == 0, done.stderr
    tables, generator = Tables(tmp_path / "lut"), np.random.default_rng(3)
    assert tables.manifest["layout"] == layout
    theta_i, theta_o = (np.arcsin(generator.uniform(-0.98, 0.98, 2000)) for _ in range(2))
    phi = generator.uniform(0, np.pi, 2000)
    exact = evaluated(tmp_path, "S", "sum", {"theta_i": theta_i, "theta_o": theta_o, "phi": phi}, ["--model", model])
    light = np.stack([np.sin(theta_i), np.cos(theta_i) * np.cos(phi), np.cos(theta_i) * np.sin(phi)], 1)
    eye = np.stack([np.sin(theta_o), np.cos(theta_o), 0 * phi], 1)
    error = tables.scattering(light, eye, np.array([[1.0, 0, 0]])) - exact
    assert np.sqrt((error ** 2).mean() / (exact ** 2).mean()) < 3e-3 and abs(error).max() < 1e-2 * exact.max()


@pytest.mark.parametrize("name", FORMATS)
def test_Files_AtTheProbes_GiveTheManifestsValues(folders, name):
    tables = Tables(folders[name])
    for table in tables.manifest["tables"]:
        assert [probe["at"] for probe in table["probes"]].count("texel centre") == 5 and len(table["probes"]) == 10
        found = tables.at(table["name"], [p["u"] for p in table["probes"]], [p["v"] for p in table["probes"]])
        wanted = np.array([probe["values"] for probe in table["probes"]])
        largest = np.array([channel["maximum"] for channel in table["channels"]])
        assert (np.abs(found - wanted) <= 1e-6 * largest).all()


@pytest.mark.parametrize("name", FORMATS)
def test_Manifest_Digests_AreTheFiles(folders, name):
    for table in Tables(folders[name]).manifest["tables"]:
        assert hashlib.sha256((folders[name] / table["file"]).read_bytes()).hexdigest() == table["sha256"]


@pytest.mark.parametrize("name", FORMATS)
def test_Check_OfWhatBakeWrote_Passes(folders, name):
    report = json.loads(run("check", "lut", folders[name], "--json").stdout)
    assert report["passed"] and all(table["unchanged"] for table in report["tables"])


def test_Check_OfARowsReversedFile_IsExitCodeOneAndNamed(folders, tmp_path):
    folder = shutil.copytree(folders["dds"], tmp_path / "flipped")
    data = bytearray((folder / "N_TT_R.dds").read_bytes())
    texels = np.frombuffer(bytes(data[148:]), "<f2").reshape(32, 32, 4)
    (folder / "N_TT_R.dds").write_bytes(bytes(data[:148]) + texels[::-1].tobytes())
    done = run("check", "lut", folder)
    assert done.returncode == 1 and "flipped in v" in done.stdout


def test_Check_OfAFolderWithoutAManifest_IsExitCodeThree(tmp_path):
    assert "manifest.json" in refused(3, "check", "lut", tmp_path)


def test_Check_OfABadManifest_NamesTheKey(folders, tmp_path):
    folder = shutil.copytree(folders["exr"], tmp_path / "bad")
    manifest = json.loads((folder / "manifest.json").read_text())
    manifest["tables"][1]["probes"][2]["v"] = -1
    (folder / "manifest.json").write_text(json.dumps(manifest))
    assert "tables[1].probes[2].v is -1" in refused(3, "check", "lut", folder)


def test_Bake_TargetThatIsNone_IsAUsageError(tmp_path):
    assert "unity" in refused(2, "bake", *HAIR, "--size", 16, "--target", "unitty", "--out", tmp_path / "x")


def test_Bake_FormatThatTheEngineCannotRead_IsAUsageErrorAndLeavesNothing(tmp_path):
    assert "png16" in refused(2, "bake", *HAIR, "--size", 16, "--format", "png16", "--target", "three", "--out", tmp_path / "x")
    assert not (tmp_path / "x").exists()


@pytest.fixture(scope="module")
def targets(tmp_path_factory):
    folder = tmp_path_factory.mktemp("targets")
    done = run("bake", *HAIR, "--size", 16, "--target", "unity,godot,unreal,three", "--out", folder)
    assert done.returncode == 0, done.stderr
    return folder


def test_Unity_EveryTable_HasAMetaWithItsOwnGuidLinearClampedWithoutMipMaps(targets):
    texts = [(targets / "unity" / f"{name}.exr.meta").read_text() for name in ("M", "N_TT_R", "N_TRT")]
    guids = {re.search(r"^guid: ([0-9a-f]{32})$", text, re.M).group(1) for text in texts}
    assert len(guids) == 3
    for text in texts:
        for setting in ("enableMipMap: 0", "sRGBTexture: 0", "wrapU: 1", "wrapV: 1", "filterMode: 1", "textureCompression: 0"):
            assert setting in text
    assert "cuticle_verify_probes() == 0" in (targets / "unity" / "CuticleLutCheck.shader").read_text()
    assert "@" not in (targets / "unity" / "CuticleLutImporter.cs").read_text()


def test_Godot_EveryTable_HasAnImportFileWithoutMipMapsOrCompression(targets):
    for name in ("M", "N_TT_R", "N_TRT"):
        settings = configparser.ConfigParser()
        settings.read(targets / "godot" / f"{name}.exr.import")
        assert settings["params"]["mipmaps/generate"] == "false" and settings["params"]["compress/mode"] == "3"
        assert settings["params"]["detect_3d/compress_to"] == "0" and settings["remap"]["importer"] == '"texture"'
    include = (targets / "godot" / "cuticle_hair.gdshaderinc").read_text()
    assert include.count("filter_linear, repeat_disable") == 3 and "source_color" not in include


class Recorder:
    """Stands in for Unreal's module: any attribute is another one; what is set is kept."""

    def __init__(self, log, name=""):
        self.log, self.name = log, name

    def __getattr__(self, name):
        return Recorder(self.log, f"{self.name}.{name}")

    def __call__(self, *arguments):
        if self.name.endswith("set_editor_property"):
            self.log.append(arguments)
        return ["/Game/Cuticle/table"] if self.name.endswith("get_editor_property") else Recorder(self.log, self.name)


def test_Unreal_Script_ImportsEveryTableAsData(targets, monkeypatch):
    log = []
    module = types.ModuleType("unreal")
    module.__getattr__ = lambda name: Recorder(log, name)
    monkeypatch.setitem(__import__("sys").modules, "unreal", module)
    path = targets / "unreal" / "import_cuticle_lut.py"
    exec(compile(ast.parse(path.read_text()), str(path), "exec"), {"__file__": str(path), "__name__": "script"})
    files = [value.rsplit("/", 1)[1] for name, value in log if name == "filename"]
    assert files == ["M.exr", "N_TT_R.exr", "N_TRT.exr"]
    assert [value for name, value in log if name == "srgb"] == [False] * 3
    assert {value.name for name, value in log if name == "address_x"} == {"TextureAddress.TA_CLAMP"}


@pytest.mark.parametrize("engine", ["babylon", "playcanvas"])
def test_EngineOfTheBrowser_WithoutAReaderOfExr_SaysWhichFormatAndWritesItsModules(tmp_path, engine):
    assert "--format ktx2" in refused(2, "bake", *HAIR, "--size", 16, "--target", engine, "--out", tmp_path / "x")
    assert run("bake", *HAIR, "--size", 16, "--format", "ktx2", "--target", engine, "--out", tmp_path / "y").returncode == 0
    made = tmp_path / "y" / engine
    assert re.findall(r"^(\d)\. ", (made / "README.md").read_text(), re.M) == ["1", "2", "3"]
    assert "cuticle_hair_scattering(" in (made / "hairMaterial.js").read_text() and "verifyHairLut" in (made / "hairLut.js").read_text()
    assert run("check", "lut", made).returncode == 0


def test_Check_OfAFolderWithTargets_Passes(targets):
    for folder in (targets, *(targets / name for name in ENGINES)):
        assert run("check", "lut", folder).returncode == 0, folder


ENGINES = {"unity": ["CuticleHairURP.shader", "CuticleHairHDRP.shader"], "godot": ["cuticle_hair.gdshader"],
           "unreal": ["make_cuticle_material.py", "CuticleHairNode.ush"], "three": ["hairMaterial.js"]}


@pytest.mark.parametrize("engine", ENGINES)
def test_EngineFolder_HasThreeStepsAndAMaterialThatReadsTheTables(targets, engine):
    readme = (targets / engine / "README.md").read_text()
    assert re.findall(r"^(\d)\. ", readme, re.M) == ["1", "2", "3"] and "M.exr, N_TT_R.exr and N_TRT.exr" in readme
    for name in ENGINES[engine]:
        text = (targets / engine / name).read_text()
        assert name in readme or name.split(".")[0].replace("CuticleHair", "") in readme or "Node" in name
        assert "cuticle_hair_scattering(" in text or "CuticleHairNode.ush" in text
        assert not re.search(r"@[A-Z_]+@", text), "a place that was not filled"


def test_UnrealNode_Compiles(targets, tmp_path):
    """The code of the material's node, without the structure that holds its textures: the compiler at hand takes none in a structure."""
    code = (targets / "unreal" / "CuticleHairNode.ush").read_text()
    names = ("M", "N_TT_R", "N_TRT")
    for name in names:
        assert f"hair.cuticle_{name} = cuticle_{name};" in code and f"Texture2D cuticle_{name};" in code
    code = re.sub(r"^(struct CuticleHair \{|Texture2D .*;|SamplerState .*;|hair\.\w+ = .*;)$", "", code, flags=re.M)
    functions, body = code.split("};\nCuticleHair hair;\n")
    textures = "".join(f"Texture2D cuticle_{name} : register(t{i}); SamplerState cuticle_{name}Sampler : register(s{i});\n" for i, name in enumerate(names))
    shader = tmp_path / "node.hlsl"
    shader.write_text(f"{textures}{functions}float3 node(float3 light, float3 eye, float3 tangent) {{\n{body.replace('hair.', '')}}}\n"
                      "float4 main(float3 d : TEXCOORD0) : SV_Target { return float4(node(d, d.yzx, d.zxy), 1); }\n")
    done = subprocess.run(["glslangValidator", "-D", "-V", "-S", "frag", "-e", "main", "-o", tmp_path / "node.spv", shader], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout


def test_Bake_SaysWhatToDoNext(tmp_path):
    done = run("bake", *HAIR, "--size", 16, "--target", "godot", "--out", tmp_path / "lut")
    assert f"next: {tmp_path}/lut/godot/README.md" in done.stdout and "cuticle check lut" in done.stdout
