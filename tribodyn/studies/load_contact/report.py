"""Reported quantities of a load contact study, and how far to trust them."""

from tribodyn.post.page.data import PageMap
from tribodyn.post.report import on_closures
from tribodyn.quantities.catalogue import quantities
from tribodyn.quantities.quantity import Reported
from tribodyn.record.reader import Record

REPORTED: Reported = {
    "Geometry": quantities(
        *("contact_ratio", "overlap_ratio", "total_contact_ratio", "contact_ratio_effective"),
        "stiffness_single_pair_at_pitch_point",
    ),
    "Load contact": quantities(
        "gear_torque",
        *("loaded_transmission_error_mean", "loaded_transmission_error_peak_to_peak"),
        "unloaded_transmission_error_peak_to_peak",
        *("least_peak_to_peak", "least_peak_to_peak_torque"),
        *("mesh_stiffness_mean", "mesh_stiffness_peak_to_peak"),
        *("line_load_max", "face_load_factor", "face_load_factor_pitch_point"),
        *("shaft_misalignment", "given_misalignment"),
        *("pinion_root_tension_max", "gear_root_tension_max"),
        *("pinion_root_compression_max", "gear_root_compression_max"),
    ),
    "Dynamics": quantities("normal_load_max"),
    "Tribology": quantities(
        "hertz_pressure_max", "film_min", "film_parameter_min", "film_parameter_min_roll_angle"
    ),
    "Solver": quantities("wall_time"),
}

SWEPT = quantities(
    *("loaded_transmission_error_peak_to_peak", "loaded_transmission_error_mean"),
    "unloaded_transmission_error_peak_to_peak",
    *("mesh_stiffness_mean", "mesh_stiffness_peak_to_peak", "contact_ratio_effective"),
    *("normal_load_max", "shared_load_max", "line_load_max"),
    *("face_load_factor", "face_load_factor_pitch_point"),
    *("hertz_pressure_max", "film_min", "film_parameter_min"),
    *("pinion_root_tension_max", "gear_root_tension_max", "torque_residual"),
)

SHORT = {"peak_to_peak": "loaded_transmission_error_peak_to_peak"}

PANELS = ("loaded_transmission_error", "normal_load", "mesh_stiffness")


def maps(record: Record) -> list[PageMap]:
    """Line load, Hertz pressure and, with a lubricant, film of one pair over its roll angle and the face."""
    from tribodyn.studies.load_contact.maps import FILM, LINE_LOAD, PRESSURE, face_map  # imports Matplotlib

    if record.samples < 2:
        return []
    page_maps = []
    for quantity in (LINE_LOAD, PRESSURE, FILM):
        if quantity.dataset in record:
            over = face_map(record, quantity.dataset)
            page_maps.append(PageMap(quantity.dataset, over.roll, *over.to_edges(record), quantity.top))
    return page_maps


def sentences(record: Record) -> list[str]:
    """Say what the model leaves out, and how well the loads carry the torque."""
    summary, texts = record.summary, []
    if (slices := summary.get("slices")) is not None:
        what = "in one piece, alike all along" if slices == 1 else f"in {slices} slices"
        texts.append(f"Slow rotation, no inertia; the face is taken {what}.")
    if record.mesh_cycle.get("pitch_slope", 0.0) != 0.0:
        texts.append(
            "The lines of contact are inclined: line load, pressure and film are per length along them, and "
            "the map shows each place of the face at its own time."
        )
    if (residual := summary.get("torque_residual")) is not None:
        texts.append(f"The loads carry the torque to within {abs(residual):.1e} of it.")
    if "film_min" in summary:
        texts.append("The film is that of each slice alone, the oil as warm as it enters.")
        texts += on_closures(summary)
    return texts
