"""Light of blond hair on a black head that casts shadows, from three sides by four lights, over that of the reference: direct light, and with dual
scattering, with its corrections and without. Red, green, blue; `direct` over direct light of paths, the others over all light of paths.

  PYTHONPATH=build/release/python python bench/dual_scattering_on_head.py [--drawn thick|thin] [--truth thick|thin] [--far]

thick: 3,144 strands stand for 40,000 fibres, each as wide as thirteen; thin: about 40,000 strands, each a fibre, in as many locks.
--far: of the front lit from behind alone, direct light by paths that take the mean over a fibre's width, as `tiles` does.
"""
import argparse
import copy
import json
import pathlib
import tempfile

import numpy

import cuticle
import measured_scenes

LADDER = pathlib.Path(__file__).resolve().parent.parent / "scenes/ladder"
VIEWS = {"side": [0.95, 0.12, -0.35], "front": [0, 0.12, 1], "back": [-0.6, 0.3, -0.8]}
THICK, THIN = 6e4, 7.63e5  # roots per square metre
LIGHTS = ([0.9, 0.6, -0.1], [-0.6, 0.5, -0.7], [0.9, 0.3, 0.1], [0.1, 0.5, 0.9])


def specified(density, folder):
    """The ladder's hair with another density, in as many locks."""
    file = pathlib.Path(folder) / f"strands_{density:g}.json"
    file.write_text(json.dumps(measured_scenes.with_strands(measured_scenes.LADDER, density / THICK)))
    return str(file)


def on_head(view, to_light, specification):
    scene = json.loads((LADDER / "blond.json").read_text())
    for moving in ("simulation", "motion", "colliders"):
        scene.pop(moving)
    scene["material"] = {"model": {"chiang": {"sigma_a": [0.06, 0.1, 0.2]}}, "evaluate": "direct"}
    scene["shadow"] = {"method": {"deep_opacity": {"layers": 16, "resolution": 512, "filter_texels": 1}}}
    scene["passes"] = {"head": {"skin": [0, 0, 0], "scalp": [0, 0, 0], "ambient": 0}, "surface_shadow": {},
                       "lines": {"ambient": 0, "tip_variation": 0, "variation": 0}}
    scene["camera"].update(position_m=view, resolution_px=[96, 96])
    scene["groom"]["specification"] = specification
    scene["lights"] = [{**scene["lights"][0], "to_light": to_light}]
    return scene


def light(scene, way, **passes):
    scene = copy.deepcopy(scene)
    scene["passes"].update(passes)
    return cuticle.render(scene, method=way)[..., :3].mean((0, 1))


def far(drawn, truth):
    settings = {"samples": 128, "bounces": 1}
    scene, true = (on_head(VIEWS["front"], LIGHTS[1], hair) for hair in (drawn, truth))
    once = light(true, "reference", reference=settings)
    for name, found in (("tiles", light(scene, "tiles")), ("paths", light(scene, "reference", reference=settings)),
                        ("paths, far field", light(scene, "reference", reference={**settings, "field": "far"}))):
        print(f"direct light, front lit from behind, {name}: {{:.2f}} {{:.2f}} {{:.2f}}".format(*found / once), flush=True)


def table(drawn, truth):
    print("view   to_light           direct                all, corrected        all, none")
    off = []
    for name, view in VIEWS.items():
        for to_light in LIGHTS:
            scene, true = (on_head(view, to_light, hair) for hair in (drawn, truth))
            paths = light(true, "reference", reference={"samples": 128})
            once = light(true, "reference", reference={"samples": 128, "bounces": 1})
            found = [light(scene, "tiles") / once]
            found += [light(scene, "tiles", dual_scattering={"corrections": way}) / paths for way in ("path_tracing", "none")]
            off.append([numpy.abs(shares - 1).mean() for shares in found])
            print(f"{name:6} {str(to_light):18}", "   ".join("{:5.2f} {:5.2f} {:5.2f}".format(*shares) for shares in found), flush=True)
    print("off in the mean          {:5.2f}                 {:5.2f}                 {:5.2f}".format(*numpy.mean(off, 0)))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--drawn", choices=("thick", "thin"), default="thick")
    parser.add_argument("--truth", choices=("thick", "thin"), default="thick")
    parser.add_argument("--far", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        hair = {"thick": specified(THICK, folder), "thin": specified(THIN, folder)}
        for name, file in hair.items():
            print(f"{name}: {len(cuticle.grow(json.loads(pathlib.Path(file).read_text())))} strands")
        (far if options.far else table)(hair[options.drawn], hair[options.truth])


if __name__ == "__main__":
    main()
