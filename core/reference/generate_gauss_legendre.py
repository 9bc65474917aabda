"""Writes gauss_legendre.csv: nodes and weights of some orders by mpmath in 40 digits. Run by hand."""
import pathlib

import mpmath as mp

mp.mp.dps = 40


def rule(order):
    with mp.workdps(200):
        roots = mp.polyroots(mp.taylor(lambda t: mp.legendre(order, t), 0, order)[::-1], maxsteps=500, extraprec=1000)
    for x in (mp.re(root) for root in roots):
        slope = order * (x * mp.legendre(order, x) - mp.legendre(order - 1, x)) / (x * x - 1)
        yield x, 2 / ((1 - x * x) * slope * slope)


if __name__ == "__main__":
    lines = ["order,node,weight"]
    for order in (2, 3, 7, 16, 33, 64):
        for x, w in sorted(rule(order)):
            x = mp.mpf(0) if abs(x) < mp.mpf(10) ** -30 else x
            lines.append(f"{order},{mp.nstr(x, 25)},{mp.nstr(w, 25)}")
    pathlib.Path(__file__).with_name("gauss_legendre.csv").write_text("\n".join(lines) + "\n")
