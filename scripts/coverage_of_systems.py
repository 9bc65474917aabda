"""Rows of docs/systems.md against the test report and the registries. See scripts/coverage-of-systems."""
import json
import os
import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree as xml

ROOT = pathlib.Path(__file__).resolve().parents[1]
BUILD = pathlib.Path(os.environ.get("CUTICLE_BUILD_DIR", ROOT / "build/release"))


def rows():
    """[(id, feature)] in the order of the table."""
    text = (ROOT / "docs/systems.md").read_text()
    return re.findall(r"^\| ([A-Z]\d+) \| (.*?) \|$", text, re.M)


def labels_by_test():
    shown = subprocess.run(["ctest", "--test-dir", BUILD, "--show-only=json-v1"], capture_output=True, text=True, check=True)
    labels = {}
    for test in json.loads(shown.stdout)["tests"]:
        properties = {p["name"]: p["value"] for p in test.get("properties", [])}
        labels[test["name"]] = properties.get("LABELS", [])
    return labels


def passed_tests(report):
    """Names of the entries that ran and passed."""
    return {case.get("name") for case in xml.parse(report).getroot().iter("testcase") if case.get("status") == "run"}


def rows_by_registry():
    """Row ids that an entry of a registry claims: {id: ['model marschner', ...]}."""
    claims = {}
    for singular, kind in (("model", "models"), ("method", "methods"), ("effect", "effects"), ("pass", "passes")):
        done = subprocess.run([BUILD / "bin/cuticle", kind, "--json"], capture_output=True, text=True)
        for entry in json.loads(done.stdout) if done.returncode == 0 else []:
            for row in entry.get("systems", []):
                claims.setdefault(row, []).append(f"{singular} {entry['name']}")
    return claims


def coverage():
    labels, passed, claims = labels_by_test(), passed_tests(BUILD / "report.xml"), rows_by_registry()
    table = []
    for row, feature in rows():
        tests = sorted(t for t, carried in labels.items() if row in carried)
        table.append({"id": row, "feature": feature, "tests": tests, "passed": [t for t in tests if t in passed],
                      "registered": claims.get(row, [])})
    return table


def main():
    table = coverage()
    if "--json" in sys.argv:
        print(json.dumps(table, indent=1))
        return
    covered = [r for r in table if r["passed"]]
    for row in covered:
        print(f"{row['id']:4} {', '.join(row['passed'])}" + (f"   [{', '.join(row['registered'])}]" if row["registered"] else ""))
    print("not yet:", " ".join(r["id"] for r in table if not r["passed"]))
    print(f"{len(covered)} of {len(table)} rows covered by tests that ran and passed")
    claimed = [r["id"] for r in table if r["registered"] and not r["passed"]]
    if claimed:
        sys.exit(f"registered but not covered: {' '.join(claimed)}")


if __name__ == "__main__":
    main()
