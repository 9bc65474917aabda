"""cuticle check: the verdict in the exit code, the facts on stdout."""
import json

import pytest

from program import ROOT, refused, run


@pytest.fixture(scope="module")
def report():
    done = run("check", "device", "--family", "strands", "--json", "--device", "cpu")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_Device_OfTheSoftwareDriver_HoldsEveryCase(report):
    assert report["failed"] == 0 and report["passed"] > 10
    assert report["chosen"]["software"] is True and report["chosen"]["subgroup_size"] >= 4


def test_Device_Cases_AreThoseOfTheSubjectOnTheProcessorAndTheDevice(report):
    assert {case["precision"] for case in report["cases"]} == {"f32", "gpu"}
    assert {case["subject"] for case in report["cases"]} == {"strands"}


def test_Device_Families_SayTheWorstTheSlowestAndHowManyNaN(report):
    family, = report["families"]
    assert family["family"] == "strands" and family["not_finite"] == 0 and family["failed"] == 0
    assert 0 < family["largest_used"] <= 1 and family["slowest_seconds"] > 0


def test_Device_Certificate_NamesMachineAndBuild(tmp_path):
    path = tmp_path / "certificate.json"
    done = run("check", "device", "--family", "functions", "--device", "cpu", "--certificate", path)
    assert done.returncode == 0 and "functions" in done.stdout
    certificate = json.loads(path.read_text())
    assert certificate["chosen"]["driver"] and certificate["build"]["compiler"] and certificate["build"]["version"]


def test_Device_FamilyThatNoCaseHas_IsAUsageError():
    assert "nonsense" in refused(2, "check", "device", "--family", "nonsense", "--device", "cpu")


def test_Device_ThatIsNotThere_IsExitCodeFour():
    assert "nosuch" in refused(4, "check", "device", "--device", "nosuch")


def test_Scene_OfTheRepository_IsValid():
    assert "valid" in run("check", "scene", ROOT / "scenes/nalu.json").stdout


def test_Scene_WithAnUnknownKey_IsExitCodeThree(tmp_path):
    scene = json.loads((ROOT / "scenes/nalu.json").read_text())
    scene["ligths"] = []
    path = tmp_path / "wrong.json"
    path.write_text(json.dumps(scene))
    message = refused(3, "check", "scene", path)
    assert "ligths" in message and "lights" in message


def test_Model_WhoseExceptionsAreStated_IsSound():
    report, = json.loads(run("check", "model", "kajiya_kay", "--quick", "--json").stdout)
    verdicts = {check["check"]: check for check in report["checks"]}
    assert report["model"] == "kajiya_kay" and report["sound"] and report["cause"] == "none"
    assert verdicts["reciprocity"]["verdict"] == "stated" and verdicts["reciprocity"]["exception"]
    assert verdicts["chi_square"]["verdict"] == "pass" and verdicts["chi_square"]["at_least"]


def test_Model_InFloat_HasAVerdictForEveryCheck():
    done = run("check", "model", "scheuermann", "--quick", "--precision", "f32")
    assert done.returncode == 0
    assert all(name in done.stdout for name in ("white_furnace", "pdf_normalised", "sample_weights", "finite"))


def test_Model_ThatIsNotThere_IsAUsageError():
    assert "kajiya_kay" in refused(2, "check", "model", "kajiya_kaj", "--quick")


def test_Check_WithoutATarget_IsAUsageError():
    assert "subcommand" in refused(2, "check")


def test_Groom_OfTheProceduralHead_Passes(tmp_path):
    assert run("grow", ROOT / "scenes/presets/short-fur.json", "--out", tmp_path / "a.hair").returncode == 0
    report = json.loads(run("check", "groom", tmp_path / "a.hair", "--metres-per-unit", "1", "--json").stdout)
    assert len(report["checks"]) == 8 and all(check["passed"] for check in report["checks"])


def test_Groom_InTheWrongUnit_IsNamedWithExitCodeOfAFailedCheck(tmp_path):
    run("grow", ROOT / "scenes/presets/short-fur.json", "--out", tmp_path / "a.hair")
    done = run("check", "groom", tmp_path / "a.hair", "--metres-per-unit", "1000")
    assert done.returncode == 1 and "wrong_unit" in done.stdout


def test_Groom_ThatIsNotThere_IsExitCodeThree(tmp_path):
    assert "nothing.hair" in refused(3, "check", "groom", tmp_path / "nothing.hair")


def test_Groom_ForAProgramThatRefusesIt_FailsAndForAnotherPasses(tmp_path):
    """300 points a strand: past Unreal's 255, which Blender does not limit."""
    file = tmp_path / "long.usda"
    points = ", ".join(f"({s * 0.01}, {0.001 * v}, 0)" for s in range(70) for v in range(300))
    file.write_text(f"""#usda 1.0
(metersPerUnit = 1)
def BasisCurves "hair" {{
    uniform token type = "linear"
    int[] curveVertexCounts = [{", ".join(["300"] * 70)}]
    point3f[] points = [{points}]
    float[] widths = [0.00007] (interpolation = "constant")
}}
""")
    refuses = run("check", "groom", file, "--for", "unreal,blender")
    assert refuses.returncode == 1 and "points of a strand 300, allowed 2 .. 255" in refuses.stdout and "blender      refuses nothing" in refuses.stdout
    assert "no root UV" in refuses.stdout
    assert run("check", "groom", file, "--for", "blender").returncode == 0
    assert "unrael" in refused(2, "check", "groom", file, "--for", "unrael")
