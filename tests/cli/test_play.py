"""The live window under a virtual display, driven by a mouse and keys as a person would."""
import json
import os
import shutil
import subprocess
import time

import pytest
from program import PROGRAM, refused

SMALL = {
    "schema_version": 1, "name": "small", "strand_count": 200, "strand_vertices": 6, "material": {"lut_size": 16},
    "lights": [{"to_light": [0.3, 0.6, 1], "irradiance": [6, 6, 6]}],
    "camera": {"position_m": [0.2, 0.15, 1.1], "target_m": [0, 0.05, 0], "fov_deg": 30, "resolution_px": [96, 96]}}


@pytest.fixture(scope="module")
def scene(tmp_path_factory):
    path = tmp_path_factory.mktemp("play") / "small.json"
    path.write_text(json.dumps(SMALL))
    return path


@pytest.fixture(scope="module")
def display():
    """A virtual display of its own for these tests."""
    server = subprocess.Popen(["Xvfb", "-displayfd", "1", "-screen", "0", "1024x768x24"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    yield dict(os.environ, DISPLAY=":" + server.stdout.readline().strip(), LIBGL_ALWAYS_SOFTWARE="1")
    server.terminate()
    server.wait()


def play(scene, display, *options):
    return subprocess.Popen([PROGRAM, "play", scene, "--json", *options], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=display)


def ended(process):
    out, err = process.communicate(timeout=100)
    assert process.returncode == 0, err
    return json.loads(out)


def closed(process, display):
    """The report of a window after Escape, which goes unheard while a control has the mouse."""
    while process.poll() is None:
        xdo(display, "key", "Escape")
    return ended(process)


def xdo(display, *words):
    subprocess.run(["xdotool", *map(str, words)], check=True, env=display, timeout=60)
    time.sleep(0.8)  # longer than the window takes to look at what was done


def middle(report, control):
    place = next(c for c in report["controls"] if c["name"] == control)
    return place["x"] + place["width"] // 2, place["y"] + place["height"] // 2


def click(display, place):
    xdo(display, "mousemove", *place)
    xdo(display, "mousedown", 1)
    xdo(display, "mouseup", 1)


@pytest.fixture(scope="module")
def untouched(scene, display, tmp_path_factory):
    """The report of a window that nobody touches, and its screenshot."""
    shot = tmp_path_factory.mktemp("play") / "window.png"
    return ended(play(scene, display, "--pictures", "2", "--screenshot", shot)), shot


@pytest.fixture(scope="module")
def touched(scene, display, untouched):
    """A window that was paused, orbited, stepped twice, and whose absorption and method were changed."""
    process = play(scene, display)
    xdo(display, "search", "--sync", "--onlyvisible", "--name", "Cuticle", "windowmove", "--sync", 0, 0, "windowfocus")  # a window not mapped yet cannot be focused
    click(display, middle(untouched[0], "pause"))
    xdo(display, "mousemove", 200, 200)
    xdo(display, "mousedown", 1)
    xdo(display, "mousemove", 280, 220)
    xdo(display, "mouseup", 1)
    xdo(display, "key", "period")
    click(display, middle(untouched[0], "step"))
    click(display, middle(untouched[0], "marschner.eta"))
    return closed(process, display)


def test_Play_Untouched_ShowsFramesInTurnAndAScreenshot(untouched):
    report, shot = untouched
    assert (report["pictures"], report["frame"], report["paused"]) == (2, 1, False)
    assert shot.stat().st_size > 4000


def test_Play_PausedAndDragged_OrbitsTheTarget(untouched, touched):
    assert touched["paused"]
    distance = [sum((r["camera_position_m"][a] - r["camera_target_m"][a]) ** 2 for a in "xyz") for r in (untouched[0], touched)]
    assert distance[0] == pytest.approx(distance[1], rel=1e-9)
    assert touched["camera_position_m"] != untouched[0]["camera_position_m"]
    assert touched["camera_target_m"] == untouched[0]["camera_target_m"]


def test_Play_SliderClickedInTheMiddle_ChangesTheMaterialAtOnce(untouched, touched):
    assert untouched[0]["material"]["eta"] == 1.55
    assert touched["material"]["eta"] == pytest.approx(0.5 * (1.05 + 3), abs=0.1)
    assert touched["change_ms"] > 0


def test_Play_RangeWithAScreenshot_EndsAfterItsLastFrame(scene, display, tmp_path):
    report = ended(play(scene, display, "--frames", "3:5", "--screenshot", tmp_path / "f.png"))
    assert (report["pictures"], report["frame"]) == (3, 5) and (tmp_path / "f.png").exists()


def test_Play_FramesThatAreNone_AreRefused(scene):
    assert "first:last" in refused(2, "play", scene, "--frames", "a:b:c")


def test_Play_NoDisplay_IsRefused(scene):
    done = subprocess.run([PROGRAM, "play", scene], capture_output=True, text=True, timeout=100, env={k: v for k, v in os.environ.items() if k != "DISPLAY"})
    assert done.returncode == 4
    assert "display" in done.stderr


def test_Play_UnknownMethod_IsRefused(scene):
    assert "tiles" in refused(2, "play", scene, "--method", "oils")
