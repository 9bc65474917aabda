"""What scripts/new makes is one folder each: a copy of the sources with one of every kind builds, and the program uses them."""
import json
import os
import shutil
import subprocess

import pytest

from repository import ROOT

pytestmark = pytest.mark.skipif(not os.environ.get("CUTICLE_SWEEPS"), reason="builds the program once more: scripts/test.sh --full")

NEW = {"model": "new_model", "method": "new_method", "effect": "new_effect", "pass": "without_red", "format": "new_format"}


def copy_of_sources(to):
    for name in subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split():
        (to / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / name, to / name)
    (to / ".venv").symlink_to(ROOT / ".venv")


@pytest.fixture(scope="module")
def sources(tmp_path_factory):
    """The repository with a folder of every kind, built."""
    folder = tmp_path_factory.mktemp("sources")
    copy_of_sources(folder)
    before = {path for path in folder.rglob("*") if path.is_dir()}
    for kind, name in NEW.items():
        subprocess.run([ROOT / "scripts/new", kind, name, "--root", folder], check=True)
    added = {path for path in folder.rglob("*") if path.is_dir()} - before
    assert len(added) == len(NEW), "one folder each"
    subprocess.run(["scripts/build.sh", "release", "-j2", "cuticle"], cwd=folder, check=True)
    return folder


def cuticle(sources, *arguments):
    done = subprocess.run([sources / "build/release/bin/cuticle", *map(str, arguments)], cwd=sources, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def picture(sources, name, **changed):
    scene = json.loads((sources / "scenes/still.json").read_text())
    scene["camera"]["resolution_px"] = [64, 64]
    for key, value in changed.items():
        scene[key] = scene.get(key, {}) | value
    (sources / f"scenes/{name}.json").write_text(json.dumps(scene))
    cuticle(sources, "render", f"scenes/{name}.json", "--out", name)
    return next((sources / name).glob("*.png")).read_bytes()


def test_NewPass_NamedInAScene_ChangesItsPicture(sources):
    before = picture(sources, "before")
    assert before == picture(sources, "without_strength", passes={"without_red": {"strength": 0}})
    assert before != picture(sources, "after", passes={"without_red": {}})


def test_NewModel_InAScene_DrawsHairByItsFormula(sources):
    drawn = {albedo: picture(sources, f"model_{n}", material={"model": {"new_model": {"albedo": [albedo] * 3}}, "evaluate": "direct"})
             for n, albedo in enumerate((0.0, 0.25, 0.5))}
    assert len(set(drawn.values())) == 3
    assert "new_model" in cuticle(sources, "models")


def test_NewMethod_InAStudy_IsMeasuredBesideTheOthers(sources):
    cuticle(sources, "grow", "--strands", "density=5000", "--out", "hair.hair")
    assert "new_method" in cuticle(sources, "shadows", "hair.hair", "--methods", "new_method,opacity_map")


def last_state(sources, name, effects):
    scene = json.loads((sources / "scenes/head_turn.json").read_text())
    del scene["motion"]
    scene |= {"name": name, "strand_count": 100}
    scene["simulation"]["effects"] = effects
    (sources / f"scenes/{name}.json").write_text(json.dumps(scene))
    cuticle(sources, "simulate", f"scenes/{name}.json", "--frames", "0:1", "--format", "hair", "--out", name)
    return max((sources / name).glob("*.hair")).read_bytes()


def test_NewEffect_InAScene_MovesItsHair(sources):
    still = last_state(sources, "still_air", {"gravity": {}})
    assert still == last_state(sources, "no_strength", {"gravity": {}, "new_effect": {"strength": 0}})
    assert still != last_state(sources, "moved", {"gravity": {}, "new_effect": {}})


def test_NewFormat_WrittenAndRead_HoldsTheStrands(sources):
    cuticle(sources, "grow", "--strands", "density=2000", "--out", "grown.hair")
    cuticle(sources, "convert", "grown.hair", "grown.new_format")
    strands = [json.loads(cuticle(sources, "--json", "info", f"grown.{kind}"))["strands"] for kind in ("hair", "new_format")]
    assert strands[0] == strands[1] > 0
