"""What it costs to find light at parts of long segments: one frame by the number of parts.

  export CUTICLE=build/release/bin/cuticle CUTICLE_TEST_DATA=...
  python bench/segment_parts.py OUT [--grooms ponytail,testhair] [--parts 1,2,4,8] [--evaluate tables,direct] [--repeats 3] [--whole-segments]
                                [--shadow '{"shadow_map":{}}'] [--size 480]

Prints, for each number of parts: the device's work of a frame (by the clock, least of the repeats, which take turns), that of
shadows, of shading and of `tiles`, and the most device memory; times also as a share of those with one part. Every pass runs in
each frame. On software Vulkan nothing else should run beside.
"""
import argparse
import json
import os
import re
import subprocess

import measured_scenes


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("out")
    parser.add_argument("--grooms", default="ponytail,testhair")
    parser.add_argument("--parts", default="1,2,4,8")
    parser.add_argument("--evaluate", default="tables,direct")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--shadow", type=json.loads, default={"shadow_map": {}}, help="method with its parameters, JSON")
    parser.add_argument("--size", type=int, default=480)
    parser.add_argument("--whole-segments", action="store_true", help="segments with parts are drawn as one")
    return parser.parse_args()


def cost_of(scene, folder):
    """Milliseconds by pass, with `frame` for all, and MiB."""
    os.makedirs(folder, exist_ok=True)
    path = measured_scenes.write(scene, os.path.join(folder, "scene.json"))
    done = subprocess.run([measured_scenes.PROGRAM, "--json", "render", path, "--method", "tiles", "--out", folder], check=True,
                          capture_output=True, text=True)
    told = json.loads(done.stdout)
    costs = {row["name"]: row["timestamp_ms_per_frame"] for row in told["passes"]}
    memory = re.search(r"most device memory at once: ([\d.]+) MiB", done.stderr)
    return {**costs, "frame": told["wall_ms_per_frame"], "MiB": float(memory[1])}


def measure(scenes, out, repeats):
    """The least of each cost; the scenes take turns."""
    least = {}
    for repeat in range(repeats):
        for parts, scene in scenes.items():
            cost = cost_of(scene, os.path.join(out, f"parts_{parts}"))
            known = least.setdefault(parts, cost)
            least[parts] = {name: min(ms, known[name]) for name, ms in cost.items()}
    return least


def show(least, shadow):
    first = next(iter(least.values()))
    names = ["frame", shadow, "shade_strands", "tiles"]
    for parts, cost in least.items():
        times = "  ".join(f"{name} {cost[name]:.0f} ms ({cost[name] / first[name]:.2f})" for name in names)
        print(f"  parts {parts}: {times}  memory {cost['MiB']:.0f} MiB", flush=True)


def main():
    options = arguments()
    os.makedirs(options.out, exist_ok=True)
    for groom in options.grooms.split(","):
        for evaluate in options.evaluate.split(","):
            scenes = {}
            for parts in map(int, options.parts.split(",")):
                scene = measured_scenes.scene(groom, options.out, size=options.size)
                scene["groom"]["segment_parts"] = parts
                scene["material"]["evaluate"] = evaluate
                if options.whole_segments:
                    scene["passes"]["tile_lists"] = {"whole_segments": True}
                scene["shadow"]["method"] = options.shadow
                scenes[parts] = scene
            print(f"{groom}, material.evaluate {evaluate}:")
            show(measure(scenes, os.path.join(options.out, f"{groom}_{evaluate}"), options.repeats), next(iter(options.shadow)))


if __name__ == "__main__":
    main()
