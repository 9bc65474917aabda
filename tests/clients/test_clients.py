"""The page of programs that open what Cuticle writes: its quick rows, and that a wrong reading is said."""
import pathlib
import subprocess
import sys

import numpy
import pytest

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "cli")]
import rows  # noqa: E402
import work  # noqa: E402


def test_QuickRows_OfASmallGroom_AreRightAndOnThePage(tmp_path):
    done = subprocess.run([sys.executable, HERE / "run.py", "--out", tmp_path], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    page = (tmp_path / "index.html").read_text()
    assert "2 programs opened" in page and "class=wrong" not in page
    assert (tmp_path / "three_strands.png").stat().st_size > 5000


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    made = tmp_path_factory.mktemp("clients")
    work.must("grow", "--strands", "density=3000", "--out", made / "groom.npz")
    work.must("convert", made / "groom.npz", made / "strands.glb")
    return made


def test_Strands_InAGlb_AreThoseOfTheGroom(folder):
    groom, found = work.groom(folder), work.glb(folder / "strands.glb")
    assert (found["POSITION"] == groom["positions"]).all()
    assert numpy.allclose(found["TEXCOORD_0"][:, 0], groom["radii"])
    ends = groom["offsets"][1:].astype(int) - 1
    assert numpy.allclose(found["TEXCOORD_0"][ends, 1], 1) and numpy.allclose(found["TEXCOORD_0"][groom["offsets"][:-1].astype(int), 1], 0)
    segments = found["indices"].reshape(-1, 2).astype(int)
    assert (segments[:, 1] == segments[:, 0] + 1).all() and not set(segments[:, 0]) & set(ends)
    along = groom["positions"][segments[:, 1]] - groom["positions"][segments[:, 0]]
    assert ((along * found["TANGENT"][segments[:, 0], :3]).sum(axis=1) > 0).all()


@pytest.mark.parametrize("wrong", ["lower", "vertices", "tangents"])
def test_Mesh_ThatAProgramReadsWrong_IsSaid(folder, wrong):
    wanted = work.glb(folder / "strands.glb")
    found = {"lower": wanted["POSITION"].min(axis=0), "upper": wanted["POSITION"].max(axis=0), "vertices": len(wanted["POSITION"]),
             "indices": len(wanted["indices"]), "tangents": wanted["TANGENT"][:10].ravel()}
    found[wrong] = found[wrong] * 1.01
    row = rows.Row("a program", "1", "strands.glb")
    rows.compare_mesh(row, found, folder, "strands.glb")
    assert [holds for _, holds in row.compared].count(False) == 1
