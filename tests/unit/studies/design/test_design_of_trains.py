"""Searches through trains: the keys of a reducer and of a planetary set are free, as `--set` takes them."""

import math
from typing import Any

import jax
import numpy as np
import pytest
from scipy.optimize import brentq

from tribodyn.input.vary import axes_of
from tribodyn.studies.design.candidates.candidates import cases_of, chosen
from tribodyn.studies.design.candidates.evaluation import evaluate, loaded_case
from tribodyn.studies.design.scenario import loaded_search
from tribodyn.studies.protocol.load import load_scenario, table_of

#: Keys of every sort of table, with bounds at which the train exists.
REDUCER = {
    "gear.pinion-1.profile_shift": (0.1, 0.2),
    "gear.wheel-1.face_width": ("38 mm", "39 mm"),
    "gear.pinion-2.thickness_allowance": ("-60 um", "-50 um"),
    "gear.wheel-2.teeth": (57, 58),
    "stage.0.helix_angle": ("5 deg", "6 deg"),
    "stage.1.module": ("4 mm", "4.1 mm"),
    "stage.1.azimuth": ("20 deg", "30 deg"),
    "stage.0.damping_ratio": (0.04, 0.05),
    "material.youngs_modulus": ("200 GPa", "206 GPa"),
    "lubricant.viscosity_40": ("100 mm**2/s", "120 mm**2/s"),
    "bearings.default.stiffness_x": ("1e8 N/m", "2e8 N/m"),
    "operating.input_speed": ("1000 rpm", "1200 rpm"),
    "operating.output_torque": ("100 N*m", "110 N*m"),
    "shaft.0.mass": ("0.1 kg", "0.2 kg"),
    "solver.cycles": (8, 9),
    "mean_roughness": ("0.4 um", "0.5 um"),
}
PLANETARY = {
    "gear.planet.addendum": (0.95, 1.0),
    "gear.ring.outer_diameter": ("285 mm", "290 mm"),
    "stage.0.centre_distance": ("81 mm", "81.001 mm"),
    "stage.0.support_stiffness": ("1e7 N*m/rad", "1e8 N*m/rad"),
    "stage.0.tangential_pin_errors.0": ("0 um", "20 um"),
    "stage.0.planets": (2, 3),
    "body.0.inertia": ("0.03 kg*m**2", "0.04 kg*m**2"),
    "mesh.damping_ratio": (0.05, 0.06),
}


def search(name: str, free: list[dict[str, Any]], overrides: Any = None, **more: Any) -> Any:
    return loaded_search(name, {"free": free, "minimise": "dynamic_factor", **more}, overrides or {}).case


@pytest.mark.parametrize(("name", "keys"), [("two-stage-reducer", REDUCER), ("planetary-24-84", PLANETARY)])
def test_keys_that_set_takes_are_free(name: str, keys: dict[str, tuple[Any, Any]]):
    """All at their upper bounds make the case that overrides make; ranges over them are axes of a sweep."""
    case = search(name, [{"key": key, "from": low, "to": high} for key, (low, high) in keys.items()])
    (values,) = cases_of(case, chosen(case, np.ones(len(keys))))
    found, expected = (
        loaded_case(case.base, values).case,
        load_scenario(name, {k: v[1] for k, v in keys.items()}),
    )
    assert found.gears == expected.gears
    assert found.bodies == expected.bodies
    drives = ([mesh.pair.drive for mesh in train.meshes] for train in (found, expected))
    numbers = (np.array(jax.tree.leaves(drive), dtype=float) for drive in drives)
    np.testing.assert_allclose(next(numbers), next(numbers), rtol=1e-12)
    assert len(
        axes_of([f"{key}={low},{high}" for key, (low, high) in list(keys.items())[:12]], table_of(case.base))
    )


def test_candidates_of_other_common_periods_are_evaluated_together():
    """Wheels of 69 and 46 teeth on the shaft of a pinion of 23: three and two cycles of the first mesh."""
    plain = {"friction.law": "coulomb", "friction.coefficient": 0.06, "output.samples_per_cycle": 60}
    case = search("two-stage-reducer", [{"key": "gear.wheel-1.teeth", "choices": [69, 46]}], plain)
    cases = [cases_of(case, {"gear.wheel-1.teeth": teeth})[0] for teeth in (69, 46)]
    together = evaluate(case.scenarios, cases)
    for found, overrides in zip(together, cases, strict=True):
        assert isinstance(found, dict), found
        (alone,) = evaluate(case.scenarios, [overrides])
        assert isinstance(alone, dict), alone
        assert found["dynamic_factor"] == pytest.approx(alone["dynamic_factor"], rel=1e-9)


def test_deviations_of_a_stage_and_of_a_gear():
    """Axes about a = a_0 cos α/cos α_t with inv α_t = inv α + 2 Σx tan α/Σz; flanks over their own path."""
    tolerances = [
        {"key": "stage.1.centre_distance", "plus_minus": "20 um", "distribution": "ends"},
        {"key": "gear.wheel-2.modification.profile_error", "plus_minus": "3 um"},
    ]
    free = [{"key": "gear.pinion-1.profile_shift", "from": 0.1, "to": 0.2}]
    overrides = {"gear.pinion-2.profile_shift": 0.25, "gear.wheel-2.profile_shift": 0.1}
    case = search("two-stage-reducer", free, overrides, tolerance=tolerances, robust={"samples": 2})
    train = load_scenario("two-stage-reducer", overrides)
    (mesh,) = (mesh for mesh in train.meshes if mesh.key == "stage.1")
    drive, alpha = mesh.pair.drive, math.radians(20.0)
    teeth = drive.pinion.teeth + drive.gear.teeth
    sought = math.tan(alpha) - alpha + 2.0 * 0.35 * math.tan(alpha) / teeth
    working: Any = brentq(lambda angle: math.tan(angle) - angle - sought, 0.1, 0.8, xtol=1e-14)
    distance = drive.module * teeth / 2.0 * math.cos(alpha) / math.cos(working)
    cases = cases_of(case, {})
    found = sorted(float(one["stage.1.centre_distance"].split()[0]) for one in cases)
    np.testing.assert_allclose(found, [1e6 * distance - 20.0, 1e6 * distance + 20.0], rtol=1e-9)
    for one in cases:
        errors = one["gear.wheel-2.modification.profile_error"]["error"]["values"]
        assert 0.0 < np.abs(errors).max() <= 3.0
