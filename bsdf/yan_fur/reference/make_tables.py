"""Writes shares.csv: what each path of the double cylinder takes, with 30 digits by mpmath, by following the paper's sequence of
events one by one: the residual is summed crossing by crossing. What is left of scattered light is a double integral, to 10 digits."""
import csv
import functools
import pathlib

from mpmath import acos, asin, cos, exp, mp, mpc, mpf, pi, quad, sin, sqrt, workdps

mp.dps = 30
FOLDER = pathlib.Path(__file__).parent


def reflectance(eta, cosine, layers):
    cosine_after = sqrt(1 - (1 - cosine ** 2) / eta ** 2)
    s = (cosine - eta * cosine_after) / (cosine + eta * cosine_after)
    p = (eta * cosine - cosine_after) / (eta * cosine + cosine_after)
    f = (s ** 2 + p ** 2) / 2
    return layers * f / (1 + (layers - 1) * f)


@functools.cache
def left(eta, sigma_a, kappa, sigma_ms, sigma_ma, layers):
    """Of light that the medulla scatters, from the first time on: visit by visit, each direction from the medulla until the light
    leaves (the real part) or is scattered again (the imaginary one)."""
    extinction = sigma_ms + sigma_ma
    depth = 2 * kappa * sigma_ms
    visit = 1 / (1 + sigma_ma * 2 * kappa * (1 - 1 / depth + exp(-depth) / (1 - exp(-depth))))

    def ends(s, theta):
        half, cos_t, c = sqrt(kappa ** 2 - s ** 2), sqrt(1 - s ** 2), cos(theta)
        outside = 1 - eta ** 2 * (1 - (c * cos_t) ** 2)
        mirrored = reflectance(eta, sqrt(outside), layers) if outside > 0 else mpf(1)
        once = exp(-sigma_a * (cos_t - half) / c)
        passed = exp(-extinction * 2 * half / c)
        met = once ** 2 * mirrored * (1 - passed) * sigma_ms / extinction
        return mpc(once * (1 - mirrored), met * visit) / (1 - once ** 2 * mirrored * passed)

    def at_offset(s):
        least = sqrt(1 - 1 / eta ** 2) / sqrt(1 - s ** 2)
        places = [0, acos(least), pi / 2] if least < 1 else [0, pi / 2]
        return quad(lambda theta: cos(theta) ** 2 * ends(s, theta), places)

    with workdps(12):
        mean = quad(at_offset, [0, 1 / eta, kappa] if kappa > 1 / eta else [0, kappa]) / (kappa * pi / 4)
        return visit * mean.real / (1 - mean.imag)


def shares(eta, sigma_a, kappa, sigma_ms, sigma_ma, layers, theta, h):
    f = reflectance(eta, cos(theta) * sqrt(1 - h ** 2), layers)
    inclined = 1 / cos(asin(sin(theta) / eta))
    sin_t = h * cos(theta) / sqrt(eta ** 2 - sin(theta) ** 2)
    half = sqrt(max(mpf(0), kappa ** 2 - sin_t ** 2))
    side = exp(-sigma_a * inclined * (sqrt(1 - sin_t ** 2) - half))
    passed = exp(-2 * inclined * half * (sigma_ms + sigma_ma))
    thrown = (1 - passed) * sigma_ms / (sigma_ms + sigma_ma) * left(eta, sigma_a, kappa, sigma_ms, sigma_ma, layers)
    inside, residual = 1 - f, mpf(0)
    for crossing in range(200):
        straight, scattered = inside * side ** 2 * passed * (1 - f), inside * side * thrown
        if crossing == 0:
            tt, tts = straight, scattered
        elif crossing == 1:
            trt, trts = straight, scattered
        else:
            residual += straight + scattered
        inside *= side ** 2 * passed * f
    return [f, tt, trt, tts, trts, residual]


def rows():
    for fibre in (("1.55", "0.2", "0.7", "2", "0.1", "1"), ("1.2", "3", "0.9", "0.3", "1", "0.5"), ("2.5", "0.05", "0.3", "20", "0", "4")):
        for theta in ("0", "0.8", "1.4"):
            for h in ("0", "-0.4", "0.93"):
                values = shares(*(mpf(float(x)) for x in fibre), mpf(float(theta)), mpf(float(h)))
                for lobe, value in enumerate(values):
                    if value > mpf("1e-30"):
                        yield [*fibre, theta, h, str(lobe), mp.nstr(value, 20)]


if __name__ == "__main__":
    with open(FOLDER / "shares.csv", "w", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(["eta", "sigma_a", "kappa", "sigma_ms", "sigma_ma", "layers", "theta_d", "h", "lobe", "a"])
        writer.writerows(rows())
