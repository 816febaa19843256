"""Planetary stages of trains: phases, forces on the sun, load shares, energy, by second methods."""

from itertools import permutations

import numpy as np
import pytest

from tests.support.planet_sets import IN_PHASE, SEQUENTIAL, planet_set, set_case, tangent_loads
from tests.support.planetary_phases import mesh_phases
from tests.support.single_set import excited, torques
from tests.support.train_scenarios import case_of_table
from tribodyn.dynamics.modes import modes
from tribodyn.errors import InputError
from tribodyn.gears.case import STAGES
from tribodyn.geometry.assembly import half_angles
from tribodyn.record.reader import Record
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.orbit.gear_map import GearMap, moving_states
from tribodyn.solve.orbit.periodic import steady_states
from tribodyn.studies.motion.planetary.results import kinds_of
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.motion.run import run
from tribodyn.train.planetary import (
    MEMBERS,
    SetTeeth,
)
from tribodyn.train.structure import shift_of, turn_of

SUN, RING, CARRIER = 0, 1, 2


@pytest.mark.parametrize("sense", ["clockwise", "counter-clockwise"])
@pytest.mark.parametrize("places", [(0, 36, 72), (0, 31, 75)])
@pytest.mark.parametrize("teeth", [IN_PHASE, SEQUENTIAL])
def test_phases_are_those_of_the_turned_outlines(teeth, places, sense):
    """The teeth put together tooth by tooth against the formula that turned outlines have checked."""
    angles = [f"{360.0 / 108.0 * place:.12f} deg" for place in places]
    prepared = prepare(set_case(teeth, angles=angles, operating={"sense": sense}))
    own, at_sun, at_ring = prepared.case.sets[0], prepared.tables[0], prepared.tables[3]
    entries = []
    for made in (at_sun, at_ring):
        path = made.assembly.path
        base = float(path.pinion_pitch_radius * np.cos(path.pressure_angle(0.0)))
        entries.append(float(made.cycle.roll_start) * base / (2.0 * np.pi * base) * made.cycle.pinion_teeth)
    halves = half_angles(at_sun.assembly)[1], half_angles(at_ring.assembly)[0]
    way = 1 if sense == "counter-clockwise" else -1
    expected = np.concatenate(mesh_phases(own.teeth, own.angles, halves, tuple(entries), way))
    off = (np.array(prepared.phases.meshes) - expected + 0.5) % 1.0 - 0.5
    np.testing.assert_allclose(off, 0.0, atol=1e-9)


@pytest.fixture(scope="module")
def steady():
    """Steady states of sets in phase and sequential, with their models."""
    found = []
    for teeth in (IN_PHASE, SEQUENTIAL):
        model = prepare(set_case(teeth)).model
        found.append((teeth, model, steady_states([model])[0]))
    return found


def test_meshes_excite_what_the_phases_allow(steady):
    """Forces on the sun or torques on the carrier vanish, by the harmonic times the sun's teeth."""
    for (sun, planet, ring), model, motion in steady:
        assert motion.period == 1
        assert motion.stable
        samples, layout = motion.samples, model.layout
        whirl = np.fft.fft(samples[:, shift_of(SUN)] + 1j * samples[:, shift_of(SUN) + 1]) / len(samples)
        turning = np.fft.rfft(samples[:, turn_of(CARRIER, layout)]) / len(samples)
        moved = {h: max(abs(whirl[h]), abs(whirl[-h])) for h in range(1, 7)}
        turned = {h: abs(turning[h]) for h in range(1, 7)}
        for h in range(1, 7):
            rotates = "rotational" in excited(SetTeeth(sun, planet, -ring), 3, h)
            assert bool(turned[h] > 1e-2 * max(turned.values())) is rotates
            if rotates:
                # what is left of translation is the steady state's own tolerance
                assert moved[h] < max(1e-3 * max(moved.values()), 1e-15)
            else:
                assert turned[h] < 1e-3 * max(turned.values())
                assert moved[h] > 1e-2 * max(moved.values())


def test_kinds_of_modes_are_kept_apart_where_all_meshes_are_in_phase():
    """The derivative of a mesh cycle's map, without loss of contact: in phase rotations stay rotations."""
    mixing = {}
    for teeth in (IN_PHASE, SEQUENTIAL):
        model = prepare(set_case(teeth, operating={"output_torque": "20000 N*m"})).model
        state, moving = static_equilibrium(model), moving_states(model)
        way = GearMap(
            [model],
            state[None],
            moving,
            solver="dopri5",
            rtol=1e-7,
            fine_rtol=1e-9,
            max_steps=10**6,
            workers=1,
        )
        jacobian = way.tangent(state[None, list(moving.states)], np.array([0]), 1).jacobian[0]
        scaled = jacobian * way.scale[0] / way.scale[0][:, None]
        rotational = _rotational(model, moving.states) / way.scale[0][:, None]
        basis, _ = np.linalg.qr(rotational)
        image = scaled @ basis
        mixing[teeth] = np.linalg.norm(image - basis @ (basis.T @ image)) / np.linalg.norm(image)
    assert mixing[IN_PHASE] < 1e-6
    assert mixing[SEQUENTIAL] > 1e-3


def test_sequential_meshes_do_not_excite_a_rotational_mode_by_its_double():
    """Floquet multipliers at twice the frequency of a rotational mode, all flanks in contact, little damping.

    In phase there is an unstable tongue about it; where the meshes come one after another their first
    harmonics cancel for rotations (Lin & Parker, J. Sound Vib. 249 (2002) 129).
    """
    largest = {}
    for teeth in (IN_PHASE, SEQUENTIAL):
        prepared = prepare(_lightly_damped(teeth, 900.0))
        found = modes(prepared.model, [made.cycle for made in prepared.tables])
        kinds = kinds_of(prepared, found)
        mode = found.frequency[[i for i, kind in enumerate(kinds) if kind == "rotational"][3]]
        meshing = 900.0 / 60.0 * teeth[0] * teeth[2] / (teeth[0] + teeth[2])
        speeds = [900.0 * 2.0 * share * mode / meshing for share in (0.97, 1.0, 1.03)]
        models = [prepare(_lightly_damped(teeth, speed)).model for speed in speeds]
        starts, moving = np.array([static_equilibrium(model) for model in models]), moving_states(models[0])
        way = GearMap(
            models, starts, moving, solver="dopri5", rtol=1e-7, fine_rtol=1e-9, max_steps=10**6, workers=1
        )
        tangent = way.tangent(starts[:, list(moving.states)], np.arange(len(models)), 1)
        largest[teeth] = [np.max(np.abs(np.linalg.eigvals(one))) for one in tangent.jacobian]
    below, at, above = largest[IN_PHASE]
    assert at > 1.03
    assert max(below, above, *largest[SEQUENTIAL]) < 1.0


def _lightly_damped(teeth, speed):
    """A set of large contact ratios at a load that keeps all flanks together; speed of the sun in rpm."""
    ratio = 0.002
    bearing = {"stiffness_x": "3e8 N/m", "stiffness_y": "3e8 N/m", "damping_ratio": ratio}
    table = planet_set(
        teeth,
        support_damping_ratio=ratio,
        mesh={"damping_ratio": ratio},
        bearings={"default": bearing},
        operating={"input_speed": f"{speed} rpm", "output_torque": "200000 N*m"},
        frame_forces=False,
    )
    table["friction"] = {"law": "none"}
    table["gear"]["sun"] |= {"addendum": 1.22, "dedendum": 1.45, "fillet_radius": 0.1}
    table["gear"]["planet"] |= {"addendum": 1.15, "dedendum": 1.5, "fillet_radius": 0.1}
    table["gear"]["ring"] |= {"addendum": 0.9, "dedendum": 1.4, "fillet_radius": 0.05}
    return case_of_table(table)


def _rotational(model, states):
    """Displacements, and rates, at which all planets move alike and sun, ring and carrier only turn."""
    layout = model.layout
    patterns = []
    for body in (RING, CARRIER):
        patterns.append({turn_of(body, layout): 1.0})
    planets = range(3, 6)
    patterns.append({turn_of(body, layout): 1.0 for body in planets})
    outwards = np.asarray(model.bodies.place)[3:6]
    for turned in (outwards, outwards[:, ::-1] * [-1.0, 1.0]):
        patterns.append(
            {shift_of(b) + k: turned[b - 3, k] for b in planets for k in (0, 1)},
        )
    columns = []
    for first in (0, int(layout.half)):
        for pattern in patterns:
            columns.append([pattern.get(state - first, 0.0) for state in states])
    return np.array(columns).T


@pytest.mark.parametrize(("held", "driving"), list(permutations(MEMBERS, 2)))
def test_loads_at_rest_in_all_arrangements(held, driving):
    """Whichever is held, drives and is driven: without friction every mesh bears its share by Willis."""
    (driven,) = (member for member in MEMBERS if member not in (held, driving))
    table = planet_set(IN_PHASE, 3, held, (driving, driven), friction={"law": "none"})
    del table["friction"]["coefficient"]
    prepared = prepare(case_of_table(table))
    model = prepared.model
    loads = tangent_loads(model, static_equilibrium(model))
    on_sun = 600.0 * abs(1.0 / torques(prepared.case.sets[0].teeth, held, driven, 1.0)[driven])
    on_sun *= abs(torques(prepared.case.sets[0].teeth, held, driven, 1.0)["sun"])
    np.testing.assert_allclose(loads, on_sun / 36e-3 / 3.0, rtol=2e-3)


@pytest.mark.parametrize("planets", [3, 4])
def test_a_floating_sun_makes_three_planets_share_alike(planets):
    """Under the error of one pin; four do not, and a sun in bearings does not."""
    shares = {}
    for floating in ((), ("sun",)):
        errors = ["30 um", *["0 um"] * (planets - 1)]
        case = set_case(
            IN_PHASE, planets, floating=list(floating), tangential_pin_errors=errors, frame_forces=False
        )
        model = prepare(case).model
        loads = tangent_loads(model, static_equilibrium(model))
        shares[floating] = loads[:planets]
        # action = reaction: what the sun gives a planet, but for friction the ring takes
        np.testing.assert_allclose(np.mean(loads[planets:]), np.mean(loads[:planets]), rtol=0.02)
        np.testing.assert_allclose(np.mean(loads), 600.0 / (2.0 * 81e-3) / planets, rtol=0.02)
    uneven = {floating: np.ptp(loads) / np.mean(loads) for floating, loads in shares.items()}
    assert uneven[()] > 0.3
    assert uneven["sun",] < 2e-3 if planets == 3 else uneven["sun",] > 0.3


@pytest.fixture(scope="module")
def record(tmp_path_factory):
    """A run of a set with a floating sun; of forces of the frame the balance leaves m Ω³ r × u."""
    path = tmp_path_factory.mktemp("set") / "set.h5"
    case = set_case(SEQUENTIAL, floating=["sun"], frame_forces=False, solver={"cycles": 12})
    result = run(case, path)
    assert result.status == "complete"
    return case, Record(path)


def test_energy_and_efficiency_of_a_run(record):
    """In = out + losses; and the efficiency is that of the rolling powers by Willis' torques."""
    case, found = record
    summary = found.summary
    stage = summary[STAGES]["set"]
    work = {name: found[f"work_{name}"] for name in ("in", "out", "friction", "damping")}
    lost = work["friction"][-1] + work["damping"][-1]
    gained = found["stored_energy"][-1] - found["stored_energy"][0]
    assert work["in"][-1] - work["out"][-1] - lost == pytest.approx(
        gained - found["work_parametric"][-1], abs=1e-6 * work["in"][-1]
    )
    rolling = np.prod(
        [
            np.mean([summary["meshes"][f"set-{at}-{n}"]["efficiency"] for n in (1, 2, 3)])
            for at in ("sun", "ring")
        ]
    )
    ideal, real = (torques(case.sets[0].teeth, "ring", "sun", 1.0, eta) for eta in (1.0, float(rolling)))
    assert stage["efficiency"] == pytest.approx(real["carrier"] / ideal["carrier"], abs=2e-5)
    # of means over samples, which jumps of the load fall between
    assert stage["mesh_load_factor"] == pytest.approx(1.0, abs=3e-3)
    assert stage["power_friction_mean"] == pytest.approx(summary["power_friction_mean"], rel=1e-9)


def test_pins_bear_the_torque_of_the_carrier(record):
    """And bearings nothing in the mean, as all planets bear alike."""
    _, found = record
    names = [str(name) for name in found["bearing"]]
    last = slice(-200, None)
    force = np.stack([found[f"bearing_force_{axis}"][last] for axis in "xy"], axis=-1)
    arms = found.geometry["centre"][3:6]
    pins = [names.index(f"pin-planet-{n}") for n in (1, 2, 3)]
    mean = np.mean(force[:, pins], axis=0)
    torque = np.sum(arms[:, 0] * mean[:, 1] - arms[:, 1] * mean[:, 0])
    assert torque == pytest.approx(600.0, rel=2e-3)
    assert set(names) == {"bearing-ring", "bearing-carrier", "pin-planet-1", "pin-planet-2", "pin-planet-3"}
    held = np.mean(force[:, names.index("bearing-carrier")], axis=0)
    assert np.all(np.abs(held) < 0.02 * np.hypot(*mean[0]))


def test_margin_against_scuffing_by_hand(record):
    """S_B of ISO/TS 6336-20 at the sun: FZG stage 12, mineral oil, bulk by the loss as in ISO/TR 15144-1."""
    case, found = record
    mesh = found.summary["meshes"]["set-sun-1"]
    viscosity = 1e3 * case.meshes[0].pair.lubricant.inlet_viscosity  # mPa s, at the oil's 70 °C
    scuffing = 80.0 + (0.85 + 1.4) * viscosity**-0.05 * 12.0**2
    bulk = 70.0 + 7400.0 * (mesh["power_friction_mean"] / 1e3 / (81.0 * 30.0)) ** 0.72 / 1.2
    contact = bulk + mesh["flash_temperature_max"]
    assert mesh["S_B"] == pytest.approx((scuffing - 70.0) / (contact - 70.0), rel=1e-3)


def test_kinds_of_modes_have_names():
    prepared = prepare(set_case(SEQUENTIAL, 4))
    kinds = kinds_of(prepared, modes(prepared.model, [made.cycle for made in prepared.tables]))
    count = {kind: kinds.count(kind) for kind in set(kinds)}
    # of 7 bodies 21 coordinates, less the rotation that is prescribed: translational ones in pairs
    assert count == {"rotational": 5, "translational": 12, "planet": 3}


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"planets": 5}, "fewer teeth|whole number"),
        ({"held": "sun"}, "is held in the planetary stage set"),
        ({"angles": ["0 deg", "102 deg", "220 deg"]}, "pitches beside the gaps"),
        ({"carrier": "arm"}, "no such"),
        ({"planets": 2, "floating": ["sun"]}, "2 planets do not hold a floating sun"),
        ({"helix_angle": "10 deg"}, "sun.hand: missing: of a helical set one gear"),
        ({"planet": "ring"}, "must be an external gear|named twice"),
        ({"radial_pin_errors": ["1 um"]}, "1 values for 3 planets"),
        ({"centre_distance": "80 mm"}, "overlap"),
        ({"floating": ["sun", "ring", "carrier"]}, "no member of the set has a bearing"),
        ({"gear": {"ring": {"teeth": 84, "face_width": "30 mm"}}}, "must be an internal gear"),
        (
            {
                "bearings": {
                    "default": {"stiffness_x": "3e8 N/m", "stiffness_y": "2e8 N/m", "damping_ratio": 0.1}
                }
            },
            "whose frame turns",
        ),
        ({"shaft": [{"name": "axle", "gears": ["sun", "ring"]}]}, "moves in the frame of its carrier"),
    ],
)
def test_wrong_sets_are_refused(changes, said):
    table = planet_set(IN_PHASE)
    for name, value in changes.items():
        if name in ("shaft", "bearings"):
            table[name] = value
        elif name == "gear":
            table["gear"] |= value
        else:
            table["stage"][0][name] = value
    with pytest.raises(InputError, match=said):
        case_of_table(table)


def test_planets_that_overlap_are_counted():
    table = planet_set((18, 36, 90), 6)
    table["gear"]["ring"]["addendum"] = 0.8
    with pytest.raises(InputError, match=r"overlap by .* use at most 4"):
        case_of_table(table)
