"""cuticle grow: specifications to files and to a picture, what it refuses, and how even roots lie."""
import json

import pytest
from program import ROOT, refused, rows, run

PRESETS = ROOT / "scenes/presets"


def specification(folder, name, **fields):
    path = folder / name
    path.write_text(json.dumps({"schema_version": 1, **fields}))
    return path


def test_Grow_SeveralSpecifications_GoToAFolder(tmp_path):
    done = run("grow", PRESETS / "straight.json", PRESETS / "curly.json", "--share", 0.02, "--out", tmp_path / "grooms")
    assert done.returncode == 0, done.stderr
    assert sorted(p.name for p in (tmp_path / "grooms").iterdir()) == ["curly.hair", "straight.hair"]
    assert run("info", tmp_path / "grooms/curly.hair").returncode == 0


def test_Grow_UnknownKey_IsRefusedWithTheNearestName(tmp_path):
    path = specification(tmp_path, "odd.json", shaping={"curl": {"radus": 0.01}})
    message = refused(3, "grow", path, "--out", tmp_path / "out.hair")
    assert "odd.json" in message and "radus" in message and "radius" in message
    assert not (tmp_path / "out.hair").exists()


def test_Grow_ToUsdBinary_IsWritten(tmp_path):
    pytest.importorskip("pxr.UsdGeom", reason="usd-core is not installed")
    path = specification(tmp_path, "small.json", strands={"density": 2000, "vertices": 8})
    done = run("grow", path, "--out", tmp_path / "hair.usdc")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "hair.usdc").read_bytes()[:8] == b"PXR-USDC"


def test_Grow_CompareRoots_EvenRulesAreMoreEven():
    found = {row["rule"]: float(row["discrepancy"]) for row in rows("grow", "--compare-roots", 4096)}
    assert sorted(found) == ["folded", "recurrence", "table", "van_der_corput"]
    assert found["recurrence"] < found["van_der_corput"] < found["folded"]


def test_Grow_Sheet_IsAPicture(tmp_path):
    path = specification(tmp_path, "small.json", strands={"density": 5000, "vertices": 8})
    done = run("grow", path, "--sheet", tmp_path / "sheet.png")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "sheet.png").read_bytes()[:4] == b"\x89PNG"
