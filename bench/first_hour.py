"""A newcomer's hour: every command of the README as it is written, then the usual mistakes; each with its seconds, exit code and what it said.

    .venv/bin/python bench/first_hour.py > bench/results/first_hour_xeon.txt
"""
import os
import pathlib
import platform
import re
import shlex
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests/docs"))
from documents import BLOCK, steps_of  # noqa: E402

PROGRAM = os.environ.get("CUTICLE_PROGRAM", str(ROOT / "build/release/bin/cuticle"))
MISTAKES = [
    "cuticle rendr scenes/demo.json",
    "cuticle render scenes/demo.json --frams 0:3",
    "cuticle eval --model marschner --preset blonde --quantity N --phi 0 --theta-d 0",
    "cuticle eval --model marschner --set beta=7.5 --quantity M --theta-i 0 --theta-o 0",
    "cuticle eval --model marschner --quantity n --lobe TT --theta-d 0.3 --phi 0.5",
    "cuticle eval --model marschner --quantity S --theta-i 0.5 --theta-o 0.2 --phi 1",
    "cuticle models --fov 3",
    "cuticle info empty",
    "cuticle shadows wavy.hair --methods deep_opacity --layers 4,64 --resolution 64 --quick",
    "cuticle check lut wrong",
    "cuticle --version",
]
SHOWN = 6


def said(command, folder):
    """Runs a command; its lines of the log."""
    words = shlex.split(command)
    started = [PROGRAM, *words[1:]]
    if words[1] == "view":
        started = ["xvfb-run", "-a", *started]
    before = time.monotonic()
    done = subprocess.run(started, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=900)
    lines = done.stdout.splitlines()
    more = [f"  ... {len(lines) - SHOWN} more lines"] if len(lines) > SHOWN else []
    head = f"$ {command}\n  [{time.monotonic() - before:.1f} s, exit {done.returncode}]"
    return "\n".join([head, *("  " + line[:160] for line in lines[:SHOWN]), *more])


def commands():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    for block in BLOCK.findall(text):
        yield from (command for command, _ in steps_of(block))


def spoil_tables(folder):
    """A table as an import would spoil it: colour decoded from sRGB."""
    subprocess.run([PROGRAM, "bake", "--preset", "blond", "--size", "64", "--format", "png8", "--out", "wrong"], cwd=folder, check=True, capture_output=True)
    spoil = ("import sys, numpy as np, matplotlib.image as image\n"
             "path = sys.argv[1]; pixels = image.imread(path); colour = pixels[..., :3]\n"
             "pixels[..., :3] = np.where(colour <= .04045, colour / 12.92, ((colour + .055) / 1.055) ** 2.4); image.imsave(path, pixels)\n")
    for path in sorted((folder / "wrong").rglob("N_*.png"))[:1]:
        subprocess.run([sys.executable, "-c", spoil, str(path)], check=True)


def main():
    model = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())
    print(f"A newcomer's hour on {os.cpu_count()} cores of {model.group(1) if model else platform.machine()}; others may have computed beside it.\n")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "scenes").symlink_to(ROOT / "scenes")
        (folder / "empty").mkdir()
        print("The README's commands\n")
        for command in commands():
            print(said(command, folder), flush=True)
        spoil_tables(folder)
        print("\nMistakes\n")
        for command in MISTAKES:
            print(said(command, folder), flush=True)


main()
