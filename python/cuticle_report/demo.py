"""The demo's page, from demo.json (README.md)."""
import math
import pathlib

from . import ReportError, data, page, study


def require(condition, where, what):
    if not condition:
        raise ReportError(f"{where}: {what}")


def section_of(raw, where, folder):
    """A section of demo.json, checked."""
    require(isinstance(raw, dict) and isinstance(raw.get("title"), str), where, "a section is an object with a title")
    table = raw.get("table") or {}
    columns, rows = table.get("columns", []), table.get("rows", [])
    for i, row in enumerate(rows):
        require(len(row) == len(columns), f"{where}.table.rows[{i}]", f"{len(row)} cells, but {len(columns)} columns")
    pictures = []
    for i, image in enumerate(raw.get("images", [])):
        require(isinstance(image.get("file"), str), f"{where}.images[{i}]", "needs a file")
        pictures.append(page.Picture(folder / image["file"], image.get("caption", "")))
    return page.Section(raw["title"], raw.get("text", ""), pictures, columns, rows)


def verdict(section):
    """How many errors of a section lie within their limits, and which do not; empty for other sections."""
    if section.columns[:3] != ["what", "error", "limit"]:
        return ""
    missed = [what for what, error, limit, *_ in section.rows if not is_number(error) or float(error) > float(limit)]
    if not missed:
        return f"All {len(section.rows)} errors of these frames are within the limits."
    return f"{len(section.rows) - len(missed)} of {len(section.rows)} errors of these frames are within the limits; above them: {'; '.join(missed)}."


def is_number(text):
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False


def make(folder):
    """Writes folder/index.html."""
    folder = pathlib.Path(folder)
    source = folder / "demo.json"
    raw = data.read_json(source)
    require(isinstance(raw.get("title"), str), source, "key 'title' is missing or not a text")
    require(isinstance(raw.get("sections"), list), source, "key 'sections' is missing or not a list")
    sections = [section_of(s, f"{source}: sections[{i}]", folder) for i, s in enumerate(raw["sections"])]
    for section in sections:
        section.strong = verdict(section)
    if sections:
        sections[0].strong = next((section.strong for section in sections if section.strong), "")
    if (folder / "study" / "study.json").is_file():
        title, more = study.make(folder / "study")
        more[0].title = f"{title}: {more[0].title.lower()}"
        sections += more
    page.write(folder / "index.html", page.render(raw["title"], sections))
