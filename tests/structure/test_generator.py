"""scripts/new makes folders that compile against the headers as they are."""
import subprocess

import pytest

from repository import ROOT

PLACES = {"model": "bsdf", "method": "shadows", "effect": "sim", "pass": "render/passes", "format": "strands/formats"}


def make(kind, name, root):
    return subprocess.run([ROOT / "scripts/new", kind, name, "--root", root], capture_output=True, text=True)


@pytest.mark.parametrize("kind", PLACES)
def test_New_EachKind_MakesAFolderThatCompiles(kind, tmp_path):
    done = make(kind, "toy_thing", tmp_path)
    assert done.returncode == 0, done.stderr
    folder = tmp_path / PLACES[kind] / "toy_thing"
    sources = sorted(folder.glob("*.cpp"))
    assert len(sources) >= 2 and (folder / "README.md").exists() and (folder / "CMakeLists.txt").exists()
    for source in (s for s in sources if not s.name.endswith("_gpu.cpp")):
        command = ["g++", "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", f"-I{tmp_path}", f"-I{ROOT}", source]
        compiled = subprocess.run(command, capture_output=True, text=True)
        assert compiled.returncode == 0, compiled.stderr


def test_New_Model_CompilesAsAKernel(tmp_path):
    assert make("model", "toy_thing", tmp_path).returncode == 0
    (tmp_path / "model_of_kernel.glslh").write_text('#include "bsdf/toy_thing/toy_thing.glslh"\n#define Prepared ToyThing\n')
    command = ["glslangValidator", "-V", "--quiet", "--target-env", "vulkan1.3", f"-I{tmp_path}", f"-I{ROOT}",
               "-o", tmp_path / "toy.spv", ROOT / "bsdf/gpu/evaluate.comp"]
    compiled = subprocess.run(command, capture_output=True, text=True)
    assert compiled.returncode == 0, compiled.stdout


def test_New_Pass_HasAKernelThatCompiles(tmp_path):
    assert make("pass", "toy_thing", tmp_path).returncode == 0
    command = ["glslangValidator", "-V", "--quiet", "--target-env", "vulkan1.3", f"-I{ROOT}", "-o", tmp_path / "toy.spv",
               tmp_path / "render/passes/toy_thing/toy_thing.comp"]
    compiled = subprocess.run(command, capture_output=True, text=True)
    assert compiled.returncode == 0, compiled.stdout


def test_New_ExistingFolder_IsRefused(tmp_path):
    assert make("method", "twice", tmp_path).returncode == 0
    assert "exists already" in make("method", "twice", tmp_path).stderr


def test_New_BadName_IsRefused(tmp_path):
    assert "snake_case" in make("method", "BadName", tmp_path).stderr
