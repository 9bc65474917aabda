"""The README's example in Python runs as it stands."""
import os
import pathlib
import re
import subprocess
import sys

import pytest

import cuticle

README = pathlib.Path(__file__).resolve().parents[2] / "README.md"


def test_Readme_ItsPythonExample_Draws(tmp_path):
    (program,) = re.findall(r"```python\n(.*?)```", README.read_text(encoding="utf-8"), flags=re.S)
    environment = {**os.environ, "MPLBACKEND": "agg", "PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run([sys.executable, "-c", program], cwd=tmp_path, env=environment, capture_output=True, text=True)
    if "no_device" in done.stderr or "this build has none" in done.stderr:
        pytest.skip("no Vulkan device")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "hair.png").stat().st_size > 10000


def test_Stubs_NameEveryFunctionOfTheCompiledHalf():
    folder = pathlib.Path(cuticle._cuticle.__file__).parent
    stub = (folder / "_cuticle.pyi").read_text()
    assert (folder / "py.typed").exists()
    missing = [name for name in dir(cuticle._cuticle) if not name.startswith("_") and not re.search(rf"^(def|class) {name}\b", stub, flags=re.M)]
    assert missing == []
