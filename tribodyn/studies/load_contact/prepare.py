"""A case of the load contact study made ready: teeth put together, elasticity, flanks as modified."""

from typing import Any, NamedTuple

from tribodyn.compliance.sharing.load_sharing import LoadedFlanks, flexibility
from tribodyn.compliance.sharing.slices import PairFlexibility
from tribodyn.geometry.drive import Drive, MaterialData
from tribodyn.geometry.families import family
from tribodyn.numerics.remembered import remembered
from tribodyn.studies.load_contact.case import LoadContactCase


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
