"""The model `chiang` (near field) against the shader that MaterialX generates for the node `chiang_hair_bsdf`.

  pip install MaterialX numpy        (in a virtual environment of its own; g++ and GLM to compile what is generated)
  CUTICLE=build/release/bin/cuticle python bench/peers_models/materialx_fibre.py [--count 2000]

The functions of the generated GLSL are compiled as C++ with GLM. Its response is over pi (the convention of MaterialX's lights), which is undone here.
Tints switch its lobes on one by one; TRT and the residual share a tint. Where the two differ: it sums I0 by ten terms below 12; it clamps variances and
widths at 1 (TRT from beta .45); it tilts theta_i where we tilt theta_o; and version 1.39.5 spreads the residual lobe with 1 / 2 * pi in place of
1 / (2 pi), so that it is pi^2 times too bright.
"""
import argparse
import os
import re
import subprocess
import tempfile

import MaterialX as mx
import MaterialX.PyMaterialXGenGlsl as genglsl
import MaterialX.PyMaterialXGenShader as gen
import numpy as np

from cuticle_eval import evaluate, summary

def generated_glsl():
    document = mx.createDocument()
    libraries = mx.createDocument()
    path = mx.getDefaultDataSearchPath()
    mx.loadLibraries(mx.getDefaultDataLibraryFolders(), path, libraries)
    document.setDataLibrary(libraries)
    hair = document.addNode("chiang_hair_bsdf", "hair", "BSDF")
    surface = document.addNode("surface", "surface", "surfaceshader")
    surface.addInput("bsdf", "BSDF").setNodeName(hair.getName())
    material = document.addNode("surfacematerial", "material", "material")
    material.addInput("surfaceshader", "surfaceshader").setNodeName(surface.getName())
    generator = genglsl.GlslShaderGenerator.create()
    context = gen.GenContext(generator)
    context.registerSourceCodeSearchPath(path)
    return generator.generate("hair", material, context).getSourceCode(gen.PIXEL_STAGE)


def function(source, name):
    """The text of a function, from its type to its last brace."""
    begin = re.search(rf"^[a-z0-9A-Z]+ {name}\(", source, re.M).start()
    depth, at = 0, source.index("{", begin)
    while True:
        depth += {"{": 1, "}": -1}.get(source[at], 0)
        at += 1
        if depth == 0:
            return source[begin:at]


def as_cpp(source):
    names = ["mx_hair_transform_sin_cos", "mx_hair_I0", "mx_hair_log_I0", "mx_hair_logistic", "mx_hair_logistic_cdf", "mx_hair_trimmed_logistic", "mx_hair_phi",
             "mx_hair_longitudinal_scattering", "mx_hair_azimuthal_scattering", "mx_hair_alpha_angles", "mx_hair_attenuation", "mx_forward_facing_normal",
             "mx_square", "mx_fresnel_dielectric", "mx_chiang_hair_roughness"]
    known = [name for name in names if re.search(rf"^[a-z0-9A-Z]+ {name}\(", source, re.M)]
    hair = function(source, "mx_chiang_hair_bsdf")
    hair = hair[:hair.index("else if (closureData.closureType == CLOSURE_TYPE_INDIRECT)")].rstrip() + "\n}"
    text = "\n\n".join([function(source, name) for name in sorted(known, key=lambda n: source.index(f"{n}("))] + [hair])
    text = re.sub(r"\b(?:in)?out (\w+) (\w+)\[4\]", r"\1 (&\2)[4]", text)
    text = re.sub(r"\b(?:in)?out (\w+) (\w+)", r"\1& \2", text)
    text = re.sub(r"(?<![\w.])(\d+\.\d*)(?![\w.])", r"\1f", text)
    return """#include <cstdio>
#include <initializer_list>
#include <glm/glm.hpp>
using namespace glm;
#define mx_atan atan2f
static const float M_FLOAT_EPS = 1e-8f, M_PI_INV = 0.31830988618f;
#undef M_PI
static const float M_PI = 3.1415926535f;
enum { CLOSURE_TYPE_REFLECTION = 1 };
struct ClosureData { int closureType; vec3 L, V, N, P; float occlusion; };
struct BSDF { vec3 response, throughput; };
""" + text + """
int main() {
  float lr, ar, tilt, ior, s[3], t[3], l[3], v[3], n[3];
  while (std::scanf("%f %f %f %f", &lr, &ar, &tilt, &ior) == 4) {
    for (float* a : {s, t, l, v, n}) if (std::scanf("%f %f %f", a, a + 1, a + 2) != 3) return 1;
    vec2 r, tt, trt;
    mx_chiang_hair_roughness(lr, ar, 0.5f, 2.0f, r, tt, trt);
    ClosureData data{CLOSURE_TYPE_REFLECTION, {l[0], l[1], l[2]}, {v[0], v[1], v[2]}, {}, {}, 1};
    BSDF bsdf{};
    mx_chiang_hair_bsdf(data, vec3(t[0]), vec3(t[1]), vec3(t[2]), ior, r, tt, trt, tilt, {s[0], s[1], s[2]}, {n[0], n[1], n[2]}, vec3(1, 0, 0), bsdf);
    std::printf("%.9g %.9g %.9g\\n", bsdf.response.x, bsdf.response.y, bsdf.response.z);
  }
}
"""


def compiled(folder):
    source, program = os.path.join(folder, "hair.cpp"), os.path.join(folder, "hair")
    with open(source, "w") as file:
        file.write(as_cpp(generated_glsl()))
    subprocess.run(["g++", "-O1", "-w", "-fpermissive", "-o", program, source], check=True)
    return program


def direction(theta, azimuth):
    """Tangent x, normal plane y z."""
    return np.column_stack([np.sin(theta), np.cos(theta) * np.sin(azimuth), np.cos(theta) * np.cos(azimuth)])


def materialx_values(program, beta_m, beta_n, tilt, sigma_a, tints, theta_i, theta_o, phi, h):
    """The viewer at azimuth 0, the light at -phi, the surface at asin h."""
    count = len(h)
    rows = np.column_stack([np.full((count, 4), [beta_m, beta_n, tilt / np.pi + 0.5, 1.55]), np.full((count, 3), sigma_a), np.full((count, 3), tints),
                            direction(theta_i, -phi), direction(theta_o, np.zeros(count)), direction(np.zeros(count), np.arcsin(h))])
    text = "\n".join(" ".join(f"{x:.9g}" for x in row) for row in rows)
    found = subprocess.run([program], input=text, capture_output=True, text=True, check=True).stdout
    return np.pi * np.array([[float(x) for x in line.split()] for line in found.splitlines()])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--count", type=int, default=2000)
    count = parser.parse_args().count
    random = np.random.default_rng(5)
    theta_i, theta_o = (np.arcsin(random.uniform(-0.98, 0.98, count)) for _ in range(2))
    phi, h = random.uniform(-np.pi, np.pi, count), random.uniform(-0.99, 0.99, count)
    degrees = {"theta_i": np.degrees(theta_i), "theta_o": np.degrees(theta_o), "phi": np.degrees(phi), "h": h}
    print(f"chiang, near field, against the shader generated by MaterialX {mx.getVersionString()}, {count} points, beta_m = beta_n")
    with tempfile.TemporaryDirectory() as folder:
        program = compiled(folder)
        for beta, tilt in ((0.15, 0), (0.3, 0), (0.4, 0), (0.6, 0), (0.3, 2)):
            settings = f"field=near,eta=1.55,beta_m={beta},beta_n={beta},alpha_deg={tilt},sigma_a=0.06/0.1/0.2"
            ours = {lobe: evaluate("chiang", settings, "S", lobe, **degrees) for lobe in ("R", "TT", "TRT", "residual")}
            for name, tints, expected in (("R", (1, 0, 0), ours["R"]), ("TT", (0, 1, 0), ours["TT"]),
                                          ("TRT + residual", (0, 0, 1), ours["TRT"] + ours["residual"]),
                                          ("TRT + pi^2 residual", (0, 0, 1), ours["TRT"] + np.pi**2 * ours["residual"])):
                theirs = materialx_values(program, beta, beta, np.radians(tilt), (0.06, 0.1, 0.2), tints, theta_i, theta_o, phi, h)
                summary(f"beta {beta}, tilt {tilt} degrees: {name}", expected, theirs)


main()
