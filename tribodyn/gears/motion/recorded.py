"""What is recorded of a gear pair over time: every dataset's dimensions, unit and meaning."""

from typing import Any

import numpy as np

from tribodyn.gears.motion.course import REVOLUTION, of_revolutions
from tribodyn.geometry.body import GEOMETRY
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.record_arrays import described
from tribodyn.numerics.parameter import Variable, flag
from tribodyn.record.schema import TIME, Layout

DOF = ("x_p", "y_p", "x_g", "y_g", "theta_p", "theta_g")
#: And of gears that move in space.
DOF_IN_SPACE = (*DOF, "z_p", "tilt_x_p", "tilt_y_p", "z_g", "tilt_x_g", "tilt_y_g")

PAIR = Variable(
    ("pair",), "1", "pair of teeth: 1 entered last, 0 the one before it; numbers above 1 are back flanks"
)
DOF_SCALE = Variable(
    ("dof",),
    "1",
    "degree of freedom; p pinion, g gear; x along the pitch tangent, y along the centres, z along the axes",
)
SLICE = Variable(("slice",), "m", "middle of a slice, from the middle of the face")

#: Meanings of flags that say whether a law is inside its range.
RANGE = "out_of_contact_or_none_stated out_of_range in_range"
_TIME, _PAIRS = ("time",), ("time", "pair")
#: What a run records over time. `time` itself is the dimension scale of the first axis.
SAMPLES: dict[str, Variable] = {
    "pinion_angle": Variable(_TIME, "rad", "rotation of the pinion"),
    "displacement": Variable(
        ("time", "dof"),
        "m or rad",
        "generalised coordinates: x_p, y_p, x_g, y_g in m, theta_p, theta_g in rad",
    ),
    "velocity": Variable(
        ("time", "dof"), "m/s or rad/s", "generalised velocities, in the order of the coordinates"
    ),
    "transmission_error_normal": Variable(
        _PAIRS,
        "m",
        "deflection along the pair's normal, gap not subtracted; NaN where the pair is out of contact",
    ),
    "transmission_error_rotational": Variable(
        _TIME, "m", "dynamic transmission error, of the gears' rotations"
    ),
    "normal_load": Variable(_PAIRS, "N", "normal load of the pair"),
    "friction_force": Variable(
        _PAIRS, "N", "sliding friction on the pinion's flank along the tangent, positive in recess"
    ),
    "friction_coefficient": Variable(_PAIRS, "1", "friction coefficient of the pair, its whole face"),
    "asperity_load_ratio": Variable(
        _PAIRS, "1", "share of the load that asperities carry, where the line load is largest"
    ),
    "film_parameter": Variable(
        _PAIRS, "1", "film parameter: central film thickness over composite roughness"
    ),
    "central_film_thickness": Variable(_PAIRS, "m", "central film thickness where the line load is largest"),
    "equivalent_radius": Variable(
        _PAIRS,
        "m",
        "equivalent radius of the two flanks; averaged over the contact where it vanishes at the pitch point",
    ),
    "hertz_pressure": Variable(
        _PAIRS, "Pa", "maximum Hertz pressure along the face, at the equivalent radius"
    ),
    "flash_temperature_rise": Variable(_PAIRS, "K", "flash temperature rise where the line load is largest"),
    "entrainment_speed": Variable(
        _PAIRS,
        "m/s",
        "entrainment speed, mean of both flanks' rolling speeds; averaged over the contact like the radius",
    ),
    "sliding_speed": Variable(
        _PAIRS, "m/s", "sliding speed that friction has, pinion's less gear's, by friction.sliding"
    ),
    "pressure_angle": Variable(_PAIRS, "rad", "angle of the pair's common normal to the pitch tangent"),
    "mesh_stiffness": Variable(_PAIRS, "N/m", "stiffness of the pair along its normal"),
    "closure_in_range": flag(
        _PAIRS, "film law inside its range: 1 yes, 0 no, -1 out of contact or none stated", RANGE
    ),
    "friction_in_range": flag(
        _PAIRS, "friction law inside its range: 1 yes, 0 no, -1 out of contact or none stated", RANGE
    ),
    "drive_torque": Variable(
        _TIME, "N*m", "torque of the drive: on the pinion, with a compliant shaft on its motor side"
    ),
    "power_in": Variable(_TIME, "W", "power the motor gives to the pinion"),
    "power_out": Variable(_TIME, "W", "power the gear gives to the load"),
    "power_friction": Variable(_TIME, "W", "power lost to sliding friction"),
    "power_damping": Variable(_TIME, "W", "power lost to mesh and bearing damping"),
    "power_parametric": Variable(
        _TIME, "W", "power that enters through the varying stiffness and geometry at fixed coordinates"
    ),
    "stored_energy": Variable(_TIME, "J", "kinetic and strain energy"),
    "work_in": Variable(_TIME, "J", "work of the drive since the start"),
    "work_out": Variable(_TIME, "J", "work on the load since the start"),
    "work_friction": Variable(_TIME, "J", "work lost to sliding friction since the start"),
    "work_damping": Variable(_TIME, "J", "work lost to mesh and bearing damping since the start"),
    "work_parametric": Variable(_TIME, "J", "parametric work since the start, jumps at engagement included"),
    "efficiency": Variable(_TIME, "1", "instantaneous efficiency"),
}


#: What is recorded beside that of pairs that are cut into slices.
OF_SLICES: dict[str, Variable] = {
    "line_load": Variable(
        (*_PAIRS, "slice"), "N/m", "normal load per length of the line of contact, of each slice"
    ),
    "axial_force": Variable(_TIME, "N", "force of the teeth on the pinion along z"),
}


def samples_of(slices: int, *, in_space: bool = False) -> dict[str, Variable]:
    """What a run records over time of pairs with so many slices; `in_space`: where one moves in space too."""
    if slices == 1 and not in_space:
        return SAMPLES
    coordinates = "x, y, z in m, theta (rotation) and tilt_x, tilt_y in rad; names in dof"
    moved = Variable(("time", "dof"), "m or rad", f"generalised coordinates: {coordinates}")
    return SAMPLES | {"displacement": moved} | (OF_SLICES if slices > 1 else {})


def pair_numbers(front_pairs: int, pairs: int) -> list[int]:
    """Numbers of the pair slots: the driving flanks end with 1, the back flanks go on from 2."""
    return [slot + 2 - front_pairs for slot in range(pairs)]


def scales_of(cycle: MeshCycle, *, in_space: bool = False) -> dict[str, Any]:
    """Values along the axes of pairs and degrees of freedom, and of slices if there are any.

    Gears in slices move in space, and others do where `in_space` says so.
    """
    side = np.asarray(cycle.pair_side)
    pairs = np.array(pair_numbers(int(np.sum(side > 0)), side.size))
    if cycle.slices == 1:
        return {"pair": pairs, "dof": np.array(DOF_IN_SPACE if in_space else DOF)}
    return {"pair": pairs, "dof": np.array(DOF_IN_SPACE), "slice": np.asarray(cycle.face_position)}


def gears_layout(slices: int, *, in_space: bool = False) -> Layout:
    """Of records over time of pairs with so many slices; see `recorded.samples_of`."""
    scales = {"pair": PAIR, "dof": DOF_SCALE, "revolution": REVOLUTION}
    scales |= {"slice": SLICE} if slices > 1 else {}
    return Layout(
        TIME,
        samples_of(slices, in_space=in_space),
        scales,
        others=of_revolutions(of_train=False),
        groups={"mesh_cycle": described(slices), "geometry": GEOMETRY},
    )


#: Of records over time of spur gears.
LAYOUT = gears_layout(1)
