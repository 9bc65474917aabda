"""Strands that fall and strands that bend, by Cuticle's solvers and by two Python packages, one thread each.

  python -m venv peers; peers/bin/pip install -r bench/peers/requirements_strands.txt
  OMP_NUM_THREADS=1 PYTHONPATH=build/release/python peers/bin/python bench/peers/strands.py [--only swing,cantilever] [--strands 1000]

swing: strands of 32 links and 30 cm, let go level, one second of 60 frames. pyPBD (PositionBasedDynamics) has distance constraints of XPBD there;
`exact` has lengths that cannot change, `rod` bends as hair does as well. Told: processor time of a frame, and the longest link over its rest length.

cantilever: one fibre of 10 cm, clamped level, at rest under its own weight, against the elastica (shooting in 4,000 steps). PyElastica is explicit:
its time step is bound to the speed of sound in a link. Told: how far the free end is off, and processor time until the fibre rests.
"""
import argparse
import contextlib
import io
import os
import time

import cuticle
import numpy

LENGTH, LINKS, FRAMES, RATE, GRAVITY = 0.3, 32, 60, 60, 9.81


def level(strands, length, links):
    points = numpy.zeros((strands, links + 1, 3))
    points[:, :, 0] = numpy.linspace(0, length, links + 1)
    points[:, :, 2] = 0.01 * numpy.arange(strands)[:, None]
    return points


def swing_cuticle(solver, strands, **settings):
    motion = cuticle.simulate(cuticle.make_groom(level(strands, LENGTH, LINKS)), solver, ["gravity"], sag_free=False, clamped_vertices=1, **settings)
    longest, begin = 0.0, time.process_time()
    for _ in range(FRAMES):
        state = motion.step(1)
        links = numpy.diff(numpy.asarray(state.positions, float).reshape(strands, LINKS + 1, 3), axis=1)
        longest = max(longest, numpy.linalg.norm(links, axis=2).max() / (LENGTH / LINKS))
    return (time.process_time() - begin) / FRAMES, longest


def swing_pypbd(strands, steps, iterations):
    import pypbd
    simulation = pypbd.Simulation.getCurrent()
    simulation.initDefault()
    model = simulation.getModel()
    model.cleanup()
    particles, points = model.getParticles(), level(strands, LENGTH, LINKS)
    for strand in points:
        for k, place in enumerate(strand):
            particles.addVertex(place)
            particles.setMass(particles.size() - 1, 0.0 if k == 0 else 1.0)
    for s in range(strands):
        for k in range(LINKS):
            first = s * (LINKS + 1) + k
            model.addDistanceConstraint_XPBD(first, first + 1, 1e12)
    stepper = simulation.getTimeStep()
    stepper.setValueUInt(pypbd.TimeStepController.NUM_SUB_STEPS, steps)
    stepper.setValueUInt(pypbd.TimeStepController.MAX_ITERATIONS, iterations)
    pypbd.TimeManager.getCurrent().setTimeStepSize(1 / RATE)
    longest, spent = 0.0, 0.0
    for _ in range(FRAMES):
        begin = time.process_time()
        stepper.step(model)
        spent += time.process_time() - begin
        places = numpy.array([particles.getPosition(i) for i in range(particles.size())]).reshape(strands, LINKS + 1, 3)
        longest = max(longest, numpy.linalg.norm(numpy.diff(places, axis=1), axis=2).max() / (LENGTH / LINKS))
    return spent / FRAMES, longest


def swing(strands):
    print(f"swing: {strands} strands of {LINKS} links, {FRAMES} frames of 1/{RATE} s; ms of one core a frame, longest link")
    for solver in ("classic", "exact", "rod"):
        spent, longest = swing_cuticle(solver, strands)
        print(f"  cuticle {solver:<22} {1e3 * spent:8.2f} ms   {longest:.6f}", flush=True)
    for steps, iterations in ((1, 10), (4, 5), (8, 20), (32, 20)):
        spent, longest = swing_pypbd(strands, steps, iterations)
        print(f"  pyPBD {steps:2} steps, {iterations:2} iterations {1e3 * spent:8.2f} ms   {longest:.6f}", flush=True)


def elastica_end(gamma, steps=4000):
    """Where the free end lies, over the length: theta'' = gamma (1 - s) cos(theta), theta(0) = 0, theta'(1) = 0."""
    step = 1 / steps

    def angles(bend):
        found, theta = [0.0], 0.0
        for i in range(steps):
            s = i * step
            a1, b1 = bend, gamma * (1 - s) * numpy.cos(theta)
            a2, b2 = bend + step / 2 * b1, gamma * (1 - s - step / 2) * numpy.cos(theta + step / 2 * a1)
            a3, b3 = bend + step / 2 * b2, gamma * (1 - s - step / 2) * numpy.cos(theta + step / 2 * a2)
            a4, b4 = bend + step * b3, gamma * (1 - s - step) * numpy.cos(theta + step * a3)
            theta, bend = theta + step / 6 * (a1 + 2 * a2 + 2 * a3 + a4), bend + step / 6 * (b1 + 2 * b2 + 2 * b3 + b4)
            found.append(theta)
        return bend, numpy.array(found)

    low, high = -gamma, 0.0
    for _ in range(36):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if angles(middle)[0] > 0 else (middle, high)
    theta = angles(0.5 * (low + high))[1]
    middle = 0.5 * (theta[1:] + theta[:-1])
    return numpy.array([numpy.cos(middle).sum(), numpy.sin(middle).sum()]) * step


DENSITY, RADIUS, FIBRE = 1300.0, 1e-3, 0.1  # Gamma alone sets the shape; at a hair's radius an explicit step is 30 times shorter


def young_modulus(gamma):
    return DENSITY * numpy.pi * RADIUS**2 * GRAVITY * FIBRE**3 / gamma / (numpy.pi * RADIUS**4 / 4)


def cantilever_cuticle(gamma, links):
    begin = time.process_time()
    motion = cuticle.simulate(cuticle.make_groom(level(1, FIBRE, links), radii=RADIUS), "rod", ["gravity"], sag_free=False, young_modulus=young_modulus(gamma),
                              shear_modulus=young_modulus(gamma) / 3, fibre_radius=RADIUS, clamped_vertices=1, damping=30, inner_step=1 / 960, double_precision=True)
    end = numpy.asarray(motion.step(150).positions, float)[-1] / FIBRE
    return time.process_time() - begin, end[:2]


def cantilever_pyelastica(gamma, links):
    import elastica

    class Fibre(elastica.BaseSystemCollection, elastica.Constraints, elastica.Forcing, elastica.Damping):
        pass

    system = Fibre()
    modulus = young_modulus(gamma)
    rod = elastica.CosseratRod.straight_rod(links, numpy.zeros(3), numpy.array([1.0, 0, 0]), numpy.array([0.0, 1, 0]), FIBRE, RADIUS, DENSITY,
                                            youngs_modulus=modulus, shear_modulus=modulus / 3)
    system.append(rod)
    system.constrain(rod).using(elastica.OneEndFixedBC, constrained_position_idx=(0,), constrained_director_idx=(0,))
    system.add_forcing_to(rod).using(elastica.GravityForces, acc_gravity=numpy.array([0, -GRAVITY, 0]))
    step = 0.4 * min(RADIUS, FIBRE / links) * numpy.sqrt(DENSITY / modulus)
    system.dampen(rod).using(elastica.AnalyticalLinearDamper, uniform_damping_constant=20.0, time_step=step)
    system.finalize()
    stepper, seconds = elastica.PositionVerlet(), 1.5
    with contextlib.redirect_stdout(io.StringIO()):
        elastica.integrate(stepper, system, 10 * step, 10, progress_bar=False)  # numba compiles here
    begin = time.process_time()
    with contextlib.redirect_stdout(io.StringIO()):
        elastica.integrate(stepper, system, seconds, int(seconds / step), progress_bar=False)
    return time.process_time() - begin, rod.position_collection[:2, -1] / FIBRE


def cantilever():
    print("cantilever: the free end against the elastica in per cent of the length; seconds of one core")
    for gamma in (3, 10, 40):
        truth = elastica_end(gamma)
        for name, run, links in (("cuticle rod", cantilever_cuticle, 32), ("PyElastica", cantilever_pyelastica, 32), ("PyElastica", cantilever_pyelastica, 64)):
            spent, end = run(gamma, links)
            off = numpy.linalg.norm(end - truth * [1, numpy.sign(truth[1]) * numpy.sign(end[1])])
            print(f"  Gamma {gamma:2}: {name:<12} {links} links: {100 * off:.3f} %, {spent:.2f} s", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--only", default="swing,cantilever")
    parser.add_argument("--strands", type=int, default=1000)
    arguments = parser.parse_args()
    if os.environ.get("OMP_NUM_THREADS") != "1":
        parser.error("set OMP_NUM_THREADS=1: pyPBD takes all threads otherwise")
    cuticle.set_threads(1)
    if "swing" in arguments.only:
        swing(arguments.strands)
    if "cantilever" in arguments.only:
        cantilever()


main()
