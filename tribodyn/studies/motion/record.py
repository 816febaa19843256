"""What is recorded of a gearbox over time: datasets over its bodies, and over its meshes and their pairs.

Where a file names its meshes they are a dimension; of a pair of gears, which has one, they are not, and the
motion is that of pinion and gear.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.dynamics.recorded.outputs import IN_SPACE_NAMES, Sampled, holding_links
from tribodyn.gears.bearings_in_time import cages_turn
from tribodyn.gears.motion.course import REVOLUTION, of_revolutions, revolution_scale
from tribodyn.gears.motion.recorded import OF_SLICES, PAIR, gears_layout, scales_of
from tribodyn.gears.motion.recorded import SAMPLES as OF_A_PAIR
from tribodyn.gears.motion.running import MeshOfRun, mesh_pairs
from tribodyn.geometry.body import GEOMETRY, geometry_arrays
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.record_arrays import as_arrays, described
from tribodyn.numerics.parameter import Variable
from tribodyn.record.reader import MESHES
from tribodyn.record.schema import TIME, Layout
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.case import Gearbox
from tribodyn.studies.motion.drivetrain.shaft_lines import HOUSING_GEOMETRY, SHAFT_GEOMETRY, shaft_arrays
from tribodyn.studies.motion.planetary.rims import waves_of
from tribodyn.studies.motion.prepare import geometry_of

_TIME, _BODY, _MESH, _PAIRS = ("time",), ("time", "body"), ("time", "mesh"), ("time", "mesh", "pair")
_CLUTCH = ("time", "clutch")
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
#: And where rims of rings bend.
RIM: dict[str, Variable] = {
    "rim_along": Variable(
        _MESH, "m", "bending of the ring's rim at each mesh along the pitch tangent, as the driver's motion"
    ),
    "rim_across": Variable(_MESH, "m", "likewise across, from the driver's axis to the driven one's"),
    "rim_wave": Variable(("time", "wave"), "m", "amplitudes of the waves of every rim, of its outside"),
}
#: In the group "geometry" then; at θ of the carrier's frame the outside of a rim moves outwards by the sum of
#: a cos nθ + a' sin nθ, and along the circle, counter-clockwise, by that of b sin nθ − b' cos nθ.
RIM_GEOMETRY: dict[str, Variable] = {
    "wave_ring": Variable(("wave",), "1", "number of the body whose rim each amplitude is of"),
    "wave_order": Variable(("wave",), "1", "order n of each amplitude; those of one are a, b, a', b'"),
    "wave_pins": Variable(("wave",), "1", "number of the pins that hold its rim; 0: none"),
}
#: And of meshes in slices.
LINE_LOAD: dict[str, Variable] = {
    "line_load": OF_SLICES["line_load"]._replace(dims=(*_PAIRS, "slice")),
}
SLICE = {
    "slice": Variable(("slice",), "1", "slice of the face, from its -z end on; NaN beyond those of a mesh")
}
#: And of one whose bodies bearings hold.
BEARINGS: dict[str, Variable] = {
    "bearing_force_x": Variable(("time", "bearing"), "N", "force of each body on its bearing or pin in x"),
    "bearing_force_y": Variable(("time", "bearing"), "N", "force of each body on its bearing or pin in y"),
}
#: Where forces of bearings are evaluated in time.
CAGES = {
    "power_cages": Variable(("time",), "W", "power with which cages carry loaded rolling elements on"),
}
_BEARING = {"bearing": Variable(("bearing",), "1", "bearing or pin, by the body that it holds")}
#: And of one with clutches or brakes.
CLUTCHES: dict[str, Variable] = {
    "clutch_slip": Variable(_CLUTCH, "rad/s", "speed of each clutch's first body over its second one's"),
    "clutch_torque": Variable(_CLUTCH, "N*m", "torque of each clutch on its first body, against its slip"),
    "clutch_capacity": Variable(_CLUTCH, "N*m", "torque that each clutch transmits while it slips"),
    "clutch_power": Variable(_CLUTCH, "W", "power that slip turns into heat in each clutch"),
    "clutch_work": Variable(_CLUTCH, "J", "work that slip turned into heat in each clutch since the start"),
}
_CLUTCH_AXIS = {"clutch": Variable(("clutch",), "1", "clutch or brake of the train")}
#: Of a pair besides what `gears_layout` has.
OF_A_GEAR = {
    name: SAMPLES[name]._replace(dims=tuple(dim for dim in SAMPLES[name].dims if dim != "mesh"))
    for name in ("driver_torque", "driven_torque", "signed_distance")
}
#: Where its bodies, gears and only mesh stand, of a mesh without its dimension.
OF_ONE_MESH = {
    name: variable._replace(dims=()) if variable.dims == ("mesh",) else variable
    for name, variable in TRAIN_GEOMETRY.items()
}
#: A mesh has as many pairs as it needs: they are counted beside those of the record.
_SLOTS = {"pair": "slot", "other_pair": "other_slot"}


def _cycle(slices: int) -> dict[str, Variable]:
    return {
        name: variable._replace(dims=tuple(_SLOTS.get(dim, dim) for dim in variable.dims))
        for name, variable in described(slices).items()
    }


class GearboxRecord(NamedTuple):
    """How the records of a case are laid out."""

    layout: Layout
    scales: dict[str, Any]
    groups: dict[str, dict[str, Any]]
    pairs: tuple[int, ...]
    meshes: Sequence[MeshOfRun]
    named: bool  # whether there is a dimension of meshes

    def block(self, sampled: Sampled) -> dict[str, np.ndarray]:
        """What a record takes of samples."""
        if not self.named:
            every = sampled.whole | sampled.meshes[0] | recorded(sampled)
            return {name: every[name] for name in ("time", *self.layout.samples)}
        count, bodies = len(sampled.cycles), len(self.scales["body"])
        block = {"time": sampled.whole["time"]}
        block["mesh_phase"] = np.stack([mesh.cycles(sampled.cycles) for mesh in self.meshes], axis=1)
        for name, variable in self.layout.samples.items():
            if variable.dims[:3] == _PAIRS:
                further = [len(self.scales[dim]) for dim in variable.dims[3:]]
                block[name] = np.full((count, len(self.meshes), len(self.pairs), *further), np.nan)
                for m, (mesh, values) in enumerate(zip(self.meshes, sampled.meshes, strict=True)):
                    self._put(block[name][:, m], mesh.cycle, values.get(name))
            elif variable.dims == _MESH and any(name in mesh for mesh in sampled.meshes):
                nothing = np.full(count, np.nan)
                block[name] = np.stack([mesh.get(name, nothing) for mesh in sampled.meshes], axis=1)
            elif variable.dims == _BODY:
                values = sampled.whole[name]
                block[name] = np.full((count, bodies), np.nan)
                block[name][:, : values.shape[1]] = values
            elif name in sampled.whole:
                block[name] = sampled.whole[name]
        return block

    def _put(self, block: np.ndarray, cycle: MeshCycle, values: np.ndarray | None) -> None:
        """Put values (n, pairs) of a mesh, or (n, pairs, slices) where it has slices, into its block."""
        columns = [self.pairs.index(number) for number in mesh_pairs(cycle)]
        if values is not None:
            block[(slice(None), columns, *(slice(size) for size in values.shape[2:]))] = values


def record_of(prepared: PreparedGearbox, meshes: Sequence[MeshOfRun]) -> GearboxRecord:
    """The layout of a record of a gearbox, and what it holds from the start."""
    case, model = prepared.case, prepared.model
    bearings = [case.links[k].name for k in holding_links(model)]
    bearings += case.system.bearing_names if case.system is not None else []
    numbers = [number for mesh in meshes for number in mesh_pairs(mesh.cycle)]
    pairs = tuple(range(min(numbers), max(numbers) + 1))
    scales = revolution_scale(case.output.revolutions(case.solver.cycles))
    of_bearings = (BEARINGS if bearings else {}) | (CAGES if cages_turn(case.system) else {})
    if bearings:
        scales["bearing"] = np.array(bearings)
    if not case.named:
        cycle, in_space = prepared.cycle, model.layout.spatial > 0
        plain = gears_layout(cycle.slices, in_space=in_space)
        samples = {**plain.samples, **OF_A_GEAR} | of_bearings
        axes = {**plain.scales, "body": SCALES["body"], "gear": SCALES["gear"]}
        axes |= _BEARING if bearings else {}
        described_groups = {**plain.groups, "geometry": GEOMETRY | OF_ONE_MESH}
        layout = plain._replace(samples=samples, scales=axes, groups=described_groups)
        scales |= scales_of(cycle, in_space=in_space)
        scales |= {"body": np.array(prepared.names), "gear": np.array([gear.name for gear in case.gears])}
        stand = {
            name: values if OF_ONE_MESH[name].dims else values[MESH]
            for name, values in geometry_of(prepared).items()
        }
        groups = {"mesh_cycle": as_arrays(cycle), "geometry": geometry_arrays(prepared.assembly) | stand}
        return GearboxRecord(layout, scales, groups, pairs, meshes, named=False)
    groups: dict[str, Any] = {"geometry": geometry_of(prepared)}
    tables: dict[str, Any] = {"geometry": TRAIN_GEOMETRY}
    if case.system is not None:
        new = {body: number for number, body in enumerate(prepared.order)}
        widths = [gear.face_width for gear in case.gears]
        groups["geometry"] |= shaft_arrays(case.system, new, widths)
        of_housing = {} if case.system.housing is None else HOUSING_GEOMETRY
        tables["geometry"] = TRAIN_GEOMETRY | SHAFT_GEOMETRY | of_housing
    for mesh, part in zip(meshes, case.meshes, strict=True):
        tables[f"{MESHES}/{part.name}/mesh_cycle"] = _cycle(mesh.cycle.slices)
        tables[f"{MESHES}/{part.name}/geometry"] = GEOMETRY
        groups[f"{MESHES}/{part.name}/mesh_cycle"] = as_arrays(mesh.cycle)
        groups[f"{MESHES}/{part.name}/geometry"] = geometry_arrays(mesh.assembly)
    scales |= {
        "mesh": np.array([mesh.name for mesh in case.meshes]),
        "body": np.array(prepared.names),
        "gear": np.array([gear.name for gear in case.gears]),
        "pair": np.array(pairs),
    }
    samples, axes = SAMPLES, SCALES
    if (slices := max(mesh.cycle.slices for mesh in meshes)) > 1:
        samples, axes = samples | IN_SPACE | LINE_LOAD, axes | SLICE
        scales["slice"] = np.arange(1, slices + 1)
    if any(model.layout.rim_count):
        samples = samples | RIM
        groups["geometry"] |= waves_of(case, prepared.order)
        tables["geometry"] = tables["geometry"] | RIM_GEOMETRY
        axes = axes | {"wave": Variable(("wave",), "1", "amplitude of a wave of a rim")}
        scales["wave"] = np.arange(1, len(groups["geometry"]["wave_order"]) + 1)
    if bearings:
        samples, axes = samples | of_bearings, axes | _BEARING
    if case.clutches:
        samples, axes = samples | CLUTCHES, axes | _CLUTCH_AXIS
        scales["clutch"] = np.array([one.name for one in case.clutches])
    axes = axes | {"revolution": REVOLUTION}
    others = of_revolutions(of_train=True)
    return GearboxRecord(
        Layout(TIME, samples, axes, others, tables), scales, groups, pairs, meshes, named=True
    )


def usual_layout(case: Gearbox) -> Layout:
    """Of a record of a case whose meshes are not known yet, without slices."""
    return Layout(TIME, SAMPLES) if case.named else gears_layout(1)


#: Bodies of a pair of gears, and its only mesh.
PINION, GEAR, MESH = 0, 1, 0


def recorded(sampled: Sampled) -> dict[str, np.ndarray]:
    """Datasets of a pair's record, by name, from those of the train of two bodies that it is."""
    whole = sampled.whole

    def dof(x: str, y: str, angle: str) -> np.ndarray:
        columns = [whole[name][:, body] for body in (PINION, GEAR) for name in (x, y)]
        end = "_rate" if x.endswith("_rate") else ""
        further = [whole[name + end].T for name in IN_SPACE_NAMES]
        in_space = [row for rows in zip(*further, strict=True) for row in rows]
        return np.stack([*columns, whole[angle][:, PINION], whole[angle][:, GEAR], *in_space], axis=-1)

    named = {
        "pinion_angle": whole["reference_angle"],
        "displacement": dof("x", "y", "angle"),
        "velocity": dof("x_rate", "y_rate", "speed"),
    }
    variables = OF_A_PAIR | (OF_SLICES if "line_load" in sampled.meshes[MESH] else {})
    every = named | sampled.meshes[MESH] | {name: v for name, v in whole.items() if v.ndim == 1}
    return {name: values for name, values in every.items() if name in variables or name == "time"}
