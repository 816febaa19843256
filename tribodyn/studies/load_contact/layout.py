"""Datasets of a load contact study: over phase of the mesh, pairs of teeth and slices of the face."""

from tribodyn.geometry.body import GEOMETRY
from tribodyn.mesh.cycle import MESH_CYCLE
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

_PAIR = ("phase", "pair")
_FACE = ("phase", "pair", "slice")
_ROOT = ("phase", "body", "pair", "slice")

#: Over the positions of the pinion. `phase` itself is the dimension scale of the first axis.
SAMPLES: dict[str, Variable] = {
    "pinion_angle": Variable(("phase",), "rad", "rotation of the pinion from the first position"),
    "roll_angle": Variable(
        _PAIR, "rad", "rotation of the pinion since the pair met at the pitch point, negative before it"
    ),
    "loaded_transmission_error": Variable(
        ("phase",), "m", "loaded static transmission error r_p theta_p - r_g theta_g"
    ),
    "unloaded_transmission_error": Variable(
        ("phase",), "m", "unloaded (kinematic) transmission error r_p theta_p - r_g theta_g"
    ),
    "normal_load": Variable(_PAIR, "N", "normal load of the pair"),
    "line_load": Variable(_FACE, "N/m", "normal load per face width"),
    "hertz_pressure": Variable(_FACE, "Pa", "maximum Hertz pressure"),
    "half_width": Variable(_FACE, "m", "half width of the Hertz contact"),
    "face_load_factor": Variable(
        _PAIR, "1", "maximum line load over the mean along the face; NaN where the pair carries none"
    ),
    "root_tension": Variable(_ROOT, "Pa", "maximum surface stress along the fillet on the loaded side"),
    "root_compression": Variable(_ROOT, "Pa", "minimum surface stress along the fillet on the other side"),
    "mesh_stiffness": Variable(
        ("phase",), "N/m", "derivative of the load at the pitch radius by the loaded transmission error"
    ),
    "torque_residual": Variable(("phase",), "1", "torque of the loads over the gear's torque, less 1"),
}

#: What a study with a lubricant adds.
FILM: dict[str, Variable] = {
    "central_film_thickness": Variable(
        _FACE, "m", "film thickness by the film law; NaN where the slice carries none"
    ),
    "closure_in_range": Variable(_FACE, "1", "1 where the film law is inside its range, 0 outside"),
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
