"""Planetary sets with helical teeth: balance of every body in space by vectors, pins, spur limit, hands."""

from typing import Any

import numpy as np
import pytest

from tests.support.planet_sets import (
    BEARING,
    IN_PHASE,
    SEQUENTIAL,
    SMOOTH,
    STIFFNESS,
    TILT,
    helical_set,
    set_case,
)
from tests.support.train_scenarios import case_of_table
from tribodyn.dynamics import approach as contact
from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.modes import natural_frequencies
from tribodyn.errors import InputError
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.right_hand_side import contacts_of
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.prepare import prepare
from tribodyn.train.schedule import interval_of
from tribodyn.train.structure import place_in_space, turn_of


def made(*given: Any, **changes: Any) -> PreparedGearbox:
    return prepare(case_of_table(helical_set(*given, **changes)))


def at_rest(prepared: PreparedGearbox, phase: float) -> tuple[np.ndarray, list[Any]]:
    model = prepared.model
    interval = int(interval_of(np.array(phase), model.schedule)[2])
    y, work = static_equilibrium(model, phase, interval), contacts_of(model)
    derivatives(phase, 0.0, interval, y, model, work, {})
    return y, work


def loads_on(prepared: PreparedGearbox, body: int, y: np.ndarray, work: Any) -> tuple[np.ndarray, np.ndarray]:
    """Force and moment about its centre of all contacts on a body, by vectors."""
    model = prepared.model
    force, moment, e_z = np.zeros(3), np.zeros(3), np.array([0.0, 0.0, 1.0])
    for m, mesh in enumerate(model.meshes):
        ends = model.layout.driver[m], model.layout.driven[m]
        if body not in ends:
            continue
        along = np.array([mesh.along_x, mesh.along_y, 0.0])
        across = np.array([mesh.across_x, mesh.across_y, 0.0])
        sign = -1.0 if body == ends[0] else 1.0
        to_pitch_point = (mesh.driver_radius if sign < 0 else -mesh.driven_radius) * across
        for slot in range(mesh.table.side.shape[0]):
            if work[m][contact.PRESENT, slot] == 0.0:
                continue
            line = mesh.table.side[slot] * work[m][contact.COS, slot] * along
            line = line + work[m][contact.SIN, slot] * across
            normal = work[m][contact.LEAN_COS, slot] * line + work[m][contact.LEAN_SIN, slot] * e_z
            point = to_pitch_point + work[m][contact.DISTANCE, slot] * line
            point = point + work[m][contact.AXIAL_PLACE, slot] * e_z
            push = sign * work[m][contact.NORMAL_LOAD, slot] * normal
            force += push
            moment += np.cross(point, push)
    return force, moment


def motion(prepared: PreparedGearbox, body: int, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Displacement of a body's centre and its small rotation, counter-clockwise about z."""
    layout = prepared.model.layout
    x, up, z, *tilts = (y[place_in_space(body, direction, layout)] for direction in range(5))
    turn = 0.0 if body == 0 else prepared.bodies[body].sense * y[turn_of(body, layout)]
    return np.array([x, up, z]), np.array([*tilts, turn])


@pytest.mark.parametrize("ends", [("sun", "carrier"), ("carrier", "sun")], ids=["reduces", "overdrive"])
def test_every_body_is_in_balance_in_space(ends: tuple[str, str]):
    """Contacts against springs: planets on pins that carriers move, the others on their bearings."""
    prepared = made(SEQUENTIAL, 4, ends=ends)
    model, case, order = prepared.model, prepared.case, list(prepared.order)
    y, work = at_rest(prepared, 0.3)
    gearset = case.sets[0]
    planets = [order.index(planet) for planet in gearset.planets]
    carrier = order.index(gearset.members["carrier"])
    on_carrier = np.zeros(3), np.zeros(3)
    largest = 0.0
    for planet in planets:
        force, moment = loads_on(prepared, planet, y, work)
        reach = np.append(np.subtract(prepared.bodies[planet].centre, prepared.bodies[carrier].centre), 0.0)
        (moved, turned), (of_carrier, carried) = (motion(prepared, body, y) for body in (planet, carrier))
        pull = -STIFFNESS * (moved - of_carrier - np.cross(carried, reach))
        twist = -TILT * (turned - carried)[:2]
        largest = max(largest, float(np.max(np.abs(moment))))
        np.testing.assert_allclose(force + pull, 0.0, atol=1e-6 * np.linalg.norm(pull))
        np.testing.assert_allclose(moment[:2] + twist, 0.0, atol=1e-6 * np.linalg.norm(twist))
        on_carrier[0][:] -= pull
        on_carrier[1][:] -= np.cross(reach, pull)
        on_carrier[1][:2] -= twist
    assert largest > 10.0
    for name in ("sun", "ring", "carrier"):
        body = order.index(gearset.members[name])
        force, moment = on_carrier if name == "carrier" else loads_on(prepared, body, y, work)
        moved, turned = motion(prepared, body, y)
        np.testing.assert_allclose(STIFFNESS * moved, force, atol=1e-6 * np.max(np.abs(force)) + 1e-4)
        np.testing.assert_allclose(TILT * turned[:2], moment[:2], atol=1e-6 * np.max(np.abs(moment)))
    assert model.layout.coupled > 0


@pytest.mark.parametrize(
    ("ends", "on_sun"),
    [(("sun", "carrier"), 600.0 / (1.0 + 84.0 / 24.0)), (("carrier", "sun"), 600.0)],
    ids=["reduces", "overdrive"],
)
def test_axial_forces_on_a_planet_cancel_and_their_moment_tilts_it(ends: tuple[str, str], on_sun: float):
    """F_a on the sun's side, -F_a on the ring's: F_a (r_w,sun + r_w,ring) on the pin's bearing.

    At the radii where the middles of the paths of contact are: contacts alike on either side of these.
    """
    stiff = {**BEARING, "stiffness_tilt": "1e12 N*m/rad"}
    prepared = made(IN_PHASE, 3, ends=ends, bearings={"default": stiff})
    model, case = prepared.model, prepared.case
    planet = prepared.order.index(case.sets[0].planets[0])
    arm, pitch_arm = 0.0, 0.0
    for m, mesh in enumerate(model.meshes):
        both = model.layout.driver[m], model.layout.driven[m]
        if planet in both:
            assembly, drives = prepared.tables[m].assembly, planet == both[0]
            radius = float(mesh.driver_radius if drives else mesh.driven_radius)
            middle = (assembly.r_start + assembly.r_end) / 2.0 * np.sin(assembly.path.pressure_angle(0.0))
            arm += radius + (middle if drives else -middle)
            pitch_arm += radius
    sun = prepared.order.index(case.sets[0].members["sun"])
    m = next(m for m in range(6) if sun in (model.layout.driver[m], model.layout.driven[m]))
    mesh = model.meshes[m]
    radius = float(mesh.driver_radius if sun == model.layout.driver[m] else mesh.driven_radius)
    # F_t tan β_w of one planet
    axial = on_sun / 3.0 / radius * float(mesh.table.pitch_slope)
    phases = (np.arange(8) + 0.5) / 8
    each = [loads_on(prepared, planet, *at_rest(prepared, phase)) for phase in phases]
    force, moment = (np.mean([one[part] for one in each], axis=0) for part in (0, 1))
    assert abs(force[2]) < 1e-6 * axial
    # the first planet is on the x axis: what its forces along z turn it about is y
    assert abs(moment[1]) == pytest.approx(axial * arm, rel=5e-3)
    # the contact analysis has the planet tilted by the loads at its pitch points, the same way
    tilts = case.supports[case.sets[0].planets[0]].displacement[3:]
    assert 1e12 * tilts[1] == pytest.approx(np.sign(moment[1]) * axial * pitch_arm, rel=1e-6)
    assert abs(tilts[0]) < 1e-6 * abs(tilts[1])


def test_a_planet_of_the_contact_analysis_tilts_as_in_the_motion_at_rest():
    """Teeth that carry over their whole face take a tenth of the moment off the pin; as c_γ of the tables."""
    pin = {**BEARING, "stiffness_tilt": "1e5 N*m/rad"}
    prepared = made(IN_PHASE, 3, bearings={"default": BEARING, "planet": pin}, mesh={"slices": 7})
    planet = prepared.case.sets[0].planets[0]
    body = prepared.order.index(planet)
    tilt = np.mean([motion(prepared, body, at_rest(prepared, phase)[0])[1][1] for phase in (0.1, 0.4, 0.7)])
    analysed = prepared.case.supports[planet].displacement[4]
    assert tilt == pytest.approx(analysed, rel=0.03)


def test_hands_the_other_way_round_mirror_the_set():
    one, other = (made(IN_PHASE, 3, hand=hand) for hand in ("right", "left"))
    states = [at_rest(prepared, 0.2)[0] for prepared in (one, other)]
    layout = one.model.layout
    factors = np.ones(layout.half)
    factors[layout.tilts :] = -1.0
    np.testing.assert_allclose(
        factors * states[1][: layout.half], states[0][: layout.half], atol=1e-9 * np.abs(states[0]).max()
    )


def test_a_vanishing_helix_has_the_frequencies_of_the_spur_set_among_its_own():
    """Motions in the plane do not meet those out of it, and slices together are as stiff as the tooth."""
    stiff = {"mesh": {"slices": 3}, "helix_angle": "1e-4 deg"}
    spur = prepare(set_case(IN_PHASE, 3, friction=SMOOTH, frame_forces=False))
    frequencies = [
        natural_frequencies(each.model, [table.cycle for table in each.tables])
        for each in (spur, made(IN_PHASE, 3, **stiff))
    ]
    assert len(frequencies[1]) == len(frequencies[0]) + 3 * 6
    for frequency in frequencies[0]:
        nearest = frequencies[1][np.argmin(np.abs(frequencies[1] - frequency))]
        # a segment's end, where the stiffness jumps, lies between two of 1025 nodes
        assert nearest == pytest.approx(frequency, rel=3e-4)


@pytest.mark.parametrize(
    ("gears", "said"),
    [
        (
            {"sun": "right", "planet": "right"},
            'gear.planet.hand = "right": crosses the hands of the stage set',
        ),
        ({"planet": "left", "ring": "right"}, 'gear.ring.hand = "right": crosses .* write "left"'),
        ({}, "gear.sun.hand: missing: of a helical set one gear"),
    ],
)
def test_hands_that_cross_are_refused_once(gears: dict[str, str], said: str):
    table = helical_set()
    del table["gear"]["sun"]["hand"]
    for gear, hand in gears.items():
        table["gear"][gear]["hand"] = hand
    with pytest.raises(InputError, match=said) as refused:
        case_of_table(table)
    assert len(getattr(refused.value, "errors", [refused.value])) == 1


def test_a_floating_sun_is_held_along_its_axis():
    """Without any bearing the teeth push it along; with one it floats in x and y alone."""
    table = helical_set(floating=["sun"])
    prepared = prepare(case_of_table(table))
    y, _ = at_rest(prepared, 0.1)
    sun = prepared.order.index(prepared.case.sets[0].members["sun"])
    moved, _ = motion(prepared, sun, y)
    torque = 600.0 / (1.0 + 84.0 / 24.0)
    mesh = prepared.model.meshes[0]
    push = torque / float(abs(mesh.driver_radius)) * float(mesh.table.pitch_slope)
    assert abs(moved[2]) * STIFFNESS == pytest.approx(push, rel=1e-6)
    alone = {name: BEARING for name in ("planet", "ring", "carrier")}
    table["bearings"] = alone
    with pytest.raises(
        InputError, match=r"bearings\.sun: missing: teeth push sun of the planetary stage set"
    ):
        case_of_table(table)
