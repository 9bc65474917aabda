"""The arrows of docs/architecture.md: who may include whom, who may link whom, and where heavy packages may appear."""
import re
import subprocess
import sys

import pytest

from repository import ARROWS, BUILD, EXTRA, LEAVES, ROOT, WITH_GPU_HALF, closure, code_files, includes, is_gpu_half, module_of

sys.path.insert(0, str(ROOT / "scripts"))
import draw_arrows  # noqa: E402

HEAVY = {
    r"nlohmann/": "core/json/", r"embree3/|embree4/": "strands/rays/", r"OpenImageIO/|OpenEXR/|Imath/": "core/image/", r"ceres/|openssl/": "lut/",
    r"vtk\w+\.h": "viz/", r"GLFW/|imgui": "play/", r"vulkan/|volk\.h": "gpu/", r"tiny_gltf\.h": "strands/character/",
}


def allowed_modules(path):
    allowed = closure(module_of(path))
    for folder, more in EXTRA.items():
        if path.startswith(folder + "/"):
            for module in more:
                allowed |= closure(module)
    if is_gpu_half(path) and module_of(path) in WITH_GPU_HALF:
        allowed |= {"gpu"}
    return allowed


def checked_files():
    return [p for p in code_files() if module_of(p) in ARROWS and not re.search(r"_(test|fuzz|bench)\.cpp$", p)]


def violations(paths):
    found = []
    for path in paths:
        for name in includes(path):
            if module_of(name) not in allowed_modules(path):
                found.append(f"{path} includes {name}")
            if is_gpu_half(name) and name.split("/")[0] in WITH_GPU_HALF and module_of(path) in WITH_GPU_HALF and not is_gpu_half(path):
                found.append(f"{path} is no GPU half but includes {name}")
    return found


def test_Includes_EveryFile_FollowsTheArrows():
    assert violations(checked_files()) == []


def test_Includes_AForbiddenArrow_IsNoticed(tmp_path, monkeypatch):
    import repository
    (tmp_path / "bsdf").mkdir()
    (tmp_path / "bsdf/wrong.h").write_text("#include <lut/table_set.h>\n")
    monkeypatch.setattr(repository, "ROOT", tmp_path)
    assert violations(["bsdf/wrong.h"]) == ["bsdf/wrong.h includes lut/table_set.h"]


GENERATED = {"model_of_kernel.glslh"}  # a kernel's model, by the build
OTHERS = re.compile(r"\.(hlsl|cginc|gdshaderinc)$|^lut/targets/")  # in the text of an engine's files


def unknown_includes(root, paths):
    """Quoted includes that name no file from the root, and angled ones that name one of ours."""
    found = []
    for path in paths:
        text = (root / path).read_text(errors="replace")
        for name in re.findall(r'^\s*#\s*include\s*"([^"]+)"', text, flags=re.M):
            if not (root / name).is_file() and name not in GENERATED and not OTHERS.search(name):
                found.append(f'{path}: "{name}"')
        found += [f"{path}: <{name}>" for name in re.findall(r"^\s*#\s*include\s*<([^>]+)>", text, flags=re.M) if (root / name).is_file()]
    return found


def test_Includes_EveryPath_NamesAFileOfTheTree():
    sources = [p for p in code_files() if not p.endswith((".py", ".sh"))]
    assert unknown_includes(ROOT, sources) == []


def test_Includes_APathThatNamesNoFile_IsNoticed(tmp_path):
    (tmp_path / "a.h").write_text('#include "b.h"\n#include "nowhere/c.h"\n#include <b.h>\n#include <vector>\n')
    (tmp_path / "b.h").write_text("#pragma once\n")
    assert unknown_includes(tmp_path, ["a.h"]) == ['a.h: "nowhere/c.h"', "a.h: <b.h>"]


def test_Drawing_OfTheArrows_HasNoCycleAndIsUpToDate():
    done = subprocess.run([sys.executable, ROOT / "scripts/draw_arrows.py", "--check"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_Drawing_ACycle_IsNamed():
    graph = {"core": set(), "gpu": {"core", "sim"}, "sim": {"strands"}, "strands": {"gpu"}}
    assert draw_arrows.cycle(graph) == ["gpu", "sim", "strands"]


def test_Leaves_NothingPointsToThem():
    wrong = [f"{p} includes {n}" for p in checked_files() for n in includes(p) if n.split("/")[0] in LEAVES]
    assert wrong == []


@pytest.mark.parametrize("pattern,home", HEAVY.items())
def test_HeavyPackage_AppearsInOnePlaceOnly(pattern, home):
    wrong = []
    for path in code_files():
        if path.startswith((home, "tests/")) or re.search(r"_test\.cpp$", path) or path.endswith(".py"):
            continue
        if re.search(r'#\s*include\s*[<"](%s)' % pattern, (ROOT / path).read_text(errors="replace")):
            wrong.append(path)
    assert wrong == []


def test_PublicHeaders_HoldNoHeavyType():
    heavy = r'#\s*include\s*[<"](embree\d?/|OpenImageIO/|OpenEXR/|Imath/|ceres/|vtk\w+|vulkan/|volk|nlohmann/|tiny_gltf)'
    wrong = [p for p in code_files() if p.endswith(".h") and "/detail/" not in p and module_of(p) in ARROWS
             and re.search(heavy, (ROOT / p).read_text())]
    assert wrong == []


def target_module(target):
    name = target.replace("cuticle::", "").replace("cuticle_", "", 1) if target.startswith("cuticle") else None
    folders = {"core_image": "core/image", "core_points": "core", "bsdf_measured": "bsdf", "render_reference": "render", "lut_fit": "lut", "strands_rays": "strands/rays", "strands_cards": "strands/cards", "study_oracle": "study/oracle", "viz_vtk": "viz"}
    if name is None or name in ("", "warnings", "cuticle"):
        return None
    if name.startswith("study_") and name not in folders:
        return "study"
    return folders.get(name, name.removesuffix("_gpu"))


def linked_pairs():
    for line in (BUILD / "generated/link_graph.txt").read_text().splitlines():
        target, _, libraries = line.partition(": ")
        for library in re.split(r"[;\s]+", libraries):
            library = re.sub(r"\$<(LINK_ONLY|BUILD_INTERFACE):(.*)>", r"\2", library)
            if library.startswith("cuticle") and "warnings" not in library and "parts" not in library:
                yield target, library


def test_LinkGraph_EveryTarget_FollowsTheArrows():
    wrong = []
    pairs = list(linked_pairs())
    assert len(pairs) > 10
    for target, library in pairs:
        module = target_module(target)
        if module is None or module in LEAVES:
            continue
        allowed = closure(module) | {"gpu"} if target.endswith("_gpu") else closure(module)
        if target in ("cuticle_shadows", "cuticle_render_reference"):
            allowed |= {"strands/rays"}
        if target_module(library) not in allowed or (library.endswith("_gpu") and module not in ("study", "play") and not target.endswith("_gpu")):
            wrong.append(f"{target} links {library}")
    assert wrong == []
