"""Pictures of a small scene from the command line, by every way of drawing strands."""
import csv
import json
import re
import struct

import pytest
from program import refused, run

METHODS = ("cards", "lines", "quads", "tiles", "supersampled")


@pytest.fixture(scope="module")
def scene(tmp_path_factory):
    path = tmp_path_factory.mktemp("scene") / "small.json"
    path.write_text(json.dumps({
        "schema_version": 1, "name": "small", "strand_count": 300, "strand_vertices": 8, "material": {"lut_size": 16},
        "lights": [{"to_light": [0.3, 0.6, 1], "irradiance": [6, 6, 6]}],
        "camera": {"position_m": [0.2, 0.15, 1.1], "target_m": [0, 0.05, 0], "fov_deg": 30, "resolution_px": [64, 64]}}))
    return path


@pytest.fixture(scope="module")
def pictures(scene, tmp_path_factory):
    """By method: the costs that were printed, and the folder."""
    drawn = {}
    for method in METHODS:
        out = tmp_path_factory.mktemp(method)
        done = run("render", scene, "--method", method, "--out", out, "--json")
        assert done.returncode == 0, done.stderr
        drawn[method] = (json.loads(done.stdout), out)
    return drawn


def test_Render_EveryMethod_WritesItsOwnPicture(pictures):
    frames = {(folder / "frame_0000.exr").read_bytes() for _, folder in pictures.values()}
    assert len(frames) == len(METHODS)
    assert all((folder / "frame_0000.png").stat().st_size > 0 for _, folder in pictures.values())


def test_Render_LayersByCards_AreSaidToBeLeftOut(scene, tmp_path):
    done = run("render", scene, "--method", "cards", "--aovs", "--out", tmp_path)
    assert done.returncode == 0
    assert re.search("aovs: asked for, but left out: .*; strands are drawn by 'cards'", done.stderr)
    assert "left out" not in run("render", scene, "--method", "lines", "--aovs", "--out", tmp_path).stderr


def test_Render_Costs_NameThePassesOfTheMethodAlone(pictures):
    for method, (costs, _) in pictures.items():
        names = {entry["name"] for entry in costs["passes"]}
        assert names & {"cards", "lines", "quads", "tiles"} == {method} - {"supersampled"}


def test_Render_SimulatedScene_PrintsWhatSimulatingGeneratingAndRenderingCost(scene, tmp_path):
    moving = tmp_path / "moving.json"
    moving.write_text(json.dumps(json.loads(scene.read_text()) | {"simulation": {"solver": {"rod": {}}}}))
    done = run("render", moving, "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    parts = re.findall(r"(simulate|generate|render) ([\d.]+) ms \((\d+) %\)", done.stdout)
    assert [name for name, _, _ in parts] == ["simulate", "generate", "render"]
    whole = sum(float(ms) for _, ms, _ in parts)
    assert all(0 < float(ms) and abs(float(ms) / whole - int(share) / 100) < 0.006 for _, ms, share in parts)


def test_Render_UnknownMethod_IsRefusedWithTheKnownOnes(scene):
    assert "tiles" in refused(2, "render", scene, "--method", "tile")


def test_StudyRender_Quick_HasEveryMethodNearAndFar(scene, tmp_path):
    done = run("study", "render", scene, "--quick", "--out", tmp_path)
    assert done.returncode == 0, done.stderr
    rows = list(csv.DictReader((tmp_path / "study.csv").open()))
    assert {(row["group"], row["method"]) for row in rows} == {(g, m) for g in ("near", "far") for m in METHODS}
    # Coverage is a fraction. Colour is relative to the truth's mean, so an error of a bright pixel may pass 1.
    most = {"coverage": 1, "color": 2}
    assert all(0 <= float(row["mean_error"]) <= float(row["max_error"]) <= most[row["metric"]] for row in rows)
    assert (tmp_path / "index.html").stat().st_size > 0


def test_Render_DeepAndMattes_AreFilesOfTheRun(scene, tmp_path):
    done = run("render", scene, "--method", "tiles", "--deep", "--cryptomatte", "--out", tmp_path)
    assert done.returncode == 0, done.stderr
    assert set(json.loads((tmp_path / "files.json").read_text())["files"]) == {
        "frame_0000.exr", "frame_0000.png", "frame_0000.deep.exr"}
    magic, version = struct.unpack("<II", (tmp_path / "frame_0000.deep.exr").read_bytes()[:8])
    assert magic == 20000630 and version & 0x800, "an EXR file of deep scan lines"
    picture = (tmp_path / "frame_0000.exr").read_bytes()
    assert all(layer in picture for layer in (b"crypto_strand00.R", b"crypto_groom02.A", b'{"marschner":'))


def test_Render_DeepByLines_IsRefused(scene, tmp_path):
    assert "does not tell strands apart" in refused(3, "render", scene, "--method", "lines", "--deep", "--out", tmp_path)
