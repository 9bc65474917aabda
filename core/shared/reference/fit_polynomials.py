"""Coefficients of the polynomials in core/shared, by interpolation at Chebyshev nodes in 60 digits.

Run by hand (needs mpmath): prints each polynomial's coefficients, constant term first, and its largest relative error
in exact arithmetic, so that what remains beside it is rounding.
"""
import mpmath as mp

mp.mp.dps = 60


def interpolate(function, lower, upper, count):
    nodes = [(lower + upper) / 2 + (upper - lower) / 2 * mp.cos(mp.pi * (2 * k + 1) / (2 * count)) for k in range(count)]
    matrix = mp.matrix(count, count)
    for row, node in enumerate(nodes):
        for column in range(count):
            matrix[row, column] = node**column
    return list(mp.lu_solve(matrix, mp.matrix([function(node) for node in nodes])))


def largest_error(function, polynomial, lower, upper, whole=None):
    """Relative error; `whole` maps (argument, polynomial value) to the quantity whose error counts."""
    worst = mp.mpf(0)
    for k in range(401):
        x = lower + (upper - lower) * (mp.mpf(k) + mp.mpf(1) / 3) / mp.mpf(402)
        value = mp.polyval(polynomial[::-1], x)
        exact = function(x)
        if whole:
            value, exact = whole(x, value), whole(x, exact)
        worst = max(worst, abs(value / exact - 1))
    return worst


def show(name, function, lower, upper, count, digits, whole=None):
    lower, upper = mp.mpf(lower), mp.mpf(upper)
    polynomial = interpolate(function, lower, upper, count)
    print(f"{name} on [{mp.nstr(lower, 6)}, {mp.nstr(upper, 6)}]: "
          f"error {mp.nstr(largest_error(function, polynomial, lower, upper, whole), 3)}")
    for coefficient in polynomial:
        print("   ", mp.nstr(coefficient, digits))


def over_powers(function, subtract, power):
    """(function(sqrt z) - subtract(z)) / sqrt(z)**power, by its limit near zero through extra digits."""
    def quotient(z):
        with mp.workdps(120):
            root = mp.sqrt(z)
            return (function(root) - subtract(z)) / root**power
    return quotient


def float_polynomials():
    quarter = (mp.pi / 4 + mp.mpf("0.001")) ** 2
    show("sine: sin x = x + x z P(z), z = x^2", over_powers(mp.sin, mp.sqrt, 3), 0, quarter, 3, 12,
         lambda z, p: 1 + z * p)
    show("cosine: cos x = 1 - z/2 + z^2 P(z)", over_powers(mp.cos, lambda z: 1 - z / 2, 4), 0, quarter, 3, 12,
         lambda z, p: 1 - z / 2 + z * z * p)
    show("arcsine: asin x = x + x z P(z)", over_powers(mp.asin, mp.sqrt, 3), 0, mp.mpf("0.25"), 5, 12,
         lambda z, p: 1 + z * p)
    show("arctangent: atan t = t + t z P(z)", over_powers(mp.atan, mp.sqrt, 3), 0, 1, 10, 12, lambda z, p: 1 + z * p)
    show("logarithm: 2 artanh t = 2 t + t z P(z), z = t^2", over_powers(lambda t: 2 * mp.atanh(t), lambda z: 2 * mp.sqrt(z), 3), 0,
         mp.mpf("0.1112"), 5, 12, lambda z, p: 2 + z * p)
    half = mp.log(2) / 2
    show("exponential", mp.exp, -half, half, 7, 12)
    show("1 - exp(-t) = t P(t)", lambda t: mp.expm1(-t) / -t, 0, mp.mpf("0.5"), 6, 12)


def scaled_bessel(x):
    return mp.besseli(0, x) * mp.exp(-x)


def bessel_polynomials():
    def near(q):
        return mp.besseli(0, mp.sqrt(q))

    def far(u):
        with mp.workdps(100):
            return scaled_bessel(1 / u) * mp.sqrt(1 / u)

    show("I0 float, x < 5: P(x^2)", near, 0, 25, 9, 12)
    show("I0 exp(-x) sqrt(x) float, x >= 5: P(1/x)", far, mp.mpf(10) ** -9, mp.mpf(1) / 5, 9, 12)
    show("I0 double, x < 8: P(x^2)", near, 0, 64, 16, 21)
    show("I0 exp(-x) sqrt(x) double, 8 <= x < 16: P(1/x)", far, mp.mpf(1) / 16, mp.mpf(1) / 8, 14, 21)
    show("I0 exp(-x) sqrt(x) double, 16 <= x < 50: P(1/x)", far, mp.mpf(1) / 50, mp.mpf(1) / 16, 14, 21)
    show("I0 exp(-x) sqrt(x) double, x >= 50: P(1/x)", far, mp.mpf(10) ** -20, mp.mpf(1) / 50, 9, 21)



if __name__ == "__main__":
    float_polynomials()
    bessel_polynomials()
