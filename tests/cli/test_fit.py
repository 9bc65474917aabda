"""`cuticle fit`: parameters found again, refusals by name, bad files; `cuticle bake --fit`."""
import ctypes
import json
import math
import random
import subprocess

import pytest

from program import refused, rows, run

GRID = ["--theta-i=-40:45:4", "--theta-o=-30:30:3", "--phi", "40,95,150,175"]
TRUTH = "eta=1.5,sigma_a=0.3,beta=0.2,alpha=-0.08"


def measured(path, *more, noise=0.01):
    """A CSV of the marschner model with noise and its sigma."""
    random.seed(3)
    lines = rows("eval", "--model", "marschner", "--set", TRUTH, *GRID, *more)
    names = [n for n in lines[0] if n not in "rgb"]
    text = ",".join(names + ["r", "g", "b", "sigma"]) + "\n"
    for line in lines:
        sigma = noise * float(line["r"]) + 1e-4
        values = [float(line[c]) + random.gauss(0, sigma) for c in "rgb"]
        text += ",".join([line[n] for n in names] + [f"{v:.9g}" for v in values + [sigma]]) + "\n"
    path.write_text(text)
    return path


def test_Fit_NoisyLobes_FindsTheTruthAndPrefersTheTrueModel(tmp_path):
    file = measured(tmp_path / "lobes.csv")
    done = run("fit", file, "--json", "--model", "marschner,karis", "--free", "eta,sigma_a,beta,alpha;color,roughness,shift")
    assert done.returncode == 0, done.stderr
    right, wrong = json.loads(done.stdout)
    truth = {"eta": 1.5, "sigma_a.r": 0.3, "sigma_a.g": 0.3, "sigma_a.b": 0.3, "beta": 0.2, "alpha": -0.08}
    assert {p["name"] for p in right["parameters"]} == set(truth)
    for p in right["parameters"]:
        assert abs(p["value"] - truth[p["name"]]) < 4 * p["sigma"] < 0.05
    assert right["aic"] < wrong["aic"] - 10


def test_Fit_ReflectionAlone_RefusesAbsorptionByName(tmp_path):
    file = measured(tmp_path / "lobes.csv", "--lobe", "R")
    message = refused(1, "fit", file, "--free", "eta,sigma_a,beta")
    assert "do not depend on sigma_a.r" in message and "eta" not in message


@pytest.mark.parametrize("text, words", [
    ("theta_i,phi,r,g,b\n1,2,3,4,5\n", "no column theta_o"),
    ("theta_i,theta_o,phi,r,g\n1,2,3,4,5\n", "columns r, g, b, or one column value"),
    ("theta_i,theta_o,phi,lobe,value\n1,2,3,TTT,5\n", "'TTT' is not one of sum, R, TT, TRT"),
    ("theta_i,theta_o,phi,value,sigma\n1,2,3,4,0\n1,2,4,4,1\n", "sigma 0 is not positive"),
])
def test_Fit_ABadFile_IsRefusedWithItsFault(tmp_path, text, words):
    file = tmp_path / "bad.csv"
    file.write_text(text)
    assert words in refused(3, "fit", file, "--free", "eta")


def test_Bake_FitAnalytic_TheShaderCodeIsTheModelWithinItsError(tmp_path):
    settings = "beta_n=0.3,azimuthal_tolerance=1e-4"
    done = run("bake", "--model", "deon", "--set", settings, "--fit", "analytic", "--out", tmp_path)
    assert done.returncode == 0, done.stderr
    source, library = tmp_path / "code.cpp", tmp_path / "code.so"
    source.write_text('#include <cmath>\nusing std::abs, std::exp, std::sin, std::cos, std::sqrt;\nextern "C" {\n'
                      + (tmp_path / "analytic.glsl").read_text() + "}\n")
    subprocess.run(["c++", "-shared", "-fPIC", "-o", library, source], check=True)
    code = ctypes.CDLL(str(library))
    for lobe in ("R", "TT", "TRT"):
        function = getattr(code, f"cuticle_N_{lobe}")
        function.restype, function.argtypes = ctypes.c_float, [ctypes.c_float] * 3
        exact = rows("eval", "--model", "deon", "--set", settings + ",sigma_a=0.2", "--quantity", "N", "--lobe", lobe,
                     "--theta-d", "20", "--phi", "2:178:45")
        peak = max(float(row["r"]) for row in exact)
        worst = max(abs(function(math.radians(float(row["phi"])), math.cos(math.radians(20)), 0.2) - float(row["r"]))
                    for row in exact)
        assert worst < 0.1 * peak
