"""Load and pressure of one pair of teeth along its path of contact."""

import numpy as np

from tribodyn.compliance.sharing.loaded_contact import LoadedContact
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.helix import pitch_slope
from tribodyn.numerics.shapes import Array, Float

#: Names of the arrays of `of_one_cycle`, and what an assessment calls them.
ALONG = {
    "pair_roll_angle": "roll_angle",
    "pair_normal_load": "normal_load",
    "pair_hertz_pressure": "hertz_pressure",
}


def highest_over_face(
    roll: Float[Array, " position"],
    pressure: Float[Array, "position slice"],
    behind: Float[Array, " slice"],
) -> Float[Array, " position"]:
    """Largest pressure, Pa, of all sections while they pass a place of the path of contact, 0 without load.

    `roll` (rad) increases; each section passes a place by `behind` (rad) later than the middle of the face.
    """
    sections = (np.interp(roll + lag, roll, at) for lag, at in zip(behind, pressure.T, strict=True))
    return np.max(np.nan_to_num(list(sections)), axis=0)


def of_one_cycle(assembly: Assembly, loaded: LoadedContact) -> dict[str, Float[Array, " position"]]:
    """Roll angle (rad, increasing), normal load (N) and `highest_over_face` of a pair, by names of `ALONG`.

    Of teeth that are all alike: the pairs of one mesh cycle are then one pair at successive times.
    """
    order = np.argsort(loaded.roll.T.ravel(), kind="stable")
    roll = loaded.roll.T.ravel()[order]
    load = loaded.normal_load.T.ravel()[order]
    over_face = np.swapaxes(loaded.pressure, 0, 1).reshape(len(roll), -1)[order]
    late = float(pitch_slope(assembly)) / float(assembly.path.pinion_pitch_radius)
    pressure = highest_over_face(roll, over_face, late * np.asarray(loaded.slice_position))
    return dict(zip(ALONG, (roll, load, pressure), strict=True))
