"""Tables of the Chiang model in 50 digits (needs mpmath), from the angles as the paper writes them: asin, wrapped azimuths, log I0.

scattering.csv: S and each lobe's part of it at inputs that float holds exactly, with the height of its peak and kappa, the sum over inputs
x of |x dS/dx| / S, by differences of the reference itself. far.csv: S averaged over offsets, and the energy, by mpmath's quadrature.
Nothing here is shared with the library.
"""
import csv
import math
import pathlib
import random
import struct

from mpmath import mp, mpf

mp.dps = 50
FOLDER = pathlib.Path(__file__).parent
INPUTS = ("eta", "sigma_a", "beta_m", "beta_n", "alpha", "theta_i", "theta_o", "phi", "h")


def single(x):
    return struct.unpack("f", struct.pack("f", x))[0]


def longitudinal(variance, shift, theta_i, theta_o):
    """M of d'Eon et al. 2011 about theta_i + theta_o = shift; past a pole the inclination folds back."""
    sine, cosine = mp.sin(theta_o - shift), abs(mp.cos(theta_o - shift))
    bessel = mp.besseli(0, mp.cos(theta_i) * cosine / variance)
    return bessel * mp.exp(-mp.sin(theta_i) * sine / variance) / (2 * variance * mp.sinh(1 / variance))


def azimuthal(scale, angle):
    angle = angle - 2 * mp.pi * mp.nint(angle / (2 * mp.pi))
    e = mp.exp(-abs(angle) / scale)
    return e / (scale * (1 + e) ** 2) / mp.tanh(mp.pi / (2 * scale))


def widths(beta_m, beta_n):
    deviation = mpf("0.726") * beta_m + mpf("0.812") * beta_m**2 + mpf("3.7") * beta_m**20
    scale = mp.sqrt(mp.pi / 8) * (mpf("0.265") * beta_n + mpf("1.194") * beta_n**2 + mpf("5.372") * beta_n**22)
    return deviation**2, scale


def energies(eta, sigma_a, theta_o, h):
    """A of R, TT, TRT and the rest, by Fresnel's equations for the inclined surface."""
    cos_in = mp.cos(theta_o) * mp.sqrt(1 - h * h)
    cos_out = mp.sqrt(1 - (1 - cos_in**2) / eta**2)
    parallel = (eta * cos_in - cos_out) / (eta * cos_in + cos_out)
    perpendicular = (cos_in - eta * cos_out) / (cos_in + eta * cos_out)
    f = (parallel**2 + perpendicular**2) / 2
    bent = mp.sqrt(eta**2 - mp.sin(theta_o) ** 2) / mp.cos(theta_o)
    cos_gamma_t = mp.sqrt(1 - (h / bent) ** 2)
    t = mp.exp(-2 * sigma_a * cos_gamma_t / mp.sqrt(1 - (mp.sin(theta_o) / eta) ** 2))
    tt = (1 - f) ** 2 * t
    rest = tt * (f * t) ** 2 / (1 - f * t) if f < 1 else mpf(0)
    return (f, tt, tt * f * t, rest), mp.asin(h / bent)


def along(beta_m, beta_n, alpha, theta_i, theta_o):
    """M of each lobe, and its peak over theta_i."""
    variance, _ = widths(beta_m, beta_n)
    lobes = [(variance, -2 * alpha), (variance / 4, alpha), (4 * variance, 4 * alpha), (4 * variance, mpf(0))]
    return [(longitudinal(v, shift, theta_i, theta_o), longitudinal(v, shift, shift - theta_o, theta_o)) for v, shift in lobes]


def around(eta, sigma_a, scale, theta_o, phi, h):
    """A D of each lobe, and A with the peak of D over phi."""
    a, gamma_t = energies(eta, sigma_a, theta_o, h)
    gamma_i = mp.asin(h)
    peaks = [phi - (2 * p * gamma_t - 2 * gamma_i + p * mp.pi) for p in range(3)]
    top = azimuthal(scale, mpf(0))
    return [(a[p] * azimuthal(scale, peaks[p]), a[p] * top) for p in range(3)] + [(a[3] / (2 * mp.pi),) * 2]


def near(eta, sigma_a, beta_m, beta_n, alpha, theta_i, theta_o, phi, h):
    """Each lobe's part of S, and the sum of A times the peaks of M and N."""
    pairs = list(zip(along(beta_m, beta_n, alpha, theta_i, theta_o), around(eta, sigma_a, widths(beta_m, beta_n)[1], theta_o, phi, h)))
    return [m[0] * n[0] for m, n in pairs], sum(m[1] * n[1] for m, n in pairs)


def kappa(values):
    total, step = mpf(0), mpf(10) ** -20
    for k, x in enumerate(values):
        if x == 0 or (k == 8 and abs(x) == 1):
            continue
        low, high = list(values), list(values)
        low[k], high[k] = x * (1 - step), x * (1 + step)
        total += abs(sum(near(*high)[0]) - sum(near(*low)[0])) / (2 * step)
    return total / sum(near(*values)[0])


def direction(draw):
    return math.asin(2 * draw.random() - 1)


def random_row(draw, smallest, largest):
    beta = [smallest * (largest / smallest) ** draw.random() for _ in range(2)]
    return [draw.uniform(1.05, 3), 10 ** draw.uniform(-3, 1.5), beta[0], beta[1], draw.uniform(-0.17, 0.17), direction(draw), direction(draw),
            draw.uniform(-math.pi, math.pi), draw.uniform(-1, 1)]


def narrow_row(draw):
    """A small beta, at a few deviations from the peak of R, TT or TRT."""
    row = random_row(draw, 1e-3, 0.1)
    p = draw.randrange(3)
    width = 0.75 * row[2] * (1, 0.5, 2)[p]
    shift = (-2, 1, 4)[p] * row[4]
    row[5] = max(-1.57, min(1.57, shift - row[6] + width * draw.uniform(-3, 3)))
    bent = math.sqrt(row[0] ** 2 - math.sin(row[6]) ** 2) / math.cos(row[6])
    peak = 2 * p * math.asin(row[8] / bent) - 2 * math.asin(row[8]) + p * math.pi
    row[7] = math.remainder(peak + 0.17 * row[3] * draw.uniform(-6, 6), 2 * math.pi)
    return row


def hard_rows():
    for theta_o in (0.0, -1.2, 1.5707):
        for h in (0.0, 0.999999, -1.0):
            for beta in (0.1, 0.3, 1.0):
                for eta, sigma_a in ((1.55, 0.2), (1.0625, 100.0), (3.0, 0.0)):
                    yield [eta, sigma_a, beta, beta, 0.0349, -theta_o + 0.1 if theta_o < 1.5 else -1.5706, theta_o, 3.0, h]


def write(name, head, rows):
    with open(FOLDER / name, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(head)
        writer.writerows(rows)


def scattering_rows():
    draw = random.Random(2016)
    sets = [("usual", random_row(draw, 0.1, 1)) for _ in range(1000)]
    sets += [("narrow", narrow_row(draw)) for _ in range(300)] + [("hard", row) for row in hard_rows()]
    for kind, row in sets:
        values = [mpf(single(x)) for x in row]
        parts, peak = near(*values)
        yield [kind, *[f"{single(x):.9g}" for x in row], *[mp.nstr(x, 17) for x in [sum(parts), *parts, peak]], mp.nstr(kappa(values), 5)]


def breaks(values, lower, upper):
    """Where D_p peaks, with points a few scales beside, and where it has its kink half a turn away: mpmath's quadrature is split there."""
    eta, sigma_a, beta_m, beta_n, alpha, theta_i, theta_o, phi = values
    scale = widths(beta_m, beta_n)[1]
    bent = mp.sqrt(eta**2 - mp.sin(theta_o) ** 2) / mp.cos(theta_o)
    points = {lower, upper}
    grid = [lower + (upper - lower) * k / 400 for k in range(401)]
    for p in range(3):
        angles = [(phi - (2 * p * mp.asin(mp.sin(g) / bent) - 2 * g + p * mp.pi)) / 2 for g in grid]
        for crossing, beside in ((mp.sin, (-20, -8, -3, 0, 3, 8, 20)), (mp.cos, (0,))):
            turns = [crossing(angle) for angle in angles]
            for k in range(400):
                if turns[k] * turns[k + 1] <= 0:
                    root = mp.findroot(lambda g: crossing((phi - (2 * p * mp.asin(mp.sin(g) / bent) - 2 * g + p * mp.pi)) / 2),
                                       (grid[k], grid[k + 1]), solver="anderson", verify=False)
                    points.update(x for x in (root + scale * j for j in beside) if lower < x < upper)
    return sorted(points)


def far_rows():
    draw = random.Random(1116)
    with mp.workdps(20):
        for k in range(40):
            row = random_row(draw, 0.1, 1)[:8]
            row[1] = min(row[1], 3.0)
            h_from, h_to = (-1.0, 1.0) if k % 2 else sorted((draw.uniform(-1, 1), draw.uniform(-1, 1)))
            values = [mpf(single(x)) for x in row]
            ends = [mp.asin(mpf(single(x))) for x in (h_from, h_to)]
            width = mpf(single(h_to)) - mpf(single(h_from))
            m = [pair[0] for pair in along(*values[2:7])]
            size = max(m)  # taken out, since mpmath's quadrature stops at an absolute error
            scale = widths(values[2], values[3])[1]

            def integrand(g):
                n = around(values[0], values[1], scale, values[6], values[7], mp.sin(g))
                return sum(m[p] / size * n[p][0] for p in range(4)) * mp.cos(g)

            s = mp.quad(integrand, breaks(values, *ends)) * size / width
            albedo = mp.quad(lambda g: sum(energies(values[0], values[1], values[6], mp.sin(g))[0]) * mp.cos(g), ends) / width
            yield [*[f"{single(x):.9g}" for x in [*row, h_from, h_to]], mp.nstr(s, 17), mp.nstr(albedo, 17)]


if __name__ == "__main__":
    write("scattering.csv", ("kind", *INPUTS, "s", "r", "tt", "trt", "rest", "peak", "kappa"), scattering_rows())
    write("far.csv", (*INPUTS[:8], "h_from", "h_to", "s", "albedo"), far_rows())
