"""The shader that MaterialX generates for a document with `chiang_hair_bsdf`, made to evaluate it at given points."""
import csv
import json
import math
import pathlib
import random

import numpy

import MaterialX as mx
import MaterialX.PyMaterialXGenGlsl as glsl
import MaterialX.PyMaterialXGenShader as gen

import work

HERE = pathlib.Path(__file__).resolve().parent
POINTS = 400

# A pixel: x, y, z of its point are theta_i, theta_o, phi in radians, w is h. The rows are the lobes R, TT, and TRT with all longer paths.
MAIN = """
uniform sampler2D cuticle_points;
void main() {
  vec4 point = texelFetch(cuticle_points, ivec2(int(gl_FragCoord.x), 0), 0);
  int lobe = int(gl_FragCoord.y);
  vec3 along = vec3(1.0, 0.0, 0.0);
  vec3 eye = vec3(sin(point.y), cos(point.y), 0.0);
  vec3 light = vec3(sin(point.x), cos(point.x) * cos(point.z), cos(point.x) * sin(point.z));
  vec3 normal = vec3(0.0, sqrt(1.0 - point.w * point.w), point.w);
  vec2 r = vec2(0.0), tt = vec2(0.0), trt = vec2(0.0);
  mx_chiang_hair_roughness(float(%(longitudinal)s), float(%(azimuthal)s), float(%(scale_TT)s), float(%(scale_TRT)s), r, tt, trt);
  BSDF scattered = BSDF(vec3(0.0), vec3(1.0));
  ClosureData closure = ClosureData(CLOSURE_TYPE_REFLECTION, light, eye, normal, vec3(0.0), 1.0);
  mx_chiang_hair_bsdf(closure, vec3(lobe == 0), vec3(lobe == 1), vec3(lobe == 2), float(%(ior)s), r, tt, trt, float(%(cuticle_angle)s),
                      vec3(%(absorption_coefficient)s), normal, along, scattered);
  out1 = vec4(scattered.response, 1.0);
}
"""


def document_of(path):
    document, library = mx.createDocument(), mx.createDocument()
    mx.loadLibraries(mx.getDefaultDataLibraryFolders(), mx.getDefaultDataSearchPath(), library)
    mx.readFromXmlFile(document, str(path))
    document.setDataLibrary(library) if hasattr(document, "setDataLibrary") else document.importLibrary(library)
    return document


def pixel_source(document, generator):
    context = gen.GenContext(generator)
    context.registerSourceCodeSearchPath(mx.getDefaultDataSearchPath())
    target = next(iter(document.getMaterialNodes()))
    return generator.generate(target.getName(), target, context)


def glsl_source(document):
    return pixel_source(document, glsl.GlslShaderGenerator.create()).getSourceCode("pixel")


def evaluating_shader(document):
    """For WebGL 2: the functions as generated, and a main() with the document's numbers."""
    shader = pixel_source(document, glsl.EsslShaderGenerator.create())
    values = {}
    for port in shader.getStage("pixel").getUniformBlock("PublicUniforms"):
        values[port.getName().split("_", 1)[-1]] = port.getValue().getValueString() if port.getValue() else ""
    source = shader.getSourceCode("pixel")
    return source[:source.index("void main()")] + MAIN % values


def values_of(folder, points, lobe, tilt):
    """S of a lobe by the program, near field, of a fibre without a tilt whose light comes `tilt` radians further along it."""
    with open(folder / "materialx_points.csv", "w", newline="") as file:
        lines = csv.writer(file)
        lines.writerow(["theta_i", "theta_o", "phi", "h"])
        lines.writerows([*(repr(math.degrees(angle)) for angle in (theta_i + tilt, theta_o, phi)), repr(-h)] for theta_i, theta_o, phi, h in points)
    found = work.rows("eval", "--material", folder / "hair.mtlx", "--set", "field=near,alpha=0", "--quantity", "S", "--lobe", lobe, "--points", folder / "materialx_points.csv")
    return numpy.array([[float(each[c]) for c in "rgb"] for each in found])


def compare(document, folder):
    """How far the generated GLSL, run by WebGL 2, is from the program: the largest difference of a lobe over the lobe's peak.

    Three things are MaterialX's own and taken into account: the response is S / pi; the scales' tilt turns the light's inclination, where Chiang et al.
    and ours turn the viewer's; and the paths after TRT spread evenly with pi / 2 in place of 1 / (2 pi). What is left is its Bessel function."""
    numbers = random.Random(3)
    points = [[numbers.uniform(-1.3, 1.3), numbers.uniform(-1.3, 1.3), numbers.uniform(-3.1, 3.1), numbers.uniform(-0.98, 0.98)] for _ in range(POINTS)]
    (folder / "materialx_points.json").write_text(json.dumps(points))
    (folder / "materialx.frag").write_text(evaluating_shader(document))
    done = work.node(HERE.parent / "browser/run_page.mjs", HERE / "pages", "materialx.html", f"work={folder}")
    if done.returncode:
        raise RuntimeError(done.stderr[-1500:])
    r, tt, trt = math.pi * numpy.array(json.loads(done.stdout)["rows"])
    alpha = math.pi * (float(next(node for node in document.getNodes() if node.getCategory() == "chiang_hair_bsdf").getInput("cuticle_angle").getValueString()) - 0.5)
    wanted = {"R": values_of(folder, points, "R", 2 * alpha), "TT": values_of(folder, points, "TT", -alpha),
              "TRT and longer": values_of(folder, points, "TRT", -4 * alpha) + math.pi**2 * values_of(folder, points, "residual", 0)}
    return {lobe: float(abs(found - value).max() / value.max()) for (lobe, value), found in zip(wanted.items(), (r, tt, trt))}
