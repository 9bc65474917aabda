"""`cuticle bake --max-error`: what it chooses is within the error, and nothing is written where nothing is."""
import json

from program import run


def test_MaxError_Reached_IsKeptByTheManifest(tmp_path):
    done = run("bake", "--set", "caustic=smoothed,beta_deg=30", "--max-error", "10%", "--out", tmp_path / "lut")
    assert done.returncode == 0 and "chosen: " in done.stdout, done.stderr
    manifest = json.loads((tmp_path / "lut" / "manifest.json").read_text())
    errors = [c["error"]["uniform_in_angle"]["rms_over_rms"] for t in manifest["tables"] for c in t["channels"]]
    assert len(errors) >= 10 and max(errors) <= 0.1


def test_MaxError_OutOfReach_PrintsTheBestAndWritesNothing(tmp_path):
    done = run("bake", "--max-error", "0.01%", "--size", "16", "--out", tmp_path / "lut")
    assert done.returncode == 1 and "none reaches 0.01%; best: nalu" in done.stdout
    assert not (tmp_path / "lut").exists()


def test_MaxError_NotANumber_IsRefused(tmp_path):
    for text in ("1 percent", "0", "-1%", "200%"):
        done = run("bake", f"--max-error={text}", "--out", tmp_path / "lut")
        assert done.returncode == 2 and "between 0 and 100%" in done.stderr, text
