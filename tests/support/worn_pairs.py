"""Wear studies of the 18/36 pair, dry and without friction unless said otherwise."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from tribodyn.studies.protocol.load import load_data
from tribodyn.studies.wear.passage import Wearing, WearPassage, Worn, march, passage, unworn
from tribodyn.studies.wear.run import prepare

COEFFICIENT = 1e-17

DRY: dict[str, Any] = {
    "title": "Worn",
    "kind": "wear",
    "drive": "diez-ibarbia-18-36",
    "operating": {"pinion_speed": "150 rpm", "gear_torque": "318.3 N*m"},
    "wear": {"law": "archard", "coefficient": f"{COEFFICIENT} m**2/N", "revolutions": 1e6},
}
OILED: dict[str, Any] = {
    **DRY,
    "lubricant": "iso-vg-220-mineral",
    "operating": {**DRY["operating"], "oil_temperature": "80 degC"},
    "friction": {"law": "coulomb", "coefficient": 0.05},
}


def study_of(table: dict[str, Any] = DRY, **overrides: Any) -> Wearing:
    """A study made ready; overrides with `__` in place of dots."""
    keys = {name.replace("__", "."): value for name, value in overrides.items()}
    return prepare(load_data(table, "worn", keys).case)


def new(study: Wearing) -> WearPassage:
    """Loads and rates of new flanks."""
    return passage(study, unworn(study).depths, 0.0)


def worn(study: Wearing, revolutions: float | Sequence[float] | None = None) -> tuple[Worn, WearPassage]:
    """State and loads at the end, or after so many revolutions."""
    rows = np.atleast_1d(study.case.revolutions if revolutions is None else revolutions)
    *_, last = march(study, unworn(study), rows)
    return last
