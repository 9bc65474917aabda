"""Writes azimuthal.csv (N of the four lobes) and non_separable.csv (M of the R lobe of 2014) with 25 digits by mpmath,
from the papers' formulas: Snell and Fresnel in the fibre's own vectors, the Gaussian wrapped by adding images."""
import csv
import pathlib

from mpmath import asin, besseli, cos, exp, mp, mpf, pi, quad, sin, sinh, sqrt

mp.dps = 25
FOLDER = pathlib.Path(__file__).parent


def reflectance(eta, cosine):
    """Unpolarised light on a plane of index eta."""
    cosine_after = sqrt(1 - (1 - cosine ** 2) / eta ** 2)
    s = (cosine - eta * cosine_after) / (cosine + eta * cosine_after)
    p = (eta * cosine - cosine_after) / (eta * cosine + cosine_after)
    return (s ** 2 + p ** 2) / 2


class Fibre:
    def __init__(self, eta, sigma_a, theta):
        self.eta, self.sigma_a, self.theta = eta, sigma_a, theta
        self.sin_t = sin(theta) / eta
        self.bent = eta * sqrt(1 - self.sin_t ** 2) / cos(theta)

    def share(self, p, gamma):
        f = reflectance(self.eta, cos(self.theta) * cos(gamma))
        inside = cos(asin(sin(gamma) / self.bent))
        t = exp(-2 * self.sigma_a * inside / sqrt(1 - self.sin_t ** 2))
        if p == 0:
            return f
        return (1 - f) ** 2 * f ** 2 * t ** 3 / (1 - f * t) if p == 3 else (1 - f) ** 2 * f ** (p - 1) * t ** p

    def azimuth(self, p, gamma):
        return 2 * p * asin(sin(gamma) / self.bent) - 2 * gamma + p * pi

    def azimuthal(self, p, phi, sigma):
        if p == 3:
            return quad(lambda g: self.share(p, g) * cos(g), [-pi / 2, 0, pi / 2]) / 2 / (2 * pi)
        images = range(-5, 6) if sigma > 0.3 else range(-2, 3)

        def integrand(g):
            apart = phi - self.azimuth(p, g)
            density = sum(exp(-((apart + 2 * pi * k) / sigma) ** 2 / 2) for k in images) / (sigma * sqrt(2 * pi))
            return self.share(p, g) * cos(g) * density / 2

        count = max(8, int(3 / sigma))
        return quad(integrand, [pi * (mpf(k) / count - mpf(1) / 2) for k in range(count + 1)], maxdegree=5)


def azimuthal_rows():
    fibres = (("1.55", "0.2", "0"), ("1.55", "0.2", "0.9"), ("1.2", "0.2", "0.4"), ("2.5", "3", "1.4"), ("1.05", "0", "1.5"))
    for eta, sigma_a, theta in fibres:
        fibre = Fibre(mpf(eta), mpf(sigma_a), mpf(float(theta)))
        for beta_n in ("0.03", "0.3", "1"):
            for p, ratio in ((0, 1), (1, mpf(1) / 2), (2, 2), (3, 1)):
                for phi in ("0.1", "1.7", "3.1"):
                    yield eta, sigma_a, theta, beta_n, str(p), phi, fibre.azimuthal(p, mpf(float(phi)), mpf(float(beta_n)) * ratio)


def non_separable(beta, alpha, theta_i, theta_o, phi):
    """The lobe of 2011 about the direction mirrored by a scale that leans by alpha, with the variance 2 beta^2 cos^2(phi/2)."""
    v = 2 * beta ** 2 * cos(phi / 2) ** 2
    facing = cos(alpha) * cos(theta_o) * cos(phi / 2) + sin(alpha) * sin(theta_o)
    axis = asin(sin(theta_o) - 2 * sin(alpha) * facing)
    a = cos(theta_i) * cos(axis) / v
    return exp(-sin(theta_i) * sin(axis) / v) * besseli(0, a) / (2 * v * sinh(1 / v))


def non_separable_rows():
    for beta in ("0.01", "0.2", "1"):
        for alpha in ("0", "-0.05", "0.17"):
            for theta_o in ("-1.5", "0", "0.7"):
                for phi in ("0", "1.2", "2.9"):
                    for widths in (0, 1, -2):
                        b, a, o, f = mpf(float(beta)), mpf(float(alpha)), mpf(float(theta_o)), mpf(float(phi))
                        i = mpf(float(-o + 2 * a * cos(f / 2) + widths * b * cos(f / 2)))
                        if abs(i) < pi / 2:
                            yield beta, alpha, i, theta_o, phi, non_separable(b, a, i, o, f)
    # Thin, light and view near grazing: the sine of the axis differs from 1 by less than a float tells.
    beta, alpha, i, theta_o, phi = "0.002", "0.000632748176", mpf(-1.5657863), "1.57016118", "2.06854669"
    yield beta, alpha, i, theta_o, phi, non_separable(*(mpf(float(x)) for x in (beta, alpha, i, theta_o, phi)))


def write(name, header, rows):
    with open(FOLDER / name, "w", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(header)
        writer.writerows([[value if isinstance(value, str) else mp.nstr(value, 20) for value in row] for row in rows])


if __name__ == "__main__":
    write("non_separable.csv", ["beta_m", "alpha", "theta_i", "theta_o", "phi", "m"], non_separable_rows())
    write("azimuthal.csv", ["eta", "sigma_a", "theta_d", "beta_n", "lobe", "phi", "n"], azimuthal_rows())
