"""Shafts in six directions: closed forms of beams, whirl, condensation, and the balance of forces."""

import numpy as np
import pytest
from scipy.linalg import eig, eigh

from tribodyn.numerics.shapes import Array, Float
from tribodyn.train.elastic.beam import ShaftMetal, ShaftSection, shear_factor
from tribodyn.train.elastic.beam_matrices import SIX, matrices
from tribodyn.train.elastic.rolling_bearing import BallRow, RollerRow
from tribodyn.train.elastic.system import (
    PlacedBearing,
    PlacedShaft,
    ShaftSystem,
    SystemMatrices,
    reduced,
    settled,
    structure_of,
)

STEEL, DENSITY = ShaftMetal(206e9, 0.3), 7850.0
RIGIDITY = 206e9 / 2.6
LENGTH, DIAMETER, BORE = 0.4, 0.06, 0.02
AREA = np.pi / 4.0 * (DIAMETER**2 - BORE**2)
INERTIA = np.pi / 64.0 * (DIAMETER**4 - BORE**4)
PIECES = 48
BALL = BallRow(9, 12e-3, 60e-3, clearance=10e-6)
ROLLER = RollerRow(14, 11e-3, 11e-3, 60e-3)
STEPPED = (ShaftSection(0.1, 0.04), ShaftSection(0.08, 0.06, 0.02), ShaftSection(0.12, 0.045))
LOADS = [[900.0, -2500.0, 400.0, 15.0, -8.0], [-1200.0, 3000.0, 300.0, -6.0, 20.0]]


def bar(
    diameter: float = DIAMETER, bore: float = BORE, spin: float = 0.0, pieces: int = PIECES
) -> SystemMatrices:
    """A uniform shaft that nothing holds."""
    section = ShaftSection(LENGTH, diameter, bore)
    return structure_of(ShaftSystem((PlacedShaft((section,), STEEL, DENSITY, (), (), spin),)), pieces)


def stepped(spin: float = 0.0, linear: bool = False) -> ShaftSystem:
    """Two points on a stepped shaft in a ball and a roller bearing, or two springs."""
    springs = tuple(map(tuple, np.diag([2e8, 3e8, 1e8, 1e4, 1e4]).tolist()))
    rows = (springs, springs) if linear else (BALL, ROLLER)
    bearings = tuple(PlacedBearing(z, row) for z, row in zip((0.02, 0.28), rows, strict=True))
    return ShaftSystem((PlacedShaft(STEPPED, STEEL, DENSITY, (0.13, 0.22), bearings, spin),))


def frequencies(structure: SystemMatrices, held: list[int], directions: list[int]) -> Float[Array, " mode"]:
    """Angular frequencies of motions in some directions, with coordinates held."""
    free = [i for i in range(len(structure.mass)) if i % SIX in directions and i not in held]
    inner = np.ix_(free, free)
    return np.sqrt(np.maximum(eigh(structure.stiffness[inner], structure.mass[inner])[0], 0.0))


def last(structure: SystemMatrices, direction: int) -> int:
    return len(structure.mass) - SIX + direction


def whirl(spin: float, pieces: int) -> list[tuple[float, float]]:
    """Angular frequencies of a simply supported shaft, increasing, and the sense in which it whirls."""
    structure = bar(spin=spin, pieces=pieces)
    ends = [0, 1, last(structure, 0), last(structure, 1)]
    free = [i for i in range(len(structure.mass)) if i % SIX in (0, 1, 3, 4) and i not in ends]
    inner, none = np.ix_(free, free), np.zeros((len(free), len(free)))
    first = np.block([[none, np.eye(len(free))], [-structure.stiffness[inner], -structure.damping[inner]]])
    second = np.block([[np.eye(len(free)), none], [none, structure.mass[inner]]])
    values, shapes = eig(first, second)
    sideways = [n for n, i in enumerate(free) if i % SIX == 0]
    found = []
    for value, shape in zip(values, shapes.T, strict=True):
        if value.imag > 0.0:  # y lags x by a quarter where it whirls counter-clockwise
            x, y = shape[sideways], shape[np.add(sideways, 1)]
            found.append((value.imag, float(np.sum(np.imag(x * np.conj(y))))))
    return sorted(found)


@pytest.mark.parametrize("spin", [0.0, 3000.0])
def test_whirl_of_a_simply_supported_shaft(spin: float):
    """Timoshenko's: (κ G A k² − ρ A ω²)(E I k² + κ G A − ρ I ω² + 2 ρ I Ω ω) = (κ G A k)², k = n π/L.

    ω > 0 turns with the shaft. Elements converge with the square of their length.
    """
    coarse, fine = whirl(spin, 24), whirl(spin, 48)
    shear = shear_factor(0.3, BORE / DIAMETER) * RIGIDITY * AREA
    bending, across, rotary = 206e9 * INERTIA, DENSITY * AREA, DENSITY * INERTIA
    for mode in (1, 2):
        wave = mode * np.pi / LENGTH
        determinant = np.polysub(
            np.polymul(
                [-across, 0.0, shear * wave**2],
                [-rotary, 2.0 * rotary * spin, bending * wave**2 + shear],
            ),
            [(shear * wave) ** 2],
        )
        roots = np.sort(np.roots(determinant).real)
        expected = np.array([-roots[roots < 0.0][-1], roots[roots > 0.0][0]])
        both = slice(2 * mode - 2, 2 * mode)
        errors = [np.array([one for one, _ in found[both]]) / expected - 1.0 for found in (coarse, fine)]
        assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.02)
        assert (4.0 * errors[1] - errors[0]) / 3.0 == pytest.approx(0.0, abs=2e-6)
        if spin:
            assert fine[both][0][1] < 0.0 < fine[both][1][1]


def test_bernoulli_of_a_slender_cantilever():
    """β₁ L = 1.87510407, β₂ L = 4.69409113."""
    structure = bar(1e-3, 0.0)
    found = frequencies(structure, list(range(SIX)), [0, 4])[:2]
    inertia_over_area = (1e-3 / 4.0) ** 2
    expected = np.array([1.87510407, 4.69409113]) ** 2 / LENGTH**2
    assert found == pytest.approx(expected * np.sqrt(206e9 * inertia_over_area / DENSITY), rel=5e-5)


@pytest.mark.parametrize(("direction", "modulus"), [(5, RIGIDITY), (2, 206e9)])
def test_waves_along_a_bar(direction: int, modulus: float):
    """Torsion and extension: free n c/(2 L), held at one end (2 n − 1) c/(4 L); rods of linear elements."""
    structure, speed = bar(), np.sqrt(modulus / DENSITY)
    free = frequencies(structure, [], [direction])[:3]
    assert free == pytest.approx(np.arange(3) * np.pi * speed / LENGTH, rel=1e-3, abs=1.0)
    held = frequencies(structure, list(range(SIX)), [direction])[:2]
    assert held == pytest.approx(np.array([0.5, 1.5]) * np.pi * speed / LENGTH, rel=1e-3)


def test_rigid_motions_have_the_inertia_of_a_tube():
    """Mass, transverse and polar inertia, and the angular momentum of its spin; no strain."""
    one = matrices(ShaftSection(LENGTH, DIAMETER, BORE), LENGTH, STEEL, DENSITY)
    rigid = np.zeros((2 * SIX, SIX))
    for node, z in enumerate((-LENGTH / 2.0, LENGTH / 2.0)):
        rigid[SIX * node : SIX * (node + 1)] = np.eye(SIX)
        rigid[SIX * node, 4], rigid[SIX * node + 1, 3] = z, -z
    mass, radii = DENSITY * AREA * LENGTH, (DIAMETER**2 + BORE**2) / 4.0
    transverse = mass * (radii / 4.0 + LENGTH**2 / 12.0)
    polar = mass * radii / 2.0
    expected = np.diag([mass, mass, mass, transverse, transverse, polar])
    assert rigid.T @ one.mass @ rigid == pytest.approx(expected, rel=1e-12, abs=1e-12 * mass)
    momentum = np.zeros((SIX, SIX))
    momentum[3, 4], momentum[4, 3] = polar, -polar
    assert rigid.T @ one.gyroscopic @ rigid == pytest.approx(momentum, rel=1e-12, abs=1e-12 * polar)
    assert np.max(np.abs(one.stiffness @ rigid)) < 1e-9 * np.max(one.stiffness)


def test_reactions_balance_the_loads():
    """Forces and moments about the start of the shaft, of bearings with clearance."""
    state = settled(structure_of(stepped()), LOADS)

    def resultant(places: list[float], loads: list[np.ndarray]) -> np.ndarray:
        total = np.zeros(5)
        for z, load in zip(places, loads, strict=True):
            total += load + np.array([0.0, 0.0, 0.0, -z * load[1], z * load[0]])
        return total

    on_bearings = resultant([0.02, 0.28], [bearing.force for bearing in state.bearings])
    outer = resultant([0.13, 0.22], list(map(np.array, LOADS)))
    assert on_bearings == pytest.approx(outer, rel=1e-6, abs=1e-5)


@pytest.mark.parametrize("elements", [1, 24])
def test_condensation_is_exact_for_loads_on_the_points(elements: int):
    """About an equilibrium of springs another load's displacement follows from the reduced matrix."""
    structure = structure_of(stepped(linear=True), elements)
    left = reduced(settled(structure, LOADS))
    other = settled(structure, [LOADS[1], LOADS[0]])
    five = [i for i in range(2 * SIX) if i % SIX != 5]
    inner = left.stiffness[np.ix_(five, five)]
    load = np.ravel([LOADS[1], LOADS[0]])
    assert np.linalg.solve(inner, load + left.force[five]) == pytest.approx(
        other.points.ravel()[five], rel=1e-7, abs=1e-14
    )
    assert left.force[five] == pytest.approx(np.zeros(10), abs=1e-6)  # springs have no constant force


def test_the_reduced_forces_stand_against_the_loads():
    """−K q + f0 = −F at the equilibrium of rolling bearings; recovery and reactions are those found there."""
    state = settled(structure_of(stepped()), LOADS)
    left = reduced(state)
    at = state.points.ravel()
    forces = (-left.stiffness @ at + left.force).reshape(2, SIX)[:, :5]
    assert forces == pytest.approx(-np.array(LOADS), rel=1e-7, abs=1e-6)
    found = left.reaction @ at + left.reaction_at_rest
    assert found == pytest.approx(np.array([one.force for one in state.bearings]), rel=1e-9, abs=1e-6)


def test_the_tangent_is_the_slope_of_the_equilibrium():
    structure, step = structure_of(stepped()), 1.0
    left = reduced(settled(structure, LOADS))
    more, less = (
        settled(structure, [[LOADS[0][0] + change, *LOADS[0][1:]], LOADS[1]]).points.ravel()
        for change in (step, -step)
    )
    five = [i for i in range(2 * SIX) if i % SIX != 5]
    slope = np.linalg.inv(left.stiffness[np.ix_(five, five)])[:, 0]
    assert ((more - less) / (2.0 * step))[five] == pytest.approx(slope, rel=1e-5, abs=1e-5 * slope[0])


def test_modes_with_held_points_complete_the_motion():
    """Frequencies of the reduced system go to those of all nodes, from above, with more of these modes."""
    state = settled(structure_of(stepped(linear=True), 24), LOADS)
    tangent, mass = state.tangent(), state.structure.mass
    free = np.setdiff1d(np.arange(len(mass)), state.structure.turns)
    whole = np.sqrt(eigh(tangent[np.ix_(free, free)], mass[np.ix_(free, free)])[0][:6])
    errors = []
    for limit in (0.0, 8000.0, 40000.0):
        left = reduced(state, limit)
        own = [i for i in range(len(left.mass)) if i >= 2 * SIX or i % SIX != 5]
        found = np.sqrt(eigh(left.stiffness[np.ix_(own, own)], left.mass[np.ix_(own, own)])[0][:6])
        assert np.all(found >= whole * (1.0 - 1e-9))
        assert left.next_frequency > limit or not left.modes
        errors.append(float(np.max(found / whole - 1.0)))
    assert errors[0] > errors[1] > errors[2]
    assert errors[2] < 1e-4
