"""Direct light of strands that stand for 13 fibres each, over that of as many strands as fibres, hair alone: by Cuticle's path tracer and by Mitsuba 3.

  pip install -r bench/peers/requirements.txt      (in a virtual environment of its own; Python 3.11)
  export CUTICLE=build/release/bin/cuticle
  python bench/peers/thick_strands.py OUT [--samples 32] [--size 160]
"""
import argparse
import os

import compare
import measured_scenes

LIGHTS = {"from beside": [0.6, 0.9, 0.8], "from beside the viewer": [0.3, 0.5, 1], "from behind": [-0.3, 0.6, -1]}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("out")
    parser.add_argument("--samples", type=int, default=32)
    parser.add_argument("--size", type=int, default=160)
    options = parser.parse_args()
    for light, to_light in LIGHTS.items():
        found = {}
        for hair in compare.FIBRES_EACH:
            out = os.path.abspath(os.path.join(options.out, f"{hair}_{light.replace(' ', '_')}"))
            os.makedirs(out, exist_ok=True)
            scene = compare.prepare(out, options.size, hair)
            scene["lights"][0]["to_light"] = to_light
            measured_scenes.write(scene, os.path.join(out, "scene.json"))
            pictures = (compare.ours(scene, out, 1, options.samples, 0), compare.theirs("mitsuba", out, 1, options.samples, 0))
            found[hair] = [picture[..., :3].mean((0, 1)) for picture in pictures]
        for name, thick, thin in zip(("Cuticle", "Mitsuba"), found["thick"], found["thin"]):
            print(f"light {light:22} {name}: thick over thin {{:.3f}} {{:.3f}} {{:.3f}}".format(*thick / thin), flush=True)
        beside = ("{} {:.3f} {:.3f} {:.3f}".format(hair, *theirs / mine) for hair, (mine, theirs) in found.items())
        print(f"light {light:22} Mitsuba over Cuticle: {', '.join(beside)}", flush=True)


if __name__ == "__main__":
    main()
