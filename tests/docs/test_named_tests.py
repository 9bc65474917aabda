"""The tests that docs/robustness.md names for what an attack found are there."""
import re
import subprocess

from documents import ROOT


def test_Robustness_NamedTests_Exist():
    table = (ROOT / "docs/robustness.md").read_text().split("## What an attack found")[1]
    files = subprocess.run(["git", "ls-files", "*_test.cpp", "*test_*.py"], cwd=ROOT, check=True, capture_output=True, text=True).stdout.split()
    text = "".join((ROOT / name).read_text() for name in files)
    declared = {f"{suite}.{name}" for suite, name in re.findall(r"TEST(?:_F|_P)?\((\w+),\s*(\w+)\)", text)}
    declared |= set(re.findall(r"def (test_\w+)", text))
    suite, named = "", []
    for word in re.findall(r"`([\w.]+)`", table):
        if re.fullmatch(r"[A-Z]\w+\.[A-Z]\w+_\w+", word):
            suite = word.split(".")[0]
        elif re.fullmatch(r"[A-Z]\w+_\w+", word):  # of the suite before
            word = f"{suite}.{word}"
        elif not re.fullmatch(r"test_[A-Z]\w+", word):
            continue
        named.append(word)
    assert len(named) > 45
    assert [word for word in named if word not in declared] == []
