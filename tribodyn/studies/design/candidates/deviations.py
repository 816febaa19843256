"""What the tolerances of a search make of a candidate's keys."""

from collections.abc import Mapping
from functools import cached_property
from typing import Any

import numpy as np

from tribodyn.errors import InputError
from tribodyn.geometry.assembly import Assembly, assemble
from tribodyn.geometry.families import family
from tribodyn.scenario.vary import base_units
from tribodyn.studies.design.candidates.evaluation import loaded_case
from tribodyn.studies.design.candidates.sources import BASE, in_unit, own, sources_of, standing
from tribodyn.studies.design.case import DRAWN, DesignCase, Tolerance

#: Names at the end of keys whose values are lists and curves: errors of each tooth, and along the profile.
PITCH_ERRORS, PROFILE_ERROR = "pitch_errors", "profile_error"
#: The distance of the axes, which is that of nominal teeth where a drive does not say it.
CENTRE_DISTANCE = "drive.centre_distance"
#: Points of a profile that deviates, and by how much of the path they go beyond its ends on either side.
POINTS, BEYOND = 7, 0.25


class Nominal:
    """A candidate under one duty, before anything deviates.

    Parameters
    ----------
    keys : its keys and their values
    """

    def __init__(self, case: DesignCase, keys: Mapping[str, Any]) -> None:
        self.case = case
        self.keys = dict(keys)

    def at(self, key: str) -> Any:
        """The value of a key; None where there is none."""
        return self.keys.get(key, standing(self.case.scenarios, key))

    @cached_property
    def gears(self) -> Assembly | None:
        """The pair put together; None where it cannot be, for the evaluation to say why."""
        schema = sources_of({BASE: self.case.base})[BASE].schema
        try:
            case = loaded_case(self.case.base, own(BASE, schema, self.keys, self.case.parts)).case
            return assemble(family(case.family), case.drive)
        except InputError:
            return None


def deviating(one: Tolerance, deviation: float, nominal: Nominal) -> dict[str, Any]:
    """The keys that a tolerance changes, and their values; none without deviation.

    Parameters
    ----------
    deviation : −1 … 1. Of what is drawn point by point, or is a number of a sample, it stands for a seed.
    """
    if deviation == 0.0:
        return {}
    if one.distribution == DRAWN:
        return {one.key: int(abs(deviation) * 2**20)}
    draw = np.random.default_rng(int(abs(deviation) * 2**52))
    if one.key.endswith(PITCH_ERRORS):
        teeth = int(nominal.at(one.key.replace(f"modification.{PITCH_ERRORS}", "teeth")))
        errors = draw.uniform(-one.plus_minus, one.plus_minus, teeth)
        return {one.key: [f"{float(error)!r} {one.unit}" for error in errors]}
    if one.key.endswith(PROFILE_ERROR):
        return _profile(one, draw, nominal)
    si = base_units(f"1 {one.unit}") if one.unit else None
    factor = si[0] if si else 1.0
    number = in_unit(nominal.at(one.key), one.unit, factor)
    if number is None and one.key == CENTRE_DISTANCE and nominal.gears is not None:
        path = nominal.gears.path
        number = float(path.pinion_pitch_radius + path.gear_pitch_radius) / factor
    value = (number or 0.0) + deviation * one.plus_minus
    return {one.key: f"{value!r} {one.unit}" if one.unit else value}


def _profile(one: Tolerance, draw: np.random.Generator, nominal: Nominal) -> dict[str, Any]:
    """A profile with an error drawn at points of the path, linear between, added to the one that stands."""
    if nominal.gears is None:
        return {}
    start, end = (float(limit) for limit in nominal.gears.roll_limits)
    roll = np.linspace(start - BEYOND * (end - start), end + BEYOND * (end - start), POINTS)
    error = draw.uniform(-one.plus_minus, one.plus_minus, POINTS)
    if isinstance(given := nominal.at(one.key), Mapping):
        known, errors = (given[name] for name in ("roll_angle", "error"))
        at = np.array(known["values"], dtype=float) * base_units(f"1 {known['unit']}")[0]  # pyright: ignore
        every = np.union1d(roll, at)
        factor = base_units(f"1 {errors['unit']}")[0] / base_units(f"1 {one.unit}")[0]  # pyright: ignore
        error = np.interp(every, roll, error) + np.interp(every, at, np.array(errors["values"])) * factor
        roll = every
    return {
        one.key: {
            "roll_angle": {"unit": "rad", "values": roll.tolist()},
            "error": {"unit": one.unit, "values": error.tolist()},
        }
    }
