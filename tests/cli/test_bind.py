"""cuticle bind: roots of a data set become hair on a head scan, which is drawn."""
import json

import pytest
from matplotlib import image
from program import DATA, ROOT, run

HEAD = f"{DATA}/heads/lee_perry_smith/LeePerrySmith.obj"
UNITS = ["--mesh-metres-per-unit", 0.0417]


def report(*arguments):
    done = run("bind", *arguments, "--json")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.skipif(not DATA, reason="CUTICLE_TEST_DATA is not set")
def test_Bind_PermRoots_BecomeHairOnTheLeePerrySmithHead(tmp_path, monkeypatch):
    roots = f"{DATA}/heads/perm_roots/rootPositions_10k.txt"
    found = report(roots, HEAD, "--metres-per-unit", 0.01, *UNITS, "--fit", "--out", tmp_path / "hair.hair")
    assert found["strands"] == 10140 and found["empty_strands"] == 0
    assert found["scale"] == pytest.approx(0.855, abs=0.01)
    assert found["distance_m"]["mean"] < 2e-3 and found["far_strands"] <= 10
    assert found["normals_differ_by_deg"] < 6
    again = report(tmp_path / "hair.hair", HEAD, "--metres-per-unit", 1, *UNITS, "--out", tmp_path / "again.hair")
    assert again["strands"] == 10140 and again["distance_m"]["max"] < 1e-6

    monkeypatch.setenv("CUTICLE_HAIR", str(tmp_path / "hair.hair"))
    done = run("render", ROOT / "scenes/perm_head.json", "--out", tmp_path / "picture")
    assert done.returncode == 0, done.stderr
    picture = image.imread(tmp_path / "picture/frame_0000.png")[..., :3]
    background = picture[0, 0]
    covered = (abs(picture - background).max(axis=2) > 0.02).mean()
    assert 0.15 < covered < 0.25
