"""Where the program meets the system: outputs, other programs, standard streams, signals and memory."""
import json
import os
import pathlib
import resource
import signal
import stat
import struct
import subprocess
import sys
import time
import zlib

import pytest

from program import PROGRAM, ROOT, refused, run

DEMO = ROOT / "scenes/demo.json"
EVAL = ["eval", "--model", "marschner", "--theta-i", "0", "--theta-o", "10", "--phi", "20"]


def groom(path, points=4):
    body = b"".join(struct.pack("<3f", 0, 0.01 * i, 0) for i in range(points))
    header = b"HAIR" + struct.pack("<III", 1, points, 2) + struct.pack("<Iff3f", points - 1, 0.1, 0, 1, 1, 1)
    path.write_bytes(header.ljust(128, b"\0") + body)
    return path


# Other programs: nothing runs from the current folder or from the output.

PLANTED = "import pathlib\npathlib.Path({mark!r}).write_text('run')\nraise ImportError('planted')\n"


def plant(folder, mark, names=("cuticle_usd", "cuticle_abc", "cuticle_report", "alembic3d", "imath", "numpy", "pxr", "matplotlib", "plotly", "jinja2", "site", "runpy",
                               "sitecustomize", "usercustomize")):
    for name in names:
        (folder / f"{name}.py").write_text(PLANTED.format(mark=str(mark)))


@pytest.mark.parametrize("where", ["current folder", "PYTHONPATH"])
def test_Python_PlantedModules_AreNotRun(tmp_path, where):
    here, out, mark = tmp_path / "here", tmp_path / "out", tmp_path / "mark"
    here.mkdir()
    out.mkdir()
    plant(here, mark)
    plant(out, mark)
    environment = {**os.environ, **({"PYTHONPATH": str(here)} if where == "PYTHONPATH" else {})}
    groom(here / "m.hair")
    (here / "m.usd").write_text("#usda 1.0\n")
    assert run("grow", "--strands", "vertices=8", "--share", "0.01", "--out", here / "a.hair").returncode == 0
    for arguments in (["info", "m.usd"], ["convert", "m.hair", "n.usdc"], ["convert", "m.hair", "n.abc"],
                      ["shadows", "a.hair", "--light", "0,1,0", "--methods", "opacity_map", "--layers", "4", "--resolution", "32", "--quick", "--rays",
                       "16", "--out", str(out)]):
        done = subprocess.run([PROGRAM, *arguments], cwd=here, env=environment, capture_output=True, text=True, timeout=200)
        assert not mark.exists(), arguments
        assert done.returncode in (0, 3), done.stderr
    assert (out / "index.html").exists(), "the page is still made"


# Outputs.

def test_Output_Device_IsWrittenTo(tmp_path):
    assert run(*EVAL, "--out", "/dev/null").returncode == 0
    assert stat.S_ISCHR(os.stat("/dev/null").st_mode)
    assert "/dev/full" in refused(3, *EVAL, "--out", "/dev/full")


def test_Output_Dash_IsStandardOutput(tmp_path):
    done = run(*EVAL, "--out", "-")
    assert done.returncode == 0 and done.stdout == run(*EVAL).stdout


def test_Output_ModeAndLink_AreKept(tmp_path):
    target, link = tmp_path / "target.csv", tmp_path / "link.csv"
    target.write_text("old")
    target.chmod(0o600)
    link.symlink_to(target)
    assert run(*EVAL, "--out", link).returncode == 0
    assert link.is_symlink() and "theta_i" in target.read_text()
    assert stat.S_IMODE(target.stat().st_mode) == 0o600


def test_Output_Folder_IsRefusedByName(tmp_path):
    assert str(tmp_path) in refused(3, *EVAL, "--out", tmp_path)


# Temporary files.

def test_Usd_TemporaryFiles_CannotBeGuessedAndGo(tmp_path):
    victim, temporary = tmp_path / "victim", tmp_path / "tmp"
    victim.write_text("mine")
    temporary.mkdir()
    groom(tmp_path / "m.hair")
    start = subprocess.Popen(["true"]).pid
    for pid in range(start, start + 300):
        (temporary / f"cuticle-{pid}.usda").symlink_to(victim)
    planted = sorted(temporary.iterdir())
    subprocess.run([PROGRAM, "convert", tmp_path / "m.hair", tmp_path / "m.usdc"], env={**os.environ, "TMPDIR": str(temporary)},
                   capture_output=True, timeout=100)
    assert victim.read_text() == "mine"
    assert sorted(temporary.iterdir()) == planted


def test_Usd_AbsentTmpdir_IsAnErrorThatSaysSo(tmp_path):
    groom(tmp_path / "m.hair")
    done = subprocess.run([PROGRAM, "convert", tmp_path / "m.hair", tmp_path / "m.usdc"], capture_output=True, text=True,
                          env={**os.environ, "TMPDIR": str(tmp_path / "absent")}, timeout=100)
    assert done.returncode == 3 and "TMPDIR" in done.stderr, done.stderr


# Standard streams.

@pytest.mark.parametrize("arguments", [["models", "--json"], ["info", "m.hair"], EVAL])
@pytest.mark.parametrize("way", [">&-", ">/dev/full"])
def test_StandardOutput_ClosedOrFull_IsNoticed(tmp_path, arguments, way):
    groom(tmp_path / "m.hair")
    done = subprocess.run(["sh", "-c", f'exec "$0" "$@" {way}', PROGRAM, *arguments], cwd=tmp_path, capture_output=True, text=True,
                          timeout=100)
    assert done.returncode == 3, done.stderr
    assert "cannot" in done.stderr


def test_StandardError_ClosedOrFull_DoesNotEndTheWork(tmp_path):
    groom(tmp_path / "m.hair")
    for way in ("2>&-", "2>/dev/full"):
        done = subprocess.run(["sh", "-c", f'exec "$0" "$@" {way}', PROGRAM, "convert", "m.hair", "n.hair"], cwd=tmp_path, timeout=100)
        assert done.returncode == 0 and (tmp_path / "n.hair").stat().st_size > 128


# Memory.

def ppm(path):
    path.write_bytes(b"P6 60000 60000 255\nxx")


def png(path):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", 60000, 60000, 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(b"")) + chunk(b"IEND", b""))


@pytest.mark.parametrize("write,name", [(ppm, "sky.ppm"), (png, "sky.png")])
def test_Environment_StatesMoreThanItHolds_IsRefusedBySize(tmp_path, write, name):
    write(tmp_path / name)
    scene = json.loads(DEMO.read_text())
    for key in ("motion", "groom"):  # files beside the scene
        scene.pop(key, None)
    scene["lights"] = scene["lights"][:1]
    scene["environment"] = {"file": name}
    (tmp_path / "scene.json").write_text(json.dumps(scene))
    message = refused(3, "render", tmp_path / "scene.json", "--out", tmp_path / "out")
    assert "60000 x 60000" in message and name in message


def test_Memory_ThatRunsOut_IsAMessage(tmp_path):
    rows = "theta_i,theta_o,phi\n" + "1,2,3\n" * 3000000
    (tmp_path / "points.csv").write_text(rows)
    done = run("--max-memory", "128M", "eval", "--points", tmp_path / "points.csv", "--out", tmp_path / "out.csv")
    assert done.returncode in (3, 4), f"{done.returncode} {done.stderr}"
    assert "memory" in done.stderr or "MiB" in done.stderr
    assert not (tmp_path / "out.csv").exists()


def test_Memory_Unreadable_IsAUsageError():
    assert "--max-memory" in refused(2, "models", "--max-memory", "lots")


def test_Grow_AtTheGreatestDensity_IsRefusedBySize(tmp_path):
    message = refused(3, "--max-memory", "1G", "grow", "--strands", "density=1e8", "--out", tmp_path / "g.hair")
    assert "MiB" in message


# Runs into a folder.

def scene(tmp_path, **changes):
    content = {"schema_version": 1, **changes}
    path = tmp_path / "scene.json"
    path.write_text(json.dumps(content))
    return path


def bytes_of(folder, but=()):
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in sorted(folder.rglob("*"))
            if path.is_file() and path.name not in but}


def small_demo(tmp_path):
    content = json.loads(DEMO.read_text())
    for key in ("motion", "groom", "environment"):  # files beside the scene, and lights in whose shadows the time would go
        content.pop(key, None)
    del content["lights"][1:]
    content["passes"]["surface_shadow"] = {"wanted": False}
    content["shadow"]["method"] = {"opacity_map": {"slices": 8, "resolution": 32}}
    content["camera"]["resolution_px"] = [64, 48]
    content["strand_count"] = 200
    content["material"]["lut_size"] = 16
    content["simulation"]["settle_time_s"] = 0
    path = tmp_path / "scene.json"
    path.write_text(json.dumps(content))
    return path


def test_Bake_Twice_GivesTheSameBytes(tmp_path):
    for name in ("a", "b"):
        assert run("bake", "--model", "marschner", "--size", "16", "--format", "exr", "--out", tmp_path / name).returncode == 0
    assert "timings.json" in bytes_of(tmp_path / "a")
    assert bytes_of(tmp_path / "a", but=["timings.json"]) == bytes_of(tmp_path / "b", but=["timings.json"])


def test_SimulateAndRender_Twice_GiveTheSameBytes(tmp_path):
    path = small_demo(tmp_path)
    for command in ("simulate", "render"):
        for name in ("a", "b"):
            assert run(command, path, "--frames", "0:1", "--out", tmp_path / command / name).returncode == 0
        first, second = (bytes_of(tmp_path / command / name, but=["timings.csv"]) for name in ("a", "b"))
        assert len(first) > 3 and first == second


def test_Render_OverAnEarlierRun_SaysWhatIsLeftAndListsItsOwn(tmp_path):
    path = small_demo(tmp_path)
    assert run("render", path, "--frames", "0:1", "--out", tmp_path / "out").returncode == 0
    done = run("render", path, "--frames", "0:0", "--out", tmp_path / "out")
    assert "2 files of an earlier run are left, frame_0001.exr .. frame_0001.png" in done.stderr
    listed = json.loads((tmp_path / "out/files.json").read_text())
    assert listed == {"command": "render", "complete": True, "files": ["frame_0000.exr", "frame_0000.png"]}


def started(*arguments, until):
    """A run that has written `until`."""
    process = subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    for _ in range(2000):
        if until.exists() or process.poll() is not None:
            break
        time.sleep(0.05)
    assert process.poll() is None, process.communicate()[1]
    return process


def test_Simulate_TwoRunsIntoOneFolder_TheSecondIsRefused(tmp_path):
    path, out = small_demo(tmp_path), tmp_path / "out"
    first = started("simulate", path, "--frames", "0:5000", "--out", out, until=out / "state_0001.vtp")
    message = refused(3, "simulate", path, "--frames", "0:1", "--out", out)
    assert "another run is writing there" in message
    first.kill()
    first.communicate()
    assert run("simulate", path, "--frames", "0:0", "--out", out).returncode == 0, "the lock goes with the process"


def test_Simulate_Interrupted_KeepsItsFramesAndSaysSo(tmp_path):
    path, out = small_demo(tmp_path), tmp_path / "out"
    process = started("simulate", path, "--frames", "0:5000", "--out", out, until=out / "state_0002.vtp")
    process.send_signal(signal.SIGINT)
    message = process.communicate(timeout=100)[1]
    assert process.returncode == 130 and "results are kept" in message and "interrupted after" in message
    listed = json.loads((out / "files.json").read_text())
    states = [name for name in listed["files"] if name.startswith("state_")]
    assert listed["complete"] is False and len(states) >= 3
    assert sorted(path.name for path in out.iterdir()) == sorted([*listed["files"], "files.json"])
    assert (out / "states.pvd").read_text().count("state_") == len(states)


def test_Simulate_Killed_LeavesWholeFilesAndTheNextRunGoes(tmp_path):
    path, out = small_demo(tmp_path), tmp_path / "out"
    process = started("simulate", path, "--frames", "0:5000", "--out", out, until=out / "state_0002.vtp")
    process.kill()
    process.communicate()
    assert process.returncode == -signal.SIGKILL
    states = sorted(out.glob("state_*.vtp"))
    assert len(states) >= 3
    for state in states:
        assert state.read_bytes().rstrip().endswith(b"</VTKFile>"), state
    assert all(file in states or file.name.startswith(".cuticle-") for file in out.iterdir() if file.suffix != ".lock")
    done = run("simulate", path, "--frames", "0:1", "--out", out)
    assert done.returncode == 0 and "of an earlier run are left" in done.stderr


def test_Simulate_FromALaterFrame_SaysWhatIsSkippedAndGivesTheSameStates(tmp_path):
    path = small_demo(tmp_path)
    done = run("simulate", path, "--frames", "10:11", "--out", tmp_path / "late")
    assert "frames 0 .. 9 are simulated first" in done.stderr
    run("simulate", path, "--frames", "0:11", "--out", tmp_path / "all")
    assert (tmp_path / "late/state_0011.vtp").read_bytes() == (tmp_path / "all/state_0011.vtp").read_bytes()


def test_Interrupt_WorkThatKeepsNothing_RemovesWhatIsHalfWritten(tmp_path):
    fifo = tmp_path / "points.csv"
    os.mkfifo(fifo)
    process = subprocess.Popen([PROGRAM, "eval", "--points", fifo, "--out", tmp_path / "out.csv"], stderr=subprocess.PIPE, text=True)
    time.sleep(1)
    process.send_signal(signal.SIGTERM)
    assert "removed" in process.communicate(timeout=100)[1]
    assert process.returncode == 128 + signal.SIGTERM
    assert [path.name for path in tmp_path.iterdir()] == ["points.csv"]


def test_ReadOnlyFolder_IsSaidAndNothingIsLeft(tmp_path):
    folder = tmp_path / "locked"
    folder.mkdir()
    folder.chmod(0o500)
    if os.access(folder, os.W_OK):
        pytest.skip("this user may write everywhere")
    assert "Permission denied" in refused(3, *EVAL, "--out", folder / "x.csv")


def test_FullDisk_LeavesTheOlderFile(tmp_path):
    """A limit on the length of files stands for a disk that is full."""
    out = tmp_path / "out.csv"
    out.write_text("old")
    def limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))
    done = subprocess.run([PROGRAM, *EVAL, "--out", out], preexec_fn=limit, capture_output=True, text=True, timeout=100)
    assert done.returncode == 3 and "File too large" in done.stderr
    assert out.read_text() == "old" and [path.name for path in tmp_path.iterdir()] == ["out.csv"]


# Input.

def test_Points_FromAPipe_AreRead(tmp_path):
    text = "theta_i,theta_o,phi\n1,2,3\n"
    (tmp_path / "points.csv").write_text(text)
    expected = run("eval", "--points", tmp_path / "points.csv").stdout
    done = subprocess.run([PROGRAM, "eval", "--points", "/dev/stdin"], input=text, capture_output=True, text=True, timeout=100)
    assert done.stdout == expected != ""
    done = subprocess.run(["bash", "-c", f'"{PROGRAM}" eval --points <(cat "{tmp_path}/points.csv")'], capture_output=True, text=True,
                          timeout=100)
    assert done.stdout == expected


def test_Groom_FromAPipe_IsRead(tmp_path):
    path = groom(tmp_path / "m.hair")
    os.mkfifo(tmp_path / "pipe.hair")
    with subprocess.Popen(["sh", "-c", 'cat "$0" >"$1"', path, tmp_path / "pipe.hair"]):
        assert "strands" in run("info", tmp_path / "pipe.hair").stdout


def test_Message_BytesOfAFile_AreShownAsText(tmp_path):
    (tmp_path / "points.csv").write_bytes(b"theta_i,\x1b]0;owned\x07\xff\n1,2\n")
    done = subprocess.run([PROGRAM, "eval", "--points", tmp_path / "points.csv"], capture_output=True, timeout=100)
    assert done.returncode == 3 and b"\\x1b]0;owned\\x07\\xff" in done.stderr
    assert not any(byte < 32 and byte != 10 for byte in done.stderr)


def test_Message_LongKey_IsCut(tmp_path):
    path = scene(tmp_path, **{"k" * (5 << 20): 1})
    message = refused(3, "plan", path)
    assert len(message) < 5000 and "more bytes" in message


def test_Scene_ManyUnknownKeys_AreRefusedByTheFirst(tmp_path):
    path = scene(tmp_path, **{f"key {i}": 0 for i in range(400000)})
    assert "key 0" in refused(3, "plan", path)


@pytest.mark.parametrize("arguments, words", [
    (["bake", "--model", "kajiya_kay", "--layout", "nalu", "--out", "lut"], ["nalu", "kajiya_kay"]),
    (["eval", "--model", "marschner", "--set", "eta=1.4,eta=1.5", "--theta-i", "0", "--theta-o", "0", "--phi", "0"], ["eta", "twice"]),
])
def test_Usage_Message_NamesWhatWasGiven(tmp_path, arguments, words):
    done = subprocess.run([PROGRAM, *arguments], cwd=tmp_path, capture_output=True, text=True, timeout=100)
    assert done.returncode == 2, done.stderr
    for word in words:
        assert word in done.stderr


def test_Scene_CameraInItsTarget_IsNamed(tmp_path):
    path = scene(tmp_path, camera={"position_m": [0, 0, 1], "target_m": [0, 0, 1]})
    assert "same point" in refused(3, "plan", path)


def test_Scene_KeyGivenTwice_IsRefused(tmp_path):
    (tmp_path / "scene.json").write_text('{"schema_version": 1, "camera": {}, "camera": {}}')
    assert "'camera' is given twice" in refused(3, "plan", tmp_path / "scene.json")


def test_Shadows_OneStrandFarAway_IsNamed(tmp_path):
    body = b"".join(struct.pack("<6f", s * 0.01, 0, 0, s * 0.01, 0.1, 0) for s in range(9)) + struct.pack("<6f", 0, 0, 0, 1e6, 0, 0)
    header = b"HAIR" + struct.pack("<III", 10, 20, 2) + struct.pack("<Iff3f", 1, 7e-5, 0, 1, 1, 1)
    (tmp_path / "far.hair").write_bytes(header.ljust(128, b"\0") + body)
    message = refused(3, "shadows", tmp_path / "far.hair", "--metres-per-unit", "1", "--light", "0,1,0", "--quick")
    assert "strand 9" in message and "footprint_radius" not in message
