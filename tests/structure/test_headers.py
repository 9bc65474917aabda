"""Every header compiles alone (in the build, or here), and the installed package serves a project of its own."""
import concurrent.futures
import os
import re
import shutil
import subprocess

import pytest

from repository import ARROWS, BUILD, ROOT, code_files, module_of


def public_headers():
    return [p for p in code_files() if p.endswith(".h") and "/detail/" not in p and module_of(p) in ARROWS]


def included_first(path):
    """Whether the source beside it begins with it, so that the build has compiled it alone."""
    source = (ROOT / path).with_suffix(".cpp")
    first = re.search(r"#\s*include\s*[<\"](.*?)[>\"]", source.read_text()) if source.exists() else None
    return first is not None and first.group(1) == path


def compile_alone(path, folder):
    """By the compiler's cache where there is one: it keeps objects, not checks of syntax."""
    cache = [program for program in [shutil.which("ccache")] if program]
    command = [*cache, "g++", "-std=c++20", "-O0", "-c", "-Wall", "-Wno-pragma-once-outside-header", f"-I{ROOT}", "-x", "c++", str(ROOT / path),
               "-o", str(folder / (str(path).strip("/").replace("/", "-") + ".o"))]
    environment = {**os.environ, "CCACHE_BASEDIR": str(ROOT), "CCACHE_NOHASHDIR": "1"}
    done = subprocess.run(command, capture_output=True, text=True, env=environment)
    return "" if done.returncode == 0 else f"{path}: {done.stderr[:400]}"


def test_Header_EachAlone_Compiles(tmp_path):
    headers = [path for path in public_headers() if not included_first(path)]
    assert 20 < len(headers) < len(public_headers())
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        assert [m for m in pool.map(lambda path: compile_alone(path, tmp_path), headers) if m] == []


def test_Header_ThatNeedsAnother_IsNoticed(tmp_path):
    broken = tmp_path / "broken.h"
    broken.write_text("#pragma once\nstd::vector<int> numbers();\n")
    assert "broken.h" in compile_alone(broken, tmp_path)


def installed_headers(prefix):
    folder = prefix / "include/cuticle"
    return [path.relative_to(folder).as_posix() for path in sorted(folder.rglob("*.h"))]


def compile_together(prefix, headers):
    text = "".join(f'#include "{header}"\n' for header in headers)
    command = ["g++", "-std=c++20", "-fsyntax-only", "-Wall", f"-I{prefix}/include/cuticle", f"-I{prefix}/include", "-x", "c++", "-"]
    done = subprocess.run(command, input=text, capture_output=True, text=True, cwd="/")
    return "" if done.returncode == 0 else done.stderr[:2000]


def failures(prefix, headers):
    """That each compiles alone is known of the tree (above); here, that the prefix holds all they include: many at a time."""
    batches = [headers[k:k + 50] for k in range(0, len(headers), 50)]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return [m for m in pool.map(lambda batch: compile_together(prefix, batch), batches) if m]


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def prefix(tmp_path_factory):
    folder = tmp_path_factory.mktemp("prefix")
    run("cmake", "--install", str(BUILD), "--prefix", str(folder))
    return folder


def test_Install_EveryHeader_CompilesFromThePrefix(prefix):
    headers = installed_headers(prefix)
    assert len(headers) > 250 and not [h for h in headers if "/detail/" in h]
    assert failures(prefix, headers) == []


def test_Install_AHeaderThatIncludesWhatIsNotInstalled_IsNoticed(tmp_path):
    (tmp_path / "include/cuticle/sim").mkdir(parents=True)
    (tmp_path / "include/cuticle/sim/broken.h").write_text('#pragma once\n#include "sim/detail/inside.h"\n')
    assert "sim/detail/inside.h" in failures(tmp_path, installed_headers(tmp_path))[0]


def test_Install_AConsumerOfEachModule_BuildsAndRuns(prefix, tmp_path):
    run("cmake", "-S", str(ROOT / "tests/consumer"), "-B", str(tmp_path), "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={prefix}")
    run("cmake", "--build", str(tmp_path))
    consumers = sorted(tmp_path.glob("consume_*"))
    assert {c.name.removeprefix("consume_") for c in consumers} == {s.stem for s in (ROOT / "tests/consumer").glob("*.cpp")}
    for consumer in consumers:
        assert run(str(consumer)), consumer.name
