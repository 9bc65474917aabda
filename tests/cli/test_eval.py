"""`cuticle eval`: grids, points, precisions."""
import math

import pytest

from program import refused, rows

CASE = ["eval", "--model", "marschner", "--set", "eta=1.55,sigma_a=0.2", "--quantity", "N", "--theta-d", "30", "--phi", "-180:180:721"]


def caustic_deg(eta, theta_d_deg):
    """The caustic of TRT: h_c^2 = (4 - eta'^2) / 3, phi_c = 4 asin(h_c / eta') - 2 asin(h_c)."""
    theta = math.radians(theta_d_deg)
    bent = math.sqrt(eta * eta - math.sin(theta) ** 2) / math.cos(theta)
    h = math.sqrt((4 - bent * bent) / 3)
    return math.degrees(abs(4 * math.asin(h / bent) - 2 * math.asin(h)))


@pytest.mark.parametrize("lobe", ["R", "TT", "TRT"])
@pytest.mark.parametrize("precision", ["f32", "gpu"])
def test_Eval_FloatAndGpu_AgreeWithDoubleAwayFromCaustics(lobe, precision):
    truth = rows(*CASE, "--lobe", lobe, "--precision", "f64")
    other = rows(*CASE, "--lobe", lobe, "--precision", precision)
    assert len(truth) == len(other) == 721
    bounds = [caustic_deg(1.55, 30)] if lobe == "TRT" else []
    far = [i for i, row in enumerate(truth) if all(abs(abs(float(row["phi"])) - c) > 0.5 for c in bounds)]
    largest = max(float(truth[i]["g"]) for i in far)
    worst = max(abs(float(truth[i]["g"]) - float(other[i]["g"])) for i in far)
    assert len(far) > 700 and worst <= 2e-5 * largest


def test_Eval_LobesAndSum_AreConsistent():
    parts = [rows(*CASE, "--lobe", lobe) for lobe in ("R", "TT", "TRT")]
    total = rows(*CASE, "--lobe", "sum")
    for i in range(0, 721, 40):
        assert float(total[i]["r"]) == pytest.approx(sum(float(p[i]["r"]) for p in parts), rel=1e-9)


def test_Eval_Points_GiveTheGridsValues(tmp_path):
    points = tmp_path / "points.csv"
    points.write_text("theta_d,phi\n30,-180\n30,17\n")
    grid = rows(*CASE[:-2], "--phi=-180,17", "--lobe", "TRT")
    listed = rows(*CASE[:7], "--lobe", "TRT", "--points", points)
    assert [r["r"] for r in grid] == [r["r"] for r in listed]


@pytest.mark.parametrize("arguments,words", [
    (["--set", "eta=0.5"], ["eta", "0.5", "1.05", "3"]),
    (["--set", "etta=1.5"], ["etta", "eta"]),
    (["--lobe", "XX"], ["XX", "TRT"]),
    (["--phi", "0:1:x"], ["phi", "x"]),
])
def test_Eval_BadRequest_IsRefusedByName(arguments, words):
    message = refused(2, "eval", "--model", "marschner", "--quantity", "N", "--theta-d", "0", *(["--phi", "0"] if "--phi" not in arguments else []),
                      *arguments)
    for word in words:
        assert word in message


def test_Eval_UnknownModel_NamesTheNearest():
    assert "marschner" in refused(2, "eval", "--model", "marschnr", "--quantity", "N", "--theta-d", "0", "--phi", "0")


def test_Eval_PointsWithNan_NamesFileLineAndColumn(tmp_path):
    points = tmp_path / "points.csv"
    points.write_text("theta_d,phi\n30,nan\n")
    message = refused(3, *CASE[:7], "--points", points)
    for word in ("points.csv", "2", "phi"):
        assert word in message
