"""The mesh cycle as a record keeps it: flat arrays with dimensions, units and meanings."""

from typing import Any

import numpy as np

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.helix import pitch_slope
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.numerics.parameter import Variable, datasets_of

_PAIR = ("phase", "pair")
#: Fields of a `MeshCycle` as a record has them: dimensions, unit, meaning; (phase,) is (S, N) in the table.
MESH_CYCLE = datasets_of(__package__)["mesh_cycle"]


def untabulated(assembly: Assembly, face_width: float) -> dict[str, float]:
    """Numbers of a mesh of which there is no table, by names of `MESH_CYCLE`."""
    path, (start, end) = assembly.path, assembly.roll_limits
    return {
        "pinion_pitch_radius": float(path.pinion_pitch_radius),
        "gear_pitch_radius": float(path.gear_pitch_radius),
        "pinion_teeth": float(assembly.drive.pinion.teeth),
        "face_width": face_width,
        "contact_ratio": float(assembly.contact_ratio),
        "roll_start": start,
        "roll_end": end,
        "pitch_slope": float(pitch_slope(assembly)),
    }


def described(slices: int) -> dict[str, Variable]:
    """Fields as a record has them of a mesh cycle with so many slices, see `MESH_CYCLE`."""
    if slices == 1:
        return {name: variable for name, variable in MESH_CYCLE.items() if name not in _FACE}
    variables = {}
    for name, variable in MESH_CYCLE.items():
        dims = (*_PAIR, "slice") if variable.dims == _PAIR else variable.dims
        if name != "coupling":
            variables[name] = variable._replace(dims=dims)
    return variables


# 1 wherever the load is even along the face, and then a number may stand for the table.
_RATIOS = ("line_load_friction", "line_load_peak", "share")
# Fields that records of spur gears may lack.
_FACE = ("share", "face_position", "face_place", "pitch_slope")
_OF_SLICES = (*_RATIOS, *_FACE, "coupling")


def as_arrays(cycle: MeshCycle) -> dict[str, Any]:
    """Flat arrays for a record: dims (phase,), (phase, pair) and (phase, pair, pair); scalars as floats.

    Of slices (phase, pair, slice), without the coupling, which is nothing.
    """
    segments, nodes, slots = cycle.compliance.shape
    names = described(cycle.slices)
    arrays: dict[str, Any] = {}
    for name, value in cycle._asdict().items():
        if name not in names:
            continue
        array = np.asarray(value, dtype=float)
        if name in _RATIOS:
            array = np.broadcast_to(array, cycle.compliance.shape)
        if name == "in_contact":
            array = np.repeat(array, nodes, axis=0)
        elif array.ndim >= 2:
            array = array.reshape(segments * nodes, *array.shape[2:])
        if cycle.slices > 1 and array.ndim == 2:
            array = array.reshape(segments * nodes, slots // cycle.slices, cycle.slices)
        if name == "side":
            array = array[:: cycle.slices]
        arrays[name] = array if array.ndim else float(array)
    return arrays


def from_arrays(arrays: dict[str, Any]) -> MeshCycle:
    """Inverse of `as_arrays`."""
    segments = len(arrays["boundary"]) - 1
    nodes = len(arrays["phase"]) // segments
    slices = np.size(arrays.get("face_position", 0.0))
    fields = {}
    for name in MeshCycle._fields:
        if name in _OF_SLICES and name not in arrays:
            continue  # of slices alone, or a record of an older version
        value = np.asarray(arrays[name], dtype=float)
        if value.ndim == 3 and name != "coupling":
            value = value.reshape(len(value), -1)
        if name == "side":
            value = np.repeat(value, slices)
        if name == "in_contact":
            value = value[::nodes]
        elif name not in ("boundary", "side", "face_position") and value.ndim >= 1:
            value = value.reshape(segments, nodes, *value.shape[1:])
        fields[name] = value if value.ndim else float(value)
    if slices > 1 and "face_place" not in fields:
        place = np.tile(fields["face_position"], fields["compliance"].shape[-1] // slices)
        fields["face_place"] = np.broadcast_to(place, fields["compliance"].shape)
    fields.setdefault("coupling", np.zeros((segments, nodes, 1, 1)))
    return MeshCycle(**fields)
