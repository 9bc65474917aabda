"""One groom, camera, light and fibre by Cuticle's path tracer, by Mitsuba 3 and by Blender's Cycles.

  pip install -r bench/peers/requirements.txt      (in a virtual environment of its own; Python 3.11)
  export CUTICLE=build/release/bin/cuticle
  python bench/peers/compare.py OUT [--programs mitsuba,cycles] [--bounces 1,64] [--samples 32] [--size 320] [--hair apart] [--shutter .5]

`--hair`: `dense`, a grown head, whose fibres pass through each other; `apart`, straight fibres in all directions, none of which touch. Cycles meets
the inner side of a fibre around the point where a ray begins, the others do not: only on hair that lies apart should all three agree. `thick`: 3,144 strands of .45 mm radius that
stand for 40,000 fibres; `thin`: 40,000 strands in as many locks (thick_strands.py compares the two).

`--shutter`: the camera travels by a fifth of the picture's height a frame, and the picture is
the mean over so many frames; by Cycles alone.

Each program draws two pictures with other random numbers. Their difference gives its noise, their mean is compared with ours: coverage, mean
radiance of red, green and blue, root mean square of the differences of means over 8 x 8 pixels, and the part of it that is noise. Time is that of the
processor, scene built and picture drawn; `equal error` is how long a program takes for the noise of ours, over our time.
"""
import argparse
import json
import os
import resource
import subprocess
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import against_reference  # noqa: E402
import measured_scenes  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))
FIBRES_EACH = {"thick": measured_scenes.LADDER_FIBRES / measured_scenes.LADDER_STRANDS, "thin": 1}
FIBRE_RADIUS = 3.5e-5  # of a strand of the ladder's blond hair; metres
PIECES = 2  # of a span of the B-spline, for programs that draw straight pieces or curves through points


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("out")
    parser.add_argument("--programs", default="mitsuba,cycles")
    parser.add_argument("--bounces", default="1,64")
    parser.add_argument("--samples", type=int, default=32)
    parser.add_argument("--size", type=int, default=320)
    parser.add_argument("--hair", choices=("dense", "apart", "thick", "thin"), default="dense")
    parser.add_argument("--shutter", type=float, default=0, help="open for so many frames; 0: a still picture")
    return parser.parse_args()


def b_spline(points, pieces):
    """Points of the uniform cubic B-spline whose ends count three times."""
    control = np.concatenate([points[:1], points[:1], points, points[-1:], points[-1:]])
    t = np.arange(pieces)[:, None] / pieces
    weights = np.concatenate([(1 - t) ** 3, 3 * t**3 - 6 * t**2 + 4, -3 * t**3 + 3 * t**2 + 3 * t + 1, t**3], 1) / 6
    spans = np.stack([control[k : len(control) - 3 + k] for k in range(4)], 1)
    return np.concatenate([np.einsum("pk,skc->spc", weights, spans).reshape(-1, 3), points[-1:]])


def distance_to(begin, end, begins, ends):
    """From a segment to the nearest of others (Ericson, Real-Time Collision Detection, 5.1.9)."""
    along, others, away = end - begin, ends - begins, begin - begins
    a, e, f, c, b = along @ along, (others**2).sum(1), (others * away).sum(1), away @ along, others @ along
    s = np.clip((b * f - c * e) / np.maximum(a * e - b * b, 1e-15), 0, 1)
    t = np.clip((b * s + f) / e, 0, 1)
    s = np.clip((b * t - c) / a, 0, 1)
    return np.linalg.norm(away + s[:, None] * along - t[:, None] * others, axis=1).min(initial=np.inf)


def apart(radius, side, length, tries=100000):
    """As many straight fibres of 32 vertices through a cube as find room at 2.1 radii from each other."""
    random, begins, ends = np.random.default_rng(5), np.zeros((0, 3)), np.zeros((0, 3))
    for _ in range(tries):
        middle, along = random.uniform(-side / 2, side / 2, 3), random.normal(size=3)
        along *= length / 2 / np.linalg.norm(along)
        if distance_to(middle - along, middle + along, begins, ends) > 2.1 * radius:
            begins, ends = np.vstack([begins, middle - along]), np.vstack([ends, middle + along])
    share = np.linspace(0, 1, 32)[:, None]
    return [(1 - share) * a + share * b for a, b in zip(begins, ends)]


def grown_ladder(name, out):
    path = os.path.join(out, "strands.npz")
    if not os.path.exists(path):
        specification = measured_scenes.ladder_of_fibres(out) if FIBRES_EACH[name] == 1 else measured_scenes.LADDER
        subprocess.run([measured_scenes.PROGRAM, "grow", specification, "--out", path], check=True, capture_output=True)
    return path


def hair_of(name, out):
    """Strands of control points, their radius, and the camera."""
    if name == "apart":
        camera = {"position_m": [0.1, 0.05, 0.3], "target_m": [0, 0, 0], "fov_deg": 3.4}
        return apart(radius=4e-4, side=0.02, length=0.16), 4e-4, camera
    if name in FIBRES_EACH:
        path, radius = grown_ladder(name, out), FIBRE_RADIUS * FIBRES_EACH[name]
    else:
        radius = measured_scenes.GROOMS["dense"]["groom"]["radius_m"]
        path = measured_scenes.grown("density=4e5", radius, out)
    with np.load(path) as file:
        offsets, positions = file["offsets"].astype(int), file["positions"].astype(float)
    return [positions[a:b] for a, b in zip(offsets[:-1], offsets[1:])], radius, None


def travel(scene, shutter):
    """The camera goes up and aside by a fifth of the picture's height from frame 0 to frame 1, which is drawn."""
    camera, rate = scene["camera"], 30
    position, target = (np.array(camera[key]) for key in ("position_m", "target_m"))
    toward = target - position
    aside = np.cross(toward, [0, 1, 0])
    up = np.cross(aside, toward)
    way = 0.2 * 2 * np.linalg.norm(toward) * np.tan(np.radians(camera["fov_deg"] / 2))
    step = way * (0.6 * aside / np.linalg.norm(aside) + 0.8 * up / np.linalg.norm(up))
    camera["keys"] = [{"time_s": time, "position_m": (position + share * step).tolist(), "target_m": (target + share * step).tolist()}
                      for time, share in ((0, -1), (1 / rate, 0))]
    scene["frames_per_second"] = rate
    scene["passes"]["motion_blur"] = {"shutter": shutter}


def prepare(out, size, hair, shutter=0):
    """Control points for Mitsuba; the curve's points for ours and Cycles; the scene."""
    strands, radius, camera = hair_of(hair, out)
    offsets = np.concatenate([[0], np.cumsum([len(strand) for strand in strands])])
    curves = [b_spline(strand, PIECES) for strand in strands]
    counts = [len(curve) for curve in curves]
    np.savez(os.path.join(out, "controls.npz"), offsets=offsets, positions=np.concatenate(strands), radius=radius)
    np.savez(os.path.join(out, "curves.npz"), offsets=np.concatenate([[0], np.cumsum(counts)]).astype(np.uint32),
             positions=np.concatenate(curves).astype(np.float32), radii=np.full(sum(counts), radius, np.float32))
    groom = {"file": os.path.abspath(os.path.join(out, "curves.npz")), "metres_per_unit": 1, "radius_m": radius}
    scene = measured_scenes.scene("dense", out, size=size, groom=groom, camera=camera)
    if shutter:
        travel(scene, shutter)
    measured_scenes.write(scene, os.path.join(out, "scene.json"))
    return scene


def seconds_of(work):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = work()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return done, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def ours(scene, out, bounces, samples, seed):
    folder = f"{out}/ours_{bounces}_{seed}"
    scene = json.loads(json.dumps(scene))
    scene["passes"]["reference"] = {"seed": seed}
    frame = 1 if "keys" in scene["camera"] else 0
    return against_reference.render(scene, folder, "--method", "reference", "--samples", str(samples), "--bounces",
                                    str(bounces), frame=frame)


def theirs(program, out, bounces, samples, seed):
    picture = f"{out}/{program}_{bounces}_{seed}.npy"
    if not os.path.exists(picture):
        done = subprocess.run([sys.executable, os.path.join(HERE, f"{program}_picture.py"), out, picture, str(bounces),
                               str(samples), str(seed)], capture_output=True, text=True)
        if done.returncode:
            sys.exit(done.stderr)
    return np.load(picture).astype(float)


def twice(draw):
    """The mean of two pictures, the variance of a pixel's radiance in it, and the seconds of both."""
    (a, b), seconds = seconds_of(lambda: (draw(0), draw(1)))
    return (a + b) / 2, ((a - b)[..., :3] ** 2).mean() / 4, seconds


def show(name, mine, other):
    (picture, noise, seconds), (reference, ours_noise, ours_seconds) = other, mine
    against_reference.show(name, picture, reference)
    blocks = measured_scenes.block_means(reference)
    lit = blocks.sum(-1) > 0.05 * blocks.sum(-1).max()
    of_blocks = (noise + ours_noise) * picture[..., 0].size / 64**2 / lit.sum()  # variance of a lit block's mean
    explained = np.sqrt(of_blocks / (blocks[lit] ** 2).mean())
    equal = seconds * noise / (ours_seconds * ours_noise) if ours_seconds * ours_noise > 0 else float("nan")
    print(f"    noise alone: rms {explained:.3f}; processor {seconds:.0f} s, ours {ours_seconds:.0f} s; equal error {equal:.1f}",
          flush=True)


def main():
    options = arguments()
    os.makedirs(options.out, exist_ok=True)
    out = os.path.abspath(options.out)
    if options.shutter and "mitsuba" in options.programs:
        sys.exit("--shutter is compared with Cycles alone: --programs cycles")
    scene = prepare(out, options.size, options.hair, options.shutter)
    for bounces in [int(part) for part in options.bounces.split(",")]:
        mine = twice(lambda seed: ours(scene, out, bounces, options.samples, seed))
        for program in options.programs.split(","):
            show(f"{program}, {bounces} scatterings", mine,
                 twice(lambda seed: theirs(program, out, bounces, options.samples, seed)))


if __name__ == "__main__":
    main()
