"""MkDocs hooks: the site's pages are the repository's own documents under their own paths, so that a link between two of them
works here as it does in the repository; the reference is written from the program's registries."""
import pathlib
import re
import sys

from mkdocs.structure.files import File

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import api  # noqa: E402
import reference  # noqa: E402

LEFT_OUT = {"build", "node_modules", "demo", "site"}
LINK = re.compile(r"\]\(([^)#\s]+)")


def documents(root):
    """Every document of the repository."""
    for path in sorted(root.rglob("*.md")):
        parts = path.relative_to(root).parts
        if not any(part in LEFT_OUT or part.startswith(".") for part in parts[:-1]):
            yield path


def linked_files(root, pages):
    """What the documents link to that is no document: pictures, data, schemas, sources."""
    found = {root / "docs/scene.schema.json"}
    for page in pages:
        for link in LINK.findall(page.read_text(encoding="utf-8")):
            target = (page.parent / link).resolve()
            if "://" not in link and target.is_file() and target.is_relative_to(root) and target.suffix != ".md":
                found.add(target)
    return sorted(found)


def on_files(files, config):
    root = pathlib.Path(config.config_file_path).resolve().parent
    for file in list(files):
        if file.abs_src_path and pathlib.Path(file.abs_src_path).is_relative_to(config.docs_dir):
            files.remove(file)
    pages = list(documents(root))
    for path in pages + linked_files(root, pages):
        files.append(File.generated(config, path.relative_to(root).as_posix(), abs_src_path=str(path)))
    for name, text in reference.pages(root).items():
        files.append(File.generated(config, f"reference/{name}.md", content=text))
    made = api.doxygen_pages(root)
    files.append(File.generated(config, "reference/api.md", content=api.index(root, made)))
    for path in sorted(made.iterdir()) if made else []:
        files.append(File.generated(config, f"api/{path.name}", abs_src_path=str(path)))
    return files
