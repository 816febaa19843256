"""Lines and sentences of the summary of a load contact study, and the figures that a sweep of it keeps."""

import numpy as np

from tribodyn.numerics.variable import Variable
from tribodyn.post.page.maps import PageMap
from tribodyn.post.report import Line, Lines, on_closures
from tribodyn.record.reader import Record
from tribodyn.studies.gears.shared import (
    CONTACT_RATIO,
    EFFECTIVE_CONTACT_RATIO,
    NORMAL_LOAD,
    SINGLE_PAIR,
    TRIBOLOGY,
    WALL_TIME,
)
from tribodyn.studies.load_contact.maps import FILM, LINE_LOAD, PRESSURE
from tribodyn.studies.load_contact.rolled import face_edges, face_map

LINES: Lines = {
    "Geometry": (CONTACT_RATIO, EFFECTIVE_CONTACT_RATIO, SINGLE_PAIR),
    "Load contact": (
        Line(
            "gear_torque",
            "Torque on the gear",
            1.0,
            "N m",
            definition="Torque at which everything but the Harris map is computed.",
        ),
        Line(
            "loaded_transmission_error_mean",
            "Loaded transmission error, mean",
            1e6,
            "µm",
            definition="Mean over the mesh cycle of r_p θ_p − r_g θ_g in slow rotation under load.",
        ),
        Line(
            "loaded_transmission_error_peak_to_peak",
            "Loaded transmission error, peak to peak",
            1e6,
            "µm",
            definition="Maximum less minimum of the same.",
        ),
        Line(
            "unloaded_transmission_error_peak_to_peak",
            "Unloaded, peak to peak",
            1e6,
            "µm",
            ".3g",
            definition="Maximum less minimum of r_p θ_p − r_g θ_g without load: that of modified or "
            "erroneous flanks.",
        ),
        Line(
            "least_peak_to_peak",
            "Minimum peak to peak of all torques",
            1e6,
            "µm",
            definition="Minimum over the torques of the Harris map.",
        ),
        Line(
            "least_peak_to_peak_torque",
            "at a torque on the gear of",
            1.0,
            "N m",
            definition="Torque of that minimum.",
        ),
        Line(
            "mesh_stiffness_mean",
            "Mesh stiffness, mean",
            1e-6,
            "N/µm",
            definition="Mean of the derivative of the load at the pitch radius by the loaded "
            "transmission error, all pairs together.",
        ),
        Line(
            "mesh_stiffness_peak_to_peak",
            "Mesh stiffness, peak to peak",
            1e-6,
            "N/µm",
            ".3g",
            definition="Maximum less minimum of the same.",
        ),
        Line(
            "line_load_max",
            "Maximum line load",
            1e-3,
            "N/mm",
            definition="Maximum normal load per face width, over pairs, face and mesh cycle.",
        ),
        Line(
            "face_load_factor",
            "Face load factor there",
            form=".3f",
            definition="Maximum over the mean line load along the face, where the line load is at its "
            "maximum. K_Hβ of ISO 6336-1 estimates the same ratio.",
        ),
        Line(
            "face_load_factor_pitch_point",
            "Face load factor at the pitch point",
            form=".3f",
            definition="The same where a pair is at the pitch point.",
        ),
        Line(
            "pinion_root_tension_max",
            "Maximum root tension, pinion",
            1e-6,
            "MPa",
            definition="Maximum surface stress in the pinion's fillet on the loaded side, over face and "
            "mesh cycle.",
        ),
        Line(
            "gear_root_tension_max",
            "Maximum root tension, gear",
            1e-6,
            "MPa",
            definition="Maximum surface stress in the gear's fillet on the loaded side, over face and "
            "mesh cycle.",
        ),
        Line(
            "pinion_root_compression_max",
            "Maximum root compression, pinion",
            1e-6,
            "MPa",
            definition="Minimum surface stress in the pinion's fillet on the other side; negative: "
            "compression.",
        ),
        Line(
            "gear_root_compression_max",
            "Maximum root compression, gear",
            1e-6,
            "MPa",
            definition="Minimum surface stress in the gear's fillet on the other side; negative: "
            "compression.",
        ),
    ),
    "Dynamics": (NORMAL_LOAD,),
    "Tribology": (
        Line(
            "hertz_pressure_max",
            "Maximum Hertz pressure",
            1e-9,
            "GPa",
            ".3g",
            definition="Maximum of the pressure in the middle of the Hertz contact, over pairs, face and "
            "mesh cycle.",
        ),
        *(line for line in TRIBOLOGY if line.name.startswith("film_")),
    ),
    "Solver": (WALL_TIME,),
}

SWEPT: dict[str, Variable] = {
    "loaded_transmission_error_peak_to_peak": Variable(
        (), "m", "loaded static transmission error, peak to peak"
    ),
    "loaded_transmission_error_mean": Variable((), "m", "mean loaded static transmission error"),
    "unloaded_transmission_error_peak_to_peak": Variable(
        (), "m", "unloaded transmission error, peak to peak"
    ),
    "mesh_stiffness_mean": Variable((), "N/m", "mean mesh stiffness"),
    "mesh_stiffness_peak_to_peak": Variable((), "N/m", "mesh stiffness, peak to peak"),
    "contact_ratio_effective": Variable((), "1", "contact ratio under load, corner contact included"),
    "normal_load_max": Variable((), "N", "maximum normal load of a pair"),
    "shared_load_max": Variable((), "N", "maximum normal load of a pair while two or more are on their path"),
    "line_load_max": Variable((), "N/m", "maximum line load"),
    "face_load_factor": Variable((), "1", "face load factor where the line load is at its maximum"),
    "face_load_factor_pitch_point": Variable((), "1", "face load factor at the pitch point"),
    "hertz_pressure_max": Variable((), "Pa", "maximum Hertz pressure"),
    "film_min": Variable((), "m", "minimum film thickness over pairs and face; with a lubricant"),
    "film_parameter_min": Variable((), "1", "minimum film parameter over pairs and face; with a lubricant"),
    "pinion_root_tension_max": Variable((), "Pa", "maximum root tension of the pinion"),
    "gear_root_tension_max": Variable((), "Pa", "maximum root tension of the gear"),
    "torque_residual": Variable((), "1", "torque of the loads over the gear's torque, less 1, at most"),
}

SHORT = {"peak_to_peak": "loaded_transmission_error_peak_to_peak"}

PANELS = ("loaded_transmission_error", "normal_load", "mesh_stiffness")


def maps(record: Record) -> list[PageMap]:
    """Line load, Hertz pressure and, with a lubricant, film of one pair over its roll angle and the face."""
    if record.samples < 2:
        return []
    edges = face_edges(record)[[0, -1]]
    found = []
    for quantity in (LINE_LOAD, PRESSURE, FILM):
        name = quantity.dataset
        if name not in record:
            continue
        over = face_map(record, name)
        # to the edges of the face with the values of the outermost slices
        face = np.concatenate([edges[:1], over.face, edges[1:]])
        values = np.concatenate([over.values[:, :1], over.values, over.values[:, -1:]], axis=1)
        found.append(PageMap(name, over.roll, face, values, quantity.top))
    return found


def sentences(record: Record) -> list[str]:
    """Say what the model leaves out, and how well the loads carry the torque."""
    summary, said = record.summary, []
    slices = summary.get("slices")
    if slices is not None:
        what = "in one piece, alike all along" if slices == 1 else f"in {slices} slices"
        said.append(f"Slow rotation, no inertia; the face is taken {what}.")
    residual = summary.get("torque_residual")
    if residual is not None:
        said.append(f"The loads carry the torque to within {abs(residual):.1e} of it.")
    if "film_min" in summary:
        said.append("The film is that of each slice alone, the oil as warm as it enters.")
        said += on_closures(summary)
    return said
