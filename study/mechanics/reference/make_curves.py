"""Master curves of slender rods, by code that shares nothing with the library (mpmath, numpy): writes curves.cpp. Run by hand.

The experiments are those of Romero et al. 2021 ("Physical validation of simulators in computer graphics", section 4), for a round fibre, and
two more; their curves are computed here from Kirchhoff's equations, not read off the paper.
Unit length, stiffness EI = 1, weight Gamma = rho g A L^3 / EI.

cantilever   clamped horizontally: drop over width. psi: angle from the vertical, from the tip psi'' = Gamma u sin psi, by Taylor series in 60 digits.
drape        the same, clamped on top of a frictionless horizontal cylinder of radius 1/10: it lies on it until its curvature is that of the cylinder.
hanging arc  natural curvature K, clamped downwards: the weight below which the plane shape turns out of its plane (Miller et al. 2014 look for the same).
standing arc clamped horizontally, curved upwards: the weight above which it falls to the side. Greenhill's column: the same, straight and upright.
             All: energy and its second variation out of the plane, Galerkin with Legendre polynomials; GJ / EI = 2/3.
stick-slip   clamped downwards, weightless, its tip held by a floor's friction under the clamp, which goes down by a share of the length: sideways over vertical
             force of the floor, which is the friction at which the tip slips there.
"""
import pathlib

import mpmath as mp
import numpy as np

mp.mp.dps = 60
RADIUS = mp.mpf(1) / 10
TWIST = 2 / 3


def taylor_step(psi, slope, start, gamma, order):
    """Coefficients of psi about `start`, and of its sine and cosine."""
    p, s, c = [psi, slope], [mp.sin(psi)], [mp.cos(psi)]
    for k in range(order):
        p.append(gamma * (start * s[k] + (s[k - 1] if k else 0)) / ((k + 1) * (k + 2)))
        s.append(sum((j + 1) * p[j + 1] * c[k - j] for j in range(k + 1)) / (k + 1))
        c.append(-sum((j + 1) * p[j + 1] * s[k - j] for j in range(k + 1)) / (k + 1))
    return p, s, c


def from_tip(tip_angle, gamma, at_end):
    """Integrates from the tip (u = 0) to u = 1, or to where at_end says; gives u, psi, slope, drop, width there."""
    steps = max(8, int(6 * mp.cbrt(gamma)) + 1)
    h, order = mp.mpf(1) / steps, 36
    psi, slope, drop, width = tip_angle, mp.mpf(0), mp.mpf(0), mp.mpf(0)
    for k in range(steps):
        p, s, c = taylor_step(psi, slope, k * h, gamma, order)
        value = lambda q, t: mp.polyval(q[::-1], t)
        whole = lambda q, t: mp.polyval([a / (i + 1) for i, a in enumerate(q)][::-1] + [0], t)
        rate = lambda q, t: mp.polyval([i * a for i, a in enumerate(q)][:0:-1], t)
        if at_end is not None and at_end(rate(p, h)) >= 0:
            t = mp.findroot(lambda x: at_end(rate(p, x)), (0, h), solver="anderson", tol=mp.mpf(10) ** -80)
            return k * h + t, value(p, t), rate(p, t), drop + whole(c, t), width + whole(s, t)
        drop, width = drop + whole(c, h), width + whole(s, h)
        psi, slope = value(p, h), rate(p, h)
    return mp.mpf(1), psi, slope, drop, width


def solved(off, gamma, high):
    """The logarithm of the tip's angle: the lowest root, which is that of the rod without loops."""
    low = -mp.mpf(7) / 10 * mp.sqrt(gamma) - 3
    step = (high - low) / max(8, int(high - low) * 2)
    while off(low + step) < 0:
        low += step
    return mp.findroot(off, (low, low + step), solver="anderson", tol=mp.mpf(10) ** -50)


def cantilever(gamma):
    off = lambda log: from_tip(mp.exp(log), gamma, None)[1] - mp.pi / 2
    log = solved(off, gamma, mp.log(mp.pi / 2))
    _, _, curvature, drop, width = from_tip(mp.exp(log), gamma, None)
    return drop, width, curvature


def drape(gamma):
    """Drop and width of the tip, from the clamp."""
    drop, width, curvature = cantilever(gamma)
    if curvature <= 1 / RADIUS:
        return drop, width
    at_end = lambda slope: slope - 1 / RADIUS

    def off(log):
        u, psi, _, _, _ = from_tip(mp.exp(log), gamma, at_end)
        return psi - mp.pi / 2 + (1 - u) / RADIUS

    log = solved(off, gamma, mp.log(mp.pi / 2) - mp.mpf(10) ** -6)
    u, _, _, drop, width = from_tip(mp.exp(log), gamma, at_end)
    angle = (1 - u) / RADIUS
    return drop + RADIUS * (1 - mp.cos(angle)), width + RADIUS * mp.sin(angle)


def basis(count, points):
    """Integrals of shifted Legendre polynomials from 0, and the polynomials, at Gauss's points of 0 .. 1."""
    x, w = np.polynomial.legendre.leggauss(points)
    one = [np.polynomial.legendre.Legendre.basis(k) for k in range(count)]
    return (x + 1) / 2, w / 2, np.array([(b.integ(lbnd=-1))(x) / 2 for b in one]), np.array([b(x) for b in one])


def plane_shape(gamma, natural, clamp, count, start=None):
    """Angle from the downward vertical at the points: stationary energy, Newton's method with the weight raised in steps."""
    s, w, b, d = basis(count, 3 * count)
    a = np.zeros(count)
    a[0] = natural
    for share in np.linspace(0, 1, 41)[1:]:
        for _ in range(30):
            psi, weight = clamp + a @ b, share * gamma * (1 - s)
            gradient = d @ (w * (a @ d - natural)) + b @ (w * weight * np.sin(psi))
            move = np.linalg.solve((d * w) @ d.T + (b * (w * weight * np.cos(psi))) @ b.T, -gradient)
            a += move
            if np.abs(move).max() < 1e-13:
                break
    return s, w, b, d, clamp + a @ b, a @ d


def lowest(gamma, natural, clamp, count=36):
    """Lowest eigenvalue of the second variation out of the plane: rotation about the tangent (x) and about the normal (y)."""
    s, w, b, d, psi, bend = plane_shape(gamma, natural, clamp, count)
    moment, weight = bend - natural, gamma * (1 - s)
    zero = np.zeros_like(b)
    x, y = np.vstack([b, zero]), np.vstack([zero, b])
    turn, lean = np.vstack([d, zero]) - bend * y, np.vstack([zero, d]) + bend * x
    form = lambda p, q, f: (p * (w * f)) @ q.T
    both = lambda p, q, f: form(p, q, f) + form(q, p, f)
    h = TWIST * form(turn, turn, 1) + form(lean, lean, 1) - (both(x, lean, moment) - both(y, turn, moment)) / 2
    h += both(x, y, weight * np.sin(psi)) / 2 + form(y, y, weight * np.cos(psi))
    return np.linalg.eigvalsh(h)[0]


def threshold(natural, clamp, stable, unstable):
    """The weight between these two at which the lowest eigenvalue is zero."""
    for _ in range(50):
        middle = (stable + unstable) / 2
        stable, unstable = (stable, middle) if lowest(middle, natural, clamp) < 0 else (middle, unstable)
    return (stable + unstable) / 2


def pressed(lowered):
    """Sideways over vertical force at a tip that stays under the clamp. theta: angle from the downward vertical, theta'' = -(V sin + H cos)."""
    count = 40
    s, w, b, d = basis(count, 3 * count)
    k = 4.493409457909064  # tan k = k: Euler's load of a clamped and pinned column is k^2, its angle cos k s + k sin k s - 1
    mode = np.cos(k * s) + k * np.sin(k * s) - 1
    mode *= np.sqrt(2 * lowered / (w @ mode**2))
    unknown = np.concatenate([np.linalg.lstsq(b.T, mode, rcond=None)[0], [k * k, 0]])
    for _ in range(200):
        a, v, h = unknown[:-2], unknown[-2], unknown[-1]
        theta = a @ b
        sine, cosine = np.sin(theta), np.cos(theta)
        bent = d @ (w * (a @ d)) - b @ (w * (v * sine + h * cosine))
        by_force = np.column_stack([-(b @ (w * sine)), -(b @ (w * cosine))])
        top = (d * w) @ d.T - (b * (w * (v * cosine - h * sine))) @ b.T
        jacobian = np.block([[top, by_force], [np.vstack([by_force[:, 0], -by_force[:, 1]]), np.zeros((2, 2))]])
        move = np.linalg.solve(jacobian, -np.concatenate([bent, [w @ cosine - (1 - lowered), w @ sine]]))
        unknown = unknown + move
        if np.abs(move).max() < 1e-12:
            break
    return abs(unknown[-1] / unknown[-2])


def lines(name, rows):
    body = "".join("      {" + ", ".join(mp.nstr(mp.mpf(v), 12) for v in row) + "},\n" for row in rows)
    return f"const std::vector<ReferencePoint>& {name}() {{\n  static const std::vector<ReferencePoint> points = {{\n{body}  }};\n  return points;\n}}\n"


def table():
    yield "// Written by make_curves.py.\n#include \"study/mechanics/reference/curves.h\"\n\nnamespace cuticle::study {\n"
    gammas = [mp.mpf(10) ** (mp.mpf(k) / 4) for k in range(-8, 17)]
    yield lines("cantilever_curve", [(g, drop / width) for g, (drop, width, _) in ((g, cantilever(g)) for g in gammas)])
    yield lines("drape_curve", [(g, *drape(g)) for g in gammas[12:24:2]])
    hanging = {5.75: 60, 6: 60, 6.5: 90, 7: 120, 7.5: 150, 8: 180, 8.5: 220}
    yield lines("hanging_arc_curve", [(k, threshold(k, 0, high, 3 * k)) for k, high in hanging.items()])
    standing = {2.75: 12, 3: 10, 3.5: 15, 4: 15, 4.5: 20, 5: 20, 5.5: 30, 6: 40}
    yield lines("standing_arc_curve", [(k, threshold(k, np.pi / 2, 1e-3, high)) for k, high in standing.items()])
    yield lines("greenhill", [(0, threshold(0, np.pi, 1, 10))])
    yield lines("stick_slip_curve", [(e, pressed(e)) for e in np.linspace(0.02, 0.5, 25)])
    yield lines("beam_roots", [(k, mp.findroot(lambda x: mp.cos(x) + mp.sech(x), (k - 0.5) * mp.pi)) for k in (1, 2, 3)])
    yield lines("chain_roots", [(k, mp.besseljzero(0, k)) for k in (1, 2, 3)])
    yield "}  // namespace cuticle::study\n"


if __name__ == "__main__":
    pathlib.Path(__file__).with_name("curves.cpp").write_text("\n".join(table()))
