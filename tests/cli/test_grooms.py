"""Groom files that other writers made (NumPy, struct, usd-core), read, converted and mended from the command line."""
import base64
import json
import struct
import zlib

import numpy
import pytest
from program import refused, run

STRANDS, POINTS = 7, 5
POSITIONS = (numpy.arange(STRANDS)[:, None, None] * [0.03, 0, 0] + numpy.arange(POINTS)[None, :, None] * [0, 0.05, 0.001]).astype(numpy.float32)


def info(path, *options):
    done = run("info", path, "--json", *options)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def convert(source, target, *options):
    done = run("convert", source, target, "--metres-per-unit", "1", *options)
    assert done.returncode == 0, done.stderr
    return done.stderr


def check_counts_and_lengths(path):
    found = info(path, "--metres-per-unit", "1")
    assert (found["strands"], found["vertices"]) == (STRANDS, STRANDS * POINTS)
    length = numpy.linalg.norm(numpy.diff(POSITIONS[0], axis=0), axis=1).sum()
    assert found["length_m"]["min"] == pytest.approx(length, rel=1e-6) and found["length_m"]["max"] == pytest.approx(length, rel=1e-6)
    return found


def save(name, path):
    """One of the layouts in which strands are passed around, without this program."""
    if name == "positions.npz":
        numpy.savez_compressed(path, positions=POSITIONS, names=numpy.array(["a"], dtype=object))
    elif name == "double.npy":
        numpy.save(path, POSITIONS.astype(numpy.float64))
    elif name == "offsets.npz":
        numpy.savez(path, offsets=numpy.arange(0, STRANDS * POINTS + 1, POINTS), positions=POSITIONS.reshape(-1, 3),
                    radii=numpy.full(STRANDS * POINTS, 4e-5, dtype=numpy.float16))
    elif name == "salon.data":
        path.write_bytes(struct.pack("<i", STRANDS) + b"".join(struct.pack("<i", POINTS) + strand.tobytes() for strand in POSITIONS))
    elif name == "big_endian.ply":
        header = f"ply\nformat binary_big_endian 1.0\nelement vertex {STRANDS * POINTS}\n" + "".join(f"property float {c}\n" for c in "xyz")
        segments = f"element strand {STRANDS}\nproperty ushort nsegs\nend_header\n"
        path.write_bytes((header + segments).encode() + POSITIONS.astype(">f4").tobytes() + numpy.full(STRANDS, POINTS - 1, ">u2").tobytes())
    elif name == "curves.txt":
        path.write_text("\n".join("".join(f"{x} {y} {z} 4e-5\n" for x, y, z in strand) for strand in POSITIONS))


@pytest.mark.parametrize("name", ["positions.npz", "double.npy", "offsets.npz", "salon.data", "big_endian.ply", "curves.txt"])
def test_FileOfAnotherWriter_IsRead(tmp_path, name):
    save(name, tmp_path / name)
    check_counts_and_lengths(tmp_path / name)


@pytest.mark.parametrize("extension", ["hair", "tfx", "data", "ply", "npz", "pbrt", "curves", "usda", "vtp"])
def test_Convert_ToEveryFormatAndBack_KeepsCountsAndLengths(tmp_path, extension):
    save("positions.npz", tmp_path / "a.npz")
    convert(tmp_path / "a.npz", tmp_path / f"b.{extension}")
    check_counts_and_lengths(tmp_path / f"b.{extension}")


def vtp_array(name, kind, values, layout, width, compress, appended):
    """A DataArray as VTK's writers lay it out; what is appended goes to the list."""
    raw = values.tobytes()
    count = {4: "<I", 8: "<Q"}[width]
    if compress:
        blocks = [raw[i:i + 64] for i in range(0, len(raw), 64)]
        packed = [zlib.compress(block) for block in blocks]
        last = len(blocks[-1]) % 64
        header = b"".join(struct.pack(count, n) for n in [len(blocks), 64, last, *map(len, packed)])
        data = base64.b64encode(header) + base64.b64encode(b"".join(packed)) if layout != "raw" else header + b"".join(packed)
    else:
        data = struct.pack(count, len(raw)) + raw
        data = base64.b64encode(data) if layout != "raw" else data
    attributes = f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{3 if name == "Points" else 1}"'
    if layout == "binary":
        return f'{attributes} format="binary">\n  {data.decode()}\n</DataArray>'
    offset = sum(map(len, appended))
    appended.append(data)
    return f'{attributes} format="appended" offset="{offset}"/>'


def save_vtp(path, layout, width, compress):
    appended = []
    def array(*fields):
        return vtp_array(*fields, layout, width, compress, appended)
    points = array("Points", "Float64", POSITIONS.reshape(-1, 3).astype(numpy.float64))
    heat = array("heat", "UInt8", numpy.arange(STRANDS * POINTS, dtype=numpy.uint8))
    lines = array("connectivity", "Int64", numpy.arange(STRANDS * POINTS)) + \
        array("offsets", "Int32", numpy.arange(POINTS, STRANDS * POINTS + 1, POINTS, dtype=numpy.int32))
    compressor = ' compressor="vtkZLibDataCompressor"' if compress else ""
    text = f'<VTKFile type="PolyData" byte_order="LittleEndian" header_type="UInt{8 * width}"{compressor}><PolyData>' \
        f'<Piece NumberOfPoints="{STRANDS * POINTS}" NumberOfLines="{STRANDS}"><PointData>{heat}</PointData>' \
        f'<Points>{points}</Points><Lines>{lines}</Lines></Piece></PolyData>'
    if appended:
        text += f'<AppendedData encoding="{"raw" if layout == "raw" else "base64"}">\n   _'
    path.write_bytes(text.encode() + b"".join(appended) + (b"\n</AppendedData>" if appended else b"") + b"</VTKFile>")


@pytest.mark.parametrize("compress", [False, True])
@pytest.mark.parametrize("width", [4, 8])
@pytest.mark.parametrize("layout", ["binary", "base64", "raw"])
def test_Vtp_InEveryEncodingOfVtk_IsRead(tmp_path, layout, width, compress):
    save_vtp(tmp_path / "a.vtp", layout, width, compress)
    check_counts_and_lengths(tmp_path / "a.vtp")
    convert(tmp_path / "a.vtp", tmp_path / "b.npz")
    with numpy.load(tmp_path / "b.npz") as file:
        assert numpy.array_equal(file["positions"].reshape(STRANDS, POINTS, 3), POSITIONS)
        assert file["vertex_heat"].tolist() == list(range(STRANDS * POINTS))


def test_Vtp_DamagedOrOfAnotherKind_IsRefusedByName(tmp_path):
    path = tmp_path / "a.vtp"
    save_vtp(path, "raw", 8, True)
    whole = path.read_bytes()
    path.write_bytes(whole[:-150])
    assert "cut short or damaged" in refused(3, "info", path)
    path.write_bytes(whole.replace(b"vtkZLib", b"vtkLZMA"))
    assert "vtkLZMADataCompressor" in refused(3, "info", path)
    path.write_bytes(whole.replace(b"LittleEndian", b"BigEndian"))
    assert "byte_order 'BigEndian'" in refused(3, "info", path)


def test_Npz_Written_NumPyReads(tmp_path):
    save("positions.npz", tmp_path / "a.npz")
    convert(tmp_path / "a.npz", tmp_path / "b.npz", "--radius", "5e-5")
    with numpy.load(tmp_path / "b.npz") as file:
        assert numpy.array_equal(file["positions"].reshape(STRANDS, POINTS, 3), POSITIONS)
        assert file["offsets"].tolist() == list(range(0, STRANDS * POINTS + 1, POINTS))
        assert file["radii"] == pytest.approx(5e-5)


def test_ObjectArray_IsNamedAndNeverRun(tmp_path):
    numpy.savez(tmp_path / "a.npz", strands=numpy.array([[1], [2, 3]], dtype=object))
    assert "'strands': descr" in refused(3, "info", tmp_path / "a.npz")


def test_Usda_Written_UsdReads(tmp_path):
    pxr = pytest.importorskip("pxr.UsdGeom", reason="usd-core is not installed")
    from pxr import Usd
    save("positions.npz", tmp_path / "a.npz")
    convert(tmp_path / "a.npz", tmp_path / "b.usda", "--radius", "5e-5", "--output-metres-per-unit", "0.01")
    stage = Usd.Stage.Open(str(tmp_path / "b.usda"))
    curves = pxr.BasisCurves(stage.GetPrimAtPath("/groom/strands"))
    assert pxr.GetStageMetersPerUnit(stage) == 0.01
    assert list(curves.GetCurveVertexCountsAttr().Get()) == [POINTS] * STRANDS
    assert numpy.array(curves.GetPointsAttr().Get()) == pytest.approx(POSITIONS.reshape(-1, 3) * 100, rel=1e-6, abs=1e-6)
    assert curves.GetWidthsAttr().Get()[0] == pytest.approx(0.01) and curves.GetWidthsInterpolation() == "vertex"
    assert list(pxr.PrimvarsAPI(curves).GetPrimvar("groom_id").Get()) == list(range(STRANDS))


def test_UsdBinary_OfAnotherWriter_IsReadAndWritten(tmp_path):
    pxr = pytest.importorskip("pxr.UsdGeom", reason="usd-core is not installed")
    from pxr import Usd
    stage = Usd.Stage.CreateNew(str(tmp_path / "a.usdc"))
    pxr.SetStageMetersPerUnit(stage, 1)
    curves = pxr.BasisCurves.Define(stage, "/hair")
    curves.CreateTypeAttr("linear")
    curves.CreateCurveVertexCountsAttr([POINTS] * STRANDS)
    curves.CreatePointsAttr(POSITIONS.reshape(-1, 3))
    curves.CreateWidthsAttr([8e-5])
    curves.SetWidthsInterpolation("constant")
    stage.Save()
    found = check_counts_and_lengths(tmp_path / "a.usdc")
    assert found["radius_m"]["max"] == pytest.approx(4e-5)
    convert(tmp_path / "a.usdc", tmp_path / "b.usdc")
    check_counts_and_lengths(tmp_path / "b.usdc")


def test_Repair_CountsWhatWasMended(tmp_path):
    damaged = POSITIONS.copy()
    damaged[2, 3] = numpy.nan
    damaged[4, 1] = damaged[4, 0]
    damaged[6] = damaged[6, 0]
    numpy.save(tmp_path / "a.npy", damaged)
    assert "point 13 is not finite" in refused(3, "info", tmp_path / "a.npy")
    found = info(tmp_path / "a.npy", "--repair", "--metres-per-unit", "1")
    assert found["repaired"] == {"points_not_finite": 1, "coincident_points": 5, "strands_of_one_point": 0,
                                 "strands_without_length": 1, "points_added": 2, "values_replaced": 0}
    assert found["strands"] == STRANDS - 1 and found["degenerate_strands"] == []
    convert(tmp_path / "a.npy", tmp_path / "b.tfx", "--repair")
    assert info(tmp_path / "b.tfx")["vertices"] == (STRANDS - 1) * POINTS


def test_Info_SaysWhatEnginesRefuse(tmp_path):
    save("positions.npz", tmp_path / "a.npz")
    refusals = {entry["engine"]: entry["what"] for entry in info(tmp_path / "a.npz")["refused_by"]}
    assert refusals == {"unity": "strands 7, allowed 64 .. 64000", "tressfx": "strands of 5 points, allowed 4, 8, 16, 32, 64"}
