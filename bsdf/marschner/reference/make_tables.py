"""Writes longitudinal.csv and azimuthal.csv: M, A and N of the corrected Marschner model with 40 digits by mpmath, written
from the paper's formulas and not from this library's: M with its exponentials apart, N by scanning phi(p, h) for its roots."""
import csv
import math
import pathlib

from mpmath import asin, besseli, cos, diff, exp, findroot, mp, mpf, pi, sin, sinh, sqrt

mp.dps = 40
FOLDER = pathlib.Path(__file__).parent
DEGREE = pi / 180


def longitudinal(beta, alpha, theta_i, theta_o):
    """d'Eon et al. 2011 for the R lobe; theta_o moved by twice the shift in theta_h; past a pole it folds back."""
    v = beta ** 2
    shifted = theta_o - 2 * alpha
    a = cos(theta_i) * abs(cos(shifted)) / v
    return exp(-sin(theta_i) * sin(shifted) / v) * besseli(0, a) / (2 * v * sinh(1 / v))


def fresnel(index, index_p, gamma_i, gamma_t):
    s = (cos(gamma_i) - index * cos(gamma_t)) / (cos(gamma_i) + index * cos(gamma_t))
    p = (index_p * cos(gamma_i) - cos(gamma_t)) / (index_p * cos(gamma_i) + cos(gamma_t))
    return (s ** 2 + p ** 2) / 2


class Fibre:
    def __init__(self, eta, sigma_a, theta_d):
        self.index = sqrt(eta ** 2 - sin(theta_d) ** 2) / cos(theta_d)
        self.index_p = eta ** 2 / self.index
        self.sigma = sigma_a / cos(asin(sin(theta_d) / eta))

    def attenuation(self, p, h):
        gamma_i, gamma_t = asin(h), asin(h / self.index)
        f = fresnel(self.index, self.index_p, gamma_i, gamma_t)
        return f if p == 0 else (1 - f) ** 2 * f ** (p - 1) * exp(-2 * p * self.sigma * cos(gamma_t))

    def exit_azimuth(self, p, h):
        return 2 * p * asin(h / self.index) - 2 * asin(h) + p * pi

    def roots(self, p, phi):
        """Every h with exit_azimuth = phi + 2 pi k: bracketed in double on a grid that is finer toward the edges."""
        grid = [math.sin(math.pi / 2 * i / 2000) for i in range(-2000, 2001)]
        index = float(self.index)
        azimuths = [2 * p * math.asin(h / index) - 2 * math.asin(h) + p * math.pi - float(phi) for h in grid]
        found = []
        for k in range(-2, 4):
            value = lambda h: self.exit_azimuth(p, h) - phi - 2 * pi * k
            for left, right, low, high in zip(grid, grid[1:], azimuths, azimuths[1:]):
                if (low - 2 * math.pi * k) * (high - 2 * math.pi * k) < 0:
                    found.append(findroot(value, (mpf(left), mpf(right)), solver="anderson"))
        return found

    def azimuthal(self, p, phi):
        return sum(self.attenuation(p, h) / abs(2 * diff(lambda x: self.exit_azimuth(p, x), h)) for h in self.roots(p, phi))


def write(name, header, rows):
    with open(FOLDER / name, "w", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(header)
        writer.writerows([[value if isinstance(value, str) else mp.nstr(value, 20) for value in row] for row in rows])


def longitudinal_rows():
    for beta in ("0.001", "0.01", "0.1", "0.2617993877991494", "1"):
        for alpha in ("0", "-0.125"):
            for theta_o in ("-1.5707", "-0.8", "0", "0.4", "1.5"):
                for widths in ("0", "1.5", "-4"):
                    b, a, o = mpf(beta), mpf(alpha), mpf(theta_o)
                    i = mpf(float(2 * a - o + mpf(widths) * b))
                    if abs(i) < pi / 2:
                        yield b, a, i, o, longitudinal(b, a, i, o)


def azimuthal_rows():
    for eta, theta_d_deg in (("1.55", 0), ("1.55", 30), ("1.55", 60), ("1.8", 20), ("1.3", 10), ("1.05", 0), ("3", 80)):
        fibre = Fibre(mpf(eta), mpf("0.2"), mpf(float(theta_d_deg * DEGREE)))
        for p in (0, 1, 2):
            for phi in ("0.013", "0.1", "0.3", "1", "1.7", "2.4", "3.1"):
                yield mpf(eta), mpf(float(theta_d_deg * DEGREE)), str(p), mpf(phi), fibre.azimuthal(p, mpf(phi))


if __name__ == "__main__":
    write("longitudinal.csv", ["beta", "alpha", "theta_i", "theta_o", "m"], longitudinal_rows())
    write("azimuthal.csv", ["eta", "theta_d", "lobe", "phi", "n"], azimuthal_rows())
