"""What is not known of a drive before it is built, and samples of it, drawn together.

Every sample has teeth of its own within the tolerance class, bearings, damping and centre distance of its
own. The numbers are a Latin hypercube (McKay, Beckman & Conover 1979): each range is cut into as many parts
of equal probability as there are samples, and every part is met once.
"""

import math
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import Annotated, Any, NamedTuple, TypeVar

import numpy as np
from pydantic import Field

from tribodyn.cases.assessment_part import MeshAtDuty
from tribodyn.errors import InputError
from tribodyn.gears.case import GearCase
from tribodyn.gears.prepare import assembled
from tribodyn.geometry.families.involute import tight_centre_distance
from tribodyn.input import units
from tribodyn.input.quantity import InUnit, NotNegative, Switch, Table
from tribodyn.input.tables.bearings import Bearing, bearing_of
from tribodyn.standards.allowances import centre_distance_allowance

#: Stiffness of one class of `models/bearings` over that below: from 1e8 by way of 4e8 to 2e9 N/m.
CLASS = math.sqrt(20.0)
#: Damping ratios of the mesh over the one that is given: 0.03 to 0.1 about 0.05. Measured are 0.03 to 0.17
#: (Kasuba & Evans 1981).
DAMPING = (0.6, 2.0)
#: Keys of a bearing's stiffness and what the first two may be replaced by.
_STIFFNESS = ("stiffness_x", "stiffness_y", "stiffness_axial", "stiffness_tilt")
_ROLLING = "rolling"
#: Key of the centre distance of a pair.
OF_PAIR = "drive.centre_distance"
_GRADE = "centre_distance_grade"

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
    bearings: Mapping[str, float]  # by name of a table of bearings: stiffness over what the scenario says
    damping_ratio: float  # of the mesh
    distances: Mapping[str, float]  # centre distances by key, m; others are as they are
    pins: Mapping[str, Sequence[float]] = MappingProxyType({})  # errors of every planet's pin by key, m

    def keys(self, bearings: Mapping[str, Any]) -> dict[str, Any]:
        """What takes the place of a scenario's keys, whose table of bearings is given."""
        overrides: dict[str, Any] = {"mesh.damping_ratio": self.damping_ratio}
        if self.deviation is not None:
            overrides["mesh.deviation_sample"] = self.deviation
        overrides |= {key: f"{1e3 * distance:.12f} mm" for key, distance in self.distances.items()}
        overrides |= {key: [f"{error!r} m" for error in errors] for key, errors in self.pins.items()}
        for name, factor in self.bearings.items():
            if factor != 1.0:
                overrides[f"bearings.{name}"] = stiffened(bearings[name], factor)
        return overrides

    def of_mesh(self, key: str) -> "Draw":
        """The same for a pair of gears alone, whose centre distance has a key in the gearbox."""
        own = {OF_PAIR: self.distances[key]} if key in self.distances else {}
        return self._replace(bearings={}, distances=own, pins={})

    def of(self, case: AnyCase, key: str = OF_PAIR) -> AnyCase:
        """The case of a pair with the centre distance that has a key."""
        if key not in self.distances:
            return case
        return replace(case, drive=case.drive._replace(centre_distance=self.distances[key]))


class Ranges(NamedTuple):
    """What is not known of a gearbox, and how far; see `Draw`."""

    deviations: bool
    bearings: Mapping[str, float]  # factor up and down; 1: known
    damping_ratio: tuple[float, float]
    distances: Mapping[str, tuple[float, float]]
    pins: Mapping[str, Sequence[tuple[float, float]]] = MappingProxyType({})  # of every planet


def stiffened(bearing: Mapping[str, Any], factor: float) -> dict[str, Any]:
    """Table of a gear's bearings, stiffness times a factor; that of rolling bearings is written out."""
    held = bearing_of(Bearing.model_validate(dict(bearing)))
    kept = {key: value for key, value in bearing.items() if key not in (*_STIFFNESS, _ROLLING)}
    for key in _STIFFNESS:
        stiffness = getattr(held, key)
        if stiffness is not None:
            kept[key] = f"{factor * stiffness!r} {'N*m/rad' if key == 'stiffness_tilt' else 'N/m'}"
    return kept


def drawn(ranges: Ranges, samples: int, seed: int) -> list[Draw]:
    """Samples of what is not known; the same for the same seed.

    Logarithms of stiffness and damping are even over their ranges, and so are the centre distances.
    """
    if not samples:
        return []
    random = np.random.default_rng([seed, samples])
    ends = dict(ranges.distances) | {
        f"{key}.{planet}": each for key, pins in ranges.pins.items() for planet, each in enumerate(pins, 1)
    }
    names = [*ranges.bearings, "", *ends]
    shares = {name: (random.permutation(samples) + random.uniform(size=samples)) / samples for name in names}

    def even(key: str, number: int) -> float:
        low, high = ends[key]
        return low + float(shares[key][number]) * (high - low)

    return [
        Draw(
            seed + number if ranges.deviations else None,
            {
                name: _logarithmic(shares[name][number], 1.0 / factor, factor)
                for name, factor in ranges.bearings.items()
            },
            _logarithmic(shares[""][number], *ranges.damping_ratio),
            {key: even(key, number) for key in ranges.distances},
            {
                key: [even(f"{key}.{planet}", number) for planet, _ in enumerate(pins, 1)]
                for key, pins in ranges.pins.items()
            },
        )
        for number in range(samples)
    ]


def ranges_of(
    meshes: Sequence[MeshAtDuty],
    table: UnknownsTable,
    bearings: Mapping[str, float],
    damping_ratio: float,
    stages: Sequence[Mapping[str, Any]] = (),
) -> Ranges:
    """What is not known of a gearbox: its meshes, factors of its bearings, `stages` as a scenario has them.

    Of a planetary stage the centre distance is known, and the pins are out of their places by as much along
    the circle. Deviations are known where a gear has no tolerance class.
    """
    apart = {mesh.distance: distances(mesh.pair, table) for mesh in meshes if mesh.distance}
    return Ranges(
        table.deviations and all(mesh.pair.quality is not None for mesh in meshes),
        bearings,
        damping_range(table, damping_ratio),
        {key: ends for key, ends in apart.items() if ends is not None},
        dict(_pins(meshes, table, stages)),
    )


def _pins(
    meshes: Sequence[MeshAtDuty], table: UnknownsTable, stages: Sequence[Mapping[str, Any]]
) -> Iterator[tuple[str, list[tuple[float, float]]]]:
    """Key and lowest and highest error, m, of every pin of planetary stages."""
    carried = {mesh.stage: mesh.pair for mesh in meshes if mesh.stage}
    for place, stage in enumerate(stages):
        pair = carried.get(stage.get("name", ""))
        if "planet" not in stage or pair is None or table.centre_distance == 0.0:
            continue
        path = assembled(pair).path
        nominal = abs(float(path.pinion_pitch_radius + path.gear_pitch_radius))
        tolerance = table.centre_distance or centre_distance_allowance(stage.get(_GRADE, 7), nominal)
        given = stage.get("tangential_pin_errors") or ["0 m"] * stage["planets"]
        errors = [units.to_si(text, units.LENGTH) for text in given]
        yield (
            f"stage.{place}.tangential_pin_errors",
            [(error - tolerance, error + tolerance) for error in errors],
        )


def damping_range(table: UnknownsTable, damping_ratio: float) -> tuple[float, float]:
    """Lowest and highest damping ratio of a mesh that is said to have one."""
    lowest, highest = (damping_ratio * share for share in DAMPING)
    return table.damping_ratio or (lowest, highest)


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
    Where the teeth would jam at the lower end of the tolerance it begins at the mesh without backlash.
    """
    if case.drive.centre_distance is None or table.centre_distance == 0.0:
        return None
    nominal = float(case.drive.centre_distance)
    grade = tomllib.loads(case.toml).get("drive", {}).get(_GRADE, 7)
    tolerance = table.centre_distance or centre_distance_allowance(grade, nominal)
    tight = float(tight_centre_distance(case.drive))
    return min(max(nominal - tolerance, tight), nominal), nominal + tolerance


def broken_unknowns(
    table: UnknownsTable, damping_ratio: float, of: str, key: str = "assessment.unknowns"
) -> Iterator[InputError]:
    """Go through what the table at a key says that contradicts itself or the damping ratio `of` a key."""
    if table.damping_ratio is None:
        return
    lowest, highest = table.damping_ratio
    if not lowest <= damping_ratio <= highest:
        yield InputError(
            f"{key}.damping_ratio",
            f"[{lowest:g}, {highest:g}]",
            f"must hold {of} = {damping_ratio:g} between the lowest and the highest",
            f"write [{0.6 * damping_ratio:g}, {2.0 * damping_ratio:g}], or leave it out",
        )


def described(ranges: Ranges) -> str:
    """What is varied, and how far."""
    lowest, highest = ranges.damping_ratio
    parts = ["deviations within the tolerances"] if ranges.deviations else []
    if (factor := max(ranges.bearings.values(), default=1.0)) != 1.0:
        parts.append(f"bearings {1.0 / factor:.2g} to {factor:.2g} times as stiff")
    if lowest != highest:
        parts.append(f"damping of the mesh {lowest:.2g} to {highest:.2g}")
    for low, high in ranges.distances.values():
        parts.append(f"centre distance {1e3 * low:.7g} to {1e3 * high:.7g} mm")
    for pins in ranges.pins.values():
        parts.append(f"pins up to {0.5e6 * (pins[0][1] - pins[0][0]):.3g} µm along their circle")
    return ", ".join(parts) or "nothing: all is known"
