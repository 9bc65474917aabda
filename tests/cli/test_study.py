"""`cuticle study`: results that repeat bit for bit, one page for all, what is complete is not run again, two results compared."""
import json
import re
import subprocess

import pytest

from program import PROGRAM, run

STUDIES = "motion,skinning"


@pytest.fixture(scope="module")
def studied(tmp_path_factory):
    folders = [tmp_path_factory.mktemp("study") for _ in range(2)]
    for folder in folders:
        done = run("study", "all", "--quick", "--only", STUDIES, "--out", folder, timeout=240)
        assert done.returncode == 0, done.stderr
    return folders


def test_Study_TwoRuns_DifferInTimesAlone(studied):
    for name in STUDIES.split(","):
        for file in ("result.json", "study.csv"):
            first, second = ((folder / name / file).read_bytes() for folder in studied)
            assert first == second, (name, file)
    machine = json.loads((studied[0] / "motion" / "times.json").read_text())["machine"]
    assert machine["processor"] and machine["compiler"] and machine["version"]


def test_Study_All_WritesOnePageWithFindings(studied):
    page = (studied[0] / "index.html").read_text()
    assert 'id="motion"' in page and 'id="skinning"' in page
    assert "Linear blend loses up to" in page
    assert not re.search(r'<(script|img|link)[^>]*(src|href)="(?!data:)', page)


def test_Study_AllWithoutOnly_BeginsWithTheFirst(tmp_path):
    command = [PROGRAM, "study", "all", "--quick", "--out", str(tmp_path)]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as running:
        first = next((line for line in running.stderr if "remain" in line or "error" in line), "nothing")
        running.terminate()
    assert re.match(r"\w+; about \d+ s remain", first), first


def test_Study_AllAgain_GoesOnWhereItWasStopped(studied):
    (studied[0] / "skinning" / "result.json").unlink()
    before = (studied[0] / "motion" / "times.json").read_bytes()
    done = run("study", "all", "--quick", "--only", STUDIES, "--out", studied[0])
    assert done.returncode == 0, done.stderr
    assert "motion: complete, not run again" in done.stderr and "skinning; about" in done.stderr
    assert (studied[0] / "motion" / "times.json").read_bytes() == before
    assert (studied[0] / "skinning" / "result.json").exists()


def test_Study_WhosePageFails_EndsWithExitCodeOneAndItsData(studied, monkeypatch):
    monkeypatch.setenv("CUTICLE_PYTHON_EXE", "/bin/false")
    done = run("study", "all", "--quick", "--only", STUDIES, "--out", studied[1])
    assert done.returncode == 1 and "no page:" in done.stderr
    assert (studied[1] / "motion" / "result.json").exists()


def test_StudyCompare_ALessExactResult_IsNamedWithExitCodeOne(studied, tmp_path):
    same = run("study", "compare", studied[0] / "skinning", studied[0] / "skinning")
    assert same.returncode == 0 and "less exact in B: 0" in same.stdout
    for file in ("result.json", "times.json"):
        (tmp_path / file).write_text((studied[0] / "skinning" / file).read_text())
    result = json.loads((tmp_path / "result.json").read_text())
    mean = result["groups"][0]["points"][1]["errors"][0]["mean"]
    mean.update(value=9.0, low=8.0, high=10.0)
    (tmp_path / "result.json").write_text(json.dumps(result))
    worse = run("study", "compare", studied[0] / "skinning", tmp_path)
    assert worse.returncode == 1 and "less exact in B: 1\n  skinning, twist, dual_quaternion: error" in worse.stdout


def test_StudyCompare_AFolderWithoutResults_IsRefused(tmp_path):
    done = run("study", "compare", tmp_path, tmp_path)
    assert done.returncode == 3 and "result.json" in done.stderr
