"""Writes scattering.csv: S, M, N and A of Karis 2016 over the domain with 50 digits by mpmath, from the formulas of the course notes with
vectors in place of the library's half angles."""
import csv
import pathlib
import random

from mpmath import asin, cos, exp, matrix, mp, mpf, nstr, pi, sin, sqrt

mp.dps = 50
F0 = ((1 - mpf("1.55")) / (1 + mpf("1.55"))) ** 2


def gaussian(width, x):
    return exp(-x ** 2 / (2 * width ** 2)) / (width * sqrt(2 * pi))


def schlick(cosine):
    return F0 + (1 - F0) * (1 - cosine) ** 5


def root(x):
    return sqrt(x) if x > 0 else mpf(0)


class Hair:
    def __init__(self, color, roughness, shift):
        self.color = mpf(color)
        self.widths = [mpf(roughness) ** 2 * f for f in (mpf(1), mpf(1) / 2, mpf(2))]
        self.shifts = [mpf(shift) * f for f in (-2, 1, 4)]

    def longitudinal(self, p, theta_i, theta_o):
        return gaussian(self.widths[p], sin(theta_i) + sin(theta_o) - self.shifts[p])

    def attenuation(self, p, cos_d, h):
        if p == 0:
            return schlick(cos_d * root(1 - h ** 2))
        if p == 2:
            f = schlick(cos_d / 2)
            return (1 - f) ** 2 * f * self.color ** (mpf("0.8") / cos_d)
        a = 1 / (mpf("1.19") / cos_d + mpf("0.36") * cos_d)
        f = schlick(cos_d * root(1 - h ** 2))
        return (1 - f) ** 2 * self.color ** (root(1 - (h * a) ** 2) / (2 * cos_d))

    def azimuthal(self, p, theta_i, theta_o, phi):
        light = matrix([sin(theta_i), cos(theta_i), 0])
        viewer = matrix([sin(theta_o), cos(theta_o) * cos(phi), cos(theta_o) * sin(phi)])
        cos_d = cos((theta_o - theta_i) / 2)
        cos_half = sqrt((1 + cos(phi)) / 2)
        if p == 0:
            between = sum(light[k] * viewer[k] for k in range(3))
            return cos_half / 4 * schlick(sqrt((1 + between) / 2))
        if p == 2:
            return self.attenuation(2, cos_d, 0) * exp(17 * cos(phi) - mpf("16.78"))
        a = 1 / (mpf("1.19") / cos_d + mpf("0.36") * cos_d)
        h = (1 + a * (mpf("0.6") - mpf("0.8") * cos(phi))) * cos_half
        return self.attenuation(1, cos_d, h) * exp(-mpf("3.65") * cos(phi) - mpf("3.98"))


def rows():
    generator = random.Random(2016)
    right = 89.9 * 3.141592653589793 / 180
    for k in range(180):
        color, roughness, shift = generator.uniform(0, 1), generator.uniform(0.04, 1), generator.uniform(-0.17, 0.17)
        hair, p = Hair(color, roughness, shift), k % 3
        theta_o = generator.uniform(-right, right)
        sine = float(-sin(mpf(theta_o)) + hair.shifts[p] + hair.widths[p] * generator.uniform(-4, 4))
        theta_i = float(asin(mpf(min(max(sine, -0.9999), 0.9999))))
        theta_d, phi, h = generator.uniform(-right, right), generator.uniform(-3.14, 3.14), generator.uniform(-1, 1)
        settings = [repr(color), repr(roughness), repr(shift), str(p)]
        place = [mpf(theta_i), mpf(theta_o), mpf(phi)]
        m = hair.longitudinal(p, place[0], place[1])
        values = {"S": m * hair.azimuthal(p, *place), "M": m, "N": hair.azimuthal(p, -mpf(theta_d), mpf(theta_d), mpf(phi)),
                  "A": hair.attenuation(p, cos(mpf(theta_d)), mpf(h))}
        for quantity, value in values.items():
            yield [*settings, quantity, repr(theta_i), repr(theta_o), repr(theta_d), repr(phi), repr(h), nstr(value, 25)]


if __name__ == "__main__":
    with open(pathlib.Path(__file__).parent / "scattering.csv", "w", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(["color", "roughness", "shift", "lobe", "quantity", "theta_i", "theta_o", "theta_d", "phi", "h", "value"])
        writer.writerows(rows())
