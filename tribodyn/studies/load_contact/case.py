"""A case of the static load contact study: what one run needs to know, records and takes; SI units."""

import math
from dataclasses import dataclass
from functools import partial

from tribodyn.cases.cost import (
    FINITE_ELEMENTS,
    TOUCHING,
    CostKey,
    Estimate,
    load_sharing,
    recorded,
    total,
)
from tribodyn.gears.case import GearCase, LubricatedCase
from tribodyn.geometry.body import GEOMETRY
from tribodyn.mesh.record_arrays import MESH_CYCLE
from tribodyn.numerics.parameter import Variable
from tribodyn.record.schema import Layout

PHASE = Variable(("phase",), "1", "phase of the mesh in mesh cycles from the first position")
PAIR = Variable(
    ("pair",),
    "1",
    "pair of teeth: 1 passed the beginning of the path of contact last, 0 the one before it, 2 is the next",
)
SLICE = Variable(("slice",), "m", "middle of the slice, from the middle of the face")
BODY = Variable(("body",), "1", "gear that a root stress is of")
TORQUE = Variable(("torque",), "N*m", "torque on the gear")

BODIES = ("pinion", "gear")

_phase, _pair = partial(Variable, ("phase",)), partial(Variable, ("phase", "pair"))
_face = partial(Variable, ("phase", "pair", "slice"))
_root = partial(Variable, ("phase", "body", "pair", "slice"))

#: Over the positions of the pinion. `phase` itself is the dimension scale of the first axis.
SAMPLES: dict[str, Variable] = {
    "pinion_angle": _phase("rad", "rotation of the pinion from the first position"),
    "roll_angle": _pair(
        "rad",
        "rotation of the pinion since the pair met at the pitch point in mid-face, negative before it",
    ),
    "loaded_transmission_error": _phase("m", "loaded static transmission error, of the gears' rotations"),
    "unloaded_transmission_error": _phase(
        "m", "unloaded (kinematic) transmission error, of the gears' rotations"
    ),
    "normal_load": _pair("N", "normal load of the pair"),
    "line_load": _face("N/m", "normal load per length of the line of contact"),
    "hertz_pressure": _face("Pa", "maximum Hertz pressure"),
    "half_width": _face("m", "half width of the Hertz contact"),
    "face_load_factor": _pair(
        "1", "maximum line load over the mean along the face; NaN where the pair carries none"
    ),
    "root_tension": _root("Pa", "maximum surface stress along the fillet on the loaded side"),
    "root_compression": _root("Pa", "minimum surface stress along the fillet on the other side"),
    "mesh_stiffness": _phase(
        "N/m", "derivative of the load at the pitch radius by the loaded transmission error"
    ),
    "torque_residual": _phase("1", "torque of the loads over the gear's torque, less 1"),
}

#: What a study with a lubricant adds.
FILM: dict[str, Variable] = {
    "central_film_thickness": _face("m", "film thickness by the film law; NaN where the slice carries none"),
    "closure_in_range": _face("1", "1 where the film law is inside its range, 0 outside"),
}

#: What a study at several torques adds: a Harris map.
MAP: dict[str, Variable] = {
    "map_transmission_error": Variable(
        ("torque", "phase"), "m", "loaded static transmission error at the torque"
    ),
    "map_peak_to_peak": Variable(
        ("torque",), "m", "peak to peak of the loaded static transmission error at the torque"
    ),
}

LAYOUT = Layout(
    PHASE,
    SAMPLES,
    {"pair": PAIR, "slice": SLICE, "body": BODY, "torque": TORQUE},
    MAP,
    {"mesh_cycle": MESH_CYCLE, "geometry": GEOMETRY},
)
OILED = LAYOUT._replace(samples={**SAMPLES, **FILM})


@dataclass(frozen=True, kw_only=True)
class LoadContactCase(GearCase):
    """One study of teeth in slow rotation under load, complete."""

    #: torques of the Harris map, > 0 and increasing, N m; empty: none is made
    gear_torques: tuple[float, ...] = ()
    friction_coefficient: float = 0.0  # μ of all pairs, ≥ 0
    positions_per_cycle: int = 60  # positions of the pinion in one mesh cycle
    cycles: int = 1  # mesh cycles to roll through; more than one where teeth differ
    #: the same gears with oil, at a speed > 0, for the film over the face; None: there is no lubricant
    lubricated: LubricatedCase | None = None


def estimate(case: LoadContactCase) -> Estimate:
    """What a run of a case takes."""
    positions, slices = case.positions_per_cycle * case.cycles, case.mesh.slices
    torques = len(case.gear_torques)
    drive = case.drive
    width = min(float(drive.pinion.face_width), float(drive.gear.face_width))
    overlap = width * abs(math.tan(float(drive.helix_angle))) / (math.pi * float(drive.module))
    pairs = TOUCHING + math.ceil(overlap)
    sizes = {"phase": positions, "pair": pairs, "slice": slices, "body": 2}
    if torques:
        sizes["torque"] = torques
    return total(
        (
            CostKey("output.positions_per_cycle", case.positions_per_cycle, 60),
            CostKey("output.cycles", case.cycles, 1),
            CostKey("mesh.slices", slices, 21),
            CostKey("operating.gear_torques", 1 + torques, 10),
        ),
        recorded(OILED if case.lubricated else LAYOUT, sizes, copies=4.0, outlines=True),
        load_sharing(float(positions) * (1 + torques), slices * pairs / TOUCHING, positions),
        FINITE_ELEMENTS,
    )
