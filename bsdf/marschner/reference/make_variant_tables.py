"""Writes variants.csv and domain.csv: the variants of the Marschner model (as printed, smoothed, elliptical), and the corrected M, N and A
drawn over the whole domain, with 50 digits by mpmath. Written from the paper's formulas: roots are bracketed on the monotone pieces of the
path's azimuth (the cubic's by mpmath's polynomial solver), no closed form of the library is used."""
import csv
import pathlib
import random

from mpmath import asin, besseli, cos, exp, findroot, mp, mpf, nstr, pi, polyroots, sin, sqrt

mp.dps = 50
FOLDER = pathlib.Path(__file__).parent
DEGREE = pi / 180


def fresnel(index, index_p, cos_i, cos_t):
    s = (cos_i - index * cos_t) / (cos_i + index * cos_t)
    p = (index_p * cos_i - cos_t) / (index_p * cos_i + cos_t)
    return (s ** 2 + p ** 2) / 2


def bell(x, width):
    return exp(-x ** 2 / (2 * width ** 2)) / (width * sqrt(2 * pi))


def short_way(x):
    return x - 2 * pi * mp.nint(x / (2 * pi))


class Path:
    """Paths of one order p through the normal plane of a fibre at one theta_d; gamma stands for gamma_i."""

    def __init__(self, eta, sigma_a, theta_d, p, printed=False):
        self.p, self.printed = p, printed
        self.index = sqrt(eta ** 2 - sin(theta_d) ** 2) / cos(theta_d)
        self.index_p = eta ** 2 / self.index
        self.sigma = sigma_a / sqrt(1 - (sin(theta_d) / eta) ** 2)
        c = asin(1 / self.index)
        self.linear, self.cubic = 6 * p * c / pi - 2, 8 * p * c / pi ** 3

    def attenuation(self, gamma):
        cos_t = sqrt(1 - (sin(gamma) / self.index) ** 2)
        f = fresnel(self.index, self.index_p, cos(gamma), cos_t)
        if self.p == 0:
            return f
        depth = 2 * self.sigma * (2 * cos_t ** 2 if self.printed else cos_t)
        return (1 - f) ** 2 * f ** (self.p - 1) * exp(-self.p * depth)

    def azimuth(self, gamma):
        """phi(p, gamma) - p pi."""
        if self.printed:
            return self.linear * gamma - self.cubic * gamma ** 3
        return 2 * self.p * asin(sin(gamma) / self.index) - 2 * gamma

    def slope(self, gamma):
        if self.printed:
            return self.linear - 3 * self.cubic * gamma ** 2
        return 2 * self.p * cos(gamma) / sqrt(self.index ** 2 - sin(gamma) ** 2) - 2

    def turn(self):
        """gamma > 0 at which the azimuth turns back; None where it is monotone."""
        if self.slope(mpf(0)) <= 0 or self.slope(pi / 2) >= 0:
            return None
        return findroot(self.slope, (mpf(0), pi / 2), solver="anderson")

    def roots_at(self, y):
        if self.printed and self.p > 0:
            found = polyroots([-self.cubic, 0, self.linear, -y], maxsteps=500, extraprec=200)
            return [r.real for r in found if abs(r.imag) < mpf(10) ** -25 and abs(r.real) <= pi / 2]
        turn = self.turn()
        ends = [-pi / 2, pi / 2] if turn is None else [-pi / 2, -turn, turn, pi / 2]
        found = []
        for low, high in zip(ends, ends[1:]):
            value = lambda gamma: self.azimuth(gamma) - y
            if value(low) * value(high) < 0:
                found.append(findroot(value, (low, high), solver="anderson", maxsteps=200))
        return found

    def azimuthal(self, phi):
        total = mpf(0)
        for k in (-1, 0, 1):
            for gamma in self.roots_at(phi - self.p * pi + 2 * pi * k):
                total += self.attenuation(gamma) * cos(gamma) / abs(2 * self.slope(gamma))
        return total

    def smoothed(self, phi, gain, width, fade, widest):
        """The paper's procedure for N_TRT."""
        turn = self.turn()
        if turn is not None:
            phi_c, t = self.azimuth(turn), mpf(1)
            second = mp.diff(lambda h: self.azimuth(asin(h)), sin(turn), 2)
            stretch = min(widest, 2 * sqrt(2 * width / abs(second)))
        else:
            x = min(max((self.index - 2) / fade, mpf(0)), mpf(1))
            phi_c, turn, stretch, t = mpf(0), mpf(0), widest, 1 - x * x * (3 - 2 * x)
        total = self.azimuthal(phi)
        for side in (phi_c, -phi_c):
            total *= 1 - t * bell(short_way(phi - side), width) / bell(mpf(0), width)
        glow = bell(short_way(phi - phi_c), width) + bell(short_way(phi + phi_c), width)
        return total + t * gain * self.attenuation(turn) * stretch * glow


def elliptical_index(eta, aspect, phi, phi_o):
    along_minor = 2 * (eta - 1) * aspect ** 2 - eta + 2
    along_major = 2 * (eta - 1) / aspect ** 2 - eta + 2
    phi_h = ((phi_o - phi) + phi_o) / 2
    return ((along_major + along_minor) + cos(2 * phi_h) * (along_major - along_minor)) / 2


def longitudinal(beta, alpha, lobe, theta_i, theta_o):
    """d'Eon et al. 2011: exponentials kept apart and in 50 digits more."""
    with mp.workdps(100):
        v = (beta * (mpf(1), mpf(1) / 2, mpf(2))[lobe]) ** 2
        shifted = theta_o - 2 * alpha * (mpf(1), -mpf(1) / 2, -mpf(3) / 2)[lobe]
        a = cos(theta_i) * abs(cos(shifted)) / v
        if a > 5000:
            series, term = mpf(1), mpf(1)
            for k in range(1, 60):
                term *= mpf((2 * k - 1) ** 2) / (8 * k * a)
                series += term
            scaled = series / sqrt(2 * pi * a)
        else:
            scaled = besseli(0, a) * exp(-a)
        return exp(a - sin(theta_i) * sin(shifted) / v - 1 / v) * scaled / (v * (1 - exp(-2 / v)))


def printed_longitudinal(beta, alpha, lobe, theta_i, theta_o):
    width = beta / 2 * (mpf(1), mpf(1) / 2, mpf(2))[lobe]
    shift = alpha * (mpf(1), -mpf(1) / 2, -mpf(3) / 2)[lobe]
    return bell((theta_i + theta_o) / 2 - shift, width)


def number(x):
    return repr(float(x))


HEADER = ["settings", "quantity", "lobe", "theta_i", "theta_o", "theta_d", "phi", "h", "phi_o", "value"]


def row(settings, quantity, lobe, value, **at):
    coordinates = [number(at.get(name, 0)) for name in HEADER[3:9]]
    return [settings, quantity, str(lobe), *coordinates, nstr(value, 25)]


def exact(text):
    return mpf(float(text))


def printed_rows():
    eta, sigma, beta, alpha = "1.55", "0.2", "0.25", "-0.125"
    for eta in ("1.55", "1.12", "2.3"):
        base = f"variant=as_published;eta={eta};sigma_a={sigma};beta={beta};alpha={alpha}"
        for theta_i, theta_o in (("0.2", "-0.3"), ("-0.9", "0.6"), ("1.2", "0.1")):
            theta_d = (exact(theta_o) - exact(theta_i)) / 2
            for lobe in (0, 1, 2):
                path = Path(exact(eta), exact(sigma), theta_d, lobe, True)
                m = printed_longitudinal(exact(beta), exact(alpha), lobe, exact(theta_i), exact(theta_o))
                yield row(base, "M", lobe, m, theta_i=theta_i, theta_o=theta_o)
                yield row(base, "A", lobe, path.attenuation(asin(exact("0.6"))), theta_d=float(theta_d), h="0.6")
                for phi in ("0.05", "0.3", "0.37", "1.1", "2.5", "3.1"):
                    n = path.azimuthal(exact(phi))
                    yield row(base, "N", lobe, n, theta_d=float(theta_d), phi=phi)
                    yield row(base, "S", lobe, m * n / cos(theta_d) ** 2, theta_i=theta_i, theta_o=theta_o, phi=phi)


def smoothed_rows():
    for variant in ("corrected", "as_published"):
        for eta in ("1.55", "1.97", "2.05", "2.5"):
            for width in ("0.1745", "0.4"):
                settings = f"variant={variant};caustic=smoothed;eta={eta};sigma_a=0.2;k_g=0.7;w_c={width};delta_eta=0.3;delta_h_max=0.5"
                path = Path(exact(eta), exact("0.2"), exact("0.2"), 2, variant == "as_published")
                for phi in ("0", "0.1", "0.4", "1", "3.1"):
                    n = path.smoothed(exact(phi), exact("0.7"), exact(width), exact("0.3"), exact("0.5"))
                    yield row(settings, "N", 2, n, theta_d="0.2", phi=phi)


def elliptical_rows():
    for aspect in ("0.85", "1.1"):
        for phi_o in ("0", "0.7", "2"):
            for phi in ("-0.5", "-0.1", "0.05", "0.2", "0.9"):
                index = elliptical_index(exact("1.55"), exact(aspect), exact(phi), exact(phi_o))
                path = Path(index, exact("0.2"), exact("0.2"), 2)
                yield row(f"aspect={aspect};sigma_a=0.2", "N", 2, path.azimuthal(exact(phi)), theta_d="0.2", phi=phi, phi_o=phi_o)


def drawn(generator, low, high):
    return generator.uniform(low, high)


def domain_rows():
    """The issue's domain: beta 0.001 .. 1, sigma_a 0 .. 100, eta 1.05 .. 3, theta to 89.999 degrees, h to 1, tilt to 10 degrees."""
    generator = random.Random(2003)
    right = 89.999 * 3.141592653589793 / 180
    for k in range(240):
        beta = 10 ** drawn(generator, -3, 0)
        sigma = generator.choice([0.0, 10 ** drawn(generator, -2, 2)])
        eta, alpha, lobe = drawn(generator, 1.05, 3), drawn(generator, -0.1745, 0.1745), k % 3
        settings = f"eta={eta!r};sigma_a={sigma!r};beta={beta!r};alpha={alpha!r}"
        theta_o = generator.choice([drawn(generator, -right, right), right, -right, 0.0])
        width, shift = beta * (1, 0.5, 2)[lobe], alpha * (2, -1, -3)[lobe]
        theta_i = min(max(shift - theta_o + width * drawn(generator, -4, 4), -right), right)
        theta_d = generator.choice([drawn(generator, -right, right), right])
        h = generator.choice([drawn(generator, -1, 1), 1 - 10 ** drawn(generator, -9, -1)])
        phi = drawn(generator, 0, 0.4 if lobe == 2 else 3.14159)
        path = Path(mpf(eta), mpf(sigma), mpf(theta_d), lobe)
        m = longitudinal(mpf(beta), mpf(alpha), lobe, mpf(theta_i), mpf(theta_o))
        yield row(settings, "M", lobe, m, theta_i=theta_i, theta_o=theta_o)
        yield row(settings, "N", lobe, path.azimuthal(mpf(phi)), theta_d=theta_d, phi=phi)
        yield row(settings, "A", lobe, path.attenuation(asin(mpf(h))), theta_d=theta_d, h=h)


def write(name, rows):
    with open(FOLDER / name, "w", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(HEADER)
        writer.writerows(rows)


if __name__ == "__main__":
    write("variants.csv", [*printed_rows(), *smoothed_rows(), *elliptical_rows()])
    write("domain.csv", list(domain_rows()))
