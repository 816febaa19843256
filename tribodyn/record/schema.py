"""The layout of a record: every dataset's dimensions, unit and meaning, in one place.

`docs/record.md` explains the conventions to the people who read such files; `writer` and `reader` are the
only modules that use this one.
"""

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import NamedTuple

from tribodyn.numerics.variable import Variable
from tribodyn.studies.backlash_oscillator import layout as backlash_oscillator
from tribodyn.studies.load_contact import layout as load_contact

FORMAT = "tribodyn-record"
#: Raised when a reader of the previous version would misread the file.
FORMAT_VERSION = 1

#: States of a record. A file that says `partial` is being written, or its process was killed.
PARTIAL, COMPLETE, FAILED = "partial", "complete", "failed"
STATUS_NOTES = {
    PARTIAL: "the run is going on, or was killed: only the first samples_written samples are results",
    COMPLETE: "",
}

DOF = ("x_p", "y_p", "x_g", "y_g", "theta_p", "theta_g")

#: Flags of range where there is no contact to speak of, or nothing was written yet.
NO_CONTACT = -1
#: Datasets that are flags of range: small integers in the file.
FLAGS = ("closure_in_range", "friction_in_range")


#: Datasets that every record of this version holds; others may be missing in one of an earlier release.
NEEDED = ("time", "pinion_angle", "transmission_error", "transmission_error_rotational", "normal_load")

#: What a run records over time. `time` itself is the dimension scale of the first axis.
SAMPLES: dict[str, Variable] = {
    "pinion_angle": Variable(("time",), "rad", "rotation of the pinion"),
    "displacement": Variable(
        ("time", "dof"),
        "m or rad",
        "generalised coordinates: x_p, y_p, x_g, y_g in m, theta_p, theta_g in rad",
    ),
    "velocity": Variable(
        ("time", "dof"), "m/s or rad/s", "generalised velocities, in the order of the coordinates"
    ),
    "transmission_error": Variable(
        ("time", "pair"),
        "m",
        "dynamic transmission error along the pair's normal; NaN where the pair is out of contact",
    ),
    "transmission_error_rotational": Variable(
        ("time",), "m", "rotational dynamic transmission error r_p theta_p - r_g theta_g"
    ),
    "normal_load": Variable(("time", "pair"), "N", "normal load of the pair"),
    "friction_force": Variable(
        ("time", "pair"), "N", "sliding friction on the pinion's flank along the tangent, positive in recess"
    ),
    "friction_coefficient": Variable(
        ("time", "pair"), "1", "friction coefficient of the pair, its whole face"
    ),
    "asperity_load_ratio": Variable(
        ("time", "pair"), "1", "share of the load that asperities carry, where the line load is greatest"
    ),
    "film_parameter": Variable(
        ("time", "pair"), "1", "film parameter: central film thickness over composite roughness"
    ),
    "central_film_thickness": Variable(
        ("time", "pair"), "m", "central film thickness where the line load is greatest"
    ),
    "equivalent_radius": Variable(
        ("time", "pair"),
        "m",
        "equivalent radius of the two flanks; averaged over the contact where it vanishes at the pitch point",
    ),
    "hertz_pressure": Variable(
        ("time", "pair"), "Pa", "greatest Hertz pressure along the face, at the equivalent radius"
    ),
    "flash_temperature_rise": Variable(
        ("time", "pair"), "K", "flash temperature rise where the line load is greatest"
    ),
    "entrainment_speed": Variable(
        ("time", "pair"),
        "m/s",
        "entrainment speed, mean of both flanks' rolling speeds; averaged over the contact like the radius",
    ),
    "sliding_speed": Variable(
        ("time", "pair"), "m/s", "sliding speed, pinion's less gear's; negative in approach"
    ),
    "pressure_angle": Variable(
        ("time", "pair"), "rad", "angle of the pair's common normal to the pitch tangent"
    ),
    "mesh_stiffness": Variable(("time", "pair"), "N/m", "stiffness of the pair along its normal"),
    "closure_in_range": Variable(
        ("time", "pair"), "1", "film law inside its range: 1 yes, 0 no, -1 out of contact or none stated"
    ),
    "friction_in_range": Variable(
        ("time", "pair"), "1", "friction law inside its range: 1 yes, 0 no, -1 out of contact or none stated"
    ),
    "drive_torque": Variable(
        ("time",), "N*m", "torque of the drive: on the pinion, with a compliant shaft on its motor side"
    ),
    "power_in": Variable(("time",), "W", "power the motor gives to the pinion"),
    "power_out": Variable(("time",), "W", "power the gear gives to the load"),
    "power_friction": Variable(("time",), "W", "power lost to sliding friction"),
    "power_damping": Variable(("time",), "W", "power lost to mesh and bearing damping"),
    "power_parametric": Variable(
        ("time",), "W", "power that enters through the varying stiffness and geometry at fixed coordinates"
    ),
    "stored_energy": Variable(("time",), "J", "kinetic and strain energy"),
    "work_in": Variable(("time",), "J", "work of the drive since the start"),
    "work_out": Variable(("time",), "J", "work on the load since the start"),
    "work_friction": Variable(("time",), "J", "work lost to sliding friction since the start"),
    "work_damping": Variable(("time",), "J", "work lost to mesh and bearing damping since the start"),
    "work_parametric": Variable(
        ("time",), "J", "parametric work since the start, jumps at engagement included"
    ),
    "efficiency": Variable(("time",), "1", "instantaneous efficiency"),
}

#: The same for a gear with rolling elements.
ROLLING_SAMPLES: dict[str, Variable] = {
    "input_angle": Variable(("time",), "rad", "rotation of the shaft"),
    "element_angle": Variable(
        ("time", "element"),
        "rad",
        "angle of the element about the cage's centre from the pitch point; 0 in a depression of the cam, "
        "pi on a protrusion",
    ),
    "cam_distance": Variable(
        ("time", "element"), "m", "L_A, distance from pitch point to contact with the cam"
    ),
    "crown_distance": Variable(
        ("time", "element"), "m", "L_B, distance from pitch point to contact with the crown"
    ),
    "normal_load": Variable(
        ("time", "element"), "N", "normal load of the element, the same on cam and crown"
    ),
    "slip_speed": Variable(
        ("time", "element"),
        "m/s",
        "slip of the element over the cam, positive counter-clockwise about the pitch point",
    ),
    "spin_speed": Variable(("time", "element"), "rad/s", "rotation of the element in the cage"),
    "power_cam": Variable(("time", "element"), "W", "power lost at the cam, to rolling and sliding"),
    "power_crown": Variable(("time", "element"), "W", "power lost at the crown, to rolling"),
    "power_in": Variable(("time",), "W", "power of the shaft"),
    "power_out": Variable(("time",), "W", "power of the cam, which drives the load"),
    "power_friction": Variable(("time",), "W", "power lost in all contacts"),
    "efficiency": Variable(("time",), "1", "instantaneous efficiency; as_published: the product (23)"),
}

TIME = Variable(("time",), "s", "time")
ELEMENT = Variable(("element",), "1", "rolling element, in the order of their angles")
PAIR = Variable(
    ("pair",), "1", "pair of teeth: 1 entered last, 0 the one before it; numbers above 1 are back flanks"
)
DOF_SCALE = Variable(
    ("dof",), "1", "degree of freedom; p pinion, g gear; x along the pitch tangent, y along the centres"
)
SAMPLES_WRITTEN = Variable((), "1", "number of samples, from the first, that hold results")

#: Arrays of the mesh cycle; its numbers are attributes of the group.
MESH_CYCLE: dict[str, Variable] = {
    "boundary": Variable(
        ("boundary",), "1", "phases, in mesh cycles, at which the set of contacting pairs changes"
    ),
    "phase": Variable(
        ("phase",),
        "1",
        "phase of the mesh in mesh cycles; boundaries of segments stand twice, before and after",
    ),
    "side": Variable(("pair",), "1", "+1 driving flanks, -1 back flanks"),
    "in_contact": Variable(
        ("phase", "pair"),
        "1",
        "1 where the pair is on the theoretical path of contact; elsewhere its values mean nothing",
    ),
    "pressure_angle": Variable(("phase", "pair"), "rad", "angle of the common normal to the pitch tangent"),
    "signed_distance": Variable(
        ("phase", "pair"), "m", "distance from pitch point to contact, negative in approach"
    ),
    "equivalent_radius": Variable(
        ("phase", "pair"), "m", "one over the sum of the flanks' curvatures, at the very point of contact"
    ),
    "pinion_speed": Variable(
        ("phase", "pair"), "m/rad", "speed of the contact along the pinion's flank per pinion speed"
    ),
    "gear_speed": Variable(
        ("phase", "pair"), "m/rad", "speed of the contact along the gear's flank per pinion speed"
    ),
    "compliance": Variable(
        ("phase", "pair"), "m/N", "deflection of one pair along its normal per normal load"
    ),
    "gap": Variable(("phase", "pair"), "m", "static transmission error; for back flanks the normal backlash"),
    "line_load_friction": Variable(
        ("phase", "pair"), "1", "line load at which friction acts as on the uneven face, over the mean"
    ),
    "line_load_peak": Variable(
        ("phase", "pair"), "1", "greatest line load along the face over the mean, K_Hbeta"
    ),
    "coupling": Variable(
        ("phase", "pair", "other_pair"),
        "m/N",
        "deflection of a pair per load on the other pair, through the gear bodies",
    ),
}

#: Units of the mesh cycle's numbers, told in the group's attribute `<name>_units`.
MESH_CYCLE_SCALARS: dict[str, str] = {
    "hertz_coefficient": "m/N^0.9",
    "pinion_pitch_radius": "m",
    "gear_pitch_radius": "m",
    "pinion_teeth": "1",
    "face_width": "m",
    "contact_ratio": "1",
    "pitch_point_phase": "1",
    "roll_start": "rad",
    "roll_end": "rad",
    "pitch_point_length": "m",
    "pitch_point_rate": "1/rad",
}


class Kind(NamedTuple):
    """What a record of one kind of scenario holds.

    Attributes
    ----------
    samples : dict
        Datasets along the axis on which a run goes on.
    needed : tuple of str
        Those that it cannot lack.
    scales : dict
        Scales of the other axes.
    axis : Variable
        Scale of the axis on which the run goes on.
    others : dict
        Datasets along other axes; left out where an axis of theirs has no scale.
    """

    samples: dict[str, Variable]
    needed: tuple[str, ...]
    scales: dict[str, Variable]
    axis: Variable = TIME
    others: Mapping[str, Variable] = MappingProxyType({})


def axis_name(kind: str) -> str:
    """Name of the axis on which runs of this kind go on: "time", "phase" in slow rotation, "frequency"."""
    return KINDS[kind].axis.dims[0]


GEAR_PAIR, ROLLING, LOAD_CONTACT = "gear-pair", "irefc", "load-contact"
BACKLASH_OSCILLATOR = "backlash-oscillator"
KINDS: dict[str, Kind] = {
    GEAR_PAIR: Kind(SAMPLES, NEEDED, {"pair": PAIR, "dof": DOF_SCALE}),
    ROLLING: Kind(
        ROLLING_SAMPLES, ("time", "input_angle", "element_angle", "normal_load"), {"element": ELEMENT}
    ),
    LOAD_CONTACT: Kind(
        load_contact.SAMPLES,
        load_contact.NEEDED,
        {
            "pair": load_contact.PAIR,
            "slice": load_contact.SLICE,
            "body": load_contact.BODY,
            "torque": load_contact.TORQUE,
        },
        load_contact.PHASE,
        load_contact.MAP,
    ),
    BACKLASH_OSCILLATOR: Kind(
        backlash_oscillator.SAMPLES,
        backlash_oscillator.NEEDED,
        {"direction": backlash_oscillator.DIRECTION, "multiplier": backlash_oscillator.MULTIPLIER},
        backlash_oscillator.FREQUENCY,
    ),
}

#: Curves of the geometry; lengths such as radii are attributes of the group, in m.
GEOMETRY: dict[str, Variable] = {
    "pinion_outline": Variable(
        ("pinion_point", "axis"),
        "m",
        "outline of the pinion about its axis, turned as when a pair touches at the pitch point",
    ),
    "gear_outline": Variable(
        ("gear_point", "axis"),
        "m",
        "outline of the gear about its axis, turned as when a pair touches at the pitch point",
    ),
    "path_of_contact": Variable(
        ("path_point", "axis"), "m", "path of contact, origin at the pitch point, x along the pitch tangent"
    ),
    "cam_outline": Variable(
        ("cam_point", "axis"), "m", "profile of the cam about its centre, as it stands at the start"
    ),
    "crown_outline": Variable(("crown_point", "axis"), "m", "profile of the crown about the shaft's axis"),
}

#: Further dimensions that only count; xarray wants each to exist.
COUNTED = ("other_pair", "pinion_point", "gear_point", "cam_point", "crown_point", "path_point", "axis")


def pair_numbers(front_pairs: int, pairs: int) -> list[int]:
    """Numbers of the pair slots: the driving flanks end with 1, the back flanks go on from 2."""
    return [slot + 2 - front_pairs for slot in range(pairs)]


def partial_path(path: Path) -> Path:
    """Where the record lies until it is complete."""
    return path.with_name(path.stem + ".partial.h5")
