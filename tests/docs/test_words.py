"""Words of --help and of headings: plain English (the dictionary of Debian's `wbritish`), the glossary's terms, or names.

    .venv/bin/python tests/docs/test_words.py     lists those that are none of these
"""
import json
import os
import pathlib
import re
import subprocess

import pytest

from documents import PAGES, ROOT

PROGRAM = os.environ.get("CUTICLE_PROGRAM", str(ROOT / "build/release/bin/cuticle"))
DICTIONARY = pathlib.Path("/usr/share/dict/british-english")
WORD = re.compile(r"[A-Za-z][a-z]+(?:'s)?\b")
ENDINGS = ("", "s", "es", "ed", "d", "ing", "er", "r", "ly", "'s")


def said(*words):
    return subprocess.run([PROGRAM, *words], capture_output=True, text=True, timeout=60, check=True).stdout


def glossary():
    text = (ROOT / "docs/glossary.md").read_text(encoding="utf-8")
    return {word.lower() for row in re.findall(r"^\| ([^|]+) \|", text, re.M) for word in re.findall(r"[A-Za-z]+", row)}


def names():
    """What the registries call things, options, and the engines, formats and people that have names of their own."""
    found = set((ROOT / "tests/docs/names.txt").read_text(encoding="utf-8").split())
    for kind in ("models", "methods", "effects", "passes"):
        found |= set(re.findall(r"[A-Za-z]+", " ".join(entry["name"] for entry in json.loads(said(kind, "--json")))))
    return {name.lower() for name in found}


def help_texts(words=()):
    text = said(*words, "--help")
    yield " ".join(["cuticle", *words]), text
    if "Subcommands:" in text:
        for line in text.split("Subcommands:")[1].splitlines():
            if line.startswith("  ") and not line.startswith("   "):
                yield from help_texts((*words, line.split()[0]))


def every_document():
    """The documents, and what lies in the folders: each README."""
    found = subprocess.run(["git", "-C", ROOT, "ls-files", "*README.md"], capture_output=True, text=True)
    folders = [ROOT / name for name in found.stdout.split()] if found.returncode == 0 else sorted(ROOT.glob("[!.]*/README.md"))
    return sorted({*PAGES, *folders})


def headings():
    for page in every_document():
        for heading in re.findall(r"^#+ (.*)$", re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.M | re.S), re.M):
            yield str(page.relative_to(ROOT)), heading


def plain(text):
    """Without code, links' targets, options, paths and names=values."""
    text = re.sub(r"`[^`]*`|\]\([^)]*\)", " ", text)
    return re.sub(r"\S*[-_/.=:]\S*[-_/=:]\S*|--?\w[\w-]*|\S*[_=/]\S*|\w+\.\w+|\.\w+", " ", text)


def is_known(word, known):
    word = word.lower()
    return any(word.endswith(end) and (word[: len(word) - len(end)] in known or word[: len(word) - len(end)] + "e" in known) for end in ENDINGS)


def unknown_words():
    known = {word.strip().lower() for word in DICTIONARY.read_text(encoding="utf-8").splitlines()} | glossary() | names()
    for place, text in [*help_texts(), *headings()]:
        for word in WORD.findall(plain(text)):
            if not is_known(word, known):
                yield place, word


@pytest.mark.skipif(not DICTIONARY.exists(), reason="wbritish is in scripts/packages.txt")
def test_Words_OfHelpAndHeadings_ArePlainOrInTheGlossary():
    assert sorted(set(unknown_words())) == []


# Words of our own that the field has other words for.
HOME_MADE = {"numbers that are none": "NaN", "one behind the other": "in sequence", "antialiasing over frames": "temporal anti-aliasing", "edge softening": "anti-aliasing"}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_Words_OfOurOwn_AreNotUsed(page):
    text = page.read_text(encoding="utf-8").lower()
    for word, better in HOME_MADE.items():
        assert word not in text, f"write {better}"


if __name__ == "__main__":
    for place, word in sorted(set(unknown_words())):
        print(f"{place}: {word}")
