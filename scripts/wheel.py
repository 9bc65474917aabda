"""A wheel of the package cuticle from a build that is there: scripts/wheel.py BUILD OUT.

What `pip wheel .` packs, without compiling again; `auditwheel repair` then puts the libraries that it needs inside, so that it installs where there
is no compiler and no library of ours. OpenImageIO stays outside (it would bring video codecs along): where libOpenImageIO is missing, PNG
and the pictures of environments say so when they are asked for.
"""
import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import tomllib

from packaging import tags
from scikit_build_core._vendor.pyproject_metadata import StandardMetadata
from scikit_build_core.build._wheelfile import WheelMetadata, WheelWriter

ROOT = pathlib.Path(__file__).resolve().parents[1]


def stage(build, folder):
    """The compiled half, as the build installs it, and the packages of pyproject.toml."""
    subprocess.run(["cmake", "--install", build, "--component", "python", "--prefix", folder, "--strip"], check=True, stdout=subprocess.DEVNULL)
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())
    for package in project["tool"]["scikit-build"]["wheel"]["packages"]:
        source = ROOT / package
        shutil.copytree(source, folder / source.name, dirs_exist_ok=True, ignore=shutil.ignore_patterns("__pycache__"))
    return project


def pack(build, out):
    out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        stage_folder = pathlib.Path(folder) / "stage"
        metadata = StandardMetadata.from_pyproject(stage(build, stage_folder), ROOT)
        wheel_tags = frozenset({next(iter(tags.sys_tags()))})
        with WheelWriter(metadata, out, wheel_tags, WheelMetadata(root_is_purelib=False, tags=wheel_tags), None) as writer:
            writer.build({"platlib": stage_folder})
            return writer.wheelpath


def repair(wheel, out):
    """The wheel with its libraries inside, under the oldest platform that may run it."""
    assert importlib.util.find_spec("auditwheel"), "auditwheel is in scripts/requirements.txt"
    environment = {**os.environ, "PATH": os.pathsep.join([str(pathlib.Path(sys.executable).parent), os.environ["PATH"]])}
    subprocess.run([sys.executable, "-m", "auditwheel", "repair", "--exclude", "libOpenImageIO*", "-w", out, wheel], check=True, env=environment)
    wheel.unlink()


def main():
    build, out = (pathlib.Path(given).absolute() for given in sys.argv[1:3])
    repair(pack(build, out / "linux"), out)
    shutil.rmtree(out / "linux")


if __name__ == "__main__":
    main()
