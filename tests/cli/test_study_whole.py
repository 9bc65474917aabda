"""`cuticle study all --quick` and its page in a browser: with scripts/test.sh --full the whole, minutes of processor time, else the cheapest part that has every kind of figure."""
import base64
import json
import os
import re
import shutil
import subprocess

import pytest

from program import run

IS_WHOLE = bool(os.environ.get("CUTICLE_SWEEPS"))
STUDIES = ("lobes", "luts", "mechanics", "models", "motion", "picture", "plan", "render", "shadows", "skinning") if IS_WHOLE else ("models", "motion", "shadows", "skinning")
# Errors of the console, and what a person would do: every plot drawn, a table sorted, a slider moved, downloads counted.
WATCH = """<script>
const errors = []; window.addEventListener("error", e => errors.push(e.message));
const say = console.error; console.error = (...a) => { errors.push(a.join(" ")); say(...a); };
window.addEventListener("load", () => setTimeout(async () => {
  drawAll(); await new Promise(r => setTimeout(r, 3000));
  const seen = {plots: [...document.querySelectorAll(".js-plotly-plot")].map(plot => plot.querySelectorAll("path, canvas, image").length)};
  const sort = document.querySelector("table th button"); sort.click(); seen.sorted = sort.closest("th").getAttribute("aria-sort") === "ascending";
  const slider = document.querySelector("img-comparison-slider"); slider.value = 25; seen.slider = slider.value;
  seen.downloads = [...document.querySelectorAll("a[download]")].filter(link => link.href.startsWith("data:")).length;
  seen.links = [...document.querySelectorAll("a[href^='#']")].filter(link => link.hash.length > 1 && !document.getElementById(decodeURIComponent(link.hash.slice(1)))).map(link => link.hash);
  seen.errors = errors;
  document.documentElement.dataset.seen = btoa(unescape(encodeURIComponent(JSON.stringify(seen))));
}, 3000)); </script>"""


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    folder = tmp_path_factory.mktemp("whole")
    only = [] if IS_WHOLE else ["--only", ",".join(STUDIES)]
    done = run("study", "all", "--quick", *only, "--out", folder, timeout=3000)
    assert done.returncode == 0, done.stderr
    return folder


def test_StudyAll_Quick_EndsWithEveryStudyOnOnePage(whole):
    page = (whole / "index.html").read_text()
    for name in STUDIES:
        assert json.loads((whole / name / "conclusions.json").read_text())["groups"], name
        assert f'id="{name}"' in page


def test_StudyAllPage_InABrowser_DrawsEveryPlotWithoutErrors(whole):
    watched = whole / "watched.html"
    watched.write_text((whole / "index.html").read_text().replace("<head>", "<head>" + WATCH, 1))
    command = [shutil.which("chromium"), "--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking", f"--user-data-dir={whole / 'profile'}",
               "--host-resolver-rules=MAP * ~NOTFOUND", "--window-size=1200,1800", "--virtual-time-budget=120000", "--dump-dom", watched.as_uri()]
    dom = subprocess.run(command, capture_output=True, text=True, timeout=1200).stdout
    seen = json.loads(base64.b64decode(re.search(r'data-seen="([^"]*)"', dom)[1]))
    assert seen["errors"] == [] and seen["links"] == []
    assert len(seen["plots"]) > (30 if IS_WHOLE else 5) and min(seen["plots"]) > 3
    assert seen["sorted"] and seen["slider"] == 25 and seen["downloads"] >= 3 * len(seen["plots"])
