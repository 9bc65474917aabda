"""Every header compiles alone (in the build, or here), and the installed package serves a project of its own."""
import concurrent.futures
import os
import re
import subprocess

from repository import ARROWS, BUILD, ROOT, code_files, module_of


def public_headers():
    return [p for p in code_files() if p.endswith(".h") and "/detail/" not in p and module_of(p) in ARROWS]


def included_first(path):
    """Whether the source beside it begins with it, so that the build has compiled it alone."""
    source = (ROOT / path).with_suffix(".cpp")
    first = re.search(r"#\s*include\s*[<\"](.*?)[>\"]", source.read_text()) if source.exists() else None
    return first is not None and first.group(1) == path


def compile_alone(path):
    command = ["g++", "-std=c++20", "-fsyntax-only", "-Wall", "-Wno-pragma-once-outside-header", f"-I{ROOT}", "-x", "c++",
               str(ROOT / path)]
    done = subprocess.run(command, capture_output=True, text=True)
    return "" if done.returncode == 0 else f"{path}: {done.stderr[:400]}"


def test_Header_EachAlone_Compiles():
    headers = [path for path in public_headers() if not included_first(path)]
    assert 20 < len(headers) < len(public_headers())
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        assert [m for m in pool.map(compile_alone, headers) if m] == []


def test_Header_ThatNeedsAnother_IsNoticed(tmp_path):
    broken = tmp_path / "broken.h"
    broken.write_text("#pragma once\nstd::vector<int> numbers();\n")
    assert "broken.h" in compile_alone(broken)


def test_Install_AConsumerProject_BuildsAndRuns(tmp_path):
    prefix, build = tmp_path / "prefix", tmp_path / "build"
    run = lambda *args: subprocess.run(args, check=True, capture_output=True, text=True)
    run("cmake", "--install", str(BUILD), "--prefix", str(prefix))
    run("cmake", "-S", str(ROOT / "tests/consumer"), "-B", str(build), "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={prefix}")
    run("cmake", "--build", str(build))
    assert "layouts, S =" in run(str(build / "consumer")).stdout
