"""Damaged and missing input: a clear error with its exit code, no crash, nothing left behind."""
import json
import struct

import pytest

from program import ROOT, refused

HAIR_HEADER = "<4sIIIIffffff88s"


def hair_file(strands, points, bits=2, body=b"", segments=1):
    header = b"HAIR" + struct.pack("<III", strands, points, bits) + struct.pack("<Iff3f", segments, 0.1, 0.0, 1.0, 1.0, 1.0)
    return header.ljust(128, b"\0") + body


def line_of(*numbers):
    return struct.pack(f"<{len(numbers)}f", *numbers)


@pytest.mark.parametrize("name,content,words", [
    ("empty.hair", b"", ["empty.hair"]),
    ("short.hair", b"HAIR\1\0", ["short.hair"]),
    ("magic.hair", b"HARE".ljust(128, b"\0"), ["magic.hair", "HAIR"]),
    ("zero.hair", hair_file(0, 0), ["zero.hair"]),
    ("lying.hair", hair_file(1000, 2000, body=line_of(0, 0, 0)), ["lying.hair", "2000"]),
    ("huge.hair", hair_file(0xFFFFFFFF, 0xFFFFFFFF), ["huge.hair"]),
    ("nan.hair", hair_file(1, 2, body=line_of(0, 0, 0, 0, float("nan"), 0)), ["nan.hair"]),
    ("one_point.hair", hair_file(1, 1, body=line_of(0, 0, 0), segments=0), ["one_point.hair"]),
    ("short.tfx", struct.pack("<fII", 3.0, 5, 16), ["short.tfx"]),
    ("huge.tfx", struct.pack("<f4I", 4.0, 0xFFFFFFFF, 0xFFFFFFFF, 160, 0).ljust(160, b"\0"), ["huge.tfx"]),
    ("unknown.xyz", b"data", ["unknown.xyz", ".hair"]),
    ("two_points.ply", b"ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n1 1 1\n",
     ["two_points.ply", "strands"]),
    ("empty.npz", b"PK\5\6".ljust(22, b"\0"), ["empty.npz", "positions"]),
    ("huge.data", struct.pack("<II", 0xFFFFFFFF, 2), ["huge.data", "4294967295"]),
])
def test_Groom_Damaged_IsRefusedByName(tmp_path, name, content, words):
    path = tmp_path / name
    path.write_bytes(content)
    message = refused(3, "info", path)
    for word in words:
        assert word in message


def test_Groom_Missing_IsRefusedByName():
    assert "nowhere.hair" in refused(3, "info", "nowhere.hair")


def test_Convert_DamagedInput_LeavesNoOutput(tmp_path):
    (tmp_path / "bad.hair").write_bytes(b"HAIR")
    refused(3, "convert", tmp_path / "bad.hair", tmp_path / "out.hair")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["bad.hair"]


def scene_with(tmp_path, change):
    scene = json.loads((ROOT / "scenes/demo.json").read_text())
    for key in ("motion", "groom"):  # files beside the scene
        scene.pop(key, None)
    change(scene)
    path = tmp_path / "scene.json"
    path.write_text(json.dumps(scene))
    return path


def test_Scene_UnknownKey_NamesItAndTheNearest(tmp_path):
    path = scene_with(tmp_path, lambda s: s.update(lihgts=[]))
    message = refused(3, "plan", path)
    assert "lihgts" in message and "lights" in message and "scene.json" in message


def test_Scene_MissingGroom_NamesTheFile(tmp_path):
    path = scene_with(tmp_path, lambda s: s.update(groom={"file": "gone.hair"}))
    message = refused(3, "plan", path)
    assert "gone.hair" in message


def test_Scene_NotJson_NamesTheOffset(tmp_path):
    path = tmp_path / "scene.json"
    path.write_text('{"schema_version": 1,')
    assert "scene.json" in refused(3, "plan", path)


def test_Scene_ValueOutOfRange_NamesKeyAndRange(tmp_path):
    path = scene_with(tmp_path, lambda s: s.update(strand_vertices=1000))
    message = refused(3, "plan", path)
    assert "strand_vertices" in message and "256" in message


def test_Device_Absurd_IsNoDevice(tmp_path):
    message = refused(4, "bake", "--model", "marschner", "--layout", "nalu", "--size", "16", "--on", "gpu", "--device", "no such device",
                      "--out", tmp_path / "lut")
    assert "no such device" in message


def test_Bake_BadSize_IsRefusedWithTheRange(tmp_path):
    message = refused(2, "bake", "--model", "marschner", "--layout", "nalu", "--size", "5000", "--out", tmp_path / "lut")
    assert "5000" in message and "1024" in message
    assert not (tmp_path / "lut/manifest.json").exists()
