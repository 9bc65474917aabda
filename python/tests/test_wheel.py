"""A wheel of this build, installed where there is neither a compiler nor a library of ours, runs the README's example."""
import os
import pathlib
import re
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("CUTICLE_BUILD_DIR") or ROOT / "build/release")
# What the README's example imports beside the package. A folder on PYTHONPATH gives no .pth file of its own a say.
OTHERS = pathlib.Path(pytest.__file__).resolve().parents[1]


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """A program of Python that has the wheel, with nothing on the path but its own folder."""
    folder = tmp_path_factory.mktemp("wheel")
    made = subprocess.run([sys.executable, ROOT / "scripts/wheel.py", BUILD, folder / "out"], capture_output=True, text=True)
    assert made.returncode == 0, made.stderr
    (wheel,) = (folder / "out").glob("*.whl")
    subprocess.run([sys.executable, "-m", "venv", folder / "fresh"], check=True)
    python = folder / "fresh/bin/python"
    subprocess.run([python, "-m", "pip", "install", "--quiet", "--no-index", "--no-deps", "--disable-pip-version-check", wheel], check=True)
    return python


def run(python, program, folder):
    environment = {"PATH": str(python.parent), "HOME": str(folder), "PYTHONPATH": str(OTHERS), "MPLBACKEND": "agg", "CUTICLE_DEVICE": "cpu"}
    return subprocess.run([python, "-c", program], cwd=folder, env=environment, capture_output=True, text=True)


def test_Wheel_InAFreshEnvironment_BringsItsLibraries(installed, tmp_path):
    done = run(installed, "import cuticle, re\nprint(cuticle.__file__, *sorted(set(re.findall(r'/\\S+\\.so\\S*', open('/proc/self/maps').read()))))", tmp_path)
    assert done.returncode == 0, done.stderr
    package, *libraries = done.stdout.split()
    assert package.startswith(str(installed.parents[1]))
    ours = [library for library in libraries if re.search(r"embree|ceres|glog|tbb|OpenEXR|tinygltf|fmt", library)]
    assert ours and all("cuticle.libs" in library for library in ours), ours


def test_Wheel_ReadmesExample_Draws(installed, tmp_path):
    (program,) = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(encoding="utf-8"), flags=re.S)
    done = run(installed, program, tmp_path)
    if "no_device" in done.stderr or "this build has none" in done.stderr:
        pytest.skip("no Vulkan device")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "hair.png").stat().st_size > 10000


def test_Wheel_ASweep_RunsByItsCommand(installed, tmp_path):
    (tmp_path / "plan.json").write_text('{"task": "eval", "fixed": {"model": "karis", "quantity": "S", "theta_i_deg": 0, "theta_o_deg": 10}, "vary": {"phi_deg": "0:180:7"}}')
    done = subprocess.run([installed.parent / "cuticle-sweep", "plan.json", "--out", "results", "--table", "all.csv"], cwd=tmp_path, capture_output=True, text=True,
                          env={"PATH": str(installed.parent), "PYTHONPATH": str(OTHERS)})
    assert done.returncode == 0 and "7 computed" in done.stdout, done.stderr
    assert (tmp_path / "all.csv").read_text().count("\n") == 8


def test_Wheel_StubsAndDocstrings_AreInside(installed, tmp_path):
    done = run(installed, "import cuticle, pathlib\nprint(sorted(p.name for p in pathlib.Path(cuticle.__file__).parent.iterdir()))", tmp_path)
    assert "py.typed" in done.stdout and "_cuticle.pyi" in done.stdout
