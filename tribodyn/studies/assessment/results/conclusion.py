"""What a pair of gears comes to by what the studies found of it, and by the standards beside them."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import Any, NamedTuple

from tribodyn.cases.assessment_part import Meshing
from tribodyn.gears.prepare import assembled
from tribodyn.gears.rating.american import agma_part, not_by_agma
from tribodyn.gears.rating.capacity import Capacity, capacity_of, life_bins, required
from tribodyn.gears.rating.fracture import fracture_of, with_fracture
from tribodyn.gears.rating.spectrum import spectrum_part
from tribodyn.gears.rating.standard import Standard, iso_part, rated_duty, standard_of
from tribodyn.geometry.assembly import Assembly
from tribodyn.studies.assessment.case import RatedMesh, RatedPair
from tribodyn.studies.assessment.parts import faces_of
from tribodyn.studies.assessment.results.margins import (
    largest_stresses,
    local_of,
    margins_and_limits,
    simulated_part,
)
from tribodyn.studies.assessment.results.reasons import compared
from tribodyn.studies.assessment.results.scatter import Conclusion
from tribodyn.studies.assessment.unknowns import Draw


class ByStandard(NamedTuple):
    """A rating by the standards."""

    iso: dict[str, Any]  # by their names; empty: other teeth than involutes, or without a tolerance class
    standard: Standard | None = None
    capacity: Capacity | None = None  # None: the materials' strength is not known

    def summary(self, case: RatedPair) -> dict[str, Any]:
        """What a summary and a check have of it: by ISO, by AGMA where it is asked for, duty by duty."""
        found: dict[str, Any] = {"iso": self.iso} if self.iso else {}
        asked_for = case.settings.standard == "agma" and not not_by_agma(case)
        if asked_for and self.standard and self.capacity:
            found["agma"] = agma_part(case, assembled(case), self.standard.factors, self.capacity)
        return found | spectrum_part(self.capacity, required(case.settings))


def by_standard(
    case: RatedPair,
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
    iso = iso_part(case, standard)
    if capacity is not None and (fracture := fracture_of(case, assembly, standard)) is not None:
        capacity, iso["A_FF"] = with_fracture(capacity, fracture), fracture.by_point
    iso |= capacity.by_name() if capacity else {}
    return ByStandard(iso, standard, capacity)


class Rating(NamedTuple):
    """A mesh by the standards."""

    rated: RatedPair
    pressed: RatedPair
    by: ByStandard

    def seen(self) -> ByStandard:
        """As the gears are pressed."""
        if self.pressed is self.rated or self.by.capacity is None:
            return self.by
        capacity = self.by.capacity
        return self.by._replace(capacity=capacity._replace(gears=capacity.gears[::-1]))


def rating_of(
    mesh: RatedMesh, share: float, quantities: Mapping[str, Any], draw: Draw | None = None
) -> Rating:
    """The rating with K_γ of a planetary stage and K_Hβ of the contact, of a sample where one is given."""
    rated, pressed = mesh.rated, mesh.pressed
    if mesh.mesh.stage:
        settings = rated.settings.model_copy(update={"mesh_load_factor": share})
        rated, pressed = (replace(one, settings=settings) for one in (rated, pressed))
    if draw is not None:
        rated, pressed = (draw.of(one, mesh.mesh.distance) for one in (rated, pressed))
    pressed = pressed if mesh.turned else rated
    face, faces = float(quantities["face_load_factor"]), faces_of(pressed, quantities)
    return Rating(rated, pressed, by_standard(rated, assembled(rated), face, faces, mesh.mesh.meshing))


def concluded(
    rating: Rating,
    along: Mapping[str, Any],
    quantities: Mapping[str, Any],
    motion: Mapping[str, Any] = MappingProxyType({}),
    *,
    accurate: Conclusion | None = None,
) -> Conclusion:
    """Put together what the studies found of a mesh: arrays along the path, quantities, loads in motion.

    A sample has no loads in motion: its stresses in motion are those of `accurate` teeth, by how the largest
    in slow rotation, with its dynamic factor, are to theirs.
    """
    case, (iso, standard, capacity) = rating.pressed, rating.seen()
    assembly = assembled(case)
    local = local_of(case, assembly, along, quantities)
    factors = standard.factors if standard else None
    comparison = compared(case, assembly, (along, motion), capacity, factors, quantities)
    stresses = largest_stresses(case, local, quantities)
    strength = comparison.strength if accurate is None else accurate.strength_under(stresses)
    judged = margins_and_limits(
        case,
        standard,
        capacity,
        strength.safeties() if strength else {},
        local,
        quantities,
    )
    simulated = simulated_part(case, assembly, local, quantities) | (strength.by_name() if strength else {})
    outcome = Conclusion(local, standard, capacity, iso, simulated, judged)
    return outcome._replace(
        stresses=stresses, strength=strength, parted=comparison.parted, rests=comparison.rests
    )
