"""What is recorded of a train over time: datasets over its bodies, and over its meshes and their pairs."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.body import GEOMETRY, geometry_arrays
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.record_arrays import as_arrays, described
from tribodyn.numerics.parameter import Variable
from tribodyn.record.reader import MESHES
from tribodyn.record.schema import TIME, Layout
from tribodyn.studies.gears.over_time import by_revolution
from tribodyn.studies.gears.over_time.recorded import PAIR
from tribodyn.studies.gears.over_time.recorded import SAMPLES as OF_A_PAIR
from tribodyn.studies.gears.over_time.running import MeshOfRun, mesh_pairs
from tribodyn.studies.gears.over_time.sampled import Sampled

_TIME, _BODY, _MESH, _PAIRS = ("time",), ("time", "body"), ("time", "mesh"), ("time", "mesh", "pair")
#: What a record of a pair says in terms of pinion and gear.
_MEANINGS = {
    "friction_force": "sliding friction on the driver's flank along the tangent, positive in recess",
    "sliding_speed": "sliding speed that friction has, the driver's less the driven one's",
    "transmission_error_rotational": "dynamic transmission error, of the rotations of driver and driven",
    "drive_torque": "torque of the drive on the input, with a compliant shaft on its motor side",
    "power_in": "power the drive gives to the input",
    "power_out": "power that all loads take",
    "power_friction": "power lost to sliding friction in all meshes",
    "power_damping": "power lost to the damping of meshes and links",
    "work_damping": "work lost to the damping of meshes and links since the start",
    "pressure_angle": "angle of the pair's common normal to the pitch tangent of its mesh",
}


def _of_train(name: str, variable: Variable) -> Variable:
    over_mesh = name == "transmission_error_rotational"
    dims = _MESH if over_mesh else _PAIRS if "pair" in variable.dims else variable.dims
    return variable._replace(dims=dims, long_name=_MEANINGS.get(name, variable.long_name))


#: What a run records over time. Rotations of a body are positive in its own nominal sense.
SAMPLES: dict[str, Variable] = {
    "reference_angle": Variable(_TIME, "rad", "rotation of the body that drives the first mesh"),
    "mesh_phase": Variable(
        _MESH,
        "1",
        "cycles of each mesh since it began one; a cycle begins as a pair enters",
    ),
    "angle": Variable(_BODY, "rad", "rotation of each body, in its own nominal sense"),
    "speed": Variable(_BODY, "rad/s", "speed of rotation of each body, in its own nominal sense"),
    "x": Variable(_BODY, "m", "displacement of each body in x of the train; NaN of those that only turn"),
    "y": Variable(_BODY, "m", "displacement of each body in y of the train; NaN of those that only turn"),
    "x_rate": Variable(_BODY, "m/s", "velocity of each body in x of the train"),
    "y_rate": Variable(_BODY, "m/s", "velocity of each body in y of the train"),
    **{
        name: _of_train(name, variable)
        for name, variable in OF_A_PAIR.items()
        if "dof" not in variable.dims and name != "pinion_angle"
    },
    "signed_distance": Variable(
        _PAIRS, "m", "distance from the pitch point to the pair's contact, negative in approach"
    ),
    "driver_torque": Variable(_MESH, "N*m", "torque of the mesh on its driver, against its motion"),
    "driven_torque": Variable(_MESH, "N*m", "torque of the mesh on its driven body, with its motion"),
    "mesh_power_friction": Variable(_MESH, "W", "power lost to sliding friction in each mesh"),
}
SCALES = {
    "mesh": Variable(("mesh",), "1", "mesh of the train; driver and driven, as power flows from the input"),
    "body": Variable(("body",), "1", "body of the train"),
    "gear": Variable(("gear",), "1", "gear of the train"),
    "pair": PAIR._replace(long_name=f"{PAIR.long_name}; NaN where a mesh has none of this number"),
}
#: Where its bodies, gears and meshes stand. Numbers of bodies and gears count from 0 along their axes.
TRAIN_GEOMETRY: dict[str, Variable] = {
    "centre": Variable(("body", "axis"), "m", "axis of each body in x, y of the train, without load"),
    "sense": Variable(("body",), "1", "nominal sense of rotation, 1 counter-clockwise seen from +z, -1 not"),
    "carrier": Variable(
        ("body",),
        "1",
        "number of the carrier of the planetary set that each body is of; -1: none",
    ),
    "carried": Variable(
        ("body",),
        "1",
        "rotation of the frame of x and y of each body about its carrier's axis, counter-clockwise, over "
        "reference_angle: nominal",
    ),
    "gear_body": Variable(("gear",), "1", "number of the body that each gear belongs to"),
    "plane": Variable(("gear",), "1", "number of the axial plane that each gear is in"),
    "tooth_direction": Variable(
        ("gear",), "rad", "direction of the axis of a tooth where its body's angle is 0, from x"
    ),
    "driver_gear": Variable(("mesh",), "1", "number of the gear that drives in each mesh"),
    "driven_gear": Variable(("mesh",), "1", "number of the gear that is driven in each mesh"),
    "phase": Variable(
        ("mesh",), "1", "cycles of each mesh where all angles are 0, without load; of the first mesh 0"
    ),
    "azimuth": Variable(("mesh",), "rad", "direction from the driver's axis to the driven one's, from x"),
}
#: And of a train with helical teeth.
IN_SPACE: dict[str, Variable] = {
    "z": Variable(_BODY, "m", "displacement of each body along its axis; NaN of those that do not move so"),
    "tilt_x": Variable(_BODY, "rad", "tilt of each body about x of the train"),
    "tilt_y": Variable(_BODY, "rad", "tilt of each body about y of the train"),
    "z_rate": Variable(_BODY, "m/s", "velocity of each body along its axis"),
    "axial_force": Variable(_MESH, "N", "force of each mesh on its driver along z"),
}
#: And of one whose bodies bearings hold.
BEARINGS: dict[str, Variable] = {
    "bearing_force_x": Variable(("time", "bearing"), "N", "force of each body on its bearing or pin in x"),
    "bearing_force_y": Variable(("time", "bearing"), "N", "force of each body on its bearing or pin in y"),
}
_BEARING = {"bearing": Variable(("bearing",), "1", "bearing or pin, by the body that it holds")}
#: A mesh has as many pairs as it needs: they are counted beside those of the record.
_SLOTS = {"pair": "slot", "other_pair": "other_slot"}


def _cycle(slices: int) -> dict[str, Variable]:
    return {
        name: variable._replace(dims=tuple(_SLOTS.get(dim, dim) for dim in variable.dims))
        for name, variable in described(slices).items()
    }


class TrainRecord(NamedTuple):
    """How the records of a case are laid out."""

    layout: Layout
    scales: dict[str, Any]
    groups: dict[str, dict[str, Any]]
    pairs: tuple[int, ...]
    meshes: Sequence[MeshOfRun]

    def block(self, found: Sampled) -> dict[str, np.ndarray]:
        """What a record takes of samples."""
        count, bodies = len(found.cycles), len(self.scales["body"])
        block = {"time": found.whole["time"]}
        block["mesh_phase"] = np.stack([mesh.cycles(found.cycles) for mesh in self.meshes], axis=1)
        for name, variable in self.layout.samples.items():
            if variable.dims == _PAIRS:
                block[name] = np.full((count, len(self.meshes), len(self.pairs)), np.nan)
                for m, (mesh, values) in enumerate(zip(self.meshes, found.meshes, strict=True)):
                    block[name][:, m, self._columns(mesh.cycle)] = values[name]
            elif variable.dims == _MESH and name in found.meshes[0]:
                block[name] = np.stack([mesh[name] for mesh in found.meshes], axis=1)
            elif variable.dims == _BODY:
                values = found.whole[name]
                block[name] = np.full((count, bodies), np.nan)
                block[name][:, : values.shape[1]] = values
            elif name in found.whole:
                block[name] = found.whole[name]
        return block

    def _columns(self, cycle: MeshCycle) -> list[int]:
        return [self.pairs.index(number) for number in mesh_pairs(cycle)]


def record_of(
    names: Sequence[str],
    bodies: Sequence[str],
    meshes: Sequence[MeshOfRun],
    assemblies: Sequence[Assembly],
    gears: Sequence[str],
    geometry: Mapping[str, Any],
    bearings: Sequence[str] = (),
    revolutions: int = 0,
) -> TrainRecord:
    """The layout of a record of meshes, bodies and gears with these names, and what it holds from the start.

    `geometry` are the values of `TRAIN_GEOMETRY`, `bearings` the names of what holds bodies in x and y,
    `revolutions` the number of those that statistics are kept of.
    """
    numbers = [number for mesh in meshes for number in mesh_pairs(mesh.cycle)]
    pairs = tuple(range(min(numbers), max(numbers) + 1))
    groups: dict[str, Any] = {"geometry": dict(geometry)}
    tables: dict[str, Any] = {"geometry": TRAIN_GEOMETRY}
    for name, mesh, assembly in zip(names, meshes, assemblies, strict=True):
        tables[f"{MESHES}/{name}/mesh_cycle"] = _cycle(mesh.cycle.slices)
        tables[f"{MESHES}/{name}/geometry"] = GEOMETRY
        groups[f"{MESHES}/{name}/mesh_cycle"] = as_arrays(mesh.cycle)
        groups[f"{MESHES}/{name}/geometry"] = geometry_arrays(assembly)
    scales = {
        "mesh": np.array(names),
        "body": np.array(bodies),
        "gear": np.array(gears),
        "pair": np.array(pairs),
    }
    helical = any(mesh.cycle.slices > 1 for mesh in meshes)
    samples, axes = SAMPLES | (IN_SPACE if helical else {}), SCALES
    if bearings:
        samples, axes = samples | BEARINGS, SCALES | _BEARING
        scales["bearing"] = np.array(bearings)
    axes = axes | {"revolution": by_revolution.REVOLUTION}
    others = by_revolution.described(of_train=True)
    scales |= by_revolution.scale(revolutions)
    return TrainRecord(Layout(TIME, samples, axes, others, tables), scales, groups, pairs, meshes)
