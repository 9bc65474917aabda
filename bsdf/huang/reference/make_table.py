"""mirrored.csv: the R lobe of the microfacet model with 30 digits, by adaptive quadrature over the normal's azimuth (far field) and at
one offset (near field). Written from Walter et al. 2007, equations 20, 33 and 34, and the geometry of an ellipse; shares nothing with
the formulas under test. Run: python make_table.py > mirrored.csv
"""
import mpmath as mp

mp.mp.dps = 30
ETA = mp.mpf("1.55")


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def direction(theta, azimuth):
    return (mp.cos(theta) * mp.cos(azimuth), mp.cos(theta) * mp.sin(azimuth), mp.sin(theta))


def smith(alpha, cosine):
    return 2 / (1 + mp.sqrt(1 + alpha**2 * (1 / cosine**2 - 1)))


def ggx(alpha, cosine):
    tangent = 1 / cosine**2 - 1
    return alpha**2 / (mp.pi * cosine**4 * (alpha**2 + tangent) ** 2)


def fresnel(cosine):
    behind = mp.sqrt(1 - (1 - cosine**2) / ETA**2)
    s = (cosine - ETA * behind) / (cosine + ETA * behind)
    p = (ETA * cosine - behind) / (ETA * cosine + behind)
    return (s * s + p * p) / 2


def density(alpha, tilt, normal_azimuth, viewer, light):
    """Light mirrored toward `light` per steradian, by the facets around one scale."""
    normal = direction(mp.mpf(0), normal_azimuth)
    scale = (mp.cos(tilt) * normal[0], mp.cos(tilt) * normal[1], -mp.sin(tilt))
    whole = [v + l for v, l in zip(viewer, light)]
    facet = [x / mp.sqrt(dot(whole, whole)) for x in whole]
    cosines = [dot(viewer, scale), dot(light, scale), dot(viewer, normal), dot(light, normal)]
    if min(cosines) <= 0:
        return mp.mpf(0)
    spread = ggx(alpha, dot(facet, scale)) * smith(alpha, cosines[0]) * smith(alpha, cosines[1])
    return fresnel(dot(viewer, facet)) * spread / (4 * cosines[0])


def far(alpha, tilt, aspect, theta_i, theta_o, phi, phi_o):
    viewer, light = direction(theta_o, phi_o), direction(theta_i, phi_o - phi)
    width = mp.sqrt(mp.sin(phi_o) ** 2 + aspect**2 * mp.cos(phi_o) ** 2)

    def integrand(azimuth):
        arc = aspect**2 / (mp.cos(azimuth) ** 2 + aspect**2 * mp.sin(azimuth) ** 2) ** mp.mpf("1.5")
        return density(alpha, tilt, azimuth, viewer, light) * arc * mp.cos(azimuth - phi_o)

    def span(theta):
        return mp.acos(min(max(mp.tan(tilt) * mp.tan(theta), 0), 1))

    low = max(phi_o - span(theta_o), phi_o - phi - span(theta_i))
    high = min(phi_o + span(theta_o), phi_o - phi + span(theta_i))
    parts = [low + (high - low) * k / 24 for k in range(25)]
    return mp.quad(integrand, parts) / (2 * width)


def near(alpha, tilt, aspect, theta_i, theta_o, phi, phi_o, h):
    """The place of offset h by solving for the point of the ellipse (cos t, b sin t)."""
    width = mp.sqrt(mp.sin(phi_o) ** 2 + aspect**2 * mp.cos(phi_o) ** 2)

    def miss(t):
        return -mp.sin(phi_o) * mp.cos(t) + mp.cos(phi_o) * aspect * mp.sin(t) - h * width

    middle = mp.atan2(mp.sin(phi_o), aspect * mp.cos(phi_o))
    t = mp.findroot(miss, (middle - mp.pi / 2, middle + mp.pi / 2), solver="anderson", tol=1e-50)
    azimuth = mp.atan2(mp.sin(t), aspect * mp.cos(t))
    return density(alpha, tilt, azimuth, direction(theta_o, phi_o), direction(theta_i, phi_o - phi))


CASES = [
    (0.3, 0.0, 1.0, -0.2, 0.3, 0.7, 0.0, 0.2), (0.3, 0.1, 0.6, -0.2, 0.3, 0.7, 0.4, -0.5),
    (0.05, 0.05, 1.0, -0.35, 0.3, 1.2, 0.0, -0.55), (0.02, 0.0, 0.5, -0.3, 0.3, 2.0, 1.0, 0.1),
    (0.8, -0.1, 0.4, 0.9, 0.3, -2.5, -0.6, 0.8), (0.1, 0.1, 0.8, -1.3, 1.2, 0.3, 2.0, 0.3),
    (0.15, 0.05, 1.0, 0.4, 0.5, 0.1, 0.0, 0.05), (1.0, 0.17, 0.7, -0.5, -0.4, 1.5, 0.2, -0.9),
]

print("roughness,tilt,aspect,theta_i,theta_o,phi,phi_o,h,far,near")
for case in CASES:
    a = [mp.mpf(repr(x)) for x in case]
    values = [far(*a[:7]), near(*a)]
    print(",".join([repr(x) for x in case] + [mp.nstr(v, 20) for v in values]))
