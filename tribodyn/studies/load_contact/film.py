"""The film between the flanks over phase, pairs and face, by the film law in use."""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.compliance.sharing.loaded_contact import LoadedContact
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.flanks.corner_contact import pair_geometry
from tribodyn.geometry.pitch_point import pitch_point
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies.gears.case import LubricatedCase
from tribodyn.tribology.closure import closure_of, exceeded_limits, law_quantities
from tribodyn.tribology.surface_state import contact_friction, fraction_in_range, range_shares


class FaceFilm(NamedTuple):
    """Film over the face, and what a summary says of it."""

    #: datasets of the record (T, P, S): film by the film law, m, and whether that is inside its range; NaN
    #: where the slice carries nothing
    arrays: dict[str, Float[Array, "position pair slice"]]
    figures: dict[str, Any]  # of the summary, SI units


def film_over_face(assembly: Assembly, loaded: LoadedContact, case: LubricatedCase) -> FaceFilm:
    """Evaluate the film law at the load of every slice, the oil as it enters the mesh.

    Each slice is a line contact of its own line load, with the radii and speeds of its pair: no flow along
    the face. Beyond the path of contact the flanks have the curvature of the path's end.
    """
    closure = closure_of(case)
    motion = pair_geometry(assembly, loaded.roll).motion
    speed = case.operating.pinion_speed
    carries = loaded.line_load > 0.0
    position, pair, _ = np.nonzero(carries)
    vanishing = pitch_point(assembly.path)
    contact = contact_friction(
        closure,
        loaded.line_load[carries],
        1.0 / motion.relative_curvature[position, pair],
        speed * motion.pinion_speed[position, pair],
        speed * motion.gear_speed[position, pair],
        float(vanishing.length),
        speed * float(vanishing.speed_per_radius),
    )
    film, inside = contact.surface.central_film_thickness, contact.surface.closure_in_range
    thickness, in_range = (np.full(carries.shape, np.nan) for _ in range(2))
    thickness[carries], in_range[carries] = film, inside
    least = int(np.argmin(film))
    laws = {name: value for name, value in law_quantities(case).items() if name.startswith("film")}
    outside = exceeded_limits(case, *range_shares(contact.contact, closure))
    return FaceFilm(
        {"central_film_thickness": thickness, "closure_in_range": in_range},
        {
            "film_min": float(film[least]),
            "film_parameter_min": float(film[least] / closure.surfaces.roughness),
            "film_parameter_min_roll_angle": float(loaded.roll[position[least], pair[least]]),
            "closure_in_range_fraction": fraction_in_range(inside),
            **{name: value for name, value in outside.items() if name == "closure_exceeded"},
            **laws,
        },
    )
