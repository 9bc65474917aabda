"""`cuticle conformance`: its tables, its script, and an adapter with known mistakes."""
import csv
import json
import os
import subprocess
import sys

import pytest

from program import refused, run


@pytest.fixture(scope="module")
def kit(tmp_path_factory):
    folder = tmp_path_factory.mktemp("kit") / "conformance"
    done = run("conformance", "--model", "karis,chiang", "--out", folder)
    assert done.returncode == 0, done.stderr
    return folder


def judged(kit, adapter, *arguments):
    return subprocess.run([sys.executable, "-I", kit / "conformance.py", kit / "karis.csv", "--with", adapter, *arguments], capture_output=True, text=True)


def adapter(tmp_path, kit, change):
    """Gives the table's own values back, with a mistake."""
    file = tmp_path / "mine.py"
    file.write_text(f"""
import csv, math
table = {{}}
for c in csv.DictReader(open({str(kit / 'karis.csv')!r})):
    key = (c["settings"], c["quantity"], c["lobe"]) + tuple(round(math.radians(float(c[n])), 9) for n in ("theta_i_deg", "theta_o_deg", "phi_deg")) + (float(c["h"]),)
    table[key] = tuple(float(c[n]) for n in "rgb")
def evaluate(model, settings, quantity, lobe, theta_i, theta_o, phi, h):
    if quantity != "S": return None
    text = ",".join(f"{{k}}={{v}}" for k, v in settings.items())
    value = table.get((text, quantity, lobe, round(theta_i, 9), round(theta_o, 9), round(phi, 9), h), (0, 0, 0))
    return tuple({change} for v in value)
""")
    return file


def test_tables_hold_every_parameter_and_finite_values(kit):
    with open(kit / "chiang.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) > 1000 and {row["quantity"] for row in rows} == {"S", "pdf", "albedo"}
    assert all("beta_m=" in row["settings"] and "field=" in row["settings"] for row in rows)
    assert all(abs(float(row["r"])) < 1e30 and float(row["tolerance"]) >= 0 for row in rows)


def test_same_values_hold(kit, tmp_path):
    done = judged(kit, adapter(tmp_path, kit, "v"))
    assert done.returncode == 0, done.stdout


@pytest.mark.parametrize("mistake,words", [("v * math.cos(theta_i)", "a cosine of the light is included"), ("v / math.pi", "pi"), ("2 * v", "1/2")])
def test_single_mistake_is_named(kit, tmp_path, mistake, words):
    done = judged(kit, adapter(tmp_path, kit, mistake), "--json")
    results = json.loads(done.stdout)
    assert done.returncode == 1
    assert any(result["cause"] and words in result["cause"] for result in results), results


def test_value_that_is_no_number_does_not_hold(kit, tmp_path):
    done = judged(kit, adapter(tmp_path, kit, "float('nan')"))
    assert done.returncode == 1


def test_files_that_cannot_be_used_are_refused_in_words(kit, tmp_path):
    empty = tmp_path / "none.py"
    empty.write_text("")
    done = judged(kit, empty)
    assert done.returncode == 3 and "evaluate" in done.stderr
    wrong = subprocess.run([sys.executable, "-I", kit / "conformance.py", kit / "README.md", "--with", empty], capture_output=True, text=True)
    assert wrong.returncode == 3 and "first line" in wrong.stderr


def test_unknown_model_is_refused(tmp_path):
    assert "chiagn" in refused(2, "conformance", "--model", "chiagn", "--out", tmp_path / "x")


@pytest.mark.skipif("CUTICLE_MITSUBA_PYTHON" not in os.environ, reason="CUTICLE_MITSUBA_PYTHON names a Python that has Mitsuba 3.9.1")
def test_mitsubas_short_bessel_function_shows(tmp_path):
    """Its I0 stops after ten terms: most values hold, those of narrow dark fibres are off by half a per cent."""
    program = run("conformance", "--for", "mitsuba", "--out", tmp_path / "kit")  # the tables, whatever this Python has
    assert program.returncode in (0, 1, 3)
    done = subprocess.run([os.environ["CUTICLE_MITSUBA_PYTHON"], tmp_path / "kit/conformance.py", tmp_path / "kit/chiang.csv", "--with",
                           tmp_path / "kit/mitsuba_hair.py", "--json"], capture_output=True, text=True)
    [result] = json.loads(done.stdout)
    assert done.returncode == 1 and 0.7 * result["rows"] < result["held"] < result["rows"] and 10 < result["worst"] < 200
