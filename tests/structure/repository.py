"""What the structure tests share: the repository's files, modules, arrows, and the build folder (from the environment)."""
import os
import pathlib
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("CUTICLE_BUILD_DIR", ROOT / "build/release"))
CODE = (".cpp", ".h", ".glslh", ".glsl", ".comp", ".vert", ".frag", ".py", ".sh")

# A -> the modules it may include (docs/architecture.md); the closure is taken below.
ARROWS = {
    "core": [], "core/image": ["core"], "gpu": ["core"], "bsdf": ["core"], "study/oracle": ["core"],
    "strands": ["core"], "strands/rays": ["strands"], "strands/cards": ["strands", "core/image"], "lut": ["bsdf", "core/image"],
    "shadows": ["strands"], "sim": ["strands"], "scene": ["strands", "core/image"],
    "render": ["bsdf", "lut", "shadows", "scene", "core/image", "strands/cards"], "plan": ["scene", "sim", "shadows", "render"],
    "study": ["plan", "strands/rays", "study/oracle", "lut", "gpu"], "viz": ["strands", "bsdf", "lut", "shadows", "sim"], "play": ["plan", "gpu"],
}
EXTRA = {"shadows/truth": ["strands/rays"], "render/reference": ["strands/rays"]}
WITH_GPU_HALF = ("strands", "bsdf", "lut", "shadows", "sim", "render", "plan")
LEAVES = ("cli", "python", "bench", "tests")


def tracked():
    out = subprocess.run(["git", "-C", ROOT, "ls-files"], capture_output=True, text=True)
    names = out.stdout.split() if out.returncode == 0 else [str(p.relative_to(ROOT)) for p in ROOT.rglob("*") if p.is_file()]
    return [n for n in names if not n.startswith(("build/", ".venv/")) and (ROOT / n).exists()]


def code_files():
    return [n for n in tracked() if n.endswith(CODE)]


def closure(module):
    seen, pending = {module}, [module]
    while pending:
        for other in ARROWS.get(pending.pop(), []):
            if other not in seen:
                seen.add(other)
                pending.append(other)
    return seen


def module_of(path):
    """'shadows/truth/truth.cpp' -> 'shadows'; the nested modules win."""
    for nested in ("core/image", "strands/rays", "strands/cards", "study/oracle"):
        if path.startswith(nested + "/"):
            return nested
    return path.split("/")[0]


def is_gpu_half(path):
    return bool(re.search(r"_gpu(_\w+)?\.(h|cpp)$|\.(comp|vert|frag|glsl)$", path)) or "/gpu/" in path


def includes(path):
    """Names of the form bsdf/model.h that a file includes from this repository."""
    text = (ROOT / path).read_text(errors="replace")
    named = re.findall(r'#\s*include\s*[<"]([^>"]+)[>"]', text)
    return [name for name in named if name.split("/")[0] in ARROWS or name.split("/")[0] in LEAVES]
