"""Long work on a terminal: every command that goes on for long draws a bar, which grows, ends full and leaves what the command prints alone."""
import json
import os
import pty
import re
import subprocess

import pytest

from program import PROGRAM, ROOT, run

BAR = re.compile(r"\r\x1b\[K(?P<task>\S.*?) +\[(?P<bar>=* *)\] (?P<done>\d+)/(?P<total>\d+)")


def on_a_terminal(*arguments):
    """Exit code, what it wrote to standard output, a file, and what a terminal of standard error was sent."""
    ours, theirs = pty.openpty()
    with subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE, stderr=theirs) as running:
        os.close(theirs)
        sent = b""
        while True:
            try:
                part = os.read(ours, 65536)
            except OSError:  # the terminal is closed
                break
            if not part:
                break
            sent += part
        written = running.stdout.read().decode()
        code = running.wait()
    os.close(ours)
    return code, written, sent.decode().replace("\r\n", "\n")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("bars")
    assert run("grow", "--strands", "vertices=8", "--share", "0.01", "--out", folder / "a.hair").returncode == 0
    scene = json.loads((ROOT / "scenes/head_turn.json").read_text())
    scene.update(strand_count=50)
    scene["camera"]["resolution_px"] = [16, 16]
    scene["motion"]["bvh"] = str(ROOT / "scenes/motion/head_turn.bvh")
    (folder / "turn.json").write_text(json.dumps(scene))
    return folder


# What each is asked, and the tasks whose bars it draws.
LONG = {
    "bake": (["bake", "--model", "marschner", "--size", 16, "--out", "lut"], {"bake", "certify"}),
    "check": (["check", "model", "karis", "--quick"], {"karis"}),
    "grow": (["grow", ROOT / "scenes/presets/straight.json", ROOT / "scenes/presets/curly.json", "--share", 0.01, "--out", "grooms"], {"grooms"}),
    "render": (["render", "turn.json", "--frames", "0:2", "--out", "frames"], {"bake", "frames"}),
    "simulate": (["simulate", "turn.json", "--frames", "0:2", "--out", "states"], {"frames"}),
    "study": (["study", "skinning", "--quick", "--out", "skinning"], {"settings", "rounds of timing"}),
}


@pytest.mark.parametrize("name", LONG)
def test_LongCommand_OnATerminal_DrawsBarsThatEndFull(folder, name, monkeypatch):
    monkeypatch.chdir(folder)
    arguments, tasks = LONG[name]
    code, written, sent = on_a_terminal(*arguments)
    bars = [found.groupdict() for found in BAR.finditer(sent)]
    assert code == 0, sent
    assert {bar["task"] for bar in bars} == tasks
    assert "\x1b" not in written and "\r" not in written
    for bar in bars:
        assert bar["bar"].count("=") == len(bar["bar"]) * int(bar["done"]) // int(bar["total"])
    for task in tasks:
        last = [bar for bar in bars if bar["task"] == task][-1]
        assert last["done"] == last["total"], last
        assert re.search(rf"{last['done']}/{last['total']}\n", sent), "a full bar stays, on a line of its own"


def test_LongCommand_IntoAPipe_DrawsNoBar(folder, monkeypatch):
    monkeypatch.chdir(folder)
    assert "\x1b" not in run(*LONG["bake"][0]).stderr
