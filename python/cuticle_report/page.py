"""One self-contained HTML page from sections of text, pictures, tables and plots."""
import base64
import dataclasses
import mimetypes
import os
import pathlib

import jinja2
import plotly.offline

from . import ReportError, look


@dataclasses.dataclass
class Picture:
    file: pathlib.Path
    caption: str = ""

    @property
    def data_uri(self):
        kind = mimetypes.guess_type(self.file.name)[0]
        if kind is None or not kind.startswith("image/"):
            raise ReportError(f"{self.file}: not a picture that a page can show (PNG, JPEG, SVG)")
        try:
            data = self.file.read_bytes()
        except OSError as error:
            raise ReportError(f"{self.file}: {error.strerror}") from error
        return f"data:{kind};base64,{base64.b64encode(data).decode()}"


@dataclasses.dataclass
class Section:
    title: str
    text: str = ""
    pictures: list = dataclasses.field(default_factory=list)
    columns: list = dataclasses.field(default_factory=list)
    rows: list = dataclasses.field(default_factory=list)
    figures: list = dataclasses.field(default_factory=list)  # plotly figures
    bold_row: int = -1  # number of a row in bold
    strong: str = ""  # a sentence in bold before the text

    @property
    def paragraphs(self):
        return [part for part in self.text.split("\n\n") if part.strip()]


def parameters(cell):
    """Names and values of a text as --set takes it, "eta=1.55,sigma_a=0.1/0.2/0.4", of three or more; else nothing."""
    pairs = [part.split("=", 1) for part in cell.split(",")] if isinstance(cell, str) and "=" in cell else []
    return pairs if len(pairs) > 2 and all(len(pair) == 2 for pair in pairs) else []


def own_script():
    return (pathlib.Path(__file__).parent / "templates/report.js").read_text(encoding="utf-8")


def render(title, sections):
    """The page as text."""
    environment = jinja2.Environment(loader=jinja2.PackageLoader(__package__), autoescape=True, undefined=jinja2.StrictUndefined,
                                     trim_blocks=True, lstrip_blocks=True)
    script = plotly.offline.get_plotlyjs() if any(section.figures for section in sections) else ""
    return environment.get_template("page.html.j2").render(title=title, sections=sections, script=script, figure_html=look.plot_html, own_script=own_script(),
                                                           parameters=parameters)


def write(path, text):
    """Writes the whole file or nothing."""
    temporary = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        temporary.write_text(text, encoding="utf-8")
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)
