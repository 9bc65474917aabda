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


def plant(folder, mark, names=("cuticle_usd", "cuticle_report", "numpy", "pxr", "matplotlib", "plotly", "jinja2", "site", "runpy",
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
    for arguments in (["info", "m.usd"], ["convert", "m.hair", "n.usdc"],
                      ["study", "lobes", "--models", "kajiya_kay", "--quick", "--out", str(out)]):
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
    scene.pop("motion", None)
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
