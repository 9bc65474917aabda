"""cuticle.view: surfaces as eval says, and a clear error where PyVista is missing."""
import importlib.util
import pathlib
import sys

import cuticle
import cuticle.view
import numpy
import pytest

HAS_PYVISTA = importlib.util.find_spec("pyvista") is not None


def test_LobeSurface_Radius_IsWhatEvalSays():
    points, values, peak = cuticle.view.lobe_surface("marschner", "TT", theta_i_deg=40, log=False, rows=19, columns=361)
    expected = cuticle.eval("marschner", "S", "TT", theta_i_deg=40, theta_o_deg=-40, phi_deg=170).mean()
    assert values[5, 350] == pytest.approx(expected, rel=0.03)
    assert numpy.linalg.norm(points[5, 350]) == pytest.approx(min(values[5, 350] / peak, 1))
    assert points[5, 350, 2] == pytest.approx(numpy.linalg.norm(points[5, 350]) * numpy.sin(numpy.radians(-40)))


def test_Lobes_WithoutPyVista_SayHowToGetIt(monkeypatch):
    monkeypatch.setitem(sys.modules, "pyvista", None)
    with pytest.raises(cuticle.Error, match="PyVista") as caught:
        cuticle.view.lobes()
    assert caught.value.kind == "no_device" and "pip install" in caught.value.hint


@pytest.mark.skipif(not HAS_PYVISTA, reason="PyVista is not installed")
def test_Lobes_TwoModels_AreTwoViews():
    plotter = cuticle.view.lobes(["marschner", "chiang"], theta_i_deg=40)
    assert plotter.shape == (1, 2)
    assert len(plotter.renderers[0].actors) >= 5


def test_LobeSurface_OfTheCausticsLobe_HasNoRipples():
    """Neighbouring rows change as the lobe does: the second difference over theta is small beside the lobe."""
    _, values, _ = cuticle.view.lobe_surface("marschner", "TRT", theta_i_deg=40)
    ridge = values.max(axis=1)
    inner = ridge[20:70]
    assert numpy.abs(numpy.diff(inner, 2)).max() < 0.2 * inner.max(), "measured: 0.11; of four samples a column 1.09"


@pytest.mark.parametrize("arguments, word", [(dict(lobe="TTT"), "TTT"), (dict(theta_i_deg=120), "theta_i_deg"), (dict(rows=1), "rows")])
def test_LobeSurface_BadInput_SaysWhat(arguments, word):
    with pytest.raises(cuticle.Error, match=word):
        cuticle.view.lobe_surface("marschner", **arguments)


THREE = pathlib.Path(__file__).resolve().parents[2] / "tests/browser/node_modules/three"


@pytest.mark.skipif(not THREE.exists(), reason="npm's package three is not installed")
def test_Page_OfAGroom_HoldsItsStrandsAndThree(tmp_path):
    strands = cuticle.make_groom(numpy.linspace(0, 0.1, 24).reshape(2, 4, 3))
    index = cuticle.view.page(strands, tmp_path / "page", title="two strands", three=THREE)
    assert "two strands" in index.read_text() and "2 strands" in (tmp_path / "page/hair.js").read_text()


def test_Page_WithoutThree_SaysWhatToInstall(tmp_path):
    strands = cuticle.make_groom(numpy.linspace(0, 0.1, 24).reshape(2, 4, 3))
    with pytest.raises(cuticle.Error, match="three.module.js"):
        cuticle.view.page(strands, tmp_path / "page", three=tmp_path)
    with pytest.raises(cuticle.Error, match="variant=corrected"):
        cuticle.view.page(strands, tmp_path / "page", "variant=as_published", three=tmp_path)
