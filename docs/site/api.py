"""The API reference: Doxygen's pages of the headers, and a page that lists the headers by module."""
import pathlib
import re
import shutil
import subprocess
import tempfile
from xml.etree import ElementTree

DOXYFILE = pathlib.Path(__file__).parent / "Doxyfile"
MODULES = re.search(r"^INPUT = (.*)$", DOXYFILE.read_text(encoding="utf-8"), re.M).group(1).split()
WITHOUT = "Doxygen was not there when this site was built (`scripts/setup.sh` installs it), so that the headers are only listed.\n\n"


def doxygen_pages(root):
    """Folder of Doxygen's pages; None where there is no Doxygen."""
    if not shutil.which("doxygen"):
        return None
    folder = pathlib.Path(tempfile.mkdtemp(prefix="cuticle-api-"))
    settings = DOXYFILE.read_text(encoding="utf-8") + f"OUTPUT_DIRECTORY = {folder}\nHTML_OUTPUT = api\nGENERATE_TAGFILE = {folder}/tags.xml\n"
    subprocess.run(["doxygen", "-"], input=settings, text=True, cwd=root, check=True, capture_output=True, timeout=300)
    return folder / "api"


def pages_of_headers(root, made):
    """Header to Doxygen's name of its page."""
    if not made:
        return {}
    files = ElementTree.parse(made.parent / "tags.xml").getroot().findall("compound[@kind='file']")
    names = {file.findtext("path", "") + file.findtext("name"): file.findtext("filename") for file in files}
    return {name.removeprefix(f"{root}/"): page if page.endswith(".html") else page + ".html" for name, page in names.items()}


def opening(path):
    """First sentence of the comment at the top of a header."""
    lines = []
    for line in path.read_text(encoding="utf-8").splitlines()[1:]:
        if not line.startswith("//"):
            break
        lines.append(line.lstrip("/ "))
    sentence = re.match(r"(.*?[.:])(?:\s|$)", " ".join(lines) + " ")
    return (sentence.group(1) if sentence else " ".join(lines)).replace("|", "\\|")


def headers(root):
    for module in MODULES:
        yield module, sorted(path.relative_to(root).as_posix() for path in (root / module).rglob("*.h"))


def cell(header, pages):
    return f"[`{header}`](../api/{pages[header]})" if header in pages else f"`{header}`"


def index(root, made):
    """The page `reference/api.md`."""
    text = "# The C++ headers\n\nEvery module's headers, with what each is for. Includes are paths from the repository's root: `#include \"bsdf/model.h\"`.\n\n"
    text += "[Classes](../api/annotated.html) · [namespaces](../api/namespaces.html) · [files](../api/files.html)\n\n" if made else WITHOUT
    pages = pages_of_headers(root, made)
    for module, names in headers(root):
        text += f"## {module}\n\n| header | what |\n|---|---|\n"
        text += "".join(f"| {cell(name, pages)} | {opening(root / name)} |\n" for name in names) + "\n"
    return text
