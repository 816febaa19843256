"""A case of load contact made ready: teeth, elasticity, flanks as modified; one pair along its path."""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.compliance.sharing.load_sharing import LoadedFlanks, flexibility
from tribodyn.compliance.sharing.loaded_contact import LoadedContact
from tribodyn.compliance.sharing.slices import PairFlexibility
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import Drive, MaterialData
from tribodyn.geometry.families import family
from tribodyn.geometry.helix import pitch_slope
from tribodyn.numerics.remembered import remembered
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies.load_contact.scenario import LoadContactCase


class PreparedTeeth(NamedTuple):
    """A case made ready: its teeth put together, and their elasticity."""

    case: LoadContactCase
    flexible: PairFlexibility


def prepare(case: LoadContactCase) -> PreparedTeeth:
    """Check geometry and modifications, and find the elasticity of both gears.

    Raises InputError where the teeth cannot be made, or cannot run together as they are modified.
    """
    from tribodyn.compliance.sharing.flank_gap import check_modifications

    flexible = _flexible(case.family, case.drive, case.materials, case.mesh.held)
    check_modifications(flexible.assembly, case.mesh.modifications)
    return PreparedTeeth(case, flexible)


@remembered(2)
def _flexible(
    name: str, drive: Drive, materials: tuple[MaterialData, MaterialData], held: bool
) -> PairFlexibility:
    """The pair as it is without modifications: cases that differ in those, or in their load, share it."""
    from tribodyn.geometry.limits.checks import check

    return flexibility(check(family(name), drive), materials, lead=True, held=held)


def contact_of(study: PreparedTeeth, gear_torque: float) -> tuple[Any, ...]:
    """Arguments of `roll_through` and `loaded_error`."""
    case = study.case
    positions, cycles = case.positions_per_cycle, case.cycles
    return flanks_of(study), gear_torque, positions, cycles, case.friction_coefficient


def flanks_of(study: PreparedTeeth) -> LoadedFlanks:
    """Flanks of the study, as they are modified and cut into slices."""
    mesh = study.case.mesh
    return LoadedFlanks(study.flexible, mesh.modifications, mesh.slices, mesh.slice_coupling)


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
