"""Which cases of gears have one table of their mesh cycle: costly, and the same for every speed."""

import dataclasses
from collections.abc import Hashable, Mapping
from typing import Any

import numpy as np

from tribodyn.gears.case import GearCase

#: Fields of a case that its table does not depend on. Whatever is not named here is taken to matter.
_NOT_IN_TABLE = (
    *("title", "name", "toml", "sha256"),
    *("roughness", "mean_roughness", "asperities", "lubricant", "bearings", "operating"),
    *("film", "friction", "temperature", "losses", "solver", "output", "quality", "supports", "teeth"),
)
_MESH_NOT_IN_TABLE = {"damping_ratio": 0.0, "formulation": "classical", "contact_width": 0.0}


def table_key(case: GearCase) -> Hashable:
    """Everything that the table of a case depends on: equal keys mean equal tables, bit for bit."""
    left_out = (*_NOT_IN_TABLE, "mesh")
    parts: list[Any] = [getattr(case, f.name) for f in dataclasses.fields(case) if f.name not in left_out]
    parts.append(dataclasses.replace(case.mesh, **_MESH_NOT_IN_TABLE))
    # slices of helical pairs, and of all that have several, hold each other and are counted under load
    if case.mesh.at_load or case.drive.helix_angle or case.mesh.slices > 1:
        parts.append(case.operating.gear_torque)
    return _hashable(parts)


def _hashable(value: Any) -> Hashable:
    """The content of nested dataclasses, tuples, dictionaries and arrays, to compare and look up by."""
    if isinstance(value, np.ndarray):
        return value.shape, value.tobytes()
    if dataclasses.is_dataclass(value):
        value = [getattr(value, field.name) for field in dataclasses.fields(value)]
    if isinstance(value, Mapping):
        value = sorted(value.items())
    return tuple(map(_hashable, value)) if isinstance(value, (list, tuple)) else value
