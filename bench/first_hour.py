"""A newcomer's hour: every command of the README as it is written, then the usual mistakes; each with its seconds, exit code and what it said.

    .venv/bin/python bench/first_hour.py > bench/results/first_hour_xeon.txt

CUTICLE_TEST_DATA names the test data; without it the TressFX groom is left out.
"""
import os
import pathlib
import platform
import re
import shlex
import shutil
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
    "cuticle plan with_comments.json",
    "cuticle plan fov.json",
    "cuticle info empty",
    "cuticle shadows wavy.hair --methods deep_opacity --layers 4,64 --resolution 64 --quick",
    "cuticle eval --hair blond --quantity A --lobe TT --theta-d 0 --h 0",
    "cuticle play scenes/still.json --frames 6 --screenshot f.png",
    "cuticle play scenes/still.json --frames 0:5 --screenshot f.png",
    "cuticle --version",
]
WINDOWS = ("view", "play")
SHOWN = 6


def said(command, folder):
    """Runs a command; its lines of the log."""
    words = shlex.split(command)
    started = [PROGRAM, *words[1:]]
    if words[1] in WINDOWS:
        started = ["xvfb-run", "-a", *started]
    before = time.monotonic()
    done = subprocess.run(started, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=900)
    data = os.environ.get("CUTICLE_TEST_DATA") or "\0"
    command, lines = command.replace(data, "$CUTICLE_TEST_DATA"), done.stdout.replace(data, "$CUTICLE_TEST_DATA").splitlines()
    more = [f"  ... {len(lines) - SHOWN} more lines"] if len(lines) > SHOWN else []
    head = f"$ {command}\n  [{time.monotonic() - before:.1f} s, exit {done.returncode}]"
    return "\n".join([head, *("  " + line[:160] for line in lines[:SHOWN]), *more])


def imported():
    """The module after scripts/demo.sh."""
    command = '.venv/bin/python -c "import cuticle; print(cuticle.__version__)"'
    done = subprocess.run(command, shell=True, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return f"$ {command}\n  [exit {done.returncode}]\n  {done.stdout.strip()}"


def commands():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    for block in BLOCK.findall(text):
        yield from (command for command, _ in steps_of(block))


# What an import does to the pixels of a table, colour and alpha between 0 and 1.
SPOILT = {
    "srgb_with_linear_alpha": "pixels[..., :3] = np.where(colour <= .04045, colour / 12.92, ((colour + .055) / 1.055) ** 2.4)",
    "premultiplied_alpha": "if pixels.shape[-1] == 4: pixels[..., :3] = colour * pixels[..., 3:]",
    "channels_swapped": "pixels[..., :3] = colour[..., ::-1]",
    "channel_dropped": "pixels[..., 2] = 0",
    "flipped": "pixels = pixels[::-1]",
    "wrapped": "pixels[:, [0, -1]] = (pixels[:, :1] + pixels[:, -1:]) / 2; pixels[[0, -1]] = (pixels[:1] + pixels[-1:]) / 2",
    "resized": "pixels = (pixels[::2, ::2] + pixels[1::2, ::2] + pixels[::2, 1::2] + pixels[1::2, 1::2]) / 4",
}


def spoil_tables(folder):
    """Folders of tables as imports would spoil them, each in one way."""
    subprocess.run([PROGRAM, "bake", "--preset", "blond", "--size", "64", "--format", "png8", "--out", "good"], cwd=folder, check=True, capture_output=True)
    for name, change in SPOILT.items():
        shutil.copytree(folder / "good", folder / name)
        spoil = f"import sys, numpy as np, matplotlib.image as image\npath = sys.argv[1]; pixels = image.imread(path); colour = pixels[..., :3].copy()\n{change}\nimage.imsave(path, pixels)\n"
        for path in sorted((folder / name).rglob("N_*.png")):
            subprocess.run([sys.executable, "-c", spoil, str(path)], check=True)
        yield f"cuticle check lut {name}"
    lost = ("import sys, numpy as np\ndata = bytearray(open(sys.argv[1], 'rb').read())\nhalves = np.frombuffer(data, '<f2', offset=int.from_bytes(data[80:88], 'little'))\n"
            "halves[:] = np.round(np.minimum(halves, 1) * 255) / 255\nopen(sys.argv[1], 'wb').write(data)\n")
    subprocess.run([PROGRAM, "bake", "--preset", "blond", "--size", "64", "--format", "ktx2", "--out", "half_precision_lost"], cwd=folder, check=True, capture_output=True)
    for path in sorted((folder / "half_precision_lost").rglob("N_*.ktx2")):
        subprocess.run([sys.executable, "-c", lost, str(path)], check=True)
    yield "cuticle check lut half_precision_lost"


def mistaken_scenes(folder):
    """A scene with comments, which is read, and one with a key without its unit."""
    text = (ROOT / "scenes/still.json").read_text(encoding="utf-8")
    (folder / "with_comments.json").write_text("// my scene\n" + text, encoding="utf-8")
    (folder / "fov.json").write_text(text.replace('"fov_deg"', '"fov"'), encoding="utf-8")


def groom_of_the_data():
    """The main job on a part of a TressFX project, as a newcomer would start it."""
    data = os.environ.get("CUTICLE_TEST_DATA", "")
    found = sorted(pathlib.Path(data).rglob("*.tfx")) if data else []
    part = next((path for path in found if "side" in path.name.lower()), found[0] if found else None)
    return [f"cuticle demo --groom {part} --frames 2 --no-study --out part"] if part else []


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
        mistaken_scenes(folder)
        print("\nMistakes\n")
        for command in [*MISTAKES, *spoil_tables(folder), *groom_of_the_data()]:
            print(said(command, folder), flush=True)
        print(imported(), flush=True)


main()
