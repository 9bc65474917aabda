#!/usr/bin/env python3
"""Writes shoulders.obj, neck, shoulders and chest under the procedural head as one closed surface of elliptic rings."""
import math
from pathlib import Path

SECTORS = 40
# height, half the width, half the depth, middle of the depth; metres
RINGS = (
    (0.030, 0.050, 0.052, -0.015),
    (-0.010, 0.050, 0.052, -0.018),
    (-0.035, 0.058, 0.056, -0.020),
    (-0.055, 0.085, 0.062, -0.020),
    (-0.072, 0.130, 0.068, -0.018),
    (-0.090, 0.172, 0.076, -0.015),
    (-0.115, 0.198, 0.086, -0.010),
    (-0.150, 0.206, 0.096, -0.006),
    (-0.220, 0.196, 0.106, 0.000),
    (-0.340, 0.170, 0.108, 0.004),
)


def obj():
    lines = ["# made by make_shoulders.py"]
    for y, width, depth, middle in RINGS:
        for s in range(SECTORS):
            angle = 2 * math.pi * s / SECTORS
            lines.append(f"v {width * math.sin(angle):.5f} {y:.5f} {middle + depth * math.cos(angle):.5f}")
    for ring in range(len(RINGS) - 1):
        for s in range(SECTORS):
            near, far = ring * SECTORS + 1, (ring + 1) * SECTORS + 1
            lines.append(f"f {near + s} {far + s} {far + (s + 1) % SECTORS} {near + (s + 1) % SECTORS}")
    last = (len(RINGS) - 1) * SECTORS
    lines.append("f " + " ".join(str(s + 1) for s in range(SECTORS)))
    lines.append("f " + " ".join(str(last + SECTORS - s) for s in range(SECTORS)))
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    (Path(__file__).parent / "shoulders.obj").write_text(obj())
