"""Direct light that falls from behind on rows of strands, one and two: `tiles` over the reference, by model. The second row stands behind the gaps
of the first, so that light reaches the middle of the first row's fibres alone: what a mean over the width cannot tell.

  PYTHONPATH=build/release/python python bench/rows_against_light.py [--mitsuba]

--mitsuba: `chiang` by Mitsuba 3 too (pip install mitsuba).
"""
import pathlib
import sys
import tempfile

import numpy

import cuticle

SPACING, RADIUS, APART, HEIGHT = 1.2e-3, 5e-4, 2e-3, 0.05  # metres
TO_LIGHT, IRRADIANCE, SIGMA_A = [0.05, 0.3, -1], [5, 5, 5], [0.06, 0.1, 0.2]
MODELS = {"chiang": {"sigma_a": SIGMA_A, "eta": 1.55, "beta_m": 0.3, "beta_n": 0.3, "alpha": 0}, "deon": {"sigma_a": SIGMA_A}, "marschner": {"sigma_a": [0.13, 0.21, 0.41]}}


def points_of(count):
    places = [(SPACING * (i + row % 2 / 2 - 29.5), -APART * row) for row in range(count) for i in range(60)]
    return numpy.array([[[x, y, z] for y in numpy.linspace(-HEIGHT, HEIGHT, 9)] for x, z in places], numpy.float32)


def light(scene, way, passes, **settings):
    return cuticle.Renderer({**scene, "passes": passes}, way, **settings).frame(0)[..., :3].mean()


def mitsuba_light(count):
    """Direct light by its `hair` on B-splines, whose ends are repeated so that they reach the strands' ends."""
    import mitsuba

    mitsuba.set_variant("scalar_rgb")
    with tempfile.TemporaryDirectory() as folder:
        curves = pathlib.Path(folder) / "curves.txt"
        lines = [[*strand[:1], *strand[:1], *strand, *strand[-1:], *strand[-1:]] for strand in points_of(count)]
        curves.write_text("\n\n".join("\n".join(f"{x:.7g} {y:.7g} {z:.7g} {RADIUS}" for x, y, z in line) for line in lines) + "\n")
        to_light = numpy.array(TO_LIGHT) / numpy.linalg.norm(TO_LIGHT)
        fibre = {"type": "hair", "int_ior": 1.55, "ext_ior": 1.0, "sigma_a": {"type": "rgb", "value": SIGMA_A}, "scale": 1.0,
                 "longitudinal_roughness": 0.3, "azimuthal_roughness": 0.3, "scale_tilt": 0.0}
        view = mitsuba.ScalarTransform4f().look_at([0, 0, 1], [0, 0, 0], [0, 1, 0])
        film = {"type": "hdrfilm", "width": 96, "height": 96, "rfilter": {"type": "box"}, "component_format": "float32"}
        scene = mitsuba.load_dict({
            "type": "scene", "integrator": {"type": "path", "max_depth": 2}, "hair": {"type": "bsplinecurve", "filename": str(curves), "bsdf": fibre},
            "light": {"type": "directional", "direction": (-to_light).tolist(), "irradiance": {"type": "rgb", "value": IRRADIANCE}},
            "sensor": {"type": "perspective", "fov": 4, "fov_axis": "y", "near_clip": 0.01, "far_clip": 100, "to_world": view, "film": film},
        })
        return numpy.array(mitsuba.render(scene, spp=64))[..., :3].mean()


def main():
    for count in (1, 2):
        for model, values in MODELS.items():
            scene = {
                "groom": cuticle.make_groom(points_of(count), radii=RADIUS), "head": {"present": False}, "material": {"model": {model: values}},
                "lights": [{"to_light": TO_LIGHT, "irradiance": IRRADIANCE}], "shadow": {"method": {"deep_shadow": {"resolution": 2048}}},
                "camera": {"position_m": [0, 0, 1], "target_m": [0, 0, 0], "fov_deg": 4, "resolution_px": [96, 96]},
            }
            truth = light(scene, "reference", {"reference": {"bounces": 1}}, samples=64)
            drawn = light(scene, "tiles", {"lines": {"ambient": 0}})
            print(f"{count} row{'s' if count > 1 else ''}, {model}: reference {truth:.3f}, tiles {drawn:.3f}, {drawn / truth:.2f} of it")
    if "--mitsuba" in sys.argv[1:]:
        print("Mitsuba, chiang: 1 row {:.3f}, 2 rows {:.3f}".format(mitsuba_light(1), mitsuba_light(2)))


if __name__ == "__main__":
    main()
