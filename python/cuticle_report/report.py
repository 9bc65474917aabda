"""One page for one study or for all: findings, error against time, tables, pictures beside each other; one file, no network."""
import base64
import csv
import dataclasses
import io
import math
import pathlib

import jinja2
import plotly.graph_objects
import plotly.offline

from . import ReportError, curves, findings, flip, ladder, look, page, pareto, results

HERE = pathlib.Path(__file__).parent
LEAST_SPAN = 2  # of times that an exponent is told of
MOST_PLOTS = 4  # of curves shown at once; the rest open on demand


@dataclasses.dataclass
class Download:
    name: str
    label: str
    uri: str


@dataclasses.dataclass
class Figure:
    """A plot of a page, with what it can be downloaded as."""
    identity: str
    title: str
    caption: str
    html: str
    downloads: list


@dataclasses.dataclass
class View:
    """A picture beside another, its error picture and its FLIP map, as data URIs."""
    title: str
    uri: str
    beside: str
    error: str = ""
    flip_map: str = ""
    mean_flip: float = None


def uri(kind, content):
    return f"data:{kind};base64,{base64.b64encode(content).decode()}"


def csv_text(columns, rows):
    buffer = io.StringIO()
    csv.writer(buffer, lineterminator="\n").writerows([columns, *rows])
    return buffer.getvalue()


def group_table(study, group):
    """Parameters in columns, then errors, time and bytes of every point."""
    knobs = list(dict.fromkeys(name for point in group.points for name in point.knobs))
    factor, unit = results.unit_of([point.seconds["value"] for point in group.points if point.seconds])
    metrics = group.raw["metrics"]
    columns = ["method", *knobs]
    for metric in metrics:
        columns += [metric["label"], "low", "high"] + (["95th percentile", "maximum"] if metric is metrics[0] else [])
    columns += [f"{study.raw['cost_label']}, {unit}", "low", "high", "bytes", "on the front"]
    rows = []
    for point in group.points:
        row = [point.method, *[point.knobs.get(name, "") for name in knobs]]
        for metric in metrics:
            error = point.errors[metric["name"]]
            row += [results.shown(error["mean"][key]) for key in ("value", "low", "high")]
            row += [results.shown(error["p95"]), results.shown(error["max"])] if metric is metrics[0] else []
        row += [results.shown(point.seconds[key] and point.seconds[key] * factor) for key in ("value", "low", "high")] if point.seconds else ["", "", ""]
        rows.append(row + [f"{point.bytes:.0f}" if point.bytes else "", "yes" if point.name in group.front else ""])
    return columns, rows


def group_figure(study, group):
    columns, rows = group_table(study, group)
    name = findings.group_id(study, group)
    drawer = ladder if ladder.is_ladder(group) else pareto
    files = drawer.printed(group, study.raw["cost_label"])
    for kind, content in files.items():
        (study.folder / f"{name}.{kind}").write_bytes(content)
    downloads = [Download(f"{name}.pdf", "PDF", uri("application/pdf", files["pdf"])), Download(f"{name}.svg", "SVG", uri("image/svg+xml", files["svg"])),
                 Download(f"{name}.csv", "data", uri("text/csv", csv_text(columns, rows).encode()))]
    return Figure(name, group.raw["title"], f"Truth: {group.raw['truth']}. {drawer.CAPTION}", look.plot_html(drawer.interactive(group, study.raw["cost_label"])), downloads)


def curve_figure(study, plot):
    if not {"name", "title", "x_label", "y_label", "polar", "curves"} <= plot.keys():
        raise ReportError(f"{study.folder}/result.json: plot {plot.get('name', '?')}: a key is missing")
    figure = curves.interactive(plot)
    rows = [[curve["name"], x, y] for curve in plot["curves"] for x, y in zip(curve["x"], curve["y"])]
    data = csv_text(["curve", plot["x_label"], plot["y_label"]], rows)
    return Figure(f"{study.name}-{plot['name']}", plot["title"], "", look.plot_html(figure), [Download(f"{plot['name']}.csv", "data", uri("text/csv", data.encode()))])


def grid_figure(study, grid):
    """A function of two angles as a heat map and as a surface, chosen by buttons; its decimal logarithm, over five decades."""
    largest = max(max(row) for row in grid["values"]) or 1
    heights = [[math.log10(max(value, 1e-5 * largest)) for value in row] for row in grid["values"]]
    common = {"x": grid["x"], "y": grid["y"], "colorscale": "Viridis", "colorbar": {"title": f"log10 {grid['z_label']}"}}
    figure = plotly.graph_objects.Figure([plotly.graph_objects.Heatmap(z=heights, **common), plotly.graph_objects.Surface(z=heights, visible=False, **common)])
    buttons = [{"label": label, "method": "update", "args": [{"visible": [label == "heat map", label == "3D"]}]} for label in ("heat map", "3D")]
    look.dress(figure, 460, 20, 40)
    figure.update_layout(updatemenus=[{"type": "buttons", "direction": "right", "x": 0, "y": 1.12, "buttons": buttons, "font": {"color": "#222"}}],
                         scene={"bgcolor": look.CLEAR, "xaxis_title": grid["x_label"], "yaxis_title": grid["y_label"], "zaxis_title": f"log10 {grid['z_label']}"})
    figure.update_xaxes(title=grid["x_label"])
    figure.update_yaxes(title=grid["y_label"])
    rows = [[y, *values] for y, values in zip(grid["y"], grid["values"])]
    data = csv_text([f"{grid['y_label']} \\ {grid['x_label']}", *grid["x"]], rows)
    return Figure(f"{study.name}-{grid['name']}", grid["title"], "", look.plot_html(figure), [Download(f"{grid['name']}.csv", "data", uri("text/csv", data.encode()))])


def views(study, means):
    """Pictures that stand beside another, with their error and FLIP maps."""
    files = {picture["file"] for picture in study.raw["pictures"]}
    inline = {}

    def read(name):
        if name not in inline:
            inline[name] = page.Picture(study.folder / name).data_uri
        return inline[name]
    found = []
    for picture in study.raw["pictures"]:
        if not picture["beside"]:
            continue
        error, flipped = (picture["file"].replace(".png", f"_{kind}.png") for kind in ("error", "flip"))
        found.append(View(picture["title"], read(picture["file"]), read(picture["beside"]), read(error) if error in files else "",
                          read(flipped) if (study.folder / flipped).is_file() else "", means.get(picture["file"])))
    return found


def conclusions(study, group):
    """Settings to take, as rows: at most so large an error, the cheapest."""
    rows, before = [], None
    for step in group.conclusions["cheapest_for"]:
        choice = step["choice"]
        if choice and choice["point"] == before:  # a looser error that the same setting meets
            continue
        before = choice and choice["point"]
        rows.append([results.shown(step["error_at_most"]), choice["point"] if choice else "none", findings.time(choice["seconds"]) if choice else "",
                     results.shown(choice["judging_error"]) if choice else ""])
    return ["error at most", "cheapest setting", "time", "error on the other half of the items"], rows


def time_span(group, method):
    """The largest time of a method's points by the smallest."""
    times = [point.seconds["value"] for point in group.drawable() if point.method == method]
    return max(times) / min(times) if times else 1


def sentences(group):
    """What is known of the group's rankings and exponents, and what is not; no exponent of points that take about the same time."""
    found = []
    for fit in group.conclusions["exponents"]:
        if time_span(group, fit["method"]) < LEAST_SPAN:
            continue
        found.append(f"{fit['method']}: error falls as time to the power {results.shown(fit['exponent'], 2)} ± {results.shown(fit['standard_error'], 1)}.")
    for fit in group.conclusions["growth"]:
        found.append(f"{fit['method']}: time grows with the {results.shown(fit['exponent'], 2)} ± {results.shown(fit['standard_error'], 1)} power of the factor.")
    if knee := group.conclusions["knee"]:
        found.append(f"Knee of the front: {knee['point']}.")
    ranks = group.conclusions["rankings"]
    if unknown := ranks["pairs_not_ranked_in_time"] + ranks["pairs_not_ranked_in_error"]:
        found.append(f"Not ranked, since their intervals overlap: {ranks['pairs_not_ranked_in_time']} pairs in time and {ranks['pairs_not_ranked_in_error']} in error, of "
                     f"the points that none surely beats ({unknown} in all).")
    return found


def section_of(study):
    means = flip.measure(study)
    groups = []
    for group in study.groups:
        groups.append({"group": group, "figure": group_figure(study, group) if len(group.drawable()) > 1 else None, "table": group_table(study, group),
                       "conclusions": conclusions(study, group) if group.drawable() else None, "sentences": sentences(group), "identity": findings.group_id(study, group)})
    plots = [curve_figure(study, plot) for plot in study.raw["plots"] if plot["curves"]] + [grid_figure(study, grid) for grid in study.raw.get("grids", [])]
    plots.sort(key=lambda drawn: not drawn.identity.endswith("-albedo"))
    return {"study": study, "groups": groups, "plots": plots, "views": views(study, means)}


def make(folder):
    """Writes folder/index.html from the results in it or in its folders."""
    studies = results.load_all(folder)
    if not studies:
        raise ReportError(f"{folder}: holds no result.json, nor does a folder in it")
    sections = [section_of(study) for study in sorted(studies, key=lambda study: (findings.ORDER.index(study.name) if study.name in findings.ORDER else 99, study.name))]
    environment = jinja2.Environment(loader=jinja2.PackageLoader(__package__), autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True)
    title = studies[0].raw["title"] if len(studies) == 1 else "What accuracy costs in time: hair, from its fibres to the final picture"
    text = environment.get_template("report.html.j2").render(
        title=title, sections=sections, findings=findings.find(studies), machine=studies[0].times["machine"], clock=studies[0].times,
        scripts=[plotly.offline.get_plotlyjs(), (HERE / "vendor/img-comparison-slider/index.js").read_text(encoding="utf-8")],
        own_script=page.own_script(), most_plots=MOST_PLOTS, shown=results.shown)
    page.write(folder / "index.html", text)
