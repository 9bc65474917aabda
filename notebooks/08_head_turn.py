# ---
# jupyter:
#   jupytext:
#     formats: py:percent
#   kernelspec:
#     display_name: Python 3
#     language: python
#     name: python3
# ---

# %% [markdown]
# # A head turn: hair that lags, pulls, and touches
#
# A head turns by 60 degrees in a third of a second and stops. Hair goes on: it swings past, pulls at its roots, and comes to rest. The solver `exact`
# keeps each segment's length by solving for the tensions of the whole strand at once; spheres stand for the head.

# %%
import os
import pathlib

import matplotlib.pyplot as pyplot
import numpy

import cuticle

figures = pathlib.Path(os.environ.get("CUTICLE_FIGURES", "figures"))
figures.mkdir(parents=True, exist_ok=True)
RATE, FRAMES, TURN = 60, 90, numpy.radians(60)
head = cuticle.make_head()
guides = cuticle.grow({"growing": {"length": 0.3}, "strands": {"control_hairs": 120}}, control=True)
simulation = cuticle.simulate(guides, "exact", frames_per_second=RATE, spheres=head.spheres, shape_stiffness=5)


def turned(frame):
    share = min(max((frame - 10) / 20, 0), 1)
    angle = TURN * share * share * (3 - 2 * share)
    matrix = numpy.eye(4)
    matrix[0, 0] = matrix[2, 2] = numpy.cos(angle)
    matrix[0, 2], matrix[2, 0] = numpy.sin(angle), -numpy.sin(angle)
    return angle, matrix


# %%
roots, tips = guides.offsets[:-1], guides.offsets[1:] - 1
long = numpy.flatnonzero(numpy.linalg.norm(guides.positions[tips] - guides.positions[roots], axis=1) > 0.1)
angles, lag, tension, stretch, inside, shapes = [], [], [], [], [], {}
for frame in range(FRAMES):
    angle, matrix = turned(frame)
    state = simulation.step(head=matrix)
    local = state.positions @ matrix[:3, :3]  # in the head's frame, p' = R^T p
    angles.append(numpy.degrees(angle))
    lag.append(1e3 * numpy.linalg.norm(local[tips] - guides.positions[tips], axis=1)[long].mean())
    tension.append(numpy.maximum.reduceat(state.tensions, roots).mean())
    stretch.append(numpy.abs(simulation.stretch() - 1).max())
    gap = numpy.linalg.norm(local[:, None] - head.spheres[None, :, :3], axis=2) - head.spheres[None, :, 3]
    inside.append(1e3 * max(0, -gap[tips[long]].min()))
    if frame in (9, 20, 30, 89):
        shapes[frame] = state.positions.copy()

# %%
figure, (top, middle, bottom) = pyplot.subplots(3, 1, figsize=(7.5, 7), sharex=True, layout="constrained")
seconds = numpy.arange(1, FRAMES + 1) / RATE
top.plot(seconds, angles, color="black")
top.set(ylabel="head, degrees", title="What the turn does to hair")
middle.plot(seconds, lag, color="#3378bf")
middle.set(ylabel="tips away from where\nthe head has them, mm")
bottom.plot(seconds, tension, color="#bf3845")
bottom.set(xlabel="seconds", ylabel="tension over mass per length\nat its largest, m^2/s^2")
figure.savefig(figures / "turn.png", dpi=130)

# %%
figure, row = pyplot.subplots(1, 4, figsize=(11, 3.4), sharey=True, layout="constrained")
for axes, (frame, positions) in zip(row, shapes.items()):
    for first, last in zip(roots, tips + 1):
        axes.plot(positions[first:last, 0], positions[first:last, 2], color="#7a4a21", linewidth=0.6)
    axes.set(title=f"{(frame + 1) / RATE:.2f} s", aspect="equal", xlabel="x, m", xlim=(-0.25, 0.25), ylim=(-0.25, 0.25))
row[0].set_ylabel("z, m (seen from above)")
figure.savefig(figures / "above.png", dpi=130)

# %% [markdown]
# ## What must hold
#
# Lengths stay, the tips lag during the turn and come back, tension peaks while the head turns.

# %%
print(f"stretch at most {max(stretch):.1e}, lag {max(lag):.1f} mm at frame {numpy.argmax(lag)}, {lag[-1]:.1f} mm at the end, tips at most {max(inside):.2f} mm inside a sphere")
assert max(stretch) < 1e-3
assert 10 <= numpy.argmax(lag) <= 45 and max(lag) > 3 * lag[-1] > 0
assert max(tension[10:40]) > 1.2 * tension[8]
simulation.reset()
assert numpy.array_equal(simulation.state.positions, simulation.state.copy().positions) and simulation.time == 0
