"""The film over the faces of teeth in slow rotation, by the film law."""

from typing import Any

import numpy as np

from tribodyn.compliance.sharing.loaded_contact import LoadedContact, slice_contacts
from tribodyn.geometry.helix import pitch_slope, speed_share
from tribodyn.geometry.pitch_point import pitch_point
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies.load_contact.prepare import PreparedTeeth, flanks_of
from tribodyn.tribology.closure import closure_of, exceeded_limits, law_quantities
from tribodyn.tribology.surface_state import contact_friction, fraction_in_range, range_shares


def film_over_face(
    study: PreparedTeeth, loaded: LoadedContact
) -> tuple[dict[str, Float[Array, "position pair slice"]], dict[str, Any]]:
    """Datasets and summary of the film law at the load of every slice, the oil as it enters the mesh.

    Film by the law in use, m, and whether that is inside its range; NaN where a slice carries nothing. Empty
    without a lubricant.

    Each slice is a line contact of its own line load, with radii and speeds across its line of contact: no
    flow along it. Beyond the path of contact the flanks have the curvature of the path's end.
    """
    assembly, case = study.flexible.assembly, study.case.lubricated
    if case is None:
        return {}, {}
    closure = closure_of(case)
    seen = slice_contacts(flanks_of(study), loaded.roll)
    speed = case.operating.pinion_speed
    carries = loaded.line_load > 0.0
    position, pair, _ = np.nonzero(carries)
    vanishing = pitch_point(assembly.path)
    whole = np.ones(carries.shape)
    share = speed_share(pitch_slope(assembly), assembly.path, seen.geometry.motion.signed_distance)
    contact = contact_friction(
        closure,
        loaded.line_load[carries],
        1.0 / (seen.curvature * whole)[carries],
        speed * (seen.geometry.motion.pinion_speed * share * whole)[carries],
        speed * (seen.geometry.motion.gear_speed * share * whole)[carries],
        float(vanishing.length),
        speed * float(vanishing.speed_per_radius),
    )
    film, inside = contact.surface.central_film_thickness, contact.surface.closure_in_range
    thickness, in_range = (np.full(carries.shape, np.nan) for _ in range(2))
    thickness[carries], in_range[carries] = film, inside
    least = int(np.argmin(film))
    laws = {name: value for name, value in law_quantities(case).items() if name.startswith("film")}
    outside = exceeded_limits(case, *range_shares(contact.contact, closure))
    arrays = {"central_film_thickness": thickness, "closure_in_range": in_range}
    return arrays, {
        "film_min": float(film[least]),
        "film_parameter_min": float(film[least] / closure.surfaces.roughness),
        "film_parameter_min_roll_angle": float(loaded.roll[position[least], pair[least]]),
        "closure_in_range_fraction": fraction_in_range(inside),
        **{name: value for name, value in outside.items() if name in ("closure_exceeded", "film_outside")},
        **laws,
    }
