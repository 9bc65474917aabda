"""Strand solvers step by step, their state as arrays."""
import numpy
import pytest

import cuticle


def strands(count=3, vertices=8):
    """Straight hairs of 0.1 m along +x."""
    x = numpy.linspace(0, 0.1, vertices)
    return cuticle.make_groom(numpy.stack([numpy.stack([x, 0 * x, numpy.full(vertices, 0.02 * s)], -1) for s in range(count)]))


SOLVERS = [entry["name"] for entry in cuticle.solvers()]


def tips(state, vertices=8):
    return state.positions.reshape(-1, vertices, 3)[:, -1]


@pytest.mark.parametrize("solver", SOLVERS)
def test_Step_EverySolver_LetsHairFallAndKeepsItsLength(solver):
    simulation = cuticle.simulate(strands(), solver, effects=["gravity"], sag_free=False)
    state = simulation.step(10)
    assert simulation.time == pytest.approx(10 / 30)
    assert tips(state)[:, 1].max() < -0.001 and state.velocities.shape == (24, 3)
    assert numpy.abs(simulation.stretch() - 1).max() < 0.05


@pytest.mark.parametrize("solver", SOLVERS)
def test_Reset_AndTheSameSteps_GiveTheSameBits(solver):
    simulation = cuticle.simulate(strands(), solver)
    first = simulation.step(5).positions
    simulation.reset()
    assert simulation.time == 0
    assert numpy.array_equal(simulation.step(5).positions, first)


def test_State_Arrays_AreViewsThatLaterStepsLeaveAlone():
    simulation = cuticle.simulate(strands(), sag_free=False)
    state = simulation.step()
    assert numpy.shares_memory(state.positions, state.positions)
    kept, copy = state.positions, state.copy()
    before = kept.copy()
    simulation.step(3)
    assert numpy.array_equal(kept, before) and not numpy.shares_memory(copy.positions, kept)
    assert numpy.array_equal(copy.positions, kept) and not numpy.array_equal(simulation.state.positions, kept)


def test_Step_HeadThatTurns_CarriesTheRoots():
    turn = numpy.eye(4)
    turn[:3, :3] = [[0, 0, 1], [0, 1, 0], [-1, 0, 0]]
    simulation = cuticle.simulate(strands(), effects=[])
    roots = simulation.step(2, head=turn).positions.reshape(-1, 8, 3)[:, 0]
    rest = strands().positions.reshape(-1, 8, 3)[:, 0]
    assert roots == pytest.approx(rest @ turn[:3, :3].T, abs=1e-6)
    assert numpy.array_equal(simulation.head, turn)


def test_Colliders_SetBetweenSteps_HoldHairUp():
    free, held = (cuticle.simulate(strands(), sag_free=False) for _ in range(2))
    free.step(10), held.step(2)
    held.set_colliders(spheres=[[0.06, -0.06, 0.02 * s, 0.05] for s in range(3)])
    held.step(8)
    assert tips(held.state)[:, 1].min() > tips(free.state)[:, 1].max() + 0.005
    held.set_colliders(spheres=[])
    held.step(20)
    assert tips(held.state)[:, 1].max() < -0.03


def test_Colliders_CapsulesMeshesAndMovingSpheres_AreTaken():
    simulation = cuticle.simulate(strands(), sag_free=False, capsules=[[0.05, -0.03, -0.1, 0.05, -0.03, 0.1, 0.02]])
    simulation.step(10)
    assert tips(simulation.state)[:, 1].min() > -0.09
    box = numpy.array([[x, y, z] for x in (0.02, 0.12) for y in (-0.1, -0.02) for z in (-0.1, 0.1)], float)
    faces = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
    simulation.set_colliders(capsules=[], meshes=[(box, faces, 0.01)])
    simulation.reset()
    simulation.step(15)
    assert tips(simulation.state)[:, 1].min() > -0.03
    simulation.set_colliders(meshes=[], moving_spheres=[[0.08, -0.5, 0.02, 0.05]])
    simulation.step()
    simulation.set_colliders(moving_spheres=[[0.08, -0.4, 0.02, 0.05]])
    simulation.step()


@pytest.mark.parametrize("make, words", [
    (lambda: cuticle.simulate(strands(), "exat"), ["exat", "exact"]),
    (lambda: cuticle.simulate(strands(), "gravity"), ["gravity", "effect"]),
    (lambda: cuticle.simulate(strands(), effects=["exact"]), ["exact", "solver"]),
    (lambda: cuticle.simulate(strands(), effects={"wind": {"drag": -1}}), ["drag", "-1", "0"]),
    (lambda: cuticle.simulate(strands(), stiffness=3), ["stiffness"]),
    (lambda: cuticle.simulate(strands()).step(head=2 * numpy.eye(4)), ["head"]),
    (lambda: cuticle.simulate(strands()).step(0), ["count", "0"]),
    (lambda: cuticle.simulate(strands(), effects=["gravity"], spheres=[[0, 0, 0, 1]]), ["colliders"]),
    (lambda: cuticle.simulate(strands()).step(seconds=-1), ["duration", "-1"]),
    (lambda: cuticle.simulate(strands(), spheres=[[1, 2, 3]]), ["spheres", "(1, 3)"]),
])
def test_Simulate_BadInput_SaysWhat(make, words):
    with pytest.raises(cuticle.Error) as error:
        make()
    assert all(word in str(error.value) for word in words), str(error.value)


def test_Groom_OfASimulation_CanBeWritten(tmp_path):
    simulation = cuticle.simulate(strands())
    simulation.step(3)
    cuticle.write(simulation.groom(), tmp_path / "moved.hair")
    assert cuticle.load_groom(tmp_path / "moved.hair", metres_per_unit=1).positions == pytest.approx(simulation.state.positions)
    assert simulation.curvature().shape == (24,)


def test_AtRest_OfACantilever_IsTheHeavyElastica():
    """Drop over width of the tip at a weight of 10 over the stiffness: 1.0668 (study/mechanics/reference)."""
    length = (10 * 3.9e9 * 3.5e-5 ** 2 / (4 * 1300) / 9.80665) ** (1 / 3)
    hair = cuticle.make_groom(numpy.linspace([0, 0, 0], [length, 0, 0], 65)[None])
    rest = cuticle.simulate(hair, "rod", ["gravity"], sag_free=False).at_rest()
    tip = rest.groom.positions[-1]
    assert -tip[1] / tip[0] == pytest.approx(1.066802, rel=1e-3)
    assert rest.balanced.all() and rest.stable.all() and rest.residual[0] < 1e-9 and rest.stiffening[0] == 1


def test_AtRest_OfAStrandThatStands_SaysHowMuchItWasStiffened():
    """Gamma is 100 for 13 cm: it stands with 1.25 * 100 / 7.837 times the stiffness."""
    length = (100 * 3.9e9 * 3.5e-5 ** 2 / (4 * 1300) / 9.80665) ** (1 / 3)
    hair = cuticle.make_groom(numpy.linspace([0, 0, 0], [0, length, 0], 65)[None])
    rest = cuticle.simulate(hair, "rod", ["gravity"]).at_rest()
    assert rest.stiffening[0] == pytest.approx(15.95, rel=0.015) and rest.held.all()
    numpy.testing.assert_allclose(rest.groom.positions, hair.positions, atol=1e-6)
    assert not cuticle.simulate(hair, "rod", ["gravity"], stiffen_at_most=4).at_rest().held.any()


def test_AtRest_OfAnotherSolver_IsRefused():
    with pytest.raises(cuticle.Error, match="no equilibrium"):
        cuticle.simulate(strands(), "exact").at_rest()
