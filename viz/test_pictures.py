"""Views as pictures under a virtual display: what is drawn is there, in its colours, inside the frame."""
import itertools
import os
import pathlib
import shutil
import subprocess

import numpy
import pytest
from matplotlib import image

ROOT = pathlib.Path(__file__).resolve().parents[1]
PROGRAM = os.environ.get("CUTICLE_PROGRAM", str(ROOT / "build/release/bin/cuticle"))
# A server number of its own for every view: the one before may still be closing.
SERVERS = itertools.count(100 + os.getpid() % 5000)
R, TT, TRT = (0.20, 0.47, 0.75), (0.93, 0.60, 0.13), (0.75, 0.22, 0.27)

STATE = """<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>
<Piece NumberOfPoints="6" NumberOfVerts="0" NumberOfLines="2" NumberOfStrips="0" NumberOfPolys="0">
<PointData Scalars="stretch"><DataArray type="Float32" Name="stretch" format="ascii">1 1 1 1 1.2 0.9</DataArray></PointData>
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">0 0 0 0 -0.1 0 0 -0.2 0 0.1 0 0 0.1 -0.1 0 0.1 -0.2 0</DataArray></Points>
<Lines><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3 4 5</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">3 6</DataArray></Lines></Piece></PolyData></VTKFile>
"""


def view(*arguments, display=True):
    command = [PROGRAM, "view", *map(str, arguments)]
    environment = dict(os.environ)
    if display:
        assert shutil.which("xvfb-run"), "xvfb is in scripts/packages.txt"
        command = ["xvfb-run", "-a", "-n", str(next(SERVERS)), *command]
    else:
        environment.pop("DISPLAY", None)
    return subprocess.run(command, capture_output=True, text=True, timeout=120, env=environment)


def picture(path, *arguments):
    done = view(*arguments, "--screenshot", path)
    assert done.returncode == 0, done.stderr
    return image.imread(path)[..., :3]


def share_of_hue(pixels, color, least_saturation=0.25):
    """Share of the picture's pixels whose colour is a shade of the given one."""
    top = pixels.max(axis=2, keepdims=True)
    saturated = (top - pixels.min(axis=2, keepdims=True))[..., 0] > least_saturation * top[..., 0]
    away = numpy.abs(pixels / numpy.maximum(top, 1e-3) - numpy.array(color) / max(color)).max(axis=2)
    return float((saturated & (away < 0.13)).mean())


def test_Lobes_All_ShowEachLobeInItsColour(tmp_path):
    pixels = picture(tmp_path / "lobes.png", "lobes", "--theta-i-deg", 30)
    for color in (R, TT, TRT):
        assert share_of_hue(pixels, color) > 0.005


def test_Lobes_One_ShowsNoOther(tmp_path):
    pixels = picture(tmp_path / "lobe.png", "lobes", "--lobe", "R", "--theta-i-deg", 30)
    assert share_of_hue(pixels, R) > 0.02
    assert share_of_hue(pixels, TRT) < 0.001


def test_Lobes_TextAndSurface_StayInsideTheFrame(tmp_path):
    pixels = picture(tmp_path / "lobes.png", "lobes", "--lobe", "sum", "--theta-i-deg", 30)
    border = numpy.concatenate([pixels[0], pixels[-1], pixels[:, 0], pixels[:, -1]])
    assert border.min() == 1.0
    assert pixels[:60, :700].min() < 0.4, "the title"


def test_Strands_State_IsColouredByStretch(tmp_path):
    state = tmp_path / "state.vtp"
    state.write_text(STATE)
    pixels = picture(tmp_path / "state.png", "strands", state)[: 800 - 120]
    assert share_of_hue(pixels, (0.75, 0.10, 0.12)) > 0.0002, "longer than at rest is red"
    assert share_of_hue(pixels, (0.45, 0.55, 0.8)) > 0.0001, "shorter is blue"


def test_View_WithoutDisplay_SaysHow(tmp_path):
    done = view("lobes", "--screenshot", tmp_path / "never.png", display=False)
    assert done.returncode == 4
    assert "xvfb-run" in done.stderr and "DISPLAY" in done.stderr
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("content", ["", "not xml", STATE[:300]])
def test_Strands_BrokenState_NamesTheFile(tmp_path, content):
    broken = tmp_path / "broken.vtp"
    broken.write_text(content)
    done = view("strands", broken, "--screenshot", tmp_path / "never.png")
    assert done.returncode == 3
    assert "broken.vtp" in done.stderr
    assert not (tmp_path / "never.png").exists()
