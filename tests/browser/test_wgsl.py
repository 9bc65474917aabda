"""The WGSL snippet on the browser's WebGPU against the tables as numpy decodes them."""
import json
import pathlib
import sys

import numpy as np
import pytest

from browser import HERE, result_of

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
from lut_files import Tables  # noqa: E402
from program import run  # noqa: E402

COUNT = 256


# Arc functions of a device may be coarse, and beside a caustic their error counts most: two steps of a half more.
BOUNDS = {"nalu": 1.5 / 1024, "nalu_caustic": 4 / 1024}


@pytest.fixture(scope="module", params=BOUNDS)
def folder(request, tmp_path_factory):
    made = tmp_path_factory.mktemp("lut")
    done = run("bake", "--model", "marschner", "--preset", "blond", "--layout", request.param, "--size", 32, "--format", "dds", "--out", made)
    assert done.returncode == 0, done.stderr
    return made


def directions(folder):
    vectors = np.random.default_rng(2).normal(size=(COUNT, 3, 3))
    vectors /= np.linalg.norm(vectors, axis=2, keepdims=True)
    folder.mkdir(exist_ok=True)
    (folder / "directions.json").write_text(json.dumps(np.pad(vectors, ((0, 0), (0, 0), (0, 1))).ravel().tolist()))
    return vectors


def test_Snippet_OnWebGpu_AgreesWithTheDecodedTablesToHalfPrecision(folder, tmp_path):
    vectors = directions(tmp_path)
    result = result_of(HERE / "pages", "wgsl.html", lut=folder, given=tmp_path)
    assert result["messages"] == []
    found = np.array(result["found"]).reshape(COUNT, 4)
    tables = Tables(folder)
    wanted = tables.scattering(*vectors.transpose(1, 0, 2))
    assert (np.abs(found[:, :3] - wanted) / (wanted + 0.01)).max() < BOUNDS[tables.manifest["layout"]]
    assert (found[:, 3] == 0).all()


def test_SnippetOfTheHalfVector_OnWebGpu_AgreesWithTheDecodedTables(tmp_path):
    done = run("bake", "--model", "scheuermann", "--size", 32, "--format", "dds", "--out", tmp_path / "lut")
    assert done.returncode == 0, done.stderr
    vectors = directions(tmp_path / "given")
    result = result_of(HERE / "pages", "wgsl.html", lut=tmp_path / "lut", given=tmp_path / "given")
    assert result["messages"] == []
    found = np.array(result["found"]).reshape(COUNT, 4)
    wanted = Tables(tmp_path / "lut").scattering(*vectors.transpose(1, 0, 2))
    assert (np.abs(found[:, :3] - wanted) / (wanted + 0.01)).max() < 5 / 1024
    assert (found[:, 3] == 0).all()


def test_Probes_OfATableThatIsUpsideDown_NameTableAndProbe(folder, tmp_path):
    directions(tmp_path / "given")
    turned = tmp_path / "turned"
    turned.mkdir()
    for file in folder.iterdir():
        (turned / file.name).write_bytes(file.read_bytes())
    data = (turned / "N_TRT.dds").read_bytes()
    rows = np.frombuffer(data[148:], "<f2").reshape(32, 32, 4)
    (turned / "N_TRT.dds").write_bytes(data[:148] + rows[::-1].tobytes())
    code = result_of(HERE / "pages", "wgsl.html", lut=turned, given=tmp_path / "given")["found"][3]
    assert 300 < code <= 310
