"""Every command that a document shows in a console block runs, and prints what is shown there.

A line `...` stands for any lines. CUTICLE_UPDATE_DOCS=1 writes what the commands print into the documents, where they show output.
"""
import os
import pathlib
import re
import shlex
import shutil
import subprocess

import pytest

from documents import BLOCK, PAGES, ROOT, steps_of

PROGRAM = pathlib.Path(os.environ.get("CUTICLE_PROGRAM", ROOT / "build/release/bin/cuticle"))
NUMBER = re.compile(r"[-+]?\d+\.?\d*(?:e[-+]?\d+)?")
# A mistake that a document shows on purpose, and a request that small hair does not always meet.
EXIT_CODES = {"beta=7.5": {2}, "--max-error 0.2": {0, 1}}


def documents_with_commands():
    return [page for page in PAGES if BLOCK.search(page.read_text(encoding="utf-8"))]


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "scenes").symlink_to(ROOT / "scenes")
    return tmp_path


def ran(command, folder):
    words = shlex.split(command)
    assert words[0] == "cuticle", command
    started = [str(PROGRAM), *words[1:]]
    if words[1] == "view":
        assert shutil.which("xvfb-run"), "xvfb is in scripts/packages.txt"
        started = ["xvfb-run", "-a", *started]
    done = subprocess.run(started, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120)
    allowed = next((codes for words, codes in EXIT_CODES.items() if words in command), {0})
    assert done.returncode in allowed, f"{command}: exit {done.returncode}\n{done.stdout}"
    return done.stdout.splitlines()


def is_same(shown, printed):
    """Words alike, numbers within a thousandth: the last digits are the machine's."""
    if NUMBER.sub("#", shown) != NUMBER.sub("#", printed):
        return False
    pairs = zip(NUMBER.findall(shown), NUMBER.findall(printed))
    return all(abs(float(a) - float(b)) <= 1e-3 * max(abs(float(a)), abs(float(b)), 1e-9) for a, b in pairs)


def matches(shown, printed):
    """Whether the lines shown are the lines printed."""
    if not shown:
        return not printed
    if shown[0] == "...":
        return any(matches(shown[1:], printed[i:]) for i in range(len(printed) + 1))
    return bool(printed) and is_same(shown[0], printed[0]) and matches(shown[1:], printed[1:])


@pytest.mark.parametrize("page", documents_with_commands(), ids=lambda page: str(page.relative_to(ROOT)))
def test_Commands_OfADocument_RunAndPrintWhatIsShown(page, folder):
    text = page.read_text(encoding="utf-8")
    for block in BLOCK.findall(text):
        for command, shown in steps_of(block):
            printed = ran(command, folder)
            if os.environ.get("CUTICLE_UPDATE_DOCS") and shown and "..." not in shown:
                text = text.replace("\n".join([command, *shown]) + "\n", "\n".join([command, *printed]) + "\n")
            elif shown:
                assert matches(shown, printed), f"{command}\n" + "\n".join(printed)
    if os.environ.get("CUTICLE_UPDATE_DOCS"):
        page.write_text(text, encoding="utf-8")


def test_Matches_AnotherWordOrNumber_IsNoMatch():
    assert matches(["a 1.0", "...", "c"], ["a 1.0004", "b", "b", "c"])
    assert not matches(["a 1.0"], ["a 1.01"]) and not matches(["a"], ["b"]) and not matches(["a"], ["a", "b"])
