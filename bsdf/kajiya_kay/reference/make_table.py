"""Writes kajiya_kay.csv: S with 40 digits by mpmath, from vectors and angles between them as Kajiya and Kay 1989 have them."""
import csv
import pathlib
import random

from mpmath import acos, cos, mp, mpf, nstr, pi, sin

mp.dps = 40


def direction(theta, phi):
    return sin(theta), cos(theta) * cos(phi), cos(theta) * sin(phi)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def diffuse(theta_i, theta_o, phi, color):
    """K_d sin(t, l)."""
    tangent, light = (1, 0, 0), direction(theta_i, -phi)
    return color * sin(acos(dot(tangent, light)))


def specular(theta_i, theta_o, phi, color, exponent):
    """K_s cos^p of the angle between the viewer and the cone whose angle to the tangent is pi minus the light's."""
    tangent = (1, 0, 0)
    to_light, to_viewer = acos(dot(tangent, direction(theta_i, -phi))), acos(dot(tangent, direction(theta_o, 0)))
    c = cos(to_viewer - (pi - to_light))
    return color * c ** exponent if c > 0 else mpf(0)


def rows():
    rng = random.Random(1989)
    for exponent in ("1", "2.5", "25", "1000", "1e+06"):
        for _ in range(14):
            theta_o = mpf(rng.uniform(-1.57, 1.57))
            theta_i = mpf(float(-theta_o + mpf(rng.uniform(-4, 4)) / mp.sqrt(mpf(exponent))))
            if abs(theta_i) >= pi / 2:
                continue
            phi = mpf(rng.uniform(-3.14, 3.14))
            settings = f"diffuse=0.5;specular=0.25;exponent={exponent}"
            yield settings, 0, theta_i, theta_o, phi, diffuse(theta_i, theta_o, phi, mpf("0.5"))
            yield settings, 1, theta_i, theta_o, phi, specular(theta_i, theta_o, phi, mpf("0.25"), mpf(exponent))


if __name__ == "__main__":
    with open(pathlib.Path(__file__).parent / "kajiya_kay.csv", "w", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(["settings", "lobe", "theta_i", "theta_o", "phi", "s"])
        for settings, lobe, *numbers in rows():
            writer.writerow([settings, lobe, *(nstr(number, 20) for number in numbers)])
