"""hairLut.js of the target `three`: it loads every format that it says, and its probes read right on WebGL 2."""
import math
import pathlib
import sys

import pytest

from browser import HERE, result_of

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
from program import rows, run  # noqa: E402


def baked(folder, name, size=32):
    done = run("bake", "--model", "marschner", "--preset", "blond", "--size", size, "--format", name, "--target", "three", "--out", folder)
    assert done.returncode == 0, done.stderr
    return folder / "three"


@pytest.mark.parametrize("name", ["exr", "ktx2", "dds", "png8"])
def test_Loader_OfAnyFormat_ReadsEveryProbeRight(name, tmp_path):
    result = result_of(HERE / "pages", "three_loader.html", lut=baked(tmp_path / "lut", name))
    assert result == {"names": ["cuticle_M", "cuticle_N_TT_R", "cuticle_N_TRT"], "code": 0}


def test_Loader_ThatFlipsTheRows_IsNoticed(tmp_path):
    folder = baked(tmp_path / "lut", "exr")
    module = folder / "hairLut.js"
    module.write_text(module.read_text().replace("(height - 1 - y) * row", "y * row"))
    assert 100 < result_of(HERE / "pages", "three_loader.html", lut=folder)["code"] <= 110


def test_Material_OfTheEngineFolder_ShadesWithTheModel(tmp_path):
    """Hair that runs upward, lit from the side and from behind, seen from the front: S times the cosine of the light's inclination."""
    result = result_of(HERE / "pages", "three_material.html", lut=baked(tmp_path / "lut", "exr", 128))
    inclination = math.degrees(math.atan2(0.3, 1))
    for place, phi in (("side", 90), ("behind", 180)):
        row = rows("eval", "--preset", "blond", "--quantity", "S", "--theta-i", inclination, "--theta-o", 0, "--phi", phi)[0]
        wanted = [float(row[c]) * math.cos(math.radians(inclination)) for c in "rgb"]
        assert result[place] == pytest.approx(wanted, rel=0.02), place
    assert max(result["along"]) < 0.05 * max(result["behind"])
