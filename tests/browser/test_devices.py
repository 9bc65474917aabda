"""The pages' devices: what every other browser test stands on."""
import pytest

from browser import HERE, result_of


def test_Browser_WithoutAGpu_OffersWebGl2AndWebGpu():
    found = result_of(HERE / "pages", "devices.html")
    assert found == {"webgl2": True, "float_targets": True, "webgpu": True, "three": "187"}


def test_PageThatThrows_IsAnError(tmp_path):
    (tmp_path / "throws.html").write_text("<script>throw new Error('on purpose')</script>")
    with pytest.raises(AssertionError, match="on purpose"):
        result_of(tmp_path, "throws.html")
