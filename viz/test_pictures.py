"""Views as pictures, windows and files: what is drawn is there, in its colours, inside the frame; a slider moves what `eval` says;
VTK's own readers find the arrays."""
import csv
import io
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

import numpy
import pytest
from matplotlib import image

ROOT = pathlib.Path(__file__).resolve().parents[1]
PROGRAM = os.environ.get("CUTICLE_PROGRAM", str(ROOT / "build/release/bin/cuticle"))
R, TT, TRT = (0.20, 0.47, 0.75), (0.93, 0.60, 0.13), (0.75, 0.22, 0.27)

STATE = """<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>
<Piece NumberOfPoints="6" NumberOfVerts="0" NumberOfLines="2" NumberOfStrips="0" NumberOfPolys="0">
<PointData Scalars="stretch"><DataArray type="Float32" Name="stretch" format="ascii">1 1 1 1 1.2 0.9</DataArray></PointData>
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">0 0 0 0 -0.1 0 0 -0.2 0 0.1 0 0 0.1 -0.1 0 0.1 -0.2 0</DataArray></Points>
<Lines><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3 4 5</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">3 6</DataArray></Lines></Piece></PolyData></VTKFile>
"""
SERIES = """<VTKFile type="Collection" version="0.1"><Collection><DataSet timestep="0" file="state_0000.vtp"/>
<DataSet timestep="0.5" file="state_0001.vtp"/></Collection></VTKFile>
"""


def view(*arguments, **environment):
    """Without a display: the program starts one of its own."""
    variables = {**os.environ, **environment}
    variables.pop("DISPLAY", None)
    return subprocess.run([PROGRAM, "view", *map(str, arguments)], capture_output=True, text=True, timeout=120, env=variables)


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


def read_by_vtk(reader, path):
    """Point arrays and units of a file, by VTK's Python (Debian's, which libvtk9-dev brings)."""
    script = f"""
import json, sys
from vtkmodules.vtkIOXML import {reader}
from vtkmodules.vtkCommonCore import vtkDataArray
reader = {reader}()
reader.SetFileName(sys.argv[1])
reader.Update()
data = reader.GetOutput()
points = data.GetPointData()
found = {{}}
for k in range(points.GetNumberOfArrays()):
    array = points.GetArray(k)
    information = array.GetInformation()
    unit = information.Get(vtkDataArray.UNITS_LABEL()) if information.Has(vtkDataArray.UNITS_LABEL()) else ""
    width = array.GetNumberOfComponents()
    found[array.GetName()] = {{"unit": unit, "values": [array.GetComponent(i, c) for i in range(array.GetNumberOfTuples()) for c in range(width)]}}
found["points"] = [data.GetPoint(i) for i in range(data.GetNumberOfPoints())]
print(json.dumps(found))
"""
    done = subprocess.run(["/usr/bin/python3", "-c", script, str(path)], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_Lobes_TwoModels_StandSideBySideInTheirColours(tmp_path):
    pixels = picture(tmp_path / "lobes.png", "lobes", "--model", "marschner,chiang", "--theta-i", 40)
    for half in (pixels[:500, :700], pixels[:500, 700:]):
        for color in (R, TT, TRT):
            assert share_of_hue(half, color) > 0.004
    border = numpy.concatenate([pixels[0], pixels[-1], pixels[:, 0], pixels[:, -1]])
    assert border.min() == 1.0, "nothing is clipped"


def test_Lobes_One_ShowsNoOther(tmp_path):
    pixels = picture(tmp_path / "lobe.png", "lobes", "--lobe", "R", "--theta-i-deg", 30, "--size", 700, 450)
    assert share_of_hue(pixels, R) > 0.02
    assert share_of_hue(pixels, TRT) < 0.001


def test_Tables_AtOnce_HaveImageFieldAndError(tmp_path):
    pixels = picture(tmp_path / "lut.png", "lut", "--texels", 32, "--layout", "nalu_theta")
    for third in (pixels[:, :450], pixels[:, 480:880], pixels[:, 900:]):
        assert third.std() > 0.05
    assert share_of_hue(pixels[:, :450], (0.267, 0.005, 0.33)) > 0.1, "the low end of the colours"


def test_Strands_State_IsColouredByStretch(tmp_path):
    state = tmp_path / "state.vtp"
    state.write_text(STATE)
    whole = picture(tmp_path / "state.png", "strands", state)
    assert whole[-100:, -100:].min() > 0.99, "below the plot, where a run has another, nothing is drawn"
    pixels = whole[:780, :900]
    assert share_of_hue(pixels, (0.71, 0.02, 0.15)) > 0.0002, "longer than at rest is red"
    assert share_of_hue(pixels, (0.55, 0.69, 1.0), 0.15) > 0.00005, "shorter is blue"


COLLIDING = """{"schema_version": 1, "simulation": {"solver": {"exact": {}}, "effects": {"gravity": {}, "colliders": {}}}, "lights": [], "strand_count": 40,
"strand_vertices": 8, "colliders": {"head": true, "capsules": [{"from_m": [-0.2, -0.15, 0], "to_m": [0.2, -0.15, 0], "radius_m": 0.03}],
"boxes": [{"center_m": [0.25, 0, 0], "size_m": [0.1, 0.1, 0.1]}], "meshes": [{"file": "box.obj", "spacing_m": 0.02}],
"spheres": [{"center_m": [0, 0, 0], "radius_m": 0.03, "motion": {"keys": [{"time_s": 0, "position_m": [-0.3, 0, 0]}, {"time_s": 0.1, "position_m": [-0.2, 0, 0]}]}}]}}"""
BOX = "".join(f"v {x} {y} {z}\n" for x in (-0.35, -0.25) for y in (-0.05, 0.05) for z in (-0.05, 0.05)) + "".join(
    f"f {a} {b} {c}\n" for a, b, c in ((1, 2, 4), (1, 4, 3), (5, 7, 8), (5, 8, 6), (1, 5, 6), (1, 6, 2), (3, 4, 8), (3, 8, 7), (1, 3, 7), (1, 7, 5), (2, 6, 8), (2, 8, 4)))


def test_Strands_OfARunWithColliders_StandAmongThem(tmp_path):
    """Contact is in the states, and the shapes are where the files say."""
    (tmp_path / "scene.json").write_text(COLLIDING)
    (tmp_path / "box.obj").write_text(BOX)
    done = subprocess.run([PROGRAM, "simulate", tmp_path / "scene.json", "--frames", "0:2", "--out", tmp_path / "run"], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    done = view("strands", tmp_path / "run", "--color", "contact", "--density", 0.03, "--export", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    state = read_by_vtk("vtkXMLPolyDataReader", tmp_path / "run/state_0002.vtp")
    shapes = json.loads((tmp_path / "run/colliders.json").read_text())
    assert {shape["shape"] for shape in shapes["colliders"]} == {"sphere", "box", "field"} and [f["frame"] for f in shapes["frames"]] == [0, 1, 2]
    surface = numpy.array(read_by_vtk("vtkXMLPolyDataReader", tmp_path / "out/colliders_run.vtp")["points"])
    nearest = numpy.array([numpy.linalg.norm(surface - place, axis=1).min() for place in state["points"]])
    contact = numpy.abs(state["contact"]["values"])
    assert state["contact"]["unit"] == "m" and numpy.median(numpy.abs(nearest - contact)) < 0.01, "points of a surface stand apart"
    moving = surface[numpy.linalg.norm(surface - (-0.3 + 0.1 * 2 / 3, 0, 0), axis=1) < 0.0301]
    assert len(moving) > 100, "the ball is two thirds of its way after 2 / 30 s"
    field = next((tmp_path / "out").glob("field_run_*.vti"))
    assert min(read_by_vtk("vtkXMLImageDataReader", field)["distance"]["values"]) == pytest.approx(-0.05, abs=0.02)
    assert max(read_by_vtk("vtkXMLImageDataReader", tmp_path / "out/density_run.vti")["density"]["values"]) > 0
    pixels = picture(tmp_path / "run.png", "strands", tmp_path / "run", "--color", "guard_fired", "--size", 700, 450)
    assert (numpy.abs(pixels[:, :400] - (0.75, 0.73, 0.7)).max(axis=2) < 0.1).mean() > 0.01, "colliders are drawn"


def test_Shadow_AGroom_IsDrawn(tmp_path):
    grown = subprocess.run([PROGRAM, "grow", ROOT / "scenes/presets/wavy.json", "--share", "0.02", "--out", tmp_path / "hair.hair"],
                           capture_output=True, text=True, timeout=60)
    assert grown.returncode == 0, grown.stderr
    pixels = picture(tmp_path / "shadow.png", "shadow", tmp_path / "hair.hair", "--methods", "opacity_map,voxel")
    for third in (pixels[:450, :460], pixels[:450, 470:930], pixels[:450, 940:]):
        assert third.std() > 0.03


def test_Movie_OfATurn_IsTheoraOrPictures(tmp_path):
    done = view("paths", "--aspect", 0.6, "--movie", tmp_path / "turn.ogv", "--turntable", "--turn-frames", 4, "--size", 320, 240)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "turn.ogv").read_bytes()[:4] == b"OggS"
    done = view("paths", "--aspect", 0.6, "--movie", tmp_path / "turn", "--turn-frames", 3, "--size", 320, 240)
    frames = [image.imread(tmp_path / "turn" / f"frame_{k:04d}.png") for k in range(3)]
    assert done.returncode == 0 and numpy.abs(frames[0] - frames[1]).max() > 0.2


def test_Picture_WithoutXvfb_SaysWhatToInstall(tmp_path):
    done = view("lobes", "--screenshot", tmp_path / "never.png", PATH=str(tmp_path))
    assert done.returncode == 4
    assert "xvfb" in done.stderr and "DISPLAY" in done.stderr
    assert list(tmp_path.iterdir()) == []


def test_Window_WithoutDisplay_NamesTheWayToAPicture():
    done = view("lobes")
    assert done.returncode == 4 and "--screenshot" in done.stderr


@pytest.fixture
def copied(tmp_path):
    """The program in a folder of its own, which finds its module there or nowhere, and a function that views with it."""
    (tmp_path / "bin").mkdir()
    shutil.copy(PROGRAM, tmp_path / "bin/cuticle")
    patchelf("--set-rpath", "$ORIGIN/../lib", tmp_path / "bin/cuticle")

    def run(*words):
        return subprocess.run([tmp_path / "bin/cuticle", "view", "paths", *words], cwd=tmp_path, capture_output=True, text=True, timeout=60)

    return run


def patchelf(*words):
    subprocess.run([pathlib.Path(sys.executable).parent / "patchelf", *map(str, words)], check=True)


def test_View_WithoutItsModule_IsOneClearLine(copied):
    done = copied("--screenshot", "x.png")
    assert done.returncode == 4 and done.stderr.count("\n") == 2, "the error in one line, and what to try"
    assert "libcuticle_views.so" in done.stderr and "VTK" in done.stderr and "--export" in done.stderr


def test_View_WithoutALibraryOfVtk_NamesIt(tmp_path, copied):
    """The program as it is where VTK is not installed: its module is there, and what that needs is not."""
    module = next(pathlib.Path(PROGRAM).parents[1].glob("**/libcuticle_views.so"))
    (tmp_path / "lib").mkdir()
    shutil.copy(module, tmp_path / "lib")
    needed = subprocess.run([pathlib.Path(sys.executable).parent / "patchelf", "--print-needed", module], capture_output=True, text=True, check=True).stdout
    library = re.search(r"libvtkRenderingCore\S*", needed).group()
    patchelf("--replace-needed", library, "libvtkNotInstalled.so.1", tmp_path / "lib/libcuticle_views.so")
    done = copied("--screenshot", "x.png")
    assert done.returncode == 4 and done.stderr.count("\n") == 2 and "libvtkNotInstalled.so.1" in done.stderr
    assert copied("--export", "out").returncode == 0 and (tmp_path / "out/paths.csv").exists(), "files need no VTK"


@pytest.mark.parametrize("content", ["", "not xml", STATE[:300]])
def test_Strands_BrokenState_NamesTheFile(tmp_path, content):
    broken = tmp_path / "broken.vtp"
    broken.write_text(content)
    done = view("strands", broken, "--screenshot", tmp_path / "never.png")
    assert done.returncode == 3
    assert "broken.vtp" in done.stderr
    assert not (tmp_path / "never.png").exists()


def test_Export_Lobes_VtkReadsWhatEvalSays(tmp_path):
    done = view("lobes", "--lobe", "TT", "--theta-i", 20, "--export", tmp_path)
    assert done.returncode == 0, done.stderr
    found = read_by_vtk("vtkXMLStructuredGridReader", tmp_path / "lobes_marschner.vts")
    assert found["S_TT"]["unit"] == "1/sr"
    at = 47 * 361 + 350
    row = {name: found[name]["values"][at] for name in ("theta_o_deg", "phi_deg", "S_TT")}
    assert row["S_TT"] == pytest.approx(evaluated("marschner", "", 20, row), rel=3e-3, abs=1e-6)  # the mean over some degrees: measured 2.5e-3


def evaluated(model, settings, theta_i, row):
    command = [PROGRAM, "eval", "--model", model, "--quantity", "S", "--lobe", "TT", "--theta-i", f"{theta_i}", "--theta-o",
               f"{row['theta_o_deg']:.9g}", "--phi", f"{row['phi_deg']:.9g}"] + (["--set", settings] if settings else [])
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    values = next(csv.DictReader(io.StringIO(done.stdout)))
    return sum(float(values[c]) for c in "rgb") / 3


def test_Export_ARun_VtkReadsTheArraysBack(tmp_path):
    (tmp_path / "run").mkdir()
    for frame in (0, 1):
        (tmp_path / f"run/state_000{frame}.vtp").write_text(STATE)
    (tmp_path / "run/states.pvd").write_text(SERIES)
    done = view("strands", tmp_path / "run", "--frame", 1, "--color", "stretch", "--export", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    found = read_by_vtk("vtkXMLPolyDataReader", tmp_path / "out/strands_run.vtp")
    assert numpy.array_equal(numpy.float32(found["stretch"]["values"]), numpy.float32([1, 1, 1, 1, 1.2, 0.9]))
    assert numpy.float32(found["points"][5]).tolist() == numpy.float32([0.1, -0.2, 0]).tolist()
    series = (tmp_path / "out/run_run.pvd").read_text()
    members = re.findall(r'file="([^"]+)"', series)
    assert [(tmp_path / "out" / member).resolve().name for member in members] == ["state_0000.vtp", "state_0001.vtp"]
    assert all((tmp_path / "out" / member).exists() for member in members)
    state = (tmp_path / "out/paraview_run.py").read_text()
    compile(state, "paraview_run.py", "exec")
    assert 'ColorBy(shown, ("POINTS", "stretch"))' in state


def test_Simulate_ItsSeries_IsReadByVtkAsItWas(tmp_path):
    """states.pvd and its members by VTK's Python: each array of the module's own reader bit by bit, with its unit."""
    cuticle = pytest.importorskip("cuticle")
    done = subprocess.run([PROGRAM, "simulate", ROOT / "scenes/head_turn.json", "--frames", "0:2", "--format", "vtp,hair", "--out", tmp_path / "run"],
                          capture_output=True, text=True, timeout=120)
    if done.returncode == 4:
        pytest.skip("no Vulkan device")
    assert done.returncode == 0, done.stderr
    members = re.findall(r'timestep="([^"]+)" part="0" file="([^"]+)"', (tmp_path / "run/states.pvd").read_text())
    assert [float(time) for time, _ in members] == pytest.approx([0, 1 / 30, 2 / 30], rel=1e-6)
    units = {"velocity": "m/s", "stretch": "1", "tension": "m^2/s^2", "curvature": "1/m"}
    for _, file in members:
        found, here = read_by_vtk("vtkXMLPolyDataReader", tmp_path / "run" / file), cuticle.load_groom(tmp_path / "run" / file, 1.0)
        assert numpy.array_equal(numpy.float32(found["points"]), here.positions)
        for name, unit in units.items():
            assert found[name]["unit"] == unit
            assert numpy.array_equal(numpy.float32(found[name]["values"]), here.attributes[name].ravel())
        written = cuticle.load_groom((tmp_path / "run" / file).with_suffix(".hair"), 1.0)
        assert numpy.array_equal(here.positions, written.positions), "two formats of one state"


def test_Window_SliderMovedByTheMouse_ChangesWhatEvalSays(tmp_path):
    """The program's own window under Xvfb: xdotool drags the slider of theta_i and asks for the files."""
    script = f"""
{PROGRAM} view lobes --lobe TT --size 1000 760 > out.txt &
for try in $(seq 100); do
  id=$(xdotool search --onlyvisible --name "cuticle view lobes" 2>/dev/null | head -1) && [ -n "$id" ] && break
  sleep 0.1
done
sleep 1
xdotool mousemove --window $id 120 36 mousedown 1; sleep 0.3
xdotool mousemove --window $id 150 36; sleep 0.3
xdotool mousemove --window $id 180 36; sleep 0.3
xdotool mouseup 1; sleep 1
xdotool key x; sleep 1.5
xdotool key q
wait
"""
    done = subprocess.run(["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24", "bash", "-c", script], cwd=tmp_path, capture_output=True,
                          text=True, timeout=120)
    words = (tmp_path / "out.txt").read_text()
    assert "theta_i," in words, done.stderr + words
    theta_i = float(re.search(r"theta_i,([-\d.e]+)", words).group(1))
    assert abs(theta_i - 30) > 5
    found = read_by_vtk("vtkXMLStructuredGridReader", tmp_path / "view_export/lobes_marschner.vts")
    at = 47 * 361 + 350
    row = {name: found[name]["values"][at] for name in ("theta_o_deg", "phi_deg", "S_TT")}
    assert row["S_TT"] == pytest.approx(evaluated("marschner", "", theta_i, row), rel=5e-3, abs=1e-6)
