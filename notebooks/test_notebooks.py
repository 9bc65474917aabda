"""Every notebook runs from top to bottom, quickly, and leaves its figures."""
import os
import pathlib
import re
import time

import jupytext
import matplotlib
import nbclient
import numpy
import pytest
from matplotlib import image, pyplot

matplotlib.use("agg")
HERE = pathlib.Path(__file__).parent
FIGURES = {"01_lobes": ["longitudinal", "azimuthal", "caustic", "polar", "models_longitudinal", "models_azimuthal"], "02_as_published_and_corrected": ["energy", "absorption"],
           "03_energy_and_reciprocity": ["energy", "reciprocity", "suspects"], "04_tables": ["tables", "error"], "05_opacity_maps": ["counts", "points"],
           "06_ladder": ["pictures", "ladder"], "07_strand_truth": ["truths", "elastica", "stretch"], "08_head_turn": ["turn", "above"],
           "09_four_ways": ["pictures", "against_reference"], "10_fit_a_lobe": ["fit", "intervals"], "11_plan": ["passes", "cost"],
           "12_gradients": ["fibre", "recovery"], "13_skinning": ["skinning"]}


def test_Notebooks_All_AreListedHere():
    readme = (HERE / "README.md").read_text()
    assert {path.stem for path in HERE.glob("[0-9]*.py")} == set(FIGURES) == set(re.findall(r"\((\w+)\.py\)", readme))


@pytest.mark.parametrize("name", FIGURES)
def test_Notebook_ItsText_StartsNoProgram(name):
    assert not re.search(r"subprocess|os\.system|^!", (HERE / f"{name}.py").read_text(), re.M)


def test_Notebook_InAKernel_RunsAsAnotherDoes(tmp_path, monkeypatch):
    """One of them by Jupyter itself; the others cell after cell in this process, which starts no kernel for each."""
    monkeypatch.setenv("CUTICLE_FIGURES", str(tmp_path))
    monkeypatch.setenv("MPLBACKEND", "agg")
    nbclient.NotebookClient(jupytext.read(HERE / "13_skinning.py"), timeout=120, kernel_name="python3", resources={"metadata": {"path": str(tmp_path)}}).execute()
    assert [path.stem for path in tmp_path.glob("*.png")] == ["skinning"]


@pytest.mark.parametrize("name", FIGURES)
def test_Notebook_FromTopToBottom_RunsAndLeavesItsFigures(name, tmp_path, monkeypatch):
    monkeypatch.setenv("CUTICLE_FIGURES", str(tmp_path))
    monkeypatch.chdir(tmp_path)
    started, names = time.process_time(), {"__name__": "__main__"}
    for number, cell in enumerate(jupytext.read(HERE / f"{name}.py").cells):
        if cell.cell_type == "code":
            exec(compile(cell.source, f"{name}.py, cell {number}", "exec"), names)
    pyplot.close("all")
    print(f"{name}: {time.process_time() - started:.1f} s of processor time", os.environ.get("CUTICLE_PROGRAM", ""))
    assert sorted(path.stem for path in tmp_path.glob("*.png")) == sorted(FIGURES[name])
    for path in tmp_path.glob("*.png"):
        pixels = image.imread(path)[..., :3]
        edges = numpy.concatenate([pixels[0], pixels[-1], pixels[:, 0], pixels[:, -1]])
        assert edges.min() == 1.0, f"{path.name}: something is cut off"
        assert pixels.std() > 0.05, f"{path.name}: empty"
