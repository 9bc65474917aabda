"""Strands drawn by three.js with the shipped module and snippet: their pixels are the model's S within the error that the manifest
states, the picture has hair's two highlights, and a damaged set says so on the page."""
import base64
import csv
import io
import json
import math
import pathlib
import random
import statistics
import sys

import pytest

from browser import HERE, result_of

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
from program import rows, run  # noqa: E402

SIZE = 64
MATERIAL = ["--model", "marschner", "--preset", "brown", "--set", "beta_deg=9"]


def baked(folder, form):
    done = run("bake", *MATERIAL, "--size", SIZE, "--format", form, "--target", "three", "--out", folder)
    assert done.returncode == 0, done.stderr
    return folder / "three"


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def random_direction(numbers):
    z, turn = numbers.uniform(-1, 1), numbers.uniform(0, 2 * math.pi)
    return [math.sqrt(1 - z * z) * math.cos(turn), math.sqrt(1 - z * z) * math.sin(turn), z]


def angles(pair):
    """theta_i, theta_o and phi in radians."""
    sin_i, sin_o = dot(pair["light"], pair["tangent"]), dot(pair["eye"], pair["tangent"])
    cosine = (dot(pair["light"], pair["eye"]) - sin_i * sin_o) / math.sqrt((1 - sin_i**2) * (1 - sin_o**2))
    return math.asin(sin_i), math.asin(sin_o), math.acos(max(-1.0, min(1.0, cosine)))


def pairs(count):
    numbers = random.Random(5)
    return [{name: random_direction(numbers) for name in ("tangent", "light", "eye")} for _ in range(count)]


def exact(work, all_pairs):
    """S of each pair by the program in double."""
    text = io.StringIO()
    lines = csv.writer(text)
    lines.writerow(["theta_i", "theta_o", "phi"])
    lines.writerows([math.degrees(angle) for angle in angles(pair)] for pair in all_pairs)
    (work / "points.csv").write_text(text.getvalue())
    return [[float(row[c]) for c in "rgb"] for row in rows("eval", *MATERIAL, "--quantity", "S", "--points", work / "points.csv")]


def pixels_of(png):
    """Rows of (r, g, b) of the picture, 0 .. 255."""
    from matplotlib import image
    return [[tuple(round(255 * float(c)) for c in pixel[:3]) for pixel in row] for row in image.imread(io.BytesIO(png))]


@pytest.mark.parametrize("form", ["exr", "ktx2", "png8"])
def test_Pixels_OfStrands_AreTheModelWithinTheStatedError(form, tmp_path):
    lut, work = baked(tmp_path / "lut", form), tmp_path / "work"
    work.mkdir()
    drawn = pairs(900)
    (work / "pairs.json").write_text(json.dumps(drawn))
    result = result_of(HERE / "pages", "strands.html", lut=lut, work=work)
    assert result["verdict"] == f"LUT OK: marschner, nalu_caustic, {form}" and not result["wrong"]
    stated = json.loads((lut / "manifest.json").read_text())["scattering"]
    truth = exact(work, drawn)
    for c, name in enumerate("rgb"):
        errors = [abs(found[c] - wanted[c]) for found, wanted in zip(result["measured"], truth)]
        assert max(errors) <= 1.2 * stated[f"S.{name}"]["maximum"]  # the largest of the directions that bake tried; others were met
        squares = [error * error for error in errors]
        allowed = stated[f"S.{name}"]["rms"] ** 2 + 3 * statistics.stdev(squares) / math.sqrt(len(squares))
        assert statistics.fmean(squares) <= allowed


def test_Picture_OfATress_HasAWhiteAndAColouredHighlight(tmp_path):
    result = result_of(HERE / "pages", "strands.html", lut=baked(tmp_path / "lut", "exr"))
    png = base64.b64decode(result["picture"].split(",")[1])
    (tmp_path / "strands.png").write_bytes(png)
    band = [row[230:370] for row in pixels_of(png)[70:560]]
    brightness = [sum(sum(pixel) for pixel in row) / len(row) / 3 for row in band]
    redness = [sum(pixel[0] - pixel[2] for pixel in row) / len(row) for row in band]
    white, coloured = brightness.index(max(brightness)), redness.index(max(redness))
    assert max(brightness) > 1.2 * sorted(brightness)[len(brightness) // 2]
    assert max(redness) > 2 * redness[white]
    assert coloured < white - 30  # the coloured one (TRT) is nearer to the roots, the white one (R) to the tips


def test_DamagedFile_IsSaidOnThePage(tmp_path):
    lut = baked(tmp_path / "lut", "ktx2")
    (lut / "M.ktx2").write_bytes((lut / "M.ktx2").read_bytes()[:200])
    result = result_of(HERE / "pages", "strands.html", lut=lut)
    assert result["wrong"] and "LUT WRONG" in result["verdict"] and "picture" not in result


def test_TableOfAnotherMaterial_IsSaidOnThePageWithItsName(tmp_path):
    lut, other = baked(tmp_path / "lut", "exr"), tmp_path / "other"
    assert run("bake", "--model", "marschner", "--set", "eta=1.3", "--size", SIZE, "--out", other).returncode == 0
    (lut / "N_TRT.exr").write_bytes((other / "N_TRT.exr").read_bytes())
    result = result_of(HERE / "pages", "strands.html", lut=lut)
    assert result["wrong"] and "table N_TRT reads another value than probe" in result["verdict"]
