"""The page of the study engine's results: drawn by a browser without errors, sorted, copied, downloaded; and its findings."""
import base64
import json
import math
import pathlib
import re
import sys
import types

import numpy
import pytest
from matplotlib import image

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from cuticle_report import curves  # noqa: E402
from test_report import CONSOLE, browse, report  # noqa: E402


def test_Curves_MoreThanSix_AreSixColoursAndNamesThatDoNotTouch():
    plot = {"title": "t", "x_label": "x", "y_label": "y", "polar": False, "logarithmic": True,
            "curves": [{"name": f"curve {k}", "x": [1, 2], "y": [1, 0.1 * 1.01 ** k]} for k in range(9)]}
    figure = curves.interactive(plot)
    assert len({curve.line.color for curve in figure.data}) == 7, "six colours and grey"
    heights = sorted(340 * (note.y + 1) + note.yshift for note in figure.layout.annotations)
    assert len(heights) == 9 and all(high - low >= 13.9 for low, high in zip(heights, heights[1:]))
    assert figure.layout.showlegend is False


def interval(value, spread=0.1):
    return {"value": value, "low": value * (1 - spread), "high": value * (1 + spread)}


def point_of(method, knobs, error):
    return {"point": " ".join([method, *(f"{k}={v}" for k, v in knobs.items())]), "method": method, "knobs": knobs, "bytes": 1024.0,
            "errors": [{"metric": "S", "mean": interval(error), "median": error, "p95": 2 * error, "p99": 3 * error, "max": 4 * error, "items": 64, "choosing": error,
                        "judging": error * 1.1}]}


def study_of(name="luts", methods=("the model, arrays", "nalu exr", "nalu png8"), pictures=()):
    points = [point_of(method, {"size": str(size)}, 0.3 / size * (1 + k)) for k, method in enumerate(methods) for size in (16, 64, 256)]
    times = [{"point": point["point"], "seconds": interval(1e-7 * math.sqrt(int(point["knobs"]["size"])) * (k + 1)), "kernels": interval(1.0), "samples": 9, "calls": 4}
             for k, point in enumerate(points)]
    choice = {"point": points[0]["point"], "seconds": 1e-7, "choosing_error": 0.01, "judging_error": 0.011, "bytes": 1024.0}
    group = {"name": "marschner", "title": "marschner: tables <beside> the model", "truth": "the model in double", "item": "direction", "floor": 0,
             "metrics": [{"name": "S", "label": "rms error of S", "unit": "1", "mean": "root mean square"}], "points": points}
    machine = {"processor": "a processor", "threads": 2, "build": "Release", "version": "0.1.0", "commit": "abc", "device": "", "driver": ""}
    return {"result.json": {"name": name, "title": f"The study {name}", "question": "Which?", "command": f"cuticle study {name} --out DIR", "cost_label": "one S", "groups": [group],
                            "plots": [{"name": "N", "title": "N", "x_label": "phi", "y_label": "N", "polar": True, "logarithmic": False,
                                       "curves": [{"name": "R", "x": list(range(0, 361, 8)), "y": [1 + x % 3 for x in range(0, 361, 8)]}]}],
                            "grids": [{"name": "S", "title": "S", "x_label": "phi", "y_label": "theta", "z_label": "S", "x": [0, 1], "y": [0, 1, 2],
                                       "values": [[1, 2], [3, 0], [5, 6]]}],
                            "tables": [{"name": "rungs", "title": "Rungs", "columns": ["rung", "added"], "rows": [["b_x", "2"], ["a", "10"], ["c", "1"]]}],
                            "pictures": list(pictures), "notes": ["a note"]},
            "times.json": {"machine": machine, "clock": "processor time of the process", "kernel": "a loop", "kernel_seconds": interval(1e-3),
                           "groups": [{"name": "marschner", "points": times}]},
            "conclusions.json": {"groups": [{"front": [{"point": point["point"], "on_front": True} for point in points[:3]], "knee": choice,
                                             "cheapest_for": [{"error_at_most": 0.01, "choice": choice}, {"error_at_most": 1e-9, "choice": None}],
                                             "most_accurate_within": [], "exponents": [{"method": "nalu exr", "exponent": -2.0, "standard_error": 0.1}], "growth": [],
                                             "rankings": {"faster": [], "more_exact": [], "pairs_not_ranked_in_time": 3, "pairs_not_ranked_in_error": 1}}]}}


def write(folder, files):
    folder.mkdir(exist_ok=True)
    for name, content in files.items():
        (folder / name).write_text(json.dumps(content))


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    """Two studies, one with pictures."""
    folder = tmp_path_factory.mktemp("all")
    write(folder / "luts", study_of())
    pictures = [{"file": "truth.png", "title": "truth", "beside": ""}, {"file": "a.png", "title": "a picture", "beside": "truth.png"}, {"file": "a_error.png", "title": "", "beside": ""}]
    write(folder / "other", study_of("other", pictures=pictures))
    random = numpy.random.default_rng(1).random((32, 32, 3))
    for name, pixels in (("truth", random), ("a", numpy.clip(random + 0.2, 0, 1)), ("a_error", 0 * random)):
        image.imsave(folder / "other" / f"{name}.png", pixels)
    done = report(folder)
    assert done.returncode == 0, done.stderr
    return folder


# Clicks what a person would click, then writes down what came of it.
SCRIPT = """<script>window.addEventListener("load", () => setTimeout(async () => {
  drawAll(); await new Promise(r => setTimeout(r, 300));
  const table = document.getElementById("luts-rungs"), column = n => [...table.tBodies[0].rows].map(row => row.cells[n].textContent);
  const seen = {}, header = n => table.tHead.rows[0].cells[n].querySelector("button");
  header(1).click(); seen.up = column(1); header(1).click(); seen.down = column(1); header(0).click(); seen.words = column(0);
  for (const kind of ["csv", "latex"]) { const button = document.querySelector(`button[data-copy=${kind}][data-table=luts-rungs]`); button.click(); for (let n = 0; n < 5000 && !button.dataset.copied; n++) await new Promise(r => setTimeout(r, 20)); seen[kind] = button.dataset.copied; }
  const views = document.querySelector(".views"), flip = views.querySelector("input[value=flip]"); flip.click();
  seen.views = [...views.querySelectorAll("[data-view]")].filter(part => !part.hidden).map(part => part.dataset.view);
  const slider = document.querySelector("img-comparison-slider"); views.querySelector("input[value=slider]").click();
  const before = slider.value; slider.value = 25; seen.slider = [before, slider.value, !!slider.shadowRoot];
  seen.downloads = [...document.querySelectorAll("#luts-marschner a[download]")].map(a => a.download);
  seen.plots = [...document.querySelectorAll(".js-plotly-plot")].map(plot => plot.querySelectorAll("path").length);
  document.getElementById("theme").click(); seen.theme = document.documentElement.dataset.theme; 
  const comes = async color => { const plot = document.querySelector("#luts-marschner .plot"); for (let n = 0; n < 100 && !plot.innerHTML.includes(color); n++) await new Promise(r => setTimeout(r, 20)); return plot.innerHTML.includes(color); };
  seen.lighter = await comes("rgb(127, 176, 230)");
  window.dispatchEvent(new Event("beforeprint")); seen.printed = [document.documentElement.dataset.theme, await comes("rgb(31, 95, 168)")];
  window.dispatchEvent(new Event("afterprint"));
  seen.reached = [...document.querySelectorAll("figure, table button, input, summary, img-comparison-slider, nav a, #theme")].every(part => part.tabIndex >= 0);
  document.documentElement.dataset.seen = btoa(JSON.stringify(seen));
}, 1500));</script>"""


@pytest.fixture(scope="module")
def seen(page):
    watched = page / "watched.html"
    watched.write_text((page / "index.html").read_text().replace("<head>", "<head>" + CONSOLE, 1).replace("</body>", SCRIPT + "</body>"))
    for seconds in (30, 120, 480):  # the browser's own clock runs on while it waits for the clipboard, faster than a busy machine answers
        root = browse(watched, "--dump-dom", f"--virtual-time-budget={1000 * seconds}").split(">", 2)[1]
        assert "data-errors" not in root, root
        if found := re.search(r'data-seen="([^"]*)"', root):
            return json.loads(base64.b64decode(found[1]))
    raise AssertionError("the page's script did not come to its end")


def test_Page_InABrowser_DrawsSortsCopiesAndSlides(seen):
    assert len(seen["plots"]) == 12 and min(seen["plots"]) > 5
    assert seen["up"] == ["1", "2", "10"] and seen["down"] == ["10", "2", "1"] and seen["words"] == ["a", "b_x", "c"]
    assert seen["csv"] == "rung,added\na,10\nb_x,2\nc,1\n"
    assert "b\\_x & 2 \\\\" in seen["latex"] and "\\begin{tabular}{lr}" in seen["latex"]
    assert seen["views"] == ["flip"] and seen["slider"][1] == 25 and seen["slider"][2]
    assert seen["downloads"] == ["luts-marschner.pdf", "luts-marschner.svg", "luts-marschner.csv"]
    assert seen["theme"] == "dark" and seen["lighter"] and seen["printed"] == ["light", True]
    assert seen["reached"]  # by the keyboard


def test_Page_Screenshot_HasTheCurvesColours(page):
    browse(page / "index.html", f"--screenshot={page / 'page.png'}")
    pixels = image.imread(page / "page.png")[..., :3]
    for color in ((0x1F, 0x5F, 0xA8), (0xD9, 0x73, 0x0D)):
        assert (numpy.abs(pixels - numpy.array(color) / 255).max(axis=2) < 0.05).sum() > 100


def test_Grid_AsASurface_HidesTheAxesOfTheMap(page):
    html = (page / "index.html").read_text()
    of_buttons = re.findall(r'"visible":\[(true|false),(true|false)\]\},\{"xaxis.visible":(true|false),"yaxis.visible":(true|false)', html)
    assert ("true", "false", "true", "true") in of_buttons and ("false", "true", "false", "false") in of_buttons


def test_Page_File_AsksForNothingElse(page):
    html = (page / "index.html").read_text()
    assert not re.search(r'<(script|img|link|iframe)[^>]*(src|href)="(?!data:)', html)
    assert "tables &lt;beside&gt; the model" in html


def test_Figures_Pdf_EmbedsItsFonts(page):
    pdf = (page / "luts" / "luts-marschner.pdf").read_bytes()
    assert pdf.startswith(b"%PDF") and b"/FontFile2" in pdf
    assert "<text" not in (page / "luts" / "luts-marschner.svg").read_text(), "letters are outlines"


def test_Flip_OfAPictureBesideItself_IsZeroAndOfABrighterOneIsNot(page):
    assert 0.05 < json.loads((page / "other" / "flip.json").read_text())["a.png"] < 1
    from cuticle_report import flip
    assert flip.evaluate(page / "other" / "truth.png", page / "other" / "truth.png")[0] == 0


def test_Findings_OfTheTables_SayWhatIsFasterForCertain(page):
    html = (page / "index.html").read_text()
    assert "On a CPU, evaluating marschner itself in arrays takes" in html and "no set of tables is faster for certain" in html


def group_with(exponents):
    group = types.SimpleNamespace(raw={"name": "g"})
    group.conclusions = {"exponents": exponents, "knee": None, "rankings": {"pairs_not_ranked_in_time": 0, "pairs_not_ranked_in_error": 0}}
    group.drawable = lambda: [types.SimpleNamespace(method=fit["method"], seconds={"value": seconds}) for fit in exponents for seconds in (1, 10)]
    return group


def test_Sentences_ExponentWhoseIntervalHoldsZero_SayThatNoTrendIsTold():
    from cuticle_report import report as page_report
    fits = [{"method": "tiles", "exponent": 1.1, "standard_error": 2.0}, {"method": "quads", "exponent": -0.4, "standard_error": 0.3},
            {"method": "supersampled", "exponent": -0.9, "standard_error": 0.1}, {"method": "cards", "exponent": 0.5, "standard_error": 0.1}]
    assert page_report.sentences(group_with(fits)) == ["supersampled: error falls as time to the power -0.90 ± 0.1.", "cards: error grows as time to the power 0.50 ± 0.1.",
                                                       "tiles, quads: whether error falls with time cannot be told from these settings."]


def write_growth(tmp_path):
    files = study_of("growth", ("read", "write"))
    group = files["result.json"]["groups"][0] | {"name": "files", "metrics": []}
    for point in group["points"]:
        point["errors"], point["knobs"] = [], {"strands": point["knobs"]["size"]}
    files["result.json"] |= {"groups": [group], "plots": [], "grids": []}
    files["times.json"]["groups"][0]["name"] = "files"
    files["conclusions.json"]["groups"][0] |= {"exponents": [], "cheapest_for": [], "front": [], "knee": None,
                                               "growth": [{"method": "read", "exponent": 1.0, "standard_error": 0.01}, {"method": "write", "exponent": 1.31, "standard_error": 0.02}]}
    write(tmp_path, files)


def test_Findings_OfGrowthAlone_SayWhatTakesLongestAndGrowsFaster(tmp_path):
    write_growth(tmp_path)
    assert report(tmp_path).returncode == 0
    html = (tmp_path / "index.html").read_text()
    assert "Of the readers and writers of strand files with 256 strands, write takes longest (9.6 µs); write (power 1.31) grows faster than the number of strands." in html


def test_Findings_OfAStudyWithoutAny_HaveNoHeading(tmp_path):
    write(tmp_path, study_of("other"))
    assert report(tmp_path).returncode == 0
    assert 'id="findings"' not in (tmp_path / "index.html").read_text()


@pytest.mark.parametrize("name, content, words", [
    ("result.json", "{", ["result.json", "JSON"]),
    ("result.json", "{}", ["result.json", "'name'"]),
    ("times.json", json.dumps(study_of()["times.json"] | {"groups": []}), ["result.json", "README"]),
])
def test_Page_BadData_SaysWhereAndLeavesNoPage(tmp_path, name, content, words):
    write(tmp_path, study_of())
    (tmp_path / name).write_text(content)
    done = report(tmp_path)
    assert done.returncode == 3
    for word in words:
        assert word in done.stderr
    assert not (tmp_path / "index.html").exists()


def test_Knobs_PointsOfOneNumber_AreACurveOfEachGroup(page):
    from cuticle_report import knobs, results
    plots = knobs.plots(results.load(page / "luts"))
    assert [plot["name"] for plot in plots] == ["the-model--arrays-size", "nalu-exr-size", "nalu-png8-size"]
    assert plots[1]["curves"] == [{"name": "marschner", "x": [16.0, 64.0, 256.0], "y": [0.3 / 16 * 2, 0.3 / 64 * 2, 0.3 / 256 * 2]}]


def test_Pareto_PointsOfTwoKnobs_LieOnLinesAlongTheOneWithMostValues():
    from cuticle_report import pareto, results
    points = [results.Point(f"m layers={n} resolution={r}", "m", {"layers": str(n), "resolution": str(r)}, {}, 0) for r in (128, 256) for n in (2, 4, 8)]
    assert [[point.knobs["layers"] for point in line] for line in pareto.lines(points)] == [["2", "4", "8"], ["2", "4", "8"]]


def test_Pareto_AFrontWithoutErrors_IsLeftOutOfThePlot(page):
    from cuticle_report import pareto, results
    group = results.load(page / "luts").groups[0]
    for point in group.points:
        if point.name in group.front:
            point.errors[group.metric]["mean"]["value"] = 0
    assert group.front and not pareto.front_of(group)
    assert pareto.printed(group, "one S")["svg"] and not pareto.interactive(group, "one S").data[0].x
