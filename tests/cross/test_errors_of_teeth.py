"""Errors of teeth have one sign: positive where material is missing, whichever gear and way to write them.

Against load contact, against rigid rotations and against the vectors of shifted axes.
"""

import json
from copy import deepcopy
from functools import lru_cache
from typing import Any

import numpy as np
import pytest

import tribodyn as td
from tests.support.own_teeth import errors, made
from tests.support.planet_sets import planet_set
from tests.support.train_scenarios import REDUCER, case_of_table
from tribodyn.dynamics.approach import APPROACH, PRESENT, TRANSMISSION_ERROR
from tribodyn.dynamics.equations import derivatives
from tribodyn.solve.initial import initial_state
from tribodyn.solve.right_hand_side import contacts_of
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.motion.prepare import prepare as prepare_pair
from tribodyn.train.schedule import interval_of

NAME, TEETH = "involute-23-47", {"pinion": 23, "gear": 47}
STIFF = {"mesh.compliance": "constant", "mesh.stiffness": "3e8 N/m", "solver.cycles": 40}
#: Mesh cycles since the start at which contacts are looked at.
AT = np.array([0.37, 5.4])
WAYS = ("pitch_errors", "tooth_errors", "tooth_formula")


def written(way: str, error: float, teeth: int) -> dict[str, Any]:
    """The `modification` that gives every tooth of a gear an error, µm."""
    if way == "pitch_errors":
        return {way: [f"{error} um"] * teeth}
    if way == "tooth_formula":
        return {way: f"{error} + 0*i"}
    columns = {"tooth": ("1", range(1, teeth + 1)), "height": ("1", [0.5] * teeth)}
    columns |= {"face": ("mm", [0.0] * teeth), "error": ("um", [error] * teeth)}
    return {
        way: {
            name: {"unit": unit, "values": [*map(float, values)]} for name, (unit, values) in columns.items()
        }
    }


def damaged(side: str, depth: float) -> list[dict[str, Any]]:
    """Every tooth with so much missing on its whole flank, µm."""
    columns = {"height": ("1", [0.0, 1.0]), "face": ("mm", [0.0, 0.0]), "depth": ("um", [depth, depth])}
    found = {name: {"unit": unit, "values": values} for name, (unit, values) in columns.items()}
    return [
        {"gear": side, "tooth": tooth, "kind": "spall", "map": found} for tooth in range(1, TEETH[side] + 1)
    ]


@pytest.mark.parametrize("side", ["pinion", "gear"])
@pytest.mark.parametrize("way", [*WAYS, "damage"])
def test_what_all_flanks_lack_opens_the_mesh_by_as_much(way: str, side: str):
    """10 µm along the normal, 10 µm / cos α_w of the gears' rotations."""
    table = f"drive.{side}.modification"
    changes = {f"{table}.{key}": value for key, value in written(way, 10.0, TEETH[side]).items()}
    changes = {"damage": damaged(side, 10.0)} if way == "damage" else changes
    case, plain = made(NAME, STIFF | changes), made(NAME, STIFF)
    opened = errors(case.model, AT) - errors(plain.model, AT)
    cosine = np.cos(float(plain.assembly.path.pressure_angle(0.0)))
    np.testing.assert_allclose(opened * cosine, 10e-6, rtol=1e-6)


@pytest.mark.parametrize("side", ["pinion", "gear"])
def test_back_flanks_stand_where_the_tooth_does_and_lack_what_is_said_of_both(side: str):
    """A tooth that is behind on one flank is ahead on the other; opening turns the gears the other way."""
    back = STIFF | {"mesh.backlash": "0.1 mm", "operating.gear_torque": "-500 N*m"}
    table, plain = f"drive.{side}.modification", errors(made(NAME, back).model, AT)
    cosine = np.cos(np.radians(20.0))
    for changes, expected in (
        (written("pitch_errors", 10.0, TEETH[side]), 10e-6),
        (written("tooth_formula", 10.0, TEETH[side]), 0.0),
        (written("tooth_formula", 10.0, TEETH[side]) | {"both_flanks": True}, -10e-6),
    ):
        keys = {f"{table}.{key}": value for key, value in changes.items()}
        opened = errors(made(NAME, back | keys).model, AT) - plain
        np.testing.assert_allclose(opened * cosine, expected, rtol=1e-6, atol=1e-12)


@pytest.mark.parametrize("side", ["pinion", "gear"])
def test_pitch_errors_over_time_are_those_of_load_contact(side: str):
    """Tooth by tooth over the hunting period of 18 and 36 teeth; bearings move the mean alone."""
    rng, teeth = np.random.default_rng(3), {"pinion": 18, "gear": 36}[side]
    listed = [f"{error:.2f} um" for error in rng.uniform(-8.0, 8.0, teeth)]
    drive = {"like": "diez-ibarbia-18-36", side: {"modification": {"pitch_errors": listed}}}
    operating = {"gear_torque": "318 N*m"}
    slow = td.run(
        {
            "kind": "load-contact",
            "title": "slow",
            "drive": drive,
            "operating": operating,
            "output": {"positions_per_cycle": 8, "cycles": 36},
        }
    )
    turning = {
        "kind": "gear-pair",
        "title": "turning",
        "drive": drive,
        "lubricant": "iso-vg-220-mineral",
        "operating": operating | {"pinion_speed": "20 rpm", "oil_temperature": "80 degC"},
        "mesh": {"compliance": "fem", "damping_ratio": 0.1, "points": 17},
        "friction": {"law": "none"},
        "solver": {"cycles": 36},
    }
    case = prepare_pair(td.scenario(turning))
    # the table begins where corners may touch
    enters = float(case.assembly.roll_limits[0]) - float(case.cycle.roll_start)
    at = slice(None, None, 15)
    phase = np.asarray(slow.data["phase"])[at] + enters / float(case.assembly.pitch_angle)
    expected = np.asarray(slow.data["loaded_transmission_error"])[at]
    found = errors(case.model, phase)
    apart = (found - found.mean()) - (expected - expected.mean())
    assert np.max(np.abs(apart)) < 0.02 * np.ptp(expected)


SIDES = {1: 0, -1: 1}  # driving flanks and back flanks


def gaps(prepared: PreparedGearbox) -> np.ndarray:
    """Gap of the contacts of every mesh by side, NaN where there is none; (side, place, mesh), m."""
    model, found = prepared.model, np.full((2, len(AT), len(prepared.case.meshes)), np.nan)
    _, phases, intervals = interval_of(AT, model.schedule)
    y = initial_state(model, "unloaded")
    for place, (phase, interval) in enumerate(zip(phases, intervals, strict=True)):
        work = contacts_of(model)
        derivatives(float(phase), 0.0, int(interval), y, model, work, {})
        for m, (own, mesh) in enumerate(zip(work, model.meshes, strict=True)):
            sides = np.asarray(mesh.table.side)
            there = [i for i in range(len(sides)) if own[PRESENT, i] > 0.0]
            for side, row in SIDES.items():
                values = [own[TRANSMISSION_ERROR, i] - own[APPROACH, i] for i in there if sides[i] == side]
                if values:
                    assert np.ptp(values) < 2e-9  # of involutes all are the same
                    found[row, place, m] = values[0]
    return found


@lru_cache
def _alike(table: str) -> np.ndarray:
    return gaps(prepare(case_of_table(json.loads(table))))


def opened_by(table: dict[str, Any], changes: dict[str, Any]) -> tuple[np.ndarray, PreparedGearbox]:
    """What changes of a train's gears open all meshes by (side, place, mesh), m, and the train."""
    train: dict[str, Any] = deepcopy(table) | {"solver": {"cycles": 30}}
    for gear in train["gear"].values():
        gear["modification"] = {"tooth_formula": "0*i"}
    plain = _alike(json.dumps(train))
    for name, change in changes.items():
        train["gear"][name] |= change
    prepared = prepare(case_of_table(train))
    return gaps(prepared) - plain, prepared


@pytest.mark.parametrize("way", WAYS)
def test_in_a_train_either_gear_of_every_mesh_opens_it(way: str):
    sizes = dict(zip(REDUCER["gear"], (1.0, 2.0, 4.0, 8.0), strict=True))
    changes = {
        name: {"modification": written(way, size, REDUCER["gear"][name]["teeth"])}
        for name, size in sizes.items()
    }
    opened, _ = opened_by(REDUCER, changes)
    np.testing.assert_allclose(opened[0], [[3e-6, 12e-6]] * len(AT), rtol=1e-9)


@pytest.mark.parametrize("way", WAYS)
def test_a_planet_s_flanks_both_lack_it_but_its_place_is_that_of_the_flank_that_drives(way: str):
    """Sun, planet and ring with 1, 2 and 4 µm: of a tooth out of place one flank is behind, one ahead."""
    table = planet_set()
    changes = {
        name: {"modification": written(way, size, table["gear"][name]["teeth"])}
        for name, size in (("sun", 1.0), ("planet", 2.0), ("ring", 4.0))
    }
    with_sun, back = (-1.0, -6.0) if way == "pitch_errors" else (3.0, 2.0)
    opened, train = opened_by(table, changes)
    of_sun = np.array([train.case.gears[mesh.gears[0]].name == "sun" for mesh in train.case.meshes])
    there = ~np.isnan(opened)
    assert np.all(there[0])
    assert np.all(there[1][:, ~of_sun])
    # the ring's meshes have back flanks: there the planet shows the flank that the sun drives
    expected = 1e-6 * np.stack([np.where(of_sun, with_sun, 6.0), np.full(len(of_sun), back)])
    expected = np.broadcast_to(expected[:, None], opened.shape)
    np.testing.assert_allclose(opened[there], expected[there], rtol=1e-9)


@pytest.mark.parametrize(
    ("table", "name"),
    [(REDUCER, name) for name in REDUCER["gear"]]
    + [(planet_set(), name) for name in ("sun", "planet", "ring")]
    + [(planet_set(held="carrier", ends=("ring", "sun")), name) for name in ("sun", "planet", "ring")],
    ids=[*REDUCER["gear"], *(f"{a} {b}" for a in ("sun-drives", "ring-drives") for b in "spr")],
)
def test_a_gear_off_its_axis_opens_its_meshes_by_the_shift_along_the_normal(table, name: str):
    """By where its first tooth points, wherever its mates are, and by which flank touches.

    A gear's tooth stands where the train is drawn with it (`tests/support/turning_outlines`) and turns by a
    pitch in a cycle of its mesh; the force on the driven gear has the direction of the normal.
    """
    shift, angle = 20e-6, np.radians(40.0)
    opened, prepared = opened_by(table, {name: {"eccentricity": "20 um", "eccentricity_angle": "40 deg"}})
    case, expected = prepared.case, np.zeros_like(opened)
    for m, mesh in enumerate(case.meshes):
        across = np.array([np.cos(mesh.azimuth), np.sin(mesh.azimuth)])
        driver = mesh.gears[0]
        sense = case.toothed_shafts[driver].sense * np.sign(case.gears[driver].teeth)
        along = sense * np.array([-across[1], across[0]])
        alpha = float(prepared.tables[m].assembly.path.pressure_angle(0.0))
        normals = np.array([side * along * np.cos(alpha) + across * np.sin(alpha) for side in SIDES])
        for gear, sign in zip(mesh.gears, (-1.0, 1.0), strict=True):
            if not case.gears[gear].name.startswith(name):
                continue
            turned = 2.0 * np.pi * float(mesh.rate) * AT / abs(case.gears[gear].teeth)
            direction = prepared.phases.teeth[gear] + case.toothed_shafts[gear].sense * (turned + angle)
            moved = shift * np.stack([np.cos(direction), np.sin(direction)], axis=-1)
            expected[:, :, m] += sign * normals @ moved.T
    there = ~np.isnan(opened)
    assert np.all(there[0])
    # meshes stand a little further by the twist under load
    np.testing.assert_allclose(opened[there], expected[there], rtol=0.0, atol=3e-3 * shift)
