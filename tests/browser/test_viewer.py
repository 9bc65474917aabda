"""`cuticle viewer`: a folder that is opened from disk, whose page bakes the tables that `cuticle bake` writes, draws the hair, and
follows its sliders."""
import pathlib
import sys

import numpy
import pytest

from browser import result_of

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
from lut_files import Tables  # noqa: E402
from program import refused, run  # noqa: E402

MODEL = ["--set", "eta=1.5,sigma_a=0.1/0.3/0.8,beta_deg=9,alpha_deg=-3"]

# The mean color of the picture's middle; then the same after each slider was moved, once the picture stands still.
DRIVE = """(async () => {
  const still = async () => { while (!document.body.dataset.still) await new Promise((go) => setTimeout(go, 20)); };
  const mean = async () => {
    await still();
    const view = document.getElementById('view'), small = document.createElement('canvas');
    small.width = small.height = 64;
    const context = small.getContext('2d');
    context.drawImage(view, view.width * .2, view.height * .15, view.width * .35, view.height * .5, 0, 0, 64, 64);
    const texels = context.getImageData(0, 0, 64, 64).data, sum = [0, 0, 0];
    for (let i = 0; i < texels.length; i += 4) for (let c = 0; c < 3; ++c) sum[c] += texels[i + c] / 4096;
    return sum;
  };
  const move = async (name, value) => {
    const slider = document.getElementById(name);
    slider.value = value;
    slider.dispatchEvent(new Event('input'));
    return mean();
  };
  const tables = [0, 1, 2].map((k) => Array.from(window.cuticleViewer.tables.read(k)));
  return { tables, strands: document.querySelector('#panel p').textContent, first: await mean(), unshadowed: await move('shadow', 0),
           dark: (await move('shadow', 1), await move('sigma_a.0', 2)) };
})()"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    work = tmp_path_factory.mktemp("viewer")
    assert run("grow", "--strands", "density=20000", "--out", work / "groom.npz").returncode == 0
    done = run("viewer", work / "groom.npz", *MODEL, "--strands", "900", "--out", work / "viewer")
    assert done.returncode == 0, done.stderr
    return work / "viewer"


@pytest.fixture(scope="module")
def seen(folder):
    return result_of(folder, "index.html?frames=3&ratio=0.5",
                     ["--ready=window.cuticleViewer", f"--result={DRIVE}", "--file", f"--screenshot={folder}/../seen.png"])


def test_Tables_BakedByThePage_AreThoseOfBake(seen, tmp_path):
    assert run("bake", *MODEL, "--layout", "nalu_theta", "--out", tmp_path).returncode == 0
    for name, found in zip(["M", "N_TT_R", "N_TRT"], seen["tables"]):
        wanted = Tables(tmp_path).values[name]
        found = numpy.reshape(found, (128, 128, 4))[..., :wanted.shape[2]]
        error = numpy.abs(found - wanted) / (numpy.abs(wanted) + 1e-3 * wanted.max())
        assert error.max() < 4e-3, name


def test_Picture_OfTheFolderFromDisk_ShowsTheHairAndFollowsTheSliders(seen):
    assert seen["strands"].startswith("900 of ")
    background = 53
    assert max(seen["first"]) > background + 10
    red, green, blue = seen["first"]
    assert red > green > blue  # absorption rises from red to blue
    assert sum(seen["unshadowed"]) > sum(seen["first"]) + 5
    assert seen["dark"][0] < red - 10


def test_Viewer_OfAModelThatThePageCannotBake_IsRefused(tmp_path):
    assert "variant=corrected" in refused(2, "viewer", "x.hair", "--set", "variant=as_published", "--out", tmp_path / "viewer")


def test_Viewer_WithoutThree_SaysHowToGetIt(tmp_path):
    assert "npm install three" in refused(3, "viewer", "x.hair", "--three", tmp_path, "--out", tmp_path / "viewer")
