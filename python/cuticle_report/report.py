"""One page for one study or for all: findings, error against time, tables, pictures beside each other; one file, no network."""
import base64
import csv
import dataclasses
import io
import pathlib

import jinja2
import plotly.graph_objects
import plotly.offline

from . import ReportError, curves, findings, flip, growth, knobs, ladder, look, page, pareto, printed_curves, processes, results, states

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

    @property
    def thumbnail(self):
        """The printed figure, as a data URI."""
        return next(file.uri for file in self.downloads if file.label == "SVG")


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


def downloads_of(folder, name, files, columns, rows):
    """A figure's PDF and SVG, also written beside the page, and its data."""
    for kind, content in files.items():
        (folder / f"{name}.{kind}").write_bytes(content)
    kinds = {"pdf": ("PDF", "application/pdf"), "svg": ("SVG", "image/svg+xml")}
    downloads = [Download(f"{name}.{kind}", label, uri(mime, files[kind])) for kind, (label, mime) in kinds.items()]
    return downloads + [Download(f"{name}.csv", "data", uri("text/csv", csv_text(columns, rows).encode()))]


def drawer_of(group):
    """What draws the group."""
    return ladder if ladder.is_ladder(group) else states if states.is_of_states(group) else growth if growth.is_of(group) else pareto


def table_of(study, group):
    return states.table(study, group) if states.is_of_states(group) else group_table(study, group)


def group_figure(study, group):
    columns, rows = table_of(study, group)
    name = findings.group_id(study, group)
    drawer = drawer_of(group)
    downloads = downloads_of(study.folder, name, drawer.printed(group, study.raw["cost_label"]), columns, rows)
    return Figure(name, group.raw["title"], f"Truth: {group.raw['truth']}. {drawer.CAPTION}", look.plot_html(drawer.interactive(group, study.raw["cost_label"])), downloads)


def check(study, plot):
    if not {"name", "title", "x_label", "y_label", "polar", "curves"} <= plot.keys():
        raise ReportError(f"{study.folder}/result.json: plot {plot.get('name', '?')}: a key is missing")


def curve_figure(study, plot, files):
    figure = curves.interactive(plot)
    rows = [[curve["name"], x, y] for curve in plot["curves"] for x, y in zip(curve["x"], curve["y"])]
    name = f"{study.name}-{plot['name']}"
    if name in [findings.group_id(study, group) for group in study.groups]:
        name += "-curves"
    downloads = downloads_of(study.folder, name, files, ["curve", plot["x_label"], plot["y_label"]], rows)
    return Figure(name, plot["title"], "", look.plot_html(figure), downloads)


def grid_figure(study, grid, files):
    """A function of two angles as a heat map and as a surface, chosen by buttons; its decimal logarithm, over five decades."""
    heights = printed_curves.heights_of(grid)
    common = {"x": grid["x"], "y": grid["y"], "colorscale": "Viridis", "colorbar": {"title": f"log10 {grid['z_label']}"}}
    figure = plotly.graph_objects.Figure([plotly.graph_objects.Heatmap(z=heights, **common), plotly.graph_objects.Surface(z=heights, visible=False, **common)])
    # The surface has axes of its own: the map's would stand behind it.
    buttons = [{"label": label, "method": "update", "args": [{"visible": [is_map, not is_map]}, {"xaxis.visible": is_map, "yaxis.visible": is_map}]}
               for label, is_map in (("heat map", True), ("3D", False))]
    look.dress(figure, 460, 20, 40)
    figure.update_layout(updatemenus=[{"type": "buttons", "direction": "right", "x": 0, "y": 1.12, "buttons": buttons, "font": {"color": "#222"}}],
                         scene={"bgcolor": look.CLEAR, "camera": {"eye": {"x": 1.7, "y": 1.7, "z": 1.1}}, "xaxis_title": grid["x_label"], "yaxis_title": grid["y_label"], "zaxis_title": f"log10 {grid['z_label']}"})
    figure.update_xaxes(title=grid["x_label"])
    figure.update_yaxes(title=grid["y_label"])
    rows = [[y, *values] for y, values in zip(grid["y"], grid["values"])]
    name = f"{study.name}-{grid['name']}"
    downloads = downloads_of(study.folder, name, files, [f"{grid['y_label']} \\ {grid['x_label']}", *grid["x"]], rows)
    return Figure(name, grid["title"], "", look.plot_html(figure), downloads)


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
    found, untold = [], []
    for fit in group.conclusions["exponents"]:
        if time_span(group, fit["method"]) < LEAST_SPAN:
            continue
        if abs(fit["exponent"]) <= 2 * fit["standard_error"]:  # its interval of 95 % holds 0
            untold.append(fit["method"])
            continue
        goes = "falls" if fit["exponent"] < 0 else "grows"
        found.append(f"{fit['method']}: error {goes} as time to the power {results.shown(fit['exponent'], 2)} ± {results.shown(fit['standard_error'], 1)}.")
    if untold:
        found.append(f"{', '.join(untold)}: whether error falls with time cannot be told from these settings.")
    if knee := group.conclusions["knee"]:
        found.append(f"Knee of the front: {knee['point']}.")
    ranks = group.conclusions["rankings"]
    if unknown := ranks["pairs_not_ranked_in_time"] + ranks["pairs_not_ranked_in_error"]:
        found.append(f"Not ranked, since their intervals overlap: {ranks['pairs_not_ranked_in_time']} pairs in time and {ranks['pairs_not_ranked_in_error']} in error, of "
                     f"the points that none surely beats ({unknown} in all).")
    return found


def every_model(studies):
    """One row for each model: its lobes beside walked light and their time, its picture beside the truth's by direct evaluation and by tables. None: a study is missing."""
    by_name = {study.name: study for study in studies}
    if not {"lobes", "models"} <= by_name.keys():
        return None
    lobes = next((group for group in by_name["lobes"].groups if group.raw["name"] == "all models"), None)
    if lobes is None:
        return None
    factor, unit = results.unit_of([point.seconds["value"] for point in lobes.points if point.seconds])
    picture = {(point.method, point.knobs["evaluate"]): point for point in by_name["models"].groups[0].points}
    rows = []
    for name in dict.fromkeys([point.method for point in lobes.points] + [method for method, _ in picture]):
        best = min((point for point in lobes.points if point.method == name), key=lambda point: point.errors["S"]["mean"]["value"], default=None)
        row = [name] + ([results.shown(best.errors["S"]["mean"]["value"]), results.shown(best.errors["albedo"]["mean"]["value"]),
                         results.shown(best.seconds["value"] * factor) if best.seconds else ""] if best else ["", "", ""])
        for how in ("direct", "tables"):
            point = picture.get((name, how))
            row += [results.shown(point.error("light")["value"]), results.shown(point.seconds["value"]) if point.seconds else ""] if point else ["", ""]
        rows.append(row)
    return ["model", "S, rms error over its rms", "albedo, error", f"one S, {unit}", "picture's light, direct", "path tracing, s", "picture's light, tables", "path tracing, s"], rows


def strip_of(study, group):
    """A ladder's pictures beside each other, inlined."""
    if drawer_of(group) is not ladder:
        return []
    return [(page.Picture(study.folder / file).data_uri, *words) for file, *words in ladder.strip(study, group)]


def section_of(study, everything=None):
    means = flip.measure(study)
    groups = []
    for group in study.groups:
        drawer = drawer_of(group)
        if drawer is ladder:
            group.flips = ladder.flips(study, group, means)
        said = {ladder: lambda _: [], states: states.sentences, growth: growth.sentences, pareto: sentences}[drawer](group)
        groups.append({"group": group, "figure": group_figure(study, group) if drawer is states or len(group.drawable()) > 1 else None, "table": table_of(study, group),
                       "conclusions": growth.table(study, group) if drawer is growth else conclusions(study, group) if group.drawable() and drawer is pareto else None, "sentences": said, "strip": strip_of(study, group), "identity": findings.group_id(study, group)})
    curved, grids = knobs.plots(study) + growth.plots(study) + [plot for plot in study.raw["plots"] if plot["curves"]], study.raw.get("grids", [])
    for plot in curved:
        check(study, plot)
    printed = printed_curves.all_of(curved, grids)
    plots = [curve_figure(study, plot, next(printed)) for plot in curved] + [grid_figure(study, grid, next(printed)) for grid in grids]
    plots.sort(key=lambda drawn: not drawn.identity.endswith("-albedo"))
    return {"study": study, "groups": groups, "plots": plots, "views": views(study, means), "every_model": everything if study.name == "models" else None}


def make(folder):
    """Writes folder/index.html from the results in it or in its folders."""
    studies = results.load_all(folder)
    if not studies:
        raise ReportError(f"{folder}: holds no result.json, nor does a folder in it")
    everything = every_model(studies)
    ordered = sorted(studies, key=lambda study: (findings.ORDER.index(study.name) if study.name in findings.ORDER else 99, study.name))
    sections = processes.mapped(section_of, ordered, [everything] * len(ordered))
    thumbnails = {figure.identity: figure.thumbnail for section in sections for figure in [*(part["figure"] for part in section["groups"] if part["figure"]), *section["plots"]]}
    environment = jinja2.Environment(loader=jinja2.PackageLoader(__package__), autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True)
    title = studies[0].raw["title"] if len(studies) == 1 else "What accuracy costs in time: hair, from its fibres to the final picture"
    strips = [(part["strip"], part["identity"]) for section in sections for part in section["groups"] if part["strip"]]
    text = environment.get_template("report.html.j2").render(
        title=title, sections=sections, findings=findings.find(studies), machine=studies[0].times["machine"], clock=studies[0].times,
        scripts=[plotly.offline.get_plotlyjs(), (HERE / "vendor/img-comparison-slider/index.js").read_text(encoding="utf-8")],
        own_script=page.own_script(), thumbnails=thumbnails, first_strip=strips[0] if strips else None, most_plots=MOST_PLOTS, shown=results.shown)
    page.write(folder / "index.html", text)
