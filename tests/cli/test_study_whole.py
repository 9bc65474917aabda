"""`cuticle study all --quick`: the whole, and its page in a browser."""
import base64
import json
import re
import shutil
import subprocess

import pytest

from program import run

STUDIES = ("growth", "lobes", "luts", "measured", "mechanics", "models", "motion", "picture", "plan", "render", "shadows", "skinning")
# Errors of the console, and what a person would do: every plot drawn and its coloured pixels counted without letters, a table sorted, a slider moved, views chosen, downloads counted.
WATCH = """<script>
const errors = []; window.addEventListener("error", e => errors.push(e.message));
const say = console.error; console.error = (...a) => { errors.push(a.join(" ")); say(...a); };
async function colouredPixels(plot) {
  const drawn = plot.querySelector("svg.main-svg").cloneNode(true);
  for (const letters of drawn.querySelectorAll("text, .infolayer")) letters.remove();
  const picture = new Image(); picture.src = "data:image/svg+xml;charset=utf-8," + encodeURIComponent(new XMLSerializer().serializeToString(drawn));
  await picture.decode();
  const canvas = document.createElement("canvas"); canvas.width = 400; canvas.height = 200;
  const paper = canvas.getContext("2d"); paper.drawImage(picture, 0, 0, 400, 200);
  const values = paper.getImageData(0, 0, 400, 200).data;
  let count = 0;
  for (let k = 0; k < values.length; k += 4) count += values[k + 3] > 60 && Math.max(...values.slice(k, k + 3)) - Math.min(...values.slice(k, k + 3)) > 40;
  return count;
}
window.addEventListener("load", () => setTimeout(async () => {
  drawAll(); await new Promise(r => setTimeout(r, 3000));
  const seen = {plots: {}};
  seen.figures = document.querySelectorAll("figure .plot").length;
  for (const plot of document.querySelectorAll(".plot")) seen.plots[plot.closest("figure").id] = plot.classList.contains("js-plotly-plot") ? await colouredPixels(plot) : -1;
  const sort = document.querySelector("table th button"); sort.click(); seen.sorted = sort.closest("th").getAttribute("aria-sort") === "ascending";
  const slider = document.querySelector("img-comparison-slider"); slider.value = 25; seen.slider = slider.value;
  seen.pictures = [...document.images].every(picture => picture.complete && picture.naturalWidth > 0);
  seen.downloads = [...document.querySelectorAll("a[download]")].filter(link => link.href.startsWith("data:")).length;
  seen.links = [...document.querySelectorAll("a[href^='#']")].filter(link => link.hash.length > 1 && !document.getElementById(decodeURIComponent(link.hash.slice(1)))).map(link => link.hash);
  seen.findings = document.querySelectorAll("ol.findings li").length;
  seen.steps = document.querySelectorAll("h1 ~ .strip:first-of-type img").length;
  seen.errors = errors;
  document.documentElement.dataset.seen = btoa(unescape(encodeURIComponent(JSON.stringify(seen))));
}, 3000)); </script>"""


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    folder = tmp_path_factory.mktemp("whole")
    done = run("study", "all", "--quick", "--out", folder, timeout=3000)
    assert done.returncode == 0, done.stderr
    return folder


def test_StudyAll_Quick_EndsWithEveryStudyOnOnePage(whole):
    page = (whole / "index.html").read_text()
    for name in STUDIES:
        assert json.loads((whole / name / "conclusions.json").read_text())["groups"], name
        assert f'id="{name}"' in page
    assert sorted(folder.name for folder in whole.iterdir() if folder.is_dir()) == sorted(STUDIES)


def test_Ladder_ErrorsOfTheRungs_AddUpToTheTotalWithTheRemainder(whole):
    tables = json.loads((whole / "picture" / "result.json").read_text())["tables"]
    assert [table["name"] for table in tables] == ["ladder_blond", "ladder_curls", "ladder_fur"]
    for table in tables:
        rows = {row[0]: row for row in table["rows"]}
        added = [float(row[2]) for row in table["rows"][1:-4]]
        total, total_of_steps, remainder = float(rows["total"][3]), float(rows["sum of what they add"][2]), float(rows["remainder"][2])
        assert len(added) >= 9 and abs(sum(added) - total_of_steps) < 2e-3 * sum(map(abs, added))
        assert abs(total - total_of_steps - remainder) < 2e-3 * max(map(abs, (total, total_of_steps, remainder)))
        assert total > 0 and float(re.search(r"-?\d[\d.e-]*$", rows["remainder"][1])[0]) == pytest.approx(remainder, rel=2e-3, abs=1e-6)


def test_StudyAllPage_InABrowser_DrawsEveryPlotWithoutErrors(whole):
    watched = whole / "watched.html"
    watched.write_text((whole / "index.html").read_text().replace("<head>", "<head>" + WATCH, 1))
    command = [shutil.which("chromium"), "--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking", f"--user-data-dir={whole / 'profile'}",
               "--host-resolver-rules=MAP * ~NOTFOUND", "--window-size=1200,1800", "--virtual-time-budget=120000", "--dump-dom", watched.as_uri()]
    dom = subprocess.run(command, capture_output=True, text=True, timeout=1200).stdout
    seen = json.loads(base64.b64decode(re.search(r'data-seen="([^"]*)"', dom)[1]))
    assert seen["errors"] == [] and seen["links"] == []
    assert len(seen["plots"]) == seen["figures"] > 60, "each has a name of its own"
    assert {name: count for name, count in seen["plots"].items() if count < 10} == {}, "empty plots"
    assert seen["sorted"] and seen["slider"] == 25 and seen["pictures"] and seen["downloads"] == 3 * len(seen["plots"])
    assert seen["findings"] == 5 and seen["steps"] == 11
