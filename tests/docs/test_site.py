"""The documentation site builds strictly, without a network, and the README stays short."""
import pathlib
import re
import shutil
import subprocess
import sys

import pytest

from documents import PAGES, ROOT


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    folder = tmp_path_factory.mktemp("site")
    done = subprocess.run([sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", folder], cwd=ROOT, capture_output=True, text=True,
                          timeout=300)
    assert done.returncode == 0, done.stderr[-4000:]
    return folder


def test_Site_EveryLinkAndAnchor_IsThere(site):
    assert (site / "index.html").is_file()


def test_Site_Reference_HasEveryEntryOfTheRegistries(site):
    assert "sigma_a" in (site / "reference/models.html").read_text()
    assert "deep_opacity" in (site / "reference/methods.html").read_text()
    assert "cuticle check lut" in (site / "reference/commands.html").read_text()


@pytest.mark.skipif(not shutil.which("doxygen"), reason="doxygen is in scripts/packages.txt")
def test_Site_ApiReference_HasEveryHeaderOfAModule(site):
    listed = (site / "reference/api.html").read_text()
    for header in sorted((ROOT / "bsdf").rglob("*.h")):
        assert f"{header.relative_to(ROOT)}</code></a>" in listed, header
    assert "find_model" in (site / "api/namespacecuticle_1_1bsdf.html").read_text()


def test_Site_LoadsNothingFromElsewhere(site):
    for page in site.rglob("*.html"):
        text = page.read_text(encoding="utf-8")
        found = re.findall(r'<(?:script|link|img)[^>]+(?:src|href)="(https?://[^"]+)"', text)
        assert not found, f"{page}: {found}"


def test_Readme_IsShort():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert len(text.splitlines()) <= 120 and len(text.split()) <= 900
    assert len(re.findall(r"!\[", text)) == 3


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_Pictures_OfADocument_AreSmall(page):
    for link in re.findall(r"!\[[^\]]*\]\(([^)]+)\)", page.read_text(encoding="utf-8")):
        picture = pathlib.Path(page.parent / link)
        assert picture.stat().st_size <= 300_000, picture
