"""Writes special_functions.csv: values and first derivatives of the functions of core/shared, by mpmath in 60 digits.

Run by hand. Arguments are float32 numbers, so that one table serves every precision. atan2 is differentiated in y.
"""
import pathlib
import random
import struct

import mpmath as mp

mp.mp.dps = 60


def single(x):
    return mp.mpf(struct.unpack("f", struct.pack("f", float(x)))[0])


def scaled_bessel(x):
    return mp.besseli(0, x) * mp.exp(-x)


def scaled_bessel_slope(x):
    return (mp.besseli(1, x) - mp.besseli(0, x)) * mp.exp(-x)


def spread(lower, upper, count, signed, edges):
    """Numbers spread evenly in logarithm, and the edges."""
    lower, upper = mp.mpf(lower), mp.mpf(upper)
    numbers = [lower * (upper / lower) ** random.random() for _ in range(count)]
    if signed:
        numbers = [x * random.choice((-1, 1)) for x in numbers]
    return [single(x) for x in numbers + [mp.mpf(e) for e in edges]]


def inner(numbers):
    return [x for x in numbers if abs(x) < 1]


def rows():
    for x in spread("1e-4", 8000, 60, True, ["0", "0.785398", "0.785399", "1.570796", "3.141593", "6.283185"]):
        yield "sin", x, 0, mp.sin(x), mp.cos(x)
        yield "cos", x, 0, mp.cos(x), -mp.sin(x)
    for x in inner(spread("1e-3", 1, 60, True, ["0", "0.5", "-0.5", "0.50001", "0.9999", "-0.999999"])):
        yield "asin", x, 0, mp.asin(x), 1 / mp.sqrt(1 - x * x)
        yield "acos", x, 0, mp.acos(x), -1 / mp.sqrt(1 - x * x)
    for _ in range(60):
        angle, radius = random.uniform(-3.1415, 3.1415), 10 ** random.uniform(-3, 3)
        y, x = single(radius * mp.sin(angle)), single(radius * mp.cos(angle))
        yield "atan2", y, x, mp.atan2(y, x), x / (x * x + y * y)
    for x in spread("1e-3", 86, 60, True, ["0", "-0.346573", "0.346574", "88"]):
        yield "exp", x, 0, mp.exp(x), mp.exp(x)
    for x in spread("1e-6", 80, 60, False, ["0", "0.4999999", "0.5"]):
        yield "one_minus_exp", x, 0, -mp.expm1(-x), mp.exp(-x)
    edges = ["0", "4.999999", "5", "7.999999", "8", "15.99999", "16", "49.99999", "50", "1e6", "1e10"]
    for x in spread("1e-3", "1e5", 80, False, edges):
        yield "bessel_i0_scaled", x, 0, scaled_bessel(x), scaled_bessel_slope(x)


if __name__ == "__main__":
    random.seed(20030727)
    lines = ["function,x,second,value,slope"]
    for name, x, second, value, slope in rows():
        lines.append(",".join([name] + [mp.nstr(number, 25) for number in (x, mp.mpf(second), value, slope)]))
    target = pathlib.Path(__file__).with_name("special_functions.csv")
    target.write_text("\n".join(lines) + "\n")
