"""Whatever a pair of gears knows of its contacts, each mesh of a train knows too: laws, teeth, flanks.

Every mesh is evaluated at random states of the train, and as a scenario of its own pair of gears at the same
motion of the two bodies against each other.
"""

from copy import deepcopy
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tomli_w

from tests.support.states import PAIR, TURN_G, VX_P, VY_P, X_P, Y_P, random_place, random_state
from tests.support.train_scenarios import REDUCER, train_case
from tribodyn.dynamics.approach import DISTANCE
from tribodyn.dynamics.parameters import Model
from tribodyn.dynamics.recorded.outputs import evaluated, mesh_outputs
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.case import Gearbox
from tribodyn.studies.motion.prepare import prepare as prepare_pair
from tribodyn.studies.motion.prepare import prepare as prepare_train
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.train.layout import velocities
from tribodyn.train.schedule import phase_of
from tribodyn.train.structure import (
    shift_of,
    turn_of,
)
from tribodyn.tribology.film import FILM_LAWS
from tribodyn.tribology.friction import FRICTION_LAWS

#: Random states at which a mesh is compared; places in a cycle, of which those next to the pitch point count.
STATES, PLACES = 60, 4000

KEYS_OF_LAWS = {"coulomb": {"coefficient": 0.06}}
#: Laws that are solved for every mesh before the run.
SOLVED = "solved"

STRAIGHT = {gear: {"profile_shift": 0.0} for gear in REDUCER["gear"]}
CRC = {"family": "crc", "pressure_angle": "22.81 deg"}
CYCLOID = {"family": "cycloidal", "shape": {"approach_circle": "30 mm", "recess_circle": "30 mm"}}
RELIEF = {"tip_relief": "20 um", "tip_relief_length": "3 mm"}
#: Tables put into the reducer's, and into those of its pairs: of the mesh, of all; of stages, of gears.
WAYS: dict[str, dict[str, Any]] = {
    "ring": {"mesh": {"foundation": "ring"}},
    "pairs on their own": {"mesh": {"foundation_coupling": False}},
    "load-dependent contact": {"mesh": {"hertz": "load-dependent"}},
    "constant stiffness": {"mesh": {"compliance": "constant", "stiffness": "4e8 N/m"}},
    "finite elements": {"mesh": {"compliance": "fem", "points": 5}},
    "relief": {"mesh": {"compliance": "fem", "points": 5}, "gears": {"pinion-1": {"modification": RELIEF}}},
    "error": {"mesh": {"transmission_error": {"harmonics": [{"order": 2, "amplitude": "5 um"}]}}},
    "both flanks": {"mesh": {"backlash": "20 um"}},
    "energy-consistent": {"mesh": {"formulation": "energy-consistent"}},
    "kinematic sliding": {"friction": {"law": "coulomb", "coefficient": 0.06, "sliding": "kinematic"}},
    "warm teeth": {"temperature": {"model": "iso"}, "friction": {"law": "masjedi-khonsari"}},
    "crc and involute": {"stages": [CRC, {}], "gears": STRAIGHT},
    "cycloidal and crc": {"stages": [CYCLOID, CRC], "gears": STRAIGHT},
}


def reducer(ways: dict[str, Any]) -> dict[str, Any]:
    """The reducer as TOML has it, in one of the `WAYS`."""
    data = deepcopy(REDUCER) | {"friction": {"law": "masjedi-khonsari"}}
    for stage, keys in zip(data["stage"], ways.get("stages", ({}, {})), strict=True):
        stage |= keys
        if stage.get("family") == "cycloidal":
            del stage["pressure_angle"]
    for gear, keys in ways.get("gears", {}).items():
        data["gear"][gear] |= keys
    for table, keys in ways.items():
        if table not in ("stages", "gears"):
            data[table] = data.get(table, {}) | keys if table == "mesh" else keys
    return data


def as_pair(data: dict[str, Any], train: PreparedGearbox, mesh: int) -> dict[str, Any]:
    """The scenario of a pair with the gears of a mesh; its gears are as heavy as the bodies of the train."""
    part, case = train.case.meshes[mesh], train.case
    gears = [dict(data["gear"][case.gears[gear].name]) for gear in part.gears]
    for gear, body in zip(gears, (part.driver, part.driven), strict=True):
        gear["inertia"] = f"{train.inertias[body].inertia!r} kg*m**2"
    stage = {key: value for key, value in data["stage"][mesh].items() if key not in ("gears", "azimuth")}
    drive = {"family": "involute", "material": data["material"], "mean_roughness": data["mean_roughness"]}
    duty = part.pair.operating
    operating = {
        "pinion_speed": f"{duty.pinion_speed!r} rad/s",
        "gear_torque": f"{duty.gear_torque!r} N*m",
        "oil_temperature": data["operating"]["oil_temperature"],
    }
    kept = {name: data[name] for name in ("mesh", "friction", "film", "temperature") if name in data}
    head = {"title": "A pair", "kind": "gear-pair", "lubricant": data["lubricant"], "bearings": "rigid-1e9"}
    both = {"pinion": gears[0], "gear": gears[1]}
    return {**head, "drive": {**drive, **stage, **both}, "operating": operating, **kept}


def states_of(model: Model, mesh: int, rng: np.random.Generator) -> tuple[np.ndarray, ...]:
    """Cycles, intervals and states of a train, the mesh's driver at its nominal speed.

    A third of them are where a pair comes by the pitch point, and hardly vibrate: its friction turns there.
    """
    layout, schedule = model.layout, model.schedule
    near = STATES // 3
    states = np.array([random_state(rng, model) for _ in range(STATES)])
    states[:near, velocities(layout)] *= 1e-3
    states[:, layout.half + layout.lag] = 0.0
    states[:, layout.half + turn_of(layout.driver[mesh], layout)] = 0.0
    grid = (np.arange(PLACES * schedule.period) + 0.5) / PLACES
    there = evaluated(grid, np.zeros((len(grid), layout.states)), model)
    table, segment = model.meshes[mesh].table, np.asarray(schedule.segment)[there.interval, mesh].astype(int)
    distance = np.min(
        [
            np.where(inside > 0.0, np.abs(there.work[mesh][DISTANCE, slot]), np.inf)
            for slot, inside in enumerate(np.asarray(table.in_contact)[segment].T)
        ],
        axis=0,
    )
    turning = np.argsort(distance)[:near]
    intervals = np.arange(STATES - near) % len(schedule.start)
    before = np.searchsorted(np.asarray(schedule.first)[1:], intervals, side="right")
    phases = [random_place(rng, schedule, int(interval))[0] for interval in intervals]
    cycles = np.concatenate([grid[turning], before + np.array(phases)])
    return cycles, np.concatenate([there.interval[turning], intervals]), states


def states_of_pair(model: Model, mesh: int, states: np.ndarray) -> np.ndarray:
    """States of a pair whose flanks stand and move against each other as those of a train's mesh do.

    The gear's centre stands still; of the driver's, only what it moves against the other centre counts.
    """
    layout, part = model.layout, model.meshes[mesh]
    driver, driven = layout.driver[mesh], layout.driven[mesh]
    of_pair = np.zeros((len(states), PAIR.states))
    for half, x, y in ((0, X_P, Y_P), (layout.half, VX_P, VY_P)):
        apart = states[:, half + shift_of(driver) :][:, :2] - states[:, half + shift_of(driven) :][:, :2]
        of_pair[:, x] = apart @ [part.along_x, part.along_y]
        of_pair[:, y] = apart @ [part.across_x, part.across_y]
    turned = states[:, turn_of(driver, layout)] if driver else 0.0
    # the driver's rotation as one of the driven gear, which is what the flanks feel of it
    of_pair[:, TURN_G] = states[:, turn_of(driven, layout)]
    of_pair[:, TURN_G] -= turned * part.driver_radius / part.driven_radius
    of_pair[:, PAIR.half + TURN_G] = states[:, layout.half + turn_of(driven, layout)]
    return of_pair


def assert_meshes_are_pairs(data: dict[str, Any], folder: Path, rng: np.random.Generator) -> None:
    path = folder / "train.toml"
    path.write_text(tomli_w.dumps(data), encoding="utf-8")
    case: Gearbox = train_case(path)
    train = prepare_train(case)
    model = train.model
    for mesh in range(2):
        path = folder / f"pair-{mesh}.toml"
        path.write_text(tomli_w.dumps(as_pair(data, train, mesh)), encoding="utf-8")
        pair: Any = prepare_pair(load_scenario(path))  # pyright: ignore[reportArgumentType]
        cycles, intervals, states = states_of(model, mesh, rng)
        found = mesh_outputs(mesh, evaluated(cycles, states, model, intervals), shares=True)
        phases = phase_of(cycles - np.floor(cycles), intervals, mesh, model.schedule)
        alone = evaluated(phases, states_of_pair(model, mesh, states), pair.model)
        expected = mesh_outputs(0, alone, shares=True)
        assert set(found) == set(expected)
        loads = expected["normal_load"]
        assert np.mean(np.any(loads > 0.0, axis=1)) > 0.5
        slots = loads.shape[1]
        for name, values in expected.items():
            own = found[name] if found[name].ndim == 1 else found[name][:, :slots]
            scale = np.max(np.abs(values[np.isfinite(values)]), initial=0.0)  # a ratio to a limit may be none
            np.testing.assert_allclose(own, values, rtol=1e-8, atol=1e-11 * scale, err_msg=name)
        if train.thermal[mesh] is not None:
            assert train.thermal[mesh] == pair.thermal[0]


def laws(registry: Any) -> list[Any]:
    """Names of the laws; the solved ones take a minute."""
    return [pytest.param(name, marks=pytest.mark.soak) if name == SOLVED else name for name in registry]


@pytest.mark.parametrize("law", laws(FRICTION_LAWS))
def test_every_friction_law(law, tmp_path, rng):
    data = reducer({"friction": {"law": law, **KEYS_OF_LAWS.get(law, {})}})
    assert_meshes_are_pairs(data, tmp_path, rng)


@pytest.mark.parametrize("law", laws(FILM_LAWS))
def test_every_film_law(law, tmp_path, rng):
    data = reducer({"film": {"law": law}, "friction": {"law": "masjedi-khonsari"}})
    assert_meshes_are_pairs(data, tmp_path, rng)


@pytest.mark.parametrize("way", WAYS)
def test_every_sort_of_teeth_and_contact(way, tmp_path, rng):
    assert_meshes_are_pairs(reducer(WAYS[way]), tmp_path, rng)
