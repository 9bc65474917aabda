"""Writes scheuermann.csv: S with 40 digits by mpmath, from normalised vectors as the shader of Scheuermann 2004 has them."""
import csv
import pathlib
import random

from mpmath import cos, mp, mpf, nstr, pi, sin, sqrt

mp.dps = 40


def direction(theta, phi):
    return sin(theta), cos(theta) * cos(phi), cos(theta) * sin(phi)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def normalised(a):
    length = sqrt(dot(a, a))
    return tuple(x / length for x in a)


def saturate(x):
    return min(max(x, mpf(0)), mpf(1))


NORMAL = (0, 1, 0)  # in the fibre's normal plane, toward the viewer


def diffuse(theta_i, theta_o, phi, color):
    n_l = dot(NORMAL, direction(theta_i, -phi))
    return color * saturate(mpf("0.25") + (1 - mpf("0.25")) * n_l)


def highlight(theta_i, theta_o, phi, color, exponent, shift):
    half = normalised(tuple(a + b for a, b in zip(direction(theta_i, -phi), direction(theta_o, 0))))
    tangent = normalised(tuple(t + shift * n for t, n in zip((1, 0, 0), NORMAL)))
    t_h = dot(tangent, half)
    t = saturate(t_h + 1)
    return color * t * t * (3 - 2 * t) * sqrt(1 - t_h * t_h) ** exponent


def rows():
    rng = random.Random(2004)
    for exponent in ("1", "3.5", "80", "2000", "100000"):
        for shift, texel in (("0", "0.5"), ("0.3", "0.5"), ("-0.1", "0.75")):
            moved = mpf(shift) + mpf(texel) - mpf("0.5")
            for _ in range(8):
                theta_o, phi = mpf(rng.uniform(-1.5, 1.5)), mpf(rng.uniform(-2.5, 2.5))
                peak = float(-theta_o - 2 * mp.atan(moved * cos(phi / 2)))
                theta_i = mpf(peak + rng.uniform(-6, 6) / float(exponent) ** 0.5)
                if abs(theta_i) >= pi / 2:
                    continue
                settings = f"diffuse=0.5;primary=0.25;primary_exponent={exponent};primary_shift={shift};shift_texture={texel}"
                yield settings, 0, theta_i, theta_o, phi, diffuse(theta_i, theta_o, phi, mpf("0.5"))
                yield settings, 1, theta_i, theta_o, phi, highlight(theta_i, theta_o, phi, mpf("0.25"), mpf(exponent), moved)


if __name__ == "__main__":
    with open(pathlib.Path(__file__).parent / "scheuermann.csv", "w", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(["settings", "lobe", "theta_i", "theta_o", "phi", "s"])
        for settings, lobe, *numbers in rows():
            writer.writerow([settings, lobe, *(nstr(number, 20) for number in numbers)])
