"""NPZ archives with a member above 4 GiB, written with a hole."""
import os
import struct
import zipfile
import zlib

import pytest

from program import refused, run
from test_boundary import groom


def zip64(path, members, big_name, big_begin, big_bytes, crc):
    """Stored members, and one of `big_begin` and zeros up to `big_bytes`, which take no room on the disk."""
    directory = b""
    def entry(name, offset, size, check):
        nonlocal directory
        big = size > 0xFFFFFFFE or offset > 0xFFFFFFFE
        extra = struct.pack("<HHQQQ", 1, 24, size, size, offset) if big else b""
        shown, at = (0xFFFFFFFF, 0xFFFFFFFF) if big else (size, offset)
        directory += struct.pack("<IHHHHHHIIIHHHHHII", 0x02014B50, 45, 45, 0, 0, 0, 33, check, shown, shown, len(name), len(extra), 0, 0, 0,
                                 0, at) + name + extra
        local = struct.pack("<HHQQ", 1, 16, size, size) if big else b""
        return struct.pack("<IHHHHHIIIHH", 0x04034B50, 45, 0, 0, 0, 33, check, shown, shown, len(name), len(local)) + name + local
    with open(path, "wb") as file:
        for name, data in members.items():
            file.write(entry(name.encode(), file.tell(), len(data), zlib.crc32(data)) + data)
        begin = file.tell()
        file.write(entry(big_name.encode(), begin, big_bytes, crc) + big_begin)
        file.seek(big_bytes - len(big_begin), os.SEEK_CUR)
        at, count = file.tell(), len(members) + 1
        end = struct.pack("<IQHHIIQQQQ", 0x06064B50, 44, 45, 45, 0, 0, count, count, len(directory), at)
        file.write(directory + end + struct.pack("<IIQI", 0x07064B50, 0, at + len(directory), 1) +
                   struct.pack("<IHHHHIIH", 0x06054B50, 0, 0, 0xFFFF, 0xFFFF, 0xFFFFFFFF, 0xFFFFFFFF, 0))


def groom_with_a_large_member(tmp_path):
    """A groom with an array that it has no use for, of 4 GiB and some."""
    assert run("convert", groom(tmp_path / "m.hair"), tmp_path / "m.npz").returncode == 0
    with zipfile.ZipFile(tmp_path / "m.npz") as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    numbers = (1 << 29) + 16
    header = f"{{'descr': '<f8', 'fortran_order': False, 'shape': ({numbers},), }}".ljust(117) + "\n"
    begin = b"\x93NUMPY\1\0" + struct.pack("<H", len(header)) + header.encode()
    size, crc, zeros = len(begin) + 8 * numbers, zlib.crc32(begin), bytes(1 << 24)
    if os.environ.get("CUTICLE_SWEEPS"):  # what is refused is not checked
        for at in range(len(begin), size, len(zeros)):
            crc = zlib.crc32(zeros[:min(len(zeros), size - at)], crc)
    zip64(tmp_path / "large.npz", members, "unused.npy", begin, size, crc)
    assert (tmp_path / "large.npz").stat().st_blocks < 10000, "a file with a hole"
    return tmp_path / "large.npz", size


def test_Npz_MemberAbove4GiB_IsRefusedByItsSizeAndTheMemoryAllowed(tmp_path):
    path, size = groom_with_a_large_member(tmp_path)
    message = refused(3, "--max-memory", "1G", "info", path)
    assert f"unused.npy needs {size >> 20} MiB" in message or f"{(size >> 20) + 1} MiB" in message, message


@pytest.mark.skipif(not os.environ.get("CUTICLE_SWEEPS"), reason="takes 7 GiB of memory: scripts/test.sh --full")
def test_Npz_MemberAbove4GiB_IsRead(tmp_path):
    path, _ = groom_with_a_large_member(tmp_path)
    done = run("--max-memory", "16G", "info", path, timeout=600)
    assert done.returncode == 0 and "strands" in done.stdout, done.stderr
