"""Scenes as dictionaries: pictures in arrays by every way of drawing, layers, plans."""
import json
import pathlib

import numpy
import pytest

import cuticle

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENE = {**json.loads((ROOT / "scenes/still.json").read_text()), "strand_count": 300}
SCENE["camera"] = {**SCENE["camera"], "resolution_px": [64, 48]}


def has_vulkan():
    try:
        cuticle.render(SCENE, size=(16, 16), device="cpu")
    except cuticle.Error as error:
        if error.kind != "no_device":
            raise
        return False
    return True


HAS_VULKAN = has_vulkan()
HAS_EMBREE = "truth" in [entry["name"] for entry in cuticle.methods()]
METHODS = [name for name in cuticle.render_methods() if (HAS_EMBREE if name == "reference" else HAS_VULKAN)]


@pytest.fixture(scope="module")
def reference():
    if not HAS_EMBREE:
        pytest.skip("built without Embree")
    return cuticle.render(SCENE, "reference", samples=32)


@pytest.mark.parametrize("method", METHODS)
def test_Render_EveryMethod_ShowsTheHairWhereTheReferenceHasIt(method, reference):
    picture = cuticle.render(SCENE, method, device="" if method == "reference" else "cpu", samples=32 if method == "reference" else None)
    assert picture.shape == (48, 64, 4) and picture.dtype == numpy.float32 and numpy.isfinite(picture).all()
    brightness, truth = (image[..., :3].mean(axis=2).ravel() for image in (picture, reference))
    assert numpy.corrcoef(brightness, truth)[0, 1] > 0.75
    assert 0.5 < brightness.mean() / truth.mean() < 2


def test_Render_TheDictionary_IsCheckedAsAFileIs():
    for change, words in (({"camara": {}}, ["camara", "camera"]), ({"strand_count": -1}, ["strand_count", "-1"]),
                          ({"material": {"model": {"marschner": {"eta": 9}}}}, ["eta", "9", "1.05"]), ({"render": {"method": "tile"}}, ["tile", "tiles"])):
        with pytest.raises(cuticle.Error) as error:
            cuticle.render({**SCENE, **change})
        assert all(word in str(error.value) for word in words), str(error.value)


@pytest.mark.skipif(not HAS_EMBREE, reason="built without Embree")
def test_Render_ProgressAndLayers_AreGiven():
    calls = []
    picture, layers = cuticle.render(SCENE, "reference", samples=8, size=(32, 24), layers=True, progress=lambda *call: calls.append(call))
    assert picture.shape == (24, 32, 4) and calls and calls[-1][1] <= calls[-1][2]
    assert len(layers) > 1 and all(values.shape[:2] == (24, 32) for values in layers.values())


@pytest.mark.skipif(not HAS_VULKAN, reason="no Vulkan device")
def test_Renderer_Frames_MoveAndItsStrandsAreRead():
    moving = {**SCENE, "camera": {**SCENE["camera"], "turntable_deg_per_frame": 30}}
    renderer = cuticle.Renderer(moving, "tiles", layers=True, device="cpu")
    first, second = renderer.frame(0), renderer.frame(1)
    assert not numpy.array_equal(first, second) and "color" in renderer.layers
    assert len(renderer.strands()) == 300 and renderer.device and "tiles" in [p.name for p in renderer.plan.passes]


@pytest.mark.skipif(not HAS_VULKAN, reason="no Vulkan device")
def test_Renderer_ChangedBlocks_AreThoseOfANewRenderer():
    dark = {"model": {"marschner": {"sigma_a": 2}}}
    shadow = {"method": {"deep_opacity": {"layers": 4}}, "fibre_alpha": 0.9}
    renderer, before = cuticle.Renderer(SCENE, "tiles", device="cpu"), cuticle.render(SCENE, "tiles", device="cpu")
    assert numpy.array_equal(renderer.frame(0), before)
    scene = {**SCENE, "render": {"method": "tiles"}}
    for blocks in ({"material": dark}, {"shadow": shadow}, {"camera": {**SCENE["camera"], "fov_deg": 20}}, {"render": {"method": "lines"}}):
        renderer.change(**blocks)
        scene.update(blocks)
        now, new = renderer.frame(0), cuticle.render(scene, device="cpu")
        assert numpy.array_equal(now, new) and not numpy.array_equal(now, before)
        before = now
    assert "lines" in [planned.name for planned in renderer.plan.passes]


@pytest.mark.skipif(not HAS_VULKAN, reason="no Vulkan device")
def test_Renderer_BlocksThatAreRefused_LeaveTheSceneAsItWas():
    renderer = cuticle.Renderer(SCENE, "tiles", device="cpu")
    before = renderer.frame(0)
    for blocks, words in (({"lights": []}, ["lights", "material"]), ({"material": {"model": {"marschner": {"eta": 9}}}}, ["eta", "9"]),
                          ({"camera": {**SCENE["camera"], "resolution_px": [32, 24]}}, ["resolution"])):
        with pytest.raises(cuticle.Error) as error:
            renderer.change(**blocks)
        assert all(word in str(error.value) for word in words), str(error.value)
    assert numpy.array_equal(renderer.frame(0), before)


@pytest.mark.skipif(not HAS_EMBREE, reason="built without Embree")
def test_Render_AGroomObject_IsTheScenesHair():
    wide = cuticle.make_groom([[[0.1 * x, 0.3, 0], [0.1 * x, -0.3, 0]] for x in range(-2, 3)], radii=0.01)
    scene = {**SCENE, "groom": wide, "head": {"present": False}}
    scene.pop("strand_count")
    columns = numpy.flatnonzero(cuticle.render(scene, "reference", samples=32)[20:28, :, 3].any(axis=0))
    assert 5 <= len(columns) <= 20 and columns.max() - columns.min() > 20


@pytest.mark.skipif(not HAS_EMBREE, reason="built without Embree")
def test_Render_SimulatedReference_MovesOnTheCpu():
    scene = {**SCENE, "simulation": {"solver": {"exact": {"sag_free": False}}, "effects": {"gravity": {}}}}
    renderer = cuticle.Renderer(scene, "reference", samples=4)
    first, then = renderer.frame(0), renderer.frame(4)
    assert renderer.device == "cpu" and not numpy.array_equal(first, then)


def test_Plan_OfAScene_SaysWhatRunsAndWhy():
    plan = cuticle.plan(SCENE)
    names = [planned.name for planned in plan.passes]
    assert "opacity_map" in names and "wind" not in names and plan.facts["light"]["holds"]
    assert "light" in plan.why("opacity_map") and plan.why("wind").startswith("left out")
    with pytest.raises(cuticle.Error, match="winds"):
        plan.why("winds")
    assert cuticle.plan(SCENE, method="tiles").why("tiles") != plan.why("tiles")


def test_ToneMap_Black_StaysBlack():
    shown = cuticle.tone_map(numpy.zeros((2, 3, 4), numpy.float32))
    assert shown.shape == (2, 3, 4) and (shown == 0).all()
    assert "camera" in cuticle.scene_schema()["properties"]


@pytest.mark.skipif(not HAS_VULKAN, reason="no Vulkan device")
def test_Renderer_SeenStrands_AddUpToThePicture():
    renderer = cuticle.Renderer(SCENE, "supersampled", size=(32, 24), seen=True, device="cpu")
    picture = renderer.frame(0)
    seen = renderer.seen
    sums = numpy.zeros_like(picture)
    numpy.add.at(sums, (seen["row"], seen["column"]), numpy.column_stack([seen["light"], seen["share"]]))
    assert (seen["strand"] >= 0).any() and seen["strand"].max() < len(renderer.strands())
    numpy.testing.assert_allclose(sums, picture, atol=1e-5)
