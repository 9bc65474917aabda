"""The page and figures of `cuticle shadows`, from study.json (study/README.md)."""
import dataclasses
import pathlib

from . import ReportError, contact, data, figures, look, page, pareto, receivers, results

COLUMNS = ["method", "settings", "mean_error", "mean_interval", "p95_error", "max_error", "bias", "light_flicker", "motion_flicker", "build_ms",
           "lookup_ms", "total_ms", "bytes"]

COMPARED = ("opacity_map", "deep_opacity")  # what every page of shadows shows beside the best
MOST_CURVES = 16  # of a figure along time
LONG_SETTINGS = 60  # characters


@dataclasses.dataclass
class Axis:
    key: str
    label: str
    scale: str = "linear"


@dataclasses.dataclass
class Study:
    raw: dict
    x: Axis
    y: Axis

    @property
    def title(self):
        return self.raw["title"]

    @property
    def point_label(self):
        return self.raw["label"]

    @property
    def baselines(self):
        return [(row["method"], row[self.y.key]) for row in self.raw["baselines"]]

    def drawn_rows(self):
        """All but those without error, which a logarithmic axis has no place for: a reference beside itself."""
        return [row for row in self.raw["rows"] if row[self.y.key] > 0 or self.y.scale != "log"]

    def by_resolution(self):
        return self.x.key == "resolution"

    def curves(self):
        """Name of each curve that is drawn and its rows; along a resolution six at most: of COMPARED, then the best of each method."""
        every = self.every_curve()
        if not self.by_resolution() or len(every) <= look.MOST_CURVES:
            return every
        by_error = sorted(every, key=lambda name: min(row[self.y.key] for row in every[name]))
        best = {every[name][0]["method"]: name for name in reversed(by_error)}.values()
        kept = sorted(best, key=lambda name: (every[name][0]["method"] not in COMPARED, by_error.index(name)))
        kept = [*kept, *(name for name in every if name not in best)][:look.MOST_CURVES]
        return {name: every[name] for name in every if name in kept}

    def every_curve(self):
        """Name of each curve and its rows, in the order of the column that labels the points."""
        series, named = self.raw["series"], {}
        for row in self.drawn_rows():
            name = f"{row['method']}, {series} {row[series]}" if series in row else self.named_by_settings(row)
            named.setdefault(name, []).append(row)
        if self.raw.get("pareto") and len(named) > MOST_CURVES:  # then the front of each method
            methods = dict.fromkeys(row["method"] for row in self.raw["rows"])
            return {name: dataclasses.replace(self, raw={"rows": [row for row in self.raw["rows"] if row["method"] == name]}).front()
                    for name in methods}
        key = self.point_label if self.has_numeric_labels() else self.x.key
        return {name: sorted(rows, key=lambda row: row.get(key, 0)) for name, rows in named.items()}

    def named_by_settings(self, row):
        """The method, with what else tells its curves apart where one is drawn along a setting."""
        swept = [part for part in row.get("settings", "").split(",") if part and not part.startswith(f"{self.x.key}=")]
        return ", ".join([row["method"], *swept]) if self.by_resolution() else row["method"]

    def front(self):
        """Rows that no other passes in both axes, by x."""
        best, rows = float("inf"), []
        for row in sorted(self.raw["rows"], key=lambda row: (row[self.x.key], row[self.y.key])):
            if row[self.y.key] < best:
                best = row[self.y.key]
                rows.append(row)
        return rows

    def has_numeric_labels(self):
        return not any(isinstance(row.get(self.point_label), str) for row in self.raw["rows"])

    def label_axis(self):
        return Axis(self.point_label, self.point_label, "log")


def load(path):
    """The study in a JSON file, checked as far as the figures need it."""
    raw = data.read_json(path)
    for key in ("title", "x", "y", "series", "label", "rows", "baselines"):
        if key not in raw:
            raise ReportError(f"{path}: key '{key}' is missing")
    if not raw["rows"]:
        raise ReportError(f"{path}: 'rows' is empty")
    study = Study(raw, Axis(**raw["x"]), Axis(**raw["y"]))
    named = {row["method"] for row in raw["baselines"] if "method" in row}  # `none` has no resolution, and stands there
    raw["rows"] = [row for row in raw["rows"] if study.x.key in row or row.get("method") not in named] or raw["rows"]
    for i, row in enumerate(raw["rows"] + raw["baselines"]):
        wanted = (study.y.key,) if i >= len(raw["rows"]) else (study.x.key, study.y.key, "method")
        for key in wanted:
            if key not in row:
                raise ReportError(f"{path}: row {i}: key '{key}' is missing")
    return study


def words(study):
    """What was measured, in sentences."""
    raw, parts = study.raw, []
    if groom := raw.get("groom"):
        place = f"averaged over a disc of radius {1e3 * raw['footprint_m']:.3g} mm" if raw["footprint_m"] else "that of single points"
        parts.append(f"Hair: {groom['name']}, {groom['strands']} strands, {groom['vertices']} vertices, strand spacing "
                     f"{1e3 * groom['spacing_m']:.3g} mm. One crossing takes {100 * raw['alpha']:.3g} % of the light; transmittance is {place}.")
    if truth := raw.get("truth"):
        of = "all of them" if truth["counted"] == truth["receivers"] else f"the {truth['counted']} with 0.05 < T < 0.95"
        parts.append(f"Truth: {'a ray' if truth['rays'] == 1 else str(truth['rays']) + ' rays'} at each of {truth['receivers']} receivers ({truth['ms']:.0f} ms); errors are over "
                     f"{of}, where the truth's own standard error is {truth['mean_standard_error']:.2g}. "
                     f"Settings are chosen on one half of them, and errors are those of the other half, with 95 % intervals.")
    if raw["baselines"]:
        parts.append("Without any shadow method, by a constant T: " + ", ".join(f"{name} {value:.3g}" for name, value in study.baselines) + ".")
    if raw.get("device"):
        parts.append(f"Times are wall clock on {raw['device']}.")
    if refused := raw.get("refused"):
        parts.append("\n\nRefused: " + "; ".join(f"{row['method']} {row['settings']}: {row['why']}" for row in refused) + ".")
    return " ".join(parts)


def knobs(settings):
    return dict(part.split("=", 1) for part in settings.split(",") if "=" in part)


def point_of(row, key):
    """A row as a point of the study engine's results; its time has no interval, it was taken once."""
    half = row.get("mean_interval", 0)
    mean = {"value": row[key], "low": max(0, row[key] - half), "high": row[key] + half}
    seconds = {edge: row["total_ms"] / 1e3 for edge in ("value", "low", "high")}
    settings = row.get("settings", "")
    return results.Point(f"{row['method']} {settings}", row["method"], knobs(settings), {key: {"metric": key, "mean": mean}}, row.get("bytes", 0), seconds, 1)


def group_of(study):
    """The rows as a group of the study engine, so that error against time looks as on every other page."""
    key, front = study.y.key, study.front()
    raw = {"name": study.raw.get("name", ""), "title": study.title, "metrics": [{"name": key, "label": study.y.label}]}
    points = [point_of(row, key) for row in study.raw["rows"]]
    on_front = [point.name for point, row in zip(points, study.raw["rows"]) if row in front]
    return results.Group(raw, points, {"front": [{"point": name, "on_front": True} for name in on_front]})


def against_time(study, folder):
    """The main figure; its PDF, SVG and PNG are written."""
    group, label = group_of(study), "build + lookup at every vertex"
    for kind, content in pareto.printed(group, label).items():
        (folder / f"error_against_time.{kind}").write_bytes(content)
    return pareto.interactive(group, label)


def rounded(value):
    return float(f"{value:.4g}") if isinstance(value, float) else value


def table(study):
    """Columns that any row has, the rows, baselines first, and the number of the chosen one, -1 for none."""
    rows, choice = study.raw["baselines"] + study.raw["rows"], study.raw.get("choice")
    columns = [column for column in COLUMNS if any(column in row for row in rows)]
    if max(len(row.get("settings", "")) for row in rows) > LONG_SETTINGS:  # they would push the numbers out of sight
        columns.sort(key=lambda column: column == "settings")
    return columns, [[rounded(row.get(column, "")) for column in columns] for row in rows], rows.index(choice) if choice in rows else -1


def verdict(study):
    """The cheapest setting within what was asked for, or why there is none."""
    asked, found = study.raw.get("request", {}), study.raw.get("verdict")
    if not found or not (asked.get("max_error") or asked.get("budget_ms")):
        return []
    limits = [f"a mean error of at most {asked['max_error']:g}"] if asked.get("max_error") else []
    limits += [f"at most {asked['budget_ms']:g} ms"] if asked.get("budget_ms") else []
    return [page.Section("Asked for: " + " and ".join(limits), strong=found)]


def rises(rows, key):
    """Pairs of neighbours of a curve whose error grows by more than both half widths of their intervals."""
    return [(a, b) for a, b in zip(rows, rows[1:]) if b[key] - a[key] > a.get("mean_interval", 0) + b.get("mean_interval", 0)]


def along_resolution(study):
    """What more texels bring, in sentences: of the curves with several resolutions."""
    key, x = study.y.key, study.x.key
    curves = {name: rows for name, rows in study.every_curve().items() if len(rows) > 1}
    if not curves:
        return ""
    best = min(curves, key=lambda name: curves[name][-1][key])
    first, last = curves[best][0], curves[best][-1]
    falls = sum(all(b[key] < a[key] for a, b in zip(rows, rows[1:])) for rows in curves.values())
    found = f"Finer maps: the error falls at every step of resolution for {falls} of {len(curves)} settings. The least at the finest maps is " \
            f"{best}: {first[key]:.3g} at {first[x]}, {last[key]:.3g} at {last[x]}."
    worse = [f"{name} from {a[x]} to {b[x]} ({a[key]:.3g} to {b[key]:.3g})" for name, rows in curves.items() for a, b in rises(rows, key)]
    found += " It rises by more than its intervals: " + "; ".join(worse) + "." if worse else " No setting's error rises by more than its intervals."
    floors = [name for name, rows in curves.items() if rows[-1][key] > dict(study.baselines).get("none", float("inf"))]
    return found + (" Worse than no shadow at all even there: " + "; ".join(floors) + "." if floors else "")


def left_out(study):
    """The curves that the figure has no colour for."""
    names = [name for name in study.every_curve() if name not in study.curves()]
    return f" In the table alone, since a figure has six curves at most: {'; '.join(names)}." if study.by_resolution() and names else ""


def make(folder):
    """Writes the plots and index.html into the folder; returns the title and the sections."""
    folder = pathlib.Path(folder)
    study = load(folder / "study.json")
    by_resolution = study.by_resolution()
    axes = [study.x] * by_resolution + [study.label_axis()] * study.has_numeric_labels()
    axes = [axis for axis in axes if all(axis.key in row for row in study.raw["rows"])]
    for axis in axes:
        figures.save_png(study, axis, folder / f"error_against_{axis.key}.png")
    drawn = [] if by_resolution else [against_time(study, folder)]
    drawn += [figures.interactive(study, axis) for axis in axes]
    columns, rows, chosen = table(study)
    heading = "Error against resolution and settings" if by_resolution else "Error against time and settings"
    sections = verdict(study) + [page.Section(heading, words(study) + left_out(study), figures=drawn, strong=along_resolution(study) if by_resolution else ""),
                page.Section("Numbers", "", columns=columns, rows=rows, bold_row=chosen)]
    sections += contact.sections(study, folder) + receivers.sections(study.raw, folder)
    page.write(folder / "index.html", page.render(study.title, sections))
    return study.title, sections
