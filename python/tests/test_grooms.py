"""Hair as arrays: made, written in every format, grown, shaped, bound, checked."""
import pathlib
import pickle

import numpy
import pytest

import cuticle

ROOT = pathlib.Path(__file__).resolve().parents[2]
POINTS = numpy.stack([numpy.stack([numpy.full(5, 0.01 * s), numpy.linspace(0, -0.1, 5), numpy.zeros(5)], -1) for s in range(4)])


def test_MakeGroom_StrandsOfOneSize_NeedNoCounts():
    groom = cuticle.make_groom(POINTS, radii=4e-5)
    assert len(groom) == 4 and groom.offsets.tolist() == [0, 5, 10, 15, 20]
    assert groom.positions == pytest.approx(POINTS.reshape(-1, 3)) and (groom.radii == numpy.float32(4e-5)).all()


def test_MakeGroom_CountsAndAttributes_AreKept():
    groom = cuticle.make_groom(POINTS.reshape(-1, 3), [2, 18], root_uv=[[0, 1], [1, 0]], strand_attributes={"id": [3, 4]},
                               vertex_attributes={"color": numpy.ones((20, 3))})
    assert groom.offsets.tolist() == [0, 2, 20] and groom.root_uv.tolist() == [[0, 1], [1, 0]]
    assert groom.attributes["id"].tolist() == [3, 4] and groom.attributes["color"].shape == (20, 3)


def test_MakeGroom_DLPackOfAnotherLibrary_IsTaken():
    class Tensor:
        def __init__(self, array):
            self.array = array

        def __dlpack__(self, **_):
            return self.array.__dlpack__()

        def __dlpack_device__(self):
            return self.array.__dlpack_device__()

    groom = cuticle.make_groom(numpy.from_dlpack(Tensor(POINTS.astype(numpy.float32))))
    assert numpy.from_dlpack(groom.positions.copy()).shape == (20, 3)


@pytest.mark.parametrize("arguments, words", [
    (dict(points=POINTS.reshape(-1, 3), counts=[3, 4]), ["counts", "7", "20"]),
    (dict(points=POINTS.reshape(-1, 3)), ["points", "(20, 3)", "counts"]),
    (dict(points=POINTS, radii=[1, 2]), ["radii"]),
    (dict(points=numpy.full((1, 2, 3), numpy.nan)), ["finite"]),
    (dict(points=POINTS, vertex_attributes={"color": [1]}), ["color", "20"]),
    (dict(points=POINTS.reshape(-1, 3), counts=[-1, 21]), ["counts"]),
])
def test_MakeGroom_BadArrays_AreNamed(arguments, words):
    with pytest.raises(cuticle.Error) as error:
        cuticle.make_groom(**arguments)
    assert all(word in str(error.value) for word in words) and error.value.kind == "bad_input"


WRITABLE = [(entry["name"], ending) for entry in cuticle.formats() if entry["writes"] for ending in entry["extensions"]]


@pytest.mark.parametrize("name, ending", WRITABLE)
def test_Write_EveryFormat_IsReadBack(name, ending, tmp_path):
    groom = cuticle.make_groom(POINTS)
    file = tmp_path / f"four.{ending}"
    lost = cuticle.write(groom, file)
    back = cuticle.load_groom(file, metres_per_unit=1)
    assert len(back) == 4 and isinstance(lost, list)
    assert back.positions == pytest.approx(groom.positions, abs=1e-6)


def test_Grow_Dictionary_IsTheProgramsHair(tmp_path):
    specification = {"strands": {"density": 20000, "vertices": 8}, "shaping": {"curl": {"radius": 0.002}}}
    groom = cuticle.grow(specification, share=0.5)
    assert len(groom) > 100 and (numpy.diff(groom.offsets) == 8).all()
    assert numpy.array_equal(cuticle.grow(specification, share=0.5).positions, groom.positions)
    assert len(cuticle.grow(specification, control=True)) < len(cuticle.grow(specification))


def test_Grow_File_IsTakenByItsPath():
    assert len(cuticle.grow(ROOT / "scenes/presets/wavy.json", share=0.002)) > 10


def test_Grow_UnknownKey_SaysWhichIsNear():
    with pytest.raises(cuticle.Error, match="strands") as error:
        cuticle.grow({"strand": {}})
    assert error.value.kind == "bad_input"
    with pytest.raises(cuticle.Error, match="vertices.*1000.*2"):
        cuticle.grow({"strands": {"vertices": 1000}})


def test_Shape_Curl_MovesAllButTheRoots():
    groom = cuticle.make_groom(POINTS)
    curled = cuticle.shape(groom, {"curl": {"radius": 0.01}})
    moved = numpy.linalg.norm(curled.positions - groom.positions, axis=1)
    assert moved[groom.offsets[:-1]].max() == 0 < moved.max() <= 0.05
    assert numpy.array_equal(cuticle.shape(groom, []).positions, groom.positions)
    with pytest.raises(cuticle.Error, match="curl"):
        cuticle.shape(groom, ["curls"])


def test_Bind_ToAPlane_FollowsItsMotion():
    plane = numpy.array([[-1, 0, -1], [1, 0, -1], [-1, 0, 1], [1, 0, 1]], float), numpy.array([[0, 2, 1], [1, 2, 3]])
    groom = cuticle.make_groom(POINTS)
    binding = cuticle.bind(groom, plane)
    assert binding.weights.sum(axis=1) == pytest.approx(numpy.ones(4)) and binding.largest_distance < 1e-6 and binding.far_strands == 0
    moved = cuticle.carry(groom, plane, binding, plane[0] + [0, 0.5, 0])
    assert moved.positions == pytest.approx(groom.positions + [0, 0.5, 0], abs=1e-6)
    with pytest.raises(cuticle.Error, match="triangle 1.*9"):
        cuticle.bind(groom, (plane[0], [[0, 2, 1], [1, 2, 9]]))


def test_CheckGroom_CentimetresTakenAsMetres_IsNamed():
    verdicts = {v["check"]: v for v in cuticle.check_groom(cuticle.make_groom(100 * POINTS))}
    assert verdicts["units"]["mistake"] == "wrong_unit" and not verdicts["units"]["passed"]
    assert all(v["passed"] for v in cuticle.check_groom(cuticle.make_groom(POINTS)))


def test_HairOf_AScene_HasControlHairsStrandsAndHead():
    hair = cuticle.hair_of(ROOT / "scenes/still.json")
    assert len(hair.drawn) == 600 and len(hair.control) < 600 and hair.head.triangles.shape[1] == 3
    assert cuticle.make_head().spheres.shape[1] == 4


def test_Groom_Pickled_IsTheSame():
    groom = cuticle.make_groom(numpy.random.default_rng(4).random((3, 5, 3)), root_uv=numpy.ones((3, 2)), strand_attributes={"shade": [1, 2, 3]},
                               vertex_attributes={"width": numpy.arange(15)})
    again = pickle.loads(pickle.dumps(groom))
    for name in ("positions", "offsets", "radii", "root_uv"):
        assert numpy.array_equal(getattr(again, name), getattr(groom, name))
    assert {name: values.tolist() for name, values in again.attributes.items()} == {name: values.tolist() for name, values in groom.attributes.items()}


def test_MakeCards_OfAGroom_AreThoseOfTheProgram(tmp_path):
    hair = cuticle.grow(share=0.01)
    cards = cuticle.make_cards(hair, {"cards": 20, "texture_width": 16, "texture_height": 32}, head=cuticle.make_head().mesh)
    assert cards.mesh.positions.shape == (len(cards.occlusion), 3) and cards.uv.shape == (len(cards.occlusion), 2)
    assert cards.mesh.triangles.max() < len(cards.occlusion) and 0 < cards.report["cards"] <= 20
    assert set(cards.textures) == {"base", "shift", "mask", "alpha"} and cards.textures["alpha"].shape == tuple(cards.report["texture_px"][::-1])
    assert 0 <= cards.occlusion.min() < cards.occlusion.max() <= 1 and 0.1 < cards.textures["alpha"].mean() <= 1
    cards.write(tmp_path / "cards")
    lines = (tmp_path / "cards/cards.obj").read_text().splitlines()
    written = numpy.array([line.split()[1:4] for line in lines if line.startswith("v ")], numpy.float32)
    assert numpy.array_equal(written, cards.mesh.positions)
    with pytest.raises(cuticle.Error, match="cardz"):
        cuticle.make_cards(hair, {"cardz": 20})
