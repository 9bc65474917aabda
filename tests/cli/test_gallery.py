"""The gallery, small: every picture is made, is no empty picture, and stands in docs/gallery.md."""
import os
import re
import shutil

import pytest

from program import ROOT, run

PAGE = (ROOT / "docs/gallery.md").read_text(encoding="utf-8")
# What takes long even when small: the sweep runs these too.
LONG = {"black_curls", "cards_beside_strands", "error_against_time", "mermaid", "tension", "colours", "fox_fur"}


def names():
    return re.findall(r'\.name = "([a-z_]+)"', (ROOT / "cli/gallery/pictures.cpp").read_text(encoding="utf-8"))


def test_Gallery_Page_HasEachPictureAndItsCommand():
    assert len(names()) == 12
    assert sorted(re.findall(r"images/gallery/([a-z_]+)\.png", PAGE)) == sorted(names())
    assert sorted(re.findall(r"--only ([a-z_]+)", PAGE)) == sorted(names())


@pytest.mark.parametrize("name", names())
def test_Gallery_Picture_IsMade(name, tmp_path):
    if name in LONG and not os.environ.get("CUTICLE_SWEEPS"):
        pytest.skip("long: scripts/test.sh --full")
    if name in ("lobes", "tension", "hard_case") and not shutil.which("xvfb-run"):
        pytest.skip("xvfb is in scripts/packages.txt")
    done = run("gallery", "--only", name, "--scale", "0.3", "--out", tmp_path, timeout=280)
    assert done.returncode == 0, done.stderr
    if "left out" in done.stderr:
        pytest.skip(done.stderr)
    assert (tmp_path / f"{name}.png").stat().st_size > 2000
    assert not [path for path in tmp_path.iterdir() if path.is_dir()]


def test_Gallery_UnknownPicture_IsRefusedWithWhatToTry(tmp_path):
    done = run("gallery", "--only", "curls", "--out", tmp_path)
    assert done.returncode == 2 and "cuticle gallery --list" in done.stderr
