#!/usr/bin/env python3
"""Writes ear_fins.obj, two fans of rays that stand behind the ears of the procedural head, and ear_fins.png, the weight
map painted over their texture coordinates: u along the root, v from root (bottom, black: rigid) to tip (top, white)."""
import math
import struct
import zlib
from pathlib import Path

RAYS, ROWS, LENGTH = 13, 10, 0.13  # metres
ROOT = ((0.069, 0.072, -0.004), (0.066, 0.158, -0.040))  # within the ear's root, so that no gap shows
LEAN = (0.80, 0.0, -0.60)  # outwards and backwards
SIZE = 64


def place(side, u, v):
    """A fan about the root line: rays from 50 degrees below to 60 above, longest in the middle, folded like a fan."""
    angle = math.radians(-50 + 110 * u)
    reach = v * LENGTH * (0.7 + 0.3 * math.sin(math.pi * u))
    fold = 0.004 * v * math.cos(math.pi * u * (RAYS - 1))
    x, y, z = (a + (b - a) * u for a, b in zip(*ROOT))
    return (
        side * (x + LEAN[0] * math.cos(angle) * reach + 0.6 * fold),
        y + math.sin(angle) * reach,
        z + LEAN[2] * math.cos(angle) * reach + 0.8 * fold,
    )


def weight(u, v):
    """0 within a tenth of the root, 1 at the tip; every second ray is a stiffer spine."""
    along = min(max((v - 0.1) / 0.9, 0), 1)
    spine = 0.5 + 0.5 * math.cos(math.pi * u * (RAYS - 1))
    return along * along * (3 - 2 * along) * (1 - 0.3 * spine * (1 - along))


def obj():
    lines = ["# made by make_fins.py"]
    grid = [(c / (RAYS - 1), r / (ROWS - 1)) for c in range(RAYS) for r in range(ROWS)]
    for side in (1, -1):
        lines += ["v %.5f %.5f %.5f" % place(side, u, v) for u, v in grid]
    lines += ["vt %.5f %.5f" % uv for uv in grid]
    for side in (0, 1):
        for c in range(RAYS - 1):
            for r in range(ROWS - 1):
                corner = [c * ROWS + r, c * ROWS + r + 1, (c + 1) * ROWS + r + 1, (c + 1) * ROWS + r]
                if side:
                    corner.reverse()
                lines.append("f " + " ".join(f"{side * RAYS * ROWS + k + 1}/{k + 1}" for k in corner))
    return "\n".join(lines) + "\n"


def png():
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    rows = b""
    for y in range(SIZE):
        v = 1 - (y + 0.5) / SIZE
        rows += b"\0" + bytes(round(255 * weight((x + 0.5) / SIZE, v)) for x in range(SIZE))
    header = struct.pack(">IIBBBBB", SIZE, SIZE, 8, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")


if __name__ == "__main__":
    here = Path(__file__).parent
    (here / "ear_fins.obj").write_text(obj())
    (here / "ear_fins.png").write_bytes(png())
