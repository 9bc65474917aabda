"""Every notebook runs from top to bottom, quickly, and leaves its figures."""
import os
import pathlib
import time

import jupytext
import nbclient
import numpy
import pytest
from matplotlib import image

HERE = pathlib.Path(__file__).parent
FIGURES = {"01_lobes": ["longitudinal", "azimuthal", "caustic", "polar"], "02_literal_and_corrected": ["energy", "absorption"],
           "03_skinning": ["skinning"], "04_tables": ["tables", "error"], "05_opacity_maps": ["counts", "points"],
           "08_head_turn": ["turn", "above"], "09_four_ways": ["pictures", "against_reference"], "11_plan": ["passes", "cost"]}


def test_Notebooks_All_AreListedHere():
    assert {path.stem for path in HERE.glob("[0-9]*.py")} == set(FIGURES)


@pytest.mark.parametrize("name", FIGURES)
def test_Notebook_FromTopToBottom_RunsAndLeavesItsFigures(name, tmp_path, monkeypatch):
    monkeypatch.setenv("CUTICLE_FIGURES", str(tmp_path))
    monkeypatch.setenv("MPLBACKEND", "agg")
    started = time.monotonic()
    nbclient.NotebookClient(jupytext.read(HERE / f"{name}.py"), timeout=120, kernel_name="python3", resources={"metadata": {"path": str(tmp_path)}}).execute()
    print(f"{name}: {time.monotonic() - started:.1f} s", os.environ.get("CUTICLE_PROGRAM", ""))
    assert sorted(path.stem for path in tmp_path.glob("*.png")) == sorted(FIGURES[name])
    for path in tmp_path.glob("*.png"):
        pixels = image.imread(path)[..., :3]
        edges = numpy.concatenate([pixels[0], pixels[-1], pixels[:, 0], pixels[:, -1]])
        assert edges.min() == 1.0, f"{path.name}: something is cut off"
        assert pixels.std() > 0.05, f"{path.name}: empty"
