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
from tribodyn.numerics.parameter import Variable, datasets_of
from tribodyn.record.reader import MESHES
from tribodyn.record.schema import TIME, Layout
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.case import Gearbox
from tribodyn.studies.motion.drivetrain.shaft_lines import HOUSING_GEOMETRY, SHAFT_GEOMETRY, shaft_arrays
from tribodyn.studies.motion.planetary.rims import waves_of
from tribodyn.studies.motion.prepare import geometry_of

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


_DATASETS = datasets_of(__package__)
#: What a run records over time. Rotations of a body are positive in its own nominal sense.
SAMPLES: dict[str, Variable] = {
    **_DATASETS["bodies"],
    **{
        name: _of_train(name, variable)
        for name, variable in OF_A_PAIR.items()
        if "dof" not in variable.dims and name != "pinion_angle"
    },
    **_DATASETS["meshes"],
}
#: Axes of trains, and those of what some of them have: bearings, clutches, slices.
_AXES = _DATASETS["scales"]
SCALES = {name: _AXES[name] for name in ("mesh", "body", "gear")}
SCALES["pair"] = PAIR._replace(long_name=f"{PAIR.long_name}; NaN where a mesh has none of this number")
#: Where its bodies, gears and meshes stand. Numbers of bodies and gears count from 0 along their axes.
TRAIN_GEOMETRY = _DATASETS["geometry"]
#: And of a train with helical teeth.
IN_SPACE = _DATASETS["in_space"]
#: And where rims of rings bend.
RIM = _DATASETS["rim"]
#: In the group "geometry" then; at θ of the carrier's frame the outside of a rim moves outwards by the sum of
#: a cos nθ + a' sin nθ, and along the circle, counter-clockwise, by that of b sin nθ − b' cos nθ.
RIM_GEOMETRY = _DATASETS["rim_geometry"]
#: And of meshes in slices.
LINE_LOAD = {"line_load": OF_SLICES["line_load"]._replace(dims=(*_PAIRS, "slice"))}
SLICE = {"slice": _AXES["slice"]}
#: And of one whose bodies bearings hold.
BEARINGS = _DATASETS["bearings"]
#: Where forces of bearings are evaluated in time.
CAGES = _DATASETS["cages"]
_BEARING = {"bearing": _AXES["bearing"]}
#: And of one with clutches or brakes.
CLUTCHES = _DATASETS["clutches"]
_CLUTCH_AXIS = {"clutch": _AXES["clutch"]}
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
