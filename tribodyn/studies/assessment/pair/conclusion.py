"""What a pair of gears comes to by what the studies found of it, and by the standards beside them."""

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple

from tribodyn.cases.assessment_part import Meshing
from tribodyn.gears.prepare import assembled
from tribodyn.gears.rating.capacity import Capacity, capacity_of, life_bins
from tribodyn.gears.rating.margins import strength_of
from tribodyn.gears.rating.standard import Standard, iso_part, rated_duty, standard_of
from tribodyn.geometry.assembly import Assembly
from tribodyn.studies.assessment.pair import parts
from tribodyn.studies.assessment.pair.case import AssessmentCase
from tribodyn.studies.assessment.pair.margins import (
    largest_stresses,
    local_of,
    margins_and_limits,
    simulated_part,
)
from tribodyn.studies.assessment.pair.reasons import compared
from tribodyn.studies.assessment.scatter import Conclusion


class ByStandard(NamedTuple):
    """A rating by the standards."""

    iso: dict[str, Any]  # by their names; empty: other teeth than involutes, or without a tolerance class
    standard: Standard | None = None
    capacity: Capacity | None = None  # None: the materials' strength is not known


def by_standard(
    case: AssessmentCase,
    assembly: Assembly,
    face: float,
    faces: Sequence[float] = (),
    meshing: tuple[Meshing, Meshing] = (Meshing(), Meshing()),
) -> ByStandard:
    """The standards by name and as they are, with a K_Hβ, and those of the duties, where none is given."""
    if case.quality is None or not assembly.family.involute:
        return ByStandard({})
    standard = standard_of(case, assembly, rated_duty(case.settings, case.oil_temperature, face=face))
    own = () if case.settings.face_load_factor else faces
    bins = life_bins(case, assembly, standard.factors, case.spectrum, own)
    capacity = capacity_of(case, assembly, standard.factors, bins, case.settings, meshing)
    iso = iso_part(case, standard) | (capacity.by_name() if capacity else {})
    return ByStandard(iso, standard, capacity)


def concluded(
    case: AssessmentCase,
    along: Mapping[str, Any],
    quantities: Mapping[str, Any],
    motion: Mapping[str, Any] = MappingProxyType({}),
    *,
    accurate: Conclusion | None = None,
    rated: ByStandard | None = None,
) -> Conclusion:
    """Put together what the studies found of a case: arrays along the path, quantities, loads in motion.

    A sample has no loads in motion: its stresses in motion are those of `accurate` teeth, by how the largest
    in slow rotation, with its dynamic factor, are to theirs. `rated` is the rating where it is known.
    """
    assembly = assembled(case)
    local = local_of(case, assembly, along, quantities)
    if rated is None:
        rated = by_standard(case, assembly, quantities["face_load_factor"], parts.faces_of(case, quantities))
    iso, standard, capacity = rated
    factors = standard.factors if standard else None
    comparison = compared(case, assembly, (along, motion), capacity, factors, quantities)
    stresses = largest_stresses(case, local, quantities)
    strength = comparison.strength if accurate is None else accurate.strength_under(stresses)
    judged = margins_and_limits(
        case,
        standard,
        capacity,
        strength_of(case.lubricant, case.oil_temperature, case.settings.structure_factor, case.materials),
        strength.safeties() if strength else {},
        local,
        quantities,
    )
    simulated = simulated_part(case, assembly, local, quantities) | (strength.by_name() if strength else {})
    outcome = Conclusion(local, standard, capacity, iso, simulated, judged)
    return outcome._replace(
        stresses=stresses, strength=strength, parted=comparison.parted, rests=comparison.rests
    )
