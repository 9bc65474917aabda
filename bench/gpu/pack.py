#!/usr/bin/env python3
"""Packs what `run_all.sh` needs on a bare machine that has only a driver.

    bench/gpu/pack.py [--build build/release] [--out build/gpu.tar.xz]

The archive holds the stripped programs and device tests of a build, the Vulkan loader and its validation layer, every
shared library that they load except the C library's own, the tests' data, and `run_all.sh`. OpenImageIO stays behind: it
loads 300 MB of libraries, and the few tests that read pictures by it fail there with its name.
"""
import argparse
import json
import lzma
import os
import re
import shutil
import subprocess
import tarfile
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAMS = ["cuticle", "bench_gpu", "calibrate"]
SYSTEM_LIBRARIES = Path("/usr/lib/x86_64-linux-gnu")
LAYER = Path("/usr/share/vulkan/explicit_layer.d/VkLayer_khronos_validation.json")
OF_THE_C_LIBRARY = re.compile(r"(ld-linux-x86-64|libc|libm|libdl|libpthread|librt|libresolv)\.so")


def device_tests(build):
    """(name, program, folder) of each compiled test with the label gpu."""
    shown = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1", "-L", "gpu"], check=True,
                           capture_output=True, text=True).stdout
    for test in json.loads(shown)["tests"]:
        command = test.get("command", [])
        if len(command) == 1:
            folder = next(p["value"] for p in test["properties"] if p["name"] == "WORKING_DIRECTORY")
            yield test["name"], Path(command[0]), folder


def libraries(program):
    """The files of the shared libraries that a program loads."""
    for line in subprocess.run(["ldd", program], check=True, capture_output=True, text=True).stdout.splitlines():
        found = re.search(r"=> (/\S+)", line)
        if found and not OF_THE_C_LIBRARY.match(Path(found[1]).name):
            yield Path(found[1])


def copy_program(source, folder, packed):
    """A stripped copy; several names of one file stay links to it."""
    real = source.resolve()
    target = folder / real.name
    if real not in packed:
        subprocess.run(["strip", "-o", target, real], check=True)
        for library in libraries(real):
            shutil.copy(library.resolve(), folder.parent / "lib" / library.name)
        packed.add(real)
    if source.name != real.name and not (folder / source.name).exists():
        (folder / source.name).symlink_to(real.name)


def sources_of(build):
    """The checkout that a build was made of: tests name its files."""
    cache = (build / "CMakeCache.txt").read_text()
    return re.search(r"^CMAKE_HOME_DIRECTORY:INTERNAL=(.*)$", cache, re.M)[1]


def write_archive(folder, out):
    """With a window so wide that what the programs share is stored once: half the size."""
    filters = [{"id": lzma.FILTER_LZMA2, "preset": 3, "dict_size": 2**28}]
    with lzma.open(out, "wb", filters=filters) as packed, tarfile.open(fileobj=packed, mode="w") as archive:
        archive.add(folder, folder.name)


def pack(build, data, out):
    with tempfile.TemporaryDirectory() as name:
        top = Path(name) / "gpu"
        for folder in ["bin", "lib", "tests"]:
            (top / folder).mkdir(parents=True)
        packed, listed = set(), []
        for program in PROGRAMS:
            if (build / "bin" / program).exists():
                copy_program(build / "bin" / program, top / "bin", packed)
        for test, program, folder in device_tests(build):
            copy_program(program, top / "tests", packed)
            listed.append(f"{test} {program.name} {os.path.relpath(folder, build)}\n")
        (top / "tests.txt").write_text("".join(listed))
        (top / "sources.txt").write_text(f"{sources_of(build)}\n")
        shutil.copytree(data, top / "data")
        shutil.copy(Path(__file__).parent / "run_all.sh", top)
        # NVIDIA's driver 580 was not found on a machine that lacked GLVND's EGL and GLX.
        for loaded_later in ["libvulkan.so.1", "libVkLayer_khronos_validation.so", "libXext.so.6", "libEGL.so.1", "libGLX.so.0"]:
            shutil.copy((SYSTEM_LIBRARIES / loaded_later).resolve(), top / "lib" / loaded_later)
        (top / "lib/VkLayer_khronos_validation.json").write_text(LAYER.read_text())
        write_archive(top, out)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=Path, default=ROOT / "build/release")
    parser.add_argument("--data", type=Path, default=Path(os.environ.get("CUTICLE_TEST_DATA", ROOT / "../shared/data")))
    parser.add_argument("--out", type=Path, default=ROOT / "build/gpu.tar.xz")
    options = parser.parse_args()
    pack(options.build.resolve(), options.data, options.out)
    print(f"{options.out}: {options.out.stat().st_size / 2**20:.1f} MiB")


if __name__ == "__main__":
    main()
