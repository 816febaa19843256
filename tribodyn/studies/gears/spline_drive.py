"""A gear pair of any family as a drive file of the family `spline`, from which a search can set out."""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.geometry.drive import SIDES, body_of
from tribodyn.geometry.families import family
from tribodyn.geometry.families.spline import FEWEST, MOST
from tribodyn.geometry.limits.checks import check
from tribodyn.geometry.spline_fit import fit_spline, flank_deviation
from tribodyn.scenario.tables.tooth_data import THICKNESS_KEYS
from tribodyn.studies.gears.drive_file import DriveModel

_OF_BODY = ("profile_shift", "addendum", "dedendum", "fillet_radius")
#: Keys whose place those of the body, and the path, take.
_OF_PATH = ("pressure_angle", "shape", "rack", "centre_distance")
_OF_TEETH = ("tip_radius", "tip_diameter", "tip_rounding", *THICKNESS_KEYS)


class SplineDrive(NamedTuple):
    """What a drive file of the fitted pair holds, and its maximum distance (m) from the original's flanks."""

    table: dict[str, Any]
    deviation: float


def as_spline(model: DriveModel, values: int, key: str = "n") -> SplineDrive:
    """Fit a free-form path to a pair's.

    Parameters
    ----------
    model : A pair that passes the checks; of any family
    values : number of angles
    key : what messages call it

    Raises
    ------
    InputError
        For too few or too many values, gears that cannot be made, and a fit of which none can be made.
    """
    if not FEWEST <= values <= MOST:
        raise InputError(key, values, f"a path has {FEWEST} to {MOST} values", "use 9")
    with model.origins.naming():
        assembly = check(family(model.family), model.drive)
    fitted = fit_spline(assembly, values)
    deviation = flank_deviation(assembly, fitted)
    drive, shape = fitted.drive, fitted.drive.shape
    table = {name: value for name, value in model.table.items() if name not in _OF_PATH}
    table |= {
        "title": f"{model.table['title']}, as a free-form path",
        "source": f"{values} values fitted to the path of contact; flanks within {1e6 * deviation:.2g} um. "
        f"Of the original: {model.table['source']}",
        "family": "spline",
        "module": f"{1e3 * drive.module:.12g} mm",
    }
    table["shape"] = {
        "angles": [f"{angle:.10g} deg" for angle in np.degrees(shape.angles)],
        "knots": [f"{knot:.10g} mm" for knot in 1e3 * shape.knots],
        "corner": f"{np.degrees(shape.corner):.10g} deg",
    }
    for side in SIDES:
        body = body_of(drive, side)
        kept = {name: value for name, value in table[side].items() if name not in _OF_TEETH}
        table[side] = kept | {name: float(f"{getattr(body, name):.12g}") for name in _OF_BODY}
        if body.thickness_allowance:
            table[side]["thickness_allowance"] = f"{1e6 * body.thickness_allowance:.10g} um"
    check(fitted.family, drive)
    return SplineDrive(table, deviation)
