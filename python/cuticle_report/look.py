"""What all figures look like, on every page: colours, lines, letters, sizes."""
import functools
import json
import math
import pathlib
import tempfile
import textwrap

from fontTools import subset
from matplotlib import font_manager, layout_engine, pyplot, ticker

COLORS = ["#1f5fa8", "#d9730d", "#2f8f4e", "#a8324a", "#6b4fa0", "#8a6d3b"]
MOST_CURVES = len(COLORS)  # of a figure: more than six colours are not told apart
OTHERS = "#8c8c8c"  # of what stands behind the six
# Of the lobes of every model, in every figure; the same as lobe_color of viz/lobe_surface.cpp.
LOBE_COLORS = {"R": "#3378bf", "TT": "#ed9921", "TRT": "#bf3845", "residual": "#599e5c", "TTs": "#f7cc85", "TRTs": "#db8c96",
               "specular": "#3378bf", "primary": "#3378bf", "diffuse": "#ed9921", "secondary": "#bf3845"}
# Of a measured fibre and of fibre models, in every plot that sets them side by side.
SUBJECT_COLORS = {"measurement": "#1f5fa8", "Monte Carlo": "#8c8c8c", "chiang": "#6b4fa0", "deon": "#2f8f4e", "hairworks": "#c77fb5", "huang": "#a8324a", "kajiya_kay": "#7fb0e6",
                  "karis": "#d9730d", "marschner": "#8a6d3b", "scheuermann": "#8fd0a4", "yan_fur": "#3a8fa8"}
FRONT = "rgba(128,128,128,0.3)"
GRID = "rgba(128,128,128,0.2)"
CLEAR = "rgba(0,0,0,0)"
FONT = "system-ui, sans-serif"
PLOT_WIDTH = 800  # of a page's axis, about: pages are wider or narrower
COLUMN_INCHES = 3.33
LETTERS = "Figure Sans"  # DejaVu Sans with the characters of Europe and of formulas alone
CHARACTERS = [*range(0x20, 0x250), *range(0x2B0, 0x400), *range(0x1E00, 0x2300)]
STYLE = {"font.family": [LETTERS, "DejaVu Sans"], "font.size": 7, "axes.labelsize": 7, "xtick.labelsize": 6, "ytick.labelsize": 6, "pdf.fonttype": 42, "svg.fonttype": "path", "svg.hashsalt": "cuticle",
         "axes.spines.top": False, "axes.spines.right": False}


@functools.cache
def add_letters():
    """Makes LETTERS known: of the whole font, each PDF takes a tenth of a second to choose what it embeds."""
    whole = subset.load_font(font_manager.findfont("DejaVu Sans"), subset.Options())
    chosen = subset.Subsetter(subset.Options(layout_features=[], notdef_outline=True, name_IDs=["*"], drop_tables=["FFTM"]))
    chosen.populate(unicodes=CHARACTERS)
    chosen.subset(whole)
    for record, text in ((1, LETTERS), (4, LETTERS), (6, LETTERS.replace(" ", ""))):  # family, full name, PostScript's
        whole["name"].setName(text, record, 3, 1, 0x409)
        whole["name"].setName(text, record, 1, 0, 0)
    folder = tempfile.TemporaryDirectory(prefix="cuticle_letters_")
    file = pathlib.Path(folder.name) / "letters.ttf"
    whole.save(file)
    font_manager.fontManager.addfont(file)
    return folder  # the file stands as long as the process


def printing():
    """The style of figures at column width, as a context."""
    add_letters()
    return pyplot.rc_context(STYLE)


def lay_out(figure):
    """Places axes and labels once and for all, so that what is drawn later takes no time for it."""
    if not isinstance(figure.get_layout_engine(), layout_engine.PlaceHolderLayoutEngine):
        figure.draw_without_rendering()
        figure.set_layout_engine("none")


def dress(figure, height, right, top=20, bottom=55):
    """The layout of a page's figure; colours are clear, so that a page's theme shows."""
    figure.update_layout(template="none", height=height, margin={"l": 75, "r": right, "t": top, "b": bottom}, paper_bgcolor=CLEAR, plot_bgcolor=CLEAR, showlegend=False,
                         font={"family": FONT, "size": 13}, modebar={"bgcolor": CLEAR, "color": "rgba(128,128,128,0.6)"}, hoverlabel={"font": {"family": FONT}})
    figure.update_xaxes(gridcolor=GRID, zeroline=False, exponentformat="power")
    figure.update_yaxes(gridcolor=GRID, zeroline=False, exponentformat="power")


def log_ticks(values):
    """Of a page's logarithmic axis: every power of ten where there are many, 1, 2 and 5 too where there are few, plotly's own within one; as 0.02 and not as powers where few digits say it."""
    values = [value for value in values if value > 0]
    low, high = min(values, default=1), max(values, default=1)
    step = 1 if high > 300 * low else "D2" if high > 8 * low else None
    return {"dtick": step, "tickformat": "~g" if high <= 1e4 * low and low >= 5e-4 and high < 1e4 else ""}


def wrapped(label):
    """A printed axis' label, in lines that are no longer than the axis."""
    return "\n".join(textwrap.wrap(label, 34))


def power_of_ten(value):
    return "10" + str(round(math.log10(value))).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def plain_ticks(axis):
    """Of a printed logarithmic axis: 0.02, 0.1, 20 and not powers of ten; between decades 2 and 5 alone, and nothing where there are many decades."""
    low, high = axis.get_view_interval()
    decades = math.log10(high / low)
    axis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}" if decades <= 4 and 1e-3 <= value < 1e4 else power_of_ten(value)))
    axis.set_minor_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}" if decades < 1.8 and f"{value:e}"[0] in "25" else ""))


def plot_html(figure):
    """A figure that the page's script draws when it comes into sight."""
    data = json.dumps(json.loads(figure.to_json()), separators=(",", ":")).replace("<", "\\u003c")
    return f'<div class="plot" style="min-height:{figure.layout.height or 450}px"><script type="application/json">{data}</script></div>'
