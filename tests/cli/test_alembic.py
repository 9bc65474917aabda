"""Alembic curves at the command line: our own read back, another writer's, Unreal's schema checked, damaged files refused."""
import json
import random

import numpy
import pytest
from program import refused, run

STRANDS, POINTS = 7, 4
POSITIONS = (numpy.arange(STRANDS)[:, None, None] * [0.03, 0, 0] + numpy.arange(POINTS)[None, :, None] * [0, 0.05, 0.001]).astype(numpy.float32)


@pytest.fixture(autouse=True)
def library():
    pytest.importorskip("alembic3d", reason="alembic3d is not installed")


def must(*arguments):
    done = run(*arguments)
    assert done.returncode == 0, done.stderr
    return done.stdout


def arrays(path):
    with numpy.load(path) as file:
        return {name: file[name] for name in file.files}


def whole_groom():
    numbers = numpy.random.default_rng(3)
    return {"offsets": numpy.arange(STRANDS + 1, dtype=numpy.uint32) * POINTS, "positions": POSITIONS.reshape(-1, 3),
            "radii": numbers.uniform(3e-5, 5e-5, STRANDS * POINTS).astype(numpy.float32), "root_uv": numbers.random((STRANDS, 2), numpy.float32),
            "root_triangle": numpy.arange(STRANDS, dtype=numpy.uint32), "root_barycentrics": numbers.random((STRANDS, 2), numpy.float32),
            "strand_guide": (numpy.arange(STRANDS) % 2).astype(numpy.float32), "strand_group_id": numpy.full(STRANDS, 3, numpy.float32),
            "strand_bone_weight": numbers.random((STRANDS, 4), numpy.float32), "vertex_color": numbers.random((STRANDS * POINTS, 3), numpy.float32)}


def test_Groom_ThroughAlembic_ComesBackWhole(tmp_path):
    wanted = whole_groom()
    numpy.savez(tmp_path / "a.npz", **wanted)
    must("convert", tmp_path / "a.npz", tmp_path / "a.abc", "--metres-per-unit", 1)
    must("convert", tmp_path / "a.abc", tmp_path / "b.npz")  # the file states its unit
    found = arrays(tmp_path / "b.npz")
    assert set(found) == set(wanted)
    for name, values in wanted.items():
        assert numpy.allclose(found[name], values, rtol=1e-6, atol=1e-9), name


def written(path, version=True, number_of_groups="Int32", scope="kUniformScope", name="groom_group_id", scale=0.01):
    """Curves by the library itself: a moved, scaled node, cubic curves, one width for all, an attribute."""
    import imath
    from alembic3d import Abc, AbcGeom
    archive = Abc.OArchive(str(path))
    node = AbcGeom.OXform(archive.getTop(), "node")
    if version:
        for each, value in (("groom_version_major", 1), ("groom_version_minor", 5)):
            Abc.OInt16Property(node.getSchema().getUserProperties(), each).setValue(value)
    placed = AbcGeom.XformSample()
    placed.setTranslation(imath.V3d(1 / scale, 0, 0))
    placed.setScale(imath.V3d(2, 2, 2))
    node.getSchema().set(placed)
    held = (imath.V3fArrayFromBuffer(numpy.ascontiguousarray(POSITIONS.reshape(-1, 3) / scale, numpy.float32)),
            imath.IntArrayFromBuffer(numpy.full(STRANDS, POINTS, numpy.int32)), imath.FloatArrayFromBuffer(numpy.array([8e-5 / scale], numpy.float32)))
    curves = AbcGeom.OCurves(node, "hair").getSchema()
    curves.set(AbcGeom.OCurvesSchemaSample(held[0], held[1], AbcGeom.CurveType.kCubic, AbcGeom.CurvePeriodicity.kNonPeriodic,
                                           AbcGeom.OFloatGeomParamSample(held[2], AbcGeom.GeometryScope.kConstantScope), AbcGeom.OV2fGeomParamSample(),
                                           AbcGeom.ON3fGeomParamSample(), AbcGeom.BasisType.kBezierBasis))
    kept = {"Int32": imath.IntArray, "Float": imath.FloatArray}[number_of_groups](STRANDS)
    for k in range(STRANDS):
        kept[k] = k
    where = getattr(AbcGeom.GeometryScope, scope)
    sample = getattr(AbcGeom, f"O{number_of_groups}GeomParamSample")(kept, where)
    getattr(AbcGeom, f"O{number_of_groups}GeomParam")(curves.getArbGeomParams(), name, False, where, 1).set(sample)


def test_BezierCurves_UnderAMovedNode_AreTheirJointsInPlace(tmp_path):
    written(tmp_path / "a.abc")
    must("convert", tmp_path / "a.abc", tmp_path / "b.npz", "--metres-per-unit", "0.01")
    found = arrays(tmp_path / "b.npz")
    assert numpy.allclose(found["positions"].reshape(STRANDS, 2, 3), 2 * POSITIONS[:, ::3] + [1, 0, 0], atol=1e-6)
    assert numpy.allclose(found["radii"], 8e-5) and (found["strand_group_id"] == numpy.arange(STRANDS)).all()


@pytest.mark.parametrize("mistake, words", [
    ({}, ""), ({"version": False}, "groom_version_major is not on the topmost node"), ({"number_of_groups": "Float"}, "groom_group_id is of float32, allowed int32"),
    ({"scope": "kVertexScope"}, "groom_group_id has the scope vertex, allowed constant, uniform"), ({"name": "groom_Group_ID"}, "names are in lower case"),
    ({"scale": 1}, "a unit is 1 cm")])
def test_UnrealsSchema_WithAMistake_NamesIt(tmp_path, mistake, words):
    written(tmp_path / "a.abc", **mistake)
    done = run("check", "groom", tmp_path / "a.abc", "--for", "unreal", "--metres-per-unit", mistake.get("scale", 0.01))
    refuses = [line for line in done.stdout.splitlines() if "refuses it" in line]
    assert len(refuses) == (2 if mistake.get("version") is False else bool(words)), done.stdout
    assert words in done.stdout and done.returncode == bool(words)


def test_UnrealsSchema_OfOurs_IsKeptAndWhatIsMissingIsSaid(tmp_path):
    numpy.savez(tmp_path / "a.npz", **whole_groom())
    must("convert", tmp_path / "a.npz", tmp_path / "a.abc", "--metres-per-unit", 1)
    done = run("check", "groom", tmp_path / "a.abc", "--for", "unreal", "--json")
    found = json.loads(done.stdout)
    assert not [each for each in found["refused_by"] if each["engine"] == "unreal"] and found["filled_in_by"] == []


def test_Damage_OfAlembic_IsRefusedInWords(tmp_path):
    written(tmp_path / "a.abc")
    whole, numbers = (tmp_path / "a.abc").read_bytes(), random.Random(1)
    (tmp_path / "b.abc").write_bytes(whole[:len(whole) // 2])
    assert "b.abc: Alembic cannot read or write it: it is no Alembic file, or a damaged one" in refused(3, "info", tmp_path / "b.abc")
    for _ in range(4):
        damaged = bytearray(whole)
        for _ in range(30):
            damaged[numbers.randrange(len(whole))] ^= 1 << numbers.randrange(8)
        (tmp_path / "c.abc").write_bytes(damaged)
        done = run("info", tmp_path / "c.abc")
        assert done.returncode in (0, 3) and "Traceback" not in done.stderr and (done.returncode == 0 or "c.abc" in done.stderr), done.stderr
    assert "must be above 0" in refused(2, "convert", tmp_path / "a.abc", tmp_path / "d.abc", "--output-metres-per-unit", "-1")


def test_Alembic_WithoutItsLibrary_SaysWhatToInstall(tmp_path, monkeypatch):
    written(tmp_path / "a.abc")
    monkeypatch.setenv("CUTICLE_PYTHON_EXE", "/usr/bin/false")
    for arguments in (["info", tmp_path / "a.abc"], ["grow", "--strands", "vertices=8", "--share", "0.01", "--out", tmp_path / "b.abc"]):
        assert "pip install alembic3d" in refused(3, *arguments)
    assert not (tmp_path / "b.abc").exists()
