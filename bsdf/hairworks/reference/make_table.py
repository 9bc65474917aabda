"""Writes hairworks.csv: S with 40 digits by mpmath, from vectors: highlights by the angles to the tangent, diffuse by both normals."""
import csv
import pathlib
import random

from mpmath import acos, cos, mp, mpf, nstr, pi, sin, sqrt

mp.dps = 40


def direction(theta, phi):
    return sin(theta), cos(theta) * cos(phi), cos(theta) * sin(phi)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def diffuse(theta_i, theta_o, phi, color, share, normal_theta, normal_phi):
    tangent, light = (1, 0, 0), direction(theta_i, -phi)
    of_tangent = sqrt(1 - dot(tangent, light) ** 2)
    of_normal = max(mpf(0), dot(direction(normal_theta, normal_phi), light))
    return color * (of_tangent * (1 - share) + of_normal * share)


def highlight(theta_i, theta_o, phi, color, exponent, shift):
    tangent = (1, 0, 0)
    to_light, to_viewer = acos(dot(tangent, direction(theta_i, -phi))), acos(dot(tangent, direction(theta_o, 0)))
    c = cos(pi - to_light - to_viewer - shift)
    return color * c ** exponent if c > 0 else mpf(0)


def rows():
    rng = random.Random(2014)
    for exponent in ("1", "60", "4000"):
        for width, shift, share in (("1", "0", "0"), ("2", "0.1", "0.5"), ("5", "-0.4", "1")):
            for _ in range(8):
                theta_o, phi = mpf(rng.uniform(-1.5, 1.5)), mpf(rng.uniform(-3, 3))
                theta_i = mpf(float(-theta_o) + rng.uniform(-3, 3) * float(width) / float(exponent) ** 0.5)
                if abs(theta_i) >= pi / 2:
                    continue
                settings = (f"root_color=0.5;tip_color=0.5;specular_color=0.25;exponent={exponent};secondary_scale=0.5;secondary_width={width};"
                            f"secondary_shift={shift};diffuse_blend={share};normal_theta=0.5;normal_phi=-0.7")
                at = theta_i, theta_o, phi
                yield settings, 0, *at, diffuse(*at, mpf("0.5"), mpf(share), mpf("0.5"), mpf("-0.7"))
                yield settings, 1, *at, highlight(*at, mpf("0.25"), mpf(exponent), 0)
                yield settings, 2, *at, highlight(*at, mpf("0.125"), mpf(exponent) / mpf(width) ** 2, mpf(shift))


if __name__ == "__main__":
    with open(pathlib.Path(__file__).parent / "hairworks.csv", "w", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(["settings", "lobe", "theta_i", "theta_o", "phi", "s"])
        for settings, lobe, *numbers in rows():
            writer.writerow([settings, lobe, *(nstr(number, 20) for number in numbers)])
