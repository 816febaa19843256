"""What is not known of a drive before it is built, and samples of it, drawn together.

Every sample has teeth of its own within the tolerance class, bearings, damping and centre distance of its
own. The numbers are a Latin hypercube (McKay, Beckman & Conover 1979): each range is cut into as many parts
of equal probability as there are samples, and every part is met once.
"""

import math
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Annotated, Any, NamedTuple, TypeVar

import numpy as np
from pydantic import Field

from tribodyn.errors import InputError
from tribodyn.gears.case import GearCase
from tribodyn.geometry.drive import SIDES
from tribodyn.geometry.families.involute import tight_centre_distance
from tribodyn.input import units
from tribodyn.input.quantity import InUnit, NotNegative, Switch, Table
from tribodyn.input.tables.supports.bearings import Bearing, bearing_of
from tribodyn.standards.allowances import centre_distance_allowance

#: Stiffness of one class of `models/bearings` over that below: from 1e8 by way of 4e8 to 2e9 N/m.
CLASS = math.sqrt(20.0)
#: Damping ratios of the mesh over the one that is given: 0.03 to 0.1 about 0.05. Measured are 0.03 to 0.17
#: (Kasuba & Evans 1981).
DAMPING = (0.6, 2.0)
#: Keys of a bearing's stiffness and what the first two may be replaced by.
_STIFFNESS = ("stiffness_x", "stiffness_y", "stiffness_axial", "stiffness_tilt")
_ROLLING = "rolling"


AnyCase = TypeVar("AnyCase", bound=GearCase)


class UnknownsTable(Table):
    """What is not known, and how far it may be from what the scenario says; what is known has no range."""

    deviations: Switch = True
    bearings: Annotated[float, Field(strict=True, ge=1.0, le=100.0)] = round(CLASS, 1)
    damping_ratio: tuple[NotNegative, NotNegative] | None = None
    centre_distance: Annotated[float, InUnit(units.not_negative(units.LENGTH), "20 um")] | None = None


class Draw(NamedTuple):
    """One sample of what is not known."""

    deviation: int | None  # number of the sample of deviations; None: accurate teeth
    #: of the bearings of pinion and gear: stiffness over what the scenario says
    bearings: tuple[float, float]
    damping_ratio: float  # of the mesh
    centre_distance: float | None  # m; None: as it is

    def keys(self, bearings: Mapping[str, Any]) -> dict[str, Any]:
        """What takes the place of a scenario's keys, whose table of bearings is given."""
        overrides: dict[str, Any] = {"mesh.damping_ratio": self.damping_ratio}
        if self.deviation is not None:
            overrides["mesh.deviation_sample"] = self.deviation
        if self.centre_distance is not None:
            overrides["drive.centre_distance"] = f"{1e3 * self.centre_distance:.12f} mm"
        for side, factor in zip(SIDES, self.bearings, strict=True):
            if factor != 1.0:
                overrides[f"bearings.{side}"] = stiffened(bearings[side], factor)
        return overrides

    def of(self, case: AnyCase) -> AnyCase:
        """The case with its centre distance."""
        if self.centre_distance is None:
            return case
        return replace(case, drive=case.drive._replace(centre_distance=self.centre_distance))


def stiffened(bearing: Mapping[str, Any], factor: float) -> dict[str, Any]:
    """Table of a gear's bearings, stiffness times a factor; that of rolling bearings is written out."""
    held = bearing_of(Bearing.model_validate(dict(bearing)))
    kept = {key: value for key, value in bearing.items() if key not in (*_STIFFNESS, _ROLLING)}
    for key in _STIFFNESS:
        stiffness = getattr(held, key)
        if stiffness is not None:
            kept[key] = f"{factor * stiffness!r} {'N*m/rad' if key == 'stiffness_tilt' else 'N/m'}"
    return kept


def drawn(case: GearCase, table: UnknownsTable, damping_ratio: float, samples: int, seed: int) -> list[Draw]:
    """Samples of what is not known of a drive whose mesh has a damping ratio; the same for the same seed.

    Logarithms of stiffness and damping are even over their ranges, and so is the centre distance. Where the
    teeth would jam at the lower end of its tolerance it begins at the mesh without backlash.
    """
    if not samples:
        return []
    random = np.random.default_rng([seed, samples])
    pinion, gear, damping, distance = (
        (random.permutation(samples) + random.uniform(size=samples)) / samples for _ in range(4)
    )
    lowest, highest = table.damping_ratio or tuple(damping_ratio * share for share in DAMPING)
    apart, ranges = distances(case, table), stiffness_ranges(case, table)
    return [
        Draw(
            seed + number if table.deviations else None,
            (
                _logarithmic(pinion[number], 1.0 / ranges[0], ranges[0]),
                _logarithmic(gear[number], 1.0 / ranges[1], ranges[1]),
            ),
            _logarithmic(damping[number], lowest, highest),
            None if apart is None else apart[0] + float(distance[number]) * (apart[1] - apart[0]),
        )
        for number in range(samples)
    ]


def stiffness_ranges(case: GearCase, table: UnknownsTable) -> tuple[float, float]:
    """Factors up and down of both gears' bearings: 1 of drawn shafts and of matrices, which are known."""
    of_gears = case.supports.pinion, case.supports.gear
    pinion, gear = (table.bearings if support is None else 1.0 for support in of_gears)
    return pinion, gear


def _logarithmic(share: float, lowest: float, highest: float) -> float:
    """Value at a share of the way between two, even in the logarithm; even in itself from 0."""
    if lowest == highest:
        return lowest
    if lowest == 0.0:
        return float(share) * highest
    return float(lowest * (highest / lowest) ** share)


def distances(case: GearCase, table: UnknownsTable) -> tuple[float, float] | None:
    """Lowest and highest centre distance, m; None where it is known, or the teeth mesh at one only.

    A drive that gives none meshes without backlash, as if its back flanks were not there: it has no other.
    """
    if case.drive.centre_distance is None or table.centre_distance == 0.0:
        return None
    nominal = float(case.drive.centre_distance)
    grade = tomllib.loads(case.toml)["drive"].get("centre_distance_grade", 7)
    tolerance = table.centre_distance or centre_distance_allowance(grade, nominal)
    tight = float(tight_centre_distance(case.drive))
    return min(max(nominal - tolerance, tight), nominal), nominal + tolerance


def broken_unknowns(table: UnknownsTable, damping_ratio: float, key: str) -> Iterator[InputError]:
    """Go through what the table at a key says that contradicts itself or the scenario."""
    if table.damping_ratio is None:
        return
    lowest, highest = table.damping_ratio
    if not lowest <= damping_ratio <= highest:
        yield InputError(
            f"{key}.damping_ratio",
            f"[{lowest:g}, {highest:g}]",
            f"must hold assessment.damping_ratio = {damping_ratio:g} between the lowest and the highest",
            f"write [{0.6 * damping_ratio:g}, {2.0 * damping_ratio:g}], or leave it out",
        )


def described(case: GearCase, table: UnknownsTable, damping_ratio: float) -> str:
    """What is varied, and how far."""
    lowest, highest = table.damping_ratio or tuple(damping_ratio * share for share in DAMPING)
    parts = ["deviations within the tolerances"] if table.deviations else []
    if max(stiffness_ranges(case, table)) != 1.0:
        parts.append(f"bearings {1.0 / table.bearings:.2g} to {table.bearings:.2g} times as stiff")
    if lowest != highest:
        parts.append(f"damping of the mesh {lowest:.2g} to {highest:.2g}")
    if (apart := distances(case, table)) is not None:
        parts.append(f"centre distance {1e3 * apart[0]:.7g} to {1e3 * apart[1]:.7g} mm")
    return ", ".join(parts) or "nothing: all is known"
