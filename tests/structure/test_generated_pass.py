"""A pass made by scripts/new is one folder: a copy of the sources with it builds, and a scene that names it changes."""
import json
import os
import shutil
import subprocess

import pytest

from repository import ROOT


def copy_of_sources(to):
    for name in subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split():
        (to / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / name, to / name)
    (to / ".venv").symlink_to(ROOT / ".venv")


def picture(program, sources, name, passes):
    scene = json.loads((sources / "scenes/still.json").read_text())
    scene["camera"]["resolution_px"] = [64, 64]
    scene["passes"] = scene.get("passes", {}) | passes
    (sources / f"scenes/{name}.json").write_text(json.dumps(scene))
    subprocess.run([program, "render", f"scenes/{name}.json", "--out", name], cwd=sources, check=True, capture_output=True)
    return next((sources / name).glob("*.png")).read_bytes()


@pytest.mark.skipif(not os.environ.get("CUTICLE_SWEEPS"), reason="builds the program once more: scripts/test.sh --full")
def test_NewPass_NamedInAScene_ChangesItsPicture(tmp_path):
    copy_of_sources(tmp_path)
    subprocess.run([ROOT / "scripts/new", "pass", "without_red", "--root", tmp_path], check=True)
    subprocess.run(["scripts/build.sh", "release", "-j2", "cuticle"], cwd=tmp_path, check=True)
    program = tmp_path / "build/release/bin/cuticle"
    before = picture(program, tmp_path, "before", {})
    assert before == picture(program, tmp_path, "without_strength", {"without_red": {"strength": 0}})
    assert before != picture(program, tmp_path, "after", {"without_red": {}})
