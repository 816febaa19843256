"""What an assessment is asked beyond the duty."""

from collections.abc import Iterator
from itertools import pairwise
from typing import Annotated, Literal

from pydantic import Field

from tribodyn.errors import InputError, quoted, unknown_name
from tribodyn.gears.rating.settings import AtLeastOne, RatingTable
from tribodyn.input.quantity import NotNegative, Positive, Text, written
from tribodyn.studies.assessment.unknowns import UnknownsTable, broken_unknowns
from tribodyn.tribology.friction import FRICTION_LAWS
from tribodyn.tribology.law import AUTO


class AssessedTable(RatingTable):
    """What is asked beyond the duty, and what the standards need to know."""

    standard: Literal["iso", "agma"] = "iso"
    ring_root: Literal["as-cut", "formula"] = "as-cut"
    torque_shares: tuple[Positive, ...] = Field((0.25, 0.5, 0.75, 1.0, 1.25), min_length=2, max_length=50)
    speed_range: tuple[Positive, Positive] = (0.2, 2.5)
    speeds: Annotated[int, Field(strict=True, ge=0)] = 46
    samples: Annotated[int, Field(strict=True, ge=0, le=1000)] = 16
    seed: Annotated[int, Field(strict=True, ge=0, le=10**9)] = 1
    unknowns: UnknownsTable = written({})
    friction_laws: tuple[Text, ...] = Field((), max_length=10)

    @property
    def root_by_formula(self) -> bool:
        """Whether roots of internal gears are those of the standard's formula."""
        return self.ring_root == "formula"

    def face_of(self, mesh: str) -> float | None:
        """K_Hβ of a mesh, where it is given."""
        return self.face_load_factor


class AssessmentTable(AssessedTable):
    """The same of a pair of gears, which has one friction law at least."""

    friction_laws: tuple[Text, ...] = Field(
        (AUTO, "masjedi-khonsari", "niemann", "schlenk", "xu", "benedict-kelley", "iso-14179-1"),
        min_length=1,
        max_length=10,
    )
    damping_ratio: NotNegative = 0.05


def of_mesh(name: str, mesh: str) -> bool:
    """Whether a name is that of a mesh, or of several: theirs go on after a hyphen."""
    return mesh == name or mesh.startswith(f"{name}-")


class TrainRatingTable(AssessedTable):
    """The same of a gearbox, whose meshes may have factors of their own."""

    face_load_factors: dict[Text, AtLeastOne] = Field({})

    def face_of(self, mesh: str) -> float | None:
        """K_Hβ of a mesh: by the longest name that it has or begins with, else that of all, where given."""
        matching = [name for name in self.face_load_factors if of_mesh(name, mesh)]
        return self.face_load_factors[max(matching, key=len)] if matching else self.face_load_factor


def broken_settings(settings: AssessedTable, damping_ratio: float | None, of: str) -> Iterator[InputError]:
    """Go through the rules that the settings break; the mesh has a damping ratio `of` a key, or not one."""
    for lower, higher in pairwise(settings.torque_shares):
        if not lower < higher:
            rule = f"must increase: {higher:g} follows {lower:g}"
            yield InputError(
                "assessment.torque_shares", f"{higher:g}", rule, "write them in increasing order"
            )
    if damping_ratio is not None:
        yield from broken_unknowns(settings.unknowns, damping_ratio, of)
    first, last = settings.speed_range
    if not first < last:
        rule = "the last speed must be above the first"
        yield InputError("assessment.speed_range", f"[{first:g}, {last:g}]", rule, "write [0.2, 2.5]")
    for name in settings.friction_laws:
        if name == AUTO:
            continue
        if name not in FRICTION_LAWS:
            yield unknown_name("assessment.friction_laws", name, FRICTION_LAWS, FRICTION_LAWS.what)
            continue
        needed = [key.name for key in FRICTION_LAWS[name].keys if key.default is None]
        if name == "none" or needed:
            rule = f"has keys of its own ({', '.join(needed)})" if needed else "has no losses"
            yield InputError("assessment.friction_laws", quoted(name), rule, "leave it out")


def without_data_sheet(table: str) -> InputError:
    """The oil of a table has no data sheet."""
    rule = "missing: temperatures and margins need the oil over temperature, by its data sheet"
    remedy = "give type, viscosity_40, viscosity_100 and density_15"
    return InputError(f"{table}.viscosity_40", rule=rule, remedy=remedy)
