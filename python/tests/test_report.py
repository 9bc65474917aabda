"""The pages: self-contained, drawn by a browser without errors, and clear about data that are missing."""
import base64
import contextlib
import io
import json
import pathlib
import re
import runpy
import shutil
import subprocess
import sys
import types
import unittest.mock

import numpy
import pytest
from matplotlib import image

PACKAGE = pathlib.Path(__file__).resolve().parents[1]
PIXEL = base64.b64decode("iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8DwHwAFBQIAX8jx0gAAAABJRU5ErkJggg==")
CONSOLE = """<script>
window.addEventListener("error", e => document.documentElement.dataset.errors = (document.documentElement.dataset.errors || "") + e.message);
const report = console.error; console.error = (...a) => { document.documentElement.dataset.errors = a.join(" "); report(...a); };
</script>"""


def report(*arguments):
    """`python -m cuticle_report`, in this process: the plotting packages are loaded once."""
    said = io.StringIO()
    with contextlib.redirect_stderr(said), unittest.mock.patch.object(sys, "argv", ["cuticle_report", *map(str, arguments)]), \
         unittest.mock.patch.object(sys, "path", [str(PACKAGE), *sys.path]):
        with pytest.raises(SystemExit) as end:
            runpy.run_module("cuticle_report", run_name="__main__")
    return types.SimpleNamespace(returncode=end.value.code, stderr=said.getvalue())


def study_of(rows=None):
    if rows is None:
        rows = [{"method": "opacity_map", "settings": f"slices={n},resolution={r}", "slices": n, "resolution": r,
                 "mean_error": 0.2 / n + 2 / r, "p95_error": 0.6 / n, "max_error": 1.5 / n, "bias": -0.01, "build_ms": 0.5 * n + r / 64,
                 "lookup_ms": 0.1, "total_ms": 0.5 * n + r / 64 + 0.1, "bytes": n * r * r * 4, "device": "a device"}
                for r in (128, 256) for n in (4, 8, 16, 32)]
    return {"name": "shadows", "title": "Opacity-map slices against ray-traced truth", "x": {"key": "total_ms", "label": "build + lookup, ms", "scale": "log"},
            "y": {"key": "mean_error", "label": "mean |error| of transmittance", "scale": "log"}, "series": "resolution", "label": "slices",
            "groom": {"name": "coat", "strands": 5000, "vertices": 80000, "spacing_m": 0.0012}, "alpha": 0.3, "to_light": [0, 1, 0],
            "footprint_m": 0.0024, "truth": {"rays": 1024, "receivers": 400, "counted": 230, "mean_standard_error": 0.004, "ms": 900, "device": "Embree"},
            "device": "a device", "rows": rows,
            "baselines": [{"method": "none", "mean_error": 0.5, "p95_error": 0.9, "max_error": 0.95, "bias": 0.5},
                          {"method": "best constant", "mean_error": 0.21, "p95_error": 0.4, "max_error": 0.5, "bias": 0.0, "value": 0.4}]}


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    folder = tmp_path_factory.mktemp("study")
    (folder / "study.json").write_text(json.dumps(study_of()))
    done = report(folder)
    assert done.returncode == 0, done.stderr
    return folder


def browse(page, *flags):
    """What Chromium gives for a page opened from disk, without any network."""
    program = shutil.which("chromium")
    assert program, "chromium is in scripts/packages.txt"
    profile = page.parent / "profile"
    command = [program, "--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking", f"--user-data-dir={profile}",
               "--host-resolver-rules=MAP * ~NOTFOUND", "--window-size=1200,1800", "--virtual-time-budget=30000", *flags, page.as_uri()]
    return subprocess.run(command, capture_output=True, text=True, timeout=120).stdout


def test_StudyPage_InABrowser_ShowsItsPlotsWithoutErrors(study):
    watched = study / "watched.html"
    watched.write_text((study / "index.html").read_text().replace("<head>", "<head>" + CONSOLE, 1))
    page = browse(watched, "--dump-dom")
    assert "data-errors" not in page.split(">", 2)[1], page.split(">", 2)[1]
    drawn = page.split("</script>")[-1] if page.count("main-svg") == 0 else page
    assert drawn.count('class="main-svg"') >= 2, "plotly has drawn"
    assert len(re.findall(r'class="scatterlayer', drawn)) == 2
    for text in ("mean |error| of transmittance", "build + lookup at every vertex, ms", "best constant", "opacity_map, resolution 256"):
        assert text in drawn


def test_StudyPage_Screenshot_HasTheCurvesColours(study):
    browse(study / "index.html", f"--screenshot={study / 'page.png'}")
    pixels = image.imread(study / "page.png")[..., :3]
    for color in ((0x1F, 0x5F, 0xA8), (0xD9, 0x73, 0x0D)):
        assert (numpy.abs(pixels - numpy.array(color) / 255).max(axis=2) < 0.05).sum() > 100


def test_StudyPage_File_AsksForNothingElse(study):
    html = (study / "index.html").read_text()
    assert not re.search(r'<(script|img|link|iframe)[^>]*(src|href)="(?!data:)', html)
    assert "Plotly" in html


def test_StudyPlots_Png_HaveAFrameOfWhiteAroundEverything(study):
    for name in ("error_against_time.png", "error_against_slices.png"):
        pixels = image.imread(study / name)[..., :3]
        assert pixels.shape[1] >= 900
        assert min(pixels[0].min(), pixels[-1].min(), pixels[:, 0].min(), pixels[:, -1].min()) == 1.0, "nothing is cut off"
        assert pixels.min() < 0.3


def test_StudyPage_WithARequestAndReceivers_HasTheChoiceInBoldAndTheHair(tmp_path):
    raw = study_of()
    for row in raw["rows"]:
        row["resolution"] *= 1 + row["slices"]  # more curves than one figure shows
    raw["rows"] = [row | {"resolution": row["resolution"] + k} for k in range(4) for row in raw["rows"]]
    raw |= {"pareto": True, "choice": raw["rows"][5], "request": {"max_error": 0.02, "budget_ms": 0}, "verdict": "opacity_map slices=8: mean error 0.02"}
    (tmp_path / "study.json").write_text(json.dumps(raw))
    points = numpy.random.default_rng(1).random((200, 3))
    lines = [f"{x},{y},{z},{t},0.01,{t / 2}" for (x, y, z), t in zip(points, points[:, 0])]
    (tmp_path / "receivers.csv").write_text("\n".join(["x,y,z,truth,standard_error,opacity_map slices=8;resolution=128", *lines]) + "\n")
    assert report(tmp_path).returncode == 0
    html = (tmp_path / "index.html").read_text()
    assert html.count('<tr class="chosen">') == 1
    assert "<strong>opacity_map slices=8: mean error 0.02</strong>" in html and "a mean error of at most 0.02" in html
    assert "On the hair" in html and image.imread(tmp_path / "hair.png").shape[1] > 800
    assert "opacity_map, resolution" not in html.split("Plotly")[-1]
    assert (tmp_path / "error_against_time.pdf").read_bytes().startswith(b"%PDF")


def test_DemoPage_Sections_AreShownWithPicturesInside(tmp_path):
    (tmp_path / "a.png").write_bytes(PIXEL)
    (tmp_path / "demo.json").write_text(json.dumps({"title": "Demo <b>", "sections": [
        {"title": "Frames", "text": "One.\n\nTwo.", "images": [{"file": "a.png", "caption": "all frames"}]},
        {"title": "Plan", "table": {"columns": ["pass", "ms"], "rows": [["simulate", 1.5], ["shade", "2"]]}}]}))
    assert report("--demo", tmp_path).returncode == 0
    html = (tmp_path / "index.html").read_text()
    assert "Demo &lt;b&gt;" in html and "<p>Two.</p>" in html and "<td>simulate</td>" in html
    assert "data:image/png;base64," + base64.b64encode(PIXEL).decode() in html


def test_DemoPage_ErrorsAboveTheirLimits_AreNamedFirst(tmp_path):
    rows = [["S", "0.004", "0.01", "tables"], ["coverage", "0.03", "0.02", "tiles"], ["light", "not measured", "0.03", "no light"]]
    (tmp_path / "demo.json").write_text(json.dumps({"title": "Demo", "sections": [
        {"title": "Frames"}, {"title": "How exact", "table": {"columns": ["what", "error", "limit", "how"], "rows": rows}}]}))
    assert report("--demo", tmp_path).returncode == 0
    html = (tmp_path / "index.html").read_text()
    assert "1 of 3 errors of these frames are within the limits; above them: coverage; light." in html.split('id="section-2"')[0]


def test_DemoPage_WithAStudy_ShowsItsPlots(study, tmp_path):
    (tmp_path / "study").mkdir()
    (tmp_path / "study" / "study.json").write_text(json.dumps(study_of()))
    (tmp_path / "demo.json").write_text(json.dumps({"title": "Demo", "sections": []}))
    assert report("--demo", tmp_path).returncode == 0
    assert "Opacity-map slices" in (tmp_path / "index.html").read_text()
    assert (tmp_path / "study" / "error_against_time.png").exists()


@pytest.mark.parametrize("mode, name, content, words", [
    ([], "study.json", None, ["result.json"]),
    ([], "study.json", "{", ["study.json", "JSON"]),
    ([], "study.json", json.dumps({"title": "a"}), ["study.json", "'x'"]),
    ([], "study.json", json.dumps(study_of(rows=[])), ["study.json", "rows"]),
    ([], "study.json", json.dumps(study_of(rows=[{"method": "a", "mean_error": 1}])), ["row 0", "total_ms"]),
    ([], "receivers.csv", "x,y,z\n1,2,3\n", ["receivers.csv"]),
    ([], "receivers.csv", "x,y,z,truth,standard_error,a\n1,2,3,4,5,b\n", ["receivers.csv"]),
    (["--demo"], "demo.json", json.dumps({"sections": []}), ["demo.json", "title"]),
    (["--demo"], "demo.json", json.dumps({"title": "", "sections": [{"title": "a", "images": [{"file": "no.png"}]}]}), ["no.png"]),
    (["--demo"], "demo.json", json.dumps({"title": "", "sections": [{"title": "a", "table": {"columns": ["b"], "rows": [[1, 2]]}}]}), ["rows[0]"]),
])
def test_Report_BadData_SaysWhereAndLeavesNoPage(tmp_path, mode, name, content, words):
    if content is not None:
        if name == "receivers.csv":
            (tmp_path / "study.json").write_text(json.dumps(study_of()))
        (tmp_path / name).write_text(content)
    done = report(*mode, tmp_path)
    assert done.returncode == 3
    for word in words:
        assert word in done.stderr
    assert not (tmp_path / "index.html").exists()


def test_Page_LongSettings_AreATableOfParameters():
    row = ["chiang", "eta=1.55,sigma_a=0.1257/0.2091/0.411,beta_m=0.3"]
    from cuticle_report import page
    text = page.render("t", [page.Section("s", columns=["model", "settings"], rows=[row, ["none", "slices=4,resolution=64"]])])
    assert "3 parameters" in text and "<td>sigma_a</td><td>0.1257/0.2091/0.411</td>" in text and "slices=4,resolution=64" in text


def along_resolution(errors):
    """A study of what a camera sees: a method of four errors for four resolutions each."""
    raw = study_of([{"method": method, "settings": f"resolution={n}" + (f",{more}" if more else ""), "resolution": n, "mean_error": error, "mean_interval": 0.01,
                     "total_ms": 1.0, "bytes": n * n} for (method, more), curve in errors.items() for n, error in zip((128, 256, 512, 1024), curve)])
    return raw | {"x": {"key": "resolution", "label": "resolution", "scale": "log"}, "series": "layers", "label": "layers"}


def test_ShadowPage_AlongResolution_SaysFirstWhatFinerMapsBring(tmp_path):
    errors = {("deep_opacity", ""): (0.08, 0.06, 0.04, 0.02), ("opacity_map", ""): (0.6, 0.61, 0.65, 0.7)}
    errors |= {("moments", f"basis=power_{k}"): (0.3 + k / 100, 0.2, 0.15, 0.1) for k in range(6)}
    (tmp_path / "study.json").write_text(json.dumps(along_resolution(errors)))
    assert report(tmp_path).returncode == 0
    html = (tmp_path / "index.html").read_text()
    said = re.search(r"<strong>(.*?)</strong>", html).group(1)
    assert "falls at every step of resolution for 7 of 8 settings" in said and "deep_opacity: 0.08 at 128, 0.02 at 1024" in said
    assert "rises by more than its intervals: opacity_map from 256 to 512 (0.61 to 0.65); opacity_map from 512 to 1024 (0.65 to 0.7)" in said
    assert "Worse than no shadow at all even there: opacity_map." in said
    assert "In the table alone, since a figure has six curves at most: moments, basis=power_4; moments, basis=power_5." in html


def test_Study_WithDistancesToTheOccluder_DrawsTheErrorNearIt(tmp_path):
    rows = [{"method": "opacity_map", "settings": f"resolution={n}", "resolution": n, "mean_error": 8 / n, "total_ms": 1.0} for n in (128, 256)]
    (tmp_path / "study.json").write_text(json.dumps({"title": "T", "x": {"key": "resolution", "label": "r", "scale": "log"}, "y": {"key": "mean_error", "label": "e", "scale": "log"},
                                                     "series": "layers", "label": "layers", "rows": rows, "baselines": []}))
    (tmp_path / "contact.csv").write_text("method,settings,from_mm,to_mm,receivers,mean_error,mean_interval,bias\n"
                                          "opacity_map,resolution=256,0,0.5,40,0.3,0.02,0\nopacity_map,resolution=256,0.5,inf,3,0.9,0.02,0\n")
    assert report(tmp_path).returncode == 0
    html = (tmp_path / "index.html").read_text(encoding="utf-8")
    assert "Near the occluder" in html and "0 to 0.5<br>(40)" in html.replace("\\u003c", "<").replace("\\u003e", ">").replace("\\/", "/")
    assert "over 0.5" not in html, "a mean of three points is not drawn"
