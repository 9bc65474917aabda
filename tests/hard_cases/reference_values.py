"""Fills the reference values of catalogue/*.json ("expect": {"reference": "mpmath"}) in 40 digits. Run by hand.

Written from the papers, apart from the C++: Fresnel's equations at the true angle of incidence on an inclined cylinder, roots of
phi(p, h) = phi by bisection, M of d'Eon et al. 2011, equation 7. Only grey fibres and single points have references.
"""
import json
import pathlib

import mpmath as mp

mp.mp.dps = 40
CATALOGUE = pathlib.Path(__file__).with_name("catalogue")
LOBES = {"R": 0, "TT": 1, "TRT": 2}
DEFAULTS = {"eta": "1.55", "sigma_a": "0.2", "beta": "0.2617993877991494", "alpha": "-0.1308996938995747"}

FUNCTIONS = {
    "bessel_i0_scaled": lambda x, _: mp.besseli(0, x) * mp.exp(-x), "sin": lambda x, _: mp.sin(x), "cos": lambda x, _: mp.cos(x),
    "asin": lambda x, _: mp.asin(x), "acos": lambda x, _: mp.acos(x), "atan2": lambda y, x: mp.atan2(y, x),
    "exp": lambda x, _: mp.exp(x), "one_minus_exp": lambda x, _: -mp.expm1(-x),
}


class Fibre:
    def __init__(self, settings):
        given = dict(item.split("=") for item in settings.split(",")) if settings else {}
        values = {name: mp.mpf(given.get(name, default)) for name, default in DEFAULTS.items()}
        self.eta, self.sigma_a, self.beta, self.alpha = (values[name] for name in ("eta", "sigma_a", "beta", "alpha"))

    def width_and_shift(self, p):
        return (self.beta * (1, mp.mpf(1) / 2, 2)[p], 2 * self.alpha * (1, mp.mpf(-1) / 2, mp.mpf(-3) / 2)[p])

    def longitudinal(self, p, theta_i, theta_o):
        width, shift = self.width_and_shift(p)
        v = width**2
        tilted = theta_o - shift
        cosines, sines = mp.cos(theta_i) * abs(mp.cos(tilted)), mp.sin(theta_i) * mp.sin(tilted)
        return mp.exp(-sines / v) * mp.besseli(0, cosines / v) / (2 * v * mp.sinh(1 / v))

    def projected_index(self, theta_d):
        return mp.sqrt(self.eta**2 - mp.sin(theta_d) ** 2) / mp.cos(theta_d)

    def reflectance(self, theta_d, gamma_i):
        cos_i = mp.cos(theta_d) * mp.cos(gamma_i)
        cos_t = mp.sqrt(1 - (1 - cos_i**2) / self.eta**2)
        across = (cos_i - self.eta * cos_t) / (cos_i + self.eta * cos_t)
        along = (self.eta * cos_i - cos_t) / (self.eta * cos_i + cos_t)
        return (across**2 + along**2) / 2

    def attenuation(self, p, theta_d, h):
        f = self.reflectance(theta_d, mp.asin(h))
        if p == 0:
            return f
        cos_theta_t = mp.sqrt(1 - (mp.sin(theta_d) / self.eta) ** 2)
        cos_gamma_t = mp.sqrt(1 - (h / self.projected_index(theta_d)) ** 2)
        crossing = mp.exp(-2 * self.sigma_a * cos_gamma_t / cos_theta_t)
        return (1 - f) ** 2 * f ** (p - 1) * crossing**p

    def exit_azimuth(self, p, theta_d, gamma_i):
        return 2 * p * mp.asin(mp.sin(gamma_i) / self.projected_index(theta_d)) - 2 * gamma_i + p * mp.pi

    def azimuthal(self, p, theta_d, phi):
        total, steps = mp.mpf(0), 720
        phi -= 2 * mp.pi * mp.nint(phi / (2 * mp.pi))
        for k in range(steps):
            low, high = (-mp.pi / 2 + mp.pi * (k + j) / steps for j in (0, 1))
            for turns in range(-3, 4):
                residual = lambda g: self.exit_azimuth(p, theta_d, g) - phi - 2 * mp.pi * turns
                if residual(low) <= 0 < residual(high) or residual(high) <= 0 < residual(low):
                    total += self.share_of_root(p, theta_d, mp.findroot(residual, (low, high), solver="anderson"))
        return total

    def share_of_root(self, p, theta_d, gamma_i):
        h, index = mp.sin(gamma_i), self.projected_index(theta_d)
        slope = 2 * p / (index * mp.sqrt(1 - (h / index) ** 2)) - 2 / mp.cos(gamma_i)
        return self.attenuation(p, theta_d, h) / (2 * abs(slope))


def model_value(inputs):
    fibre, p = Fibre(inputs.get("set", "")), LOBES[inputs["lobe"]]
    angle = lambda key: mp.mpf(str(inputs.get(key, 0))) * mp.pi / 180
    if inputs["quantity"] == "M":
        return fibre.longitudinal(p, angle("theta_i_deg"), angle("theta_o_deg"))
    if inputs["quantity"] == "A":
        return fibre.attenuation(p, angle("theta_d_deg"), mp.mpf(str(inputs["h"])))
    if inputs["quantity"] == "S":
        theta_i, theta_o = angle("theta_i_deg"), angle("theta_o_deg")
        return fibre.longitudinal(p, theta_i, theta_o) * fibre.azimuthal(p, (theta_o - theta_i) / 2, angle("phi_deg"))
    return fibre.azimuthal(p, angle("theta_d_deg"), angle("phi_deg"))


def reference(case):
    inputs = case["inputs"]
    if case["subject"] == "function":
        return FUNCTIONS[inputs["function"]](mp.mpf(inputs["x"]), mp.mpf(inputs.get("second", 0)))
    return model_value(inputs)


def listed(items):
    return ",\n".join("  " + item for item in items)


def write(path, document):
    lines = [f'{{"family": {json.dumps(document["family"])}, "source": {json.dumps(document["source"])},']
    if "grooms" in document:
        grooms = listed(f"{json.dumps(name)}: {json.dumps(groom)}" for name, groom in document["grooms"].items())
        lines += [' "grooms": {', grooms + "},"]
    path.write_text("\n".join([*lines, ' "cases": [', listed(map(json.dumps, document["cases"])), "]}"]) + "\n")


def main():
    for path in sorted(CATALOGUE.glob("*.json")):
        document = json.loads(path.read_text())
        for case in document["cases"]:
            if case["expect"].get("reference") == "mpmath":
                case["expect"]["value"] = float(reference(case))
        write(path, document)


if __name__ == "__main__":
    main()
