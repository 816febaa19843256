"""The numbers that a drive's family has of its own, ``[drive.shape]``, and its pressure angle."""

from typing import Any

import numpy as np

from tribodyn.errors import InputError
from tribodyn.geometry.family import Family
from tribodyn.scenario.own_keys import Owner, own_key_errors, own_values
from tribodyn.scenario.tables.model_files import DriveTable

TABLE = "drive.shape"


def shape_of(drive: DriveTable, family: Family) -> Any:
    """Return the family's shape in SI units; raises the first of `shape_errors`."""
    if family.shape is None:
        return ()
    given = own_values(Owner(TABLE, "family", family.parameters), drive.shape or {})
    return family.shape(**{one.name: given.get(one.name, one.default) for one in family.parameters})


def shape_errors(drive: DriveTable, family: Family) -> list[InputError]:
    """Return what is wrong with the keys that depend on the family: ``pressure_angle`` and ``shape``."""
    errors = []
    if family.pressure_angle and drive.pressure_angle is None and not (family.involute and drive.rack):
        remedy = 'add pressure_angle = "20 deg"' + (', or rack = "ISO 53 A"' if family.involute else "")
        errors.append(InputError("drive.pressure_angle", None, "missing", remedy))
    if not family.pressure_angle and drive.pressure_angle is not None:
        rule = f'contradicts family = "{family.name}", whose shape alone gives the pressure angle'
        shown = f"{np.degrees(drive.pressure_angle):.4g} deg"
        errors.append(InputError("drive.pressure_angle", shown, rule, "leave it out"))
    return errors + own_key_errors(Owner(TABLE, "family", family.parameters), drive.shape or {})
