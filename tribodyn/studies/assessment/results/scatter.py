"""Scatter of an assessment: quantities of every sample of what is not known, and their ranges."""

import math
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from typing import Any, NamedTuple

import numpy as np

from tribodyn.cases.assessment_part import CONTACT_LOST
from tribodyn.errors import InputError, SimulationError
from tribodyn.gears.rating.capacity import Capacity
from tribodyn.gears.rating.limits import least, over_samples
from tribodyn.gears.rating.standard import Standard
from tribodyn.quantities.catalogue import SPREAD, scatter
from tribodyn.studies.assessment.results.margins import LocalValues
from tribodyn.studies.assessment.results.simulated_strength import SimulatedStrength
from tribodyn.studies.assessment.unknowns import Draw

#: Quantity of the simulation -> its name by the standards.
_NAMES = {"dynamic_factor": "K_v", "transverse_load_factor": "K_Halpha", "face_load_factor": "K_Hbeta"}
#: Speeds of something that a sample may not have: no range is given of them.
_PLACES = ("contact_loss_speed_from", "dynamic_factor_max_speed")


class Conclusion(NamedTuple):
    """What a case comes to by the other studies' quantities, and by the standards beside them."""

    local: LocalValues
    by_standard: Standard | None
    capacity: Capacity | None
    iso: dict[str, Any]  # see `standard.iso_part`
    simulated: dict[str, Any]  # see `margins.simulated_part`
    judged: dict[str, Any]  # see `margins.margins_and_limits`
    stresses: tuple[float, float] = (0.0, 0.0)  # of flanks and roots, see `margins.largest_stresses`
    strength: SimulatedStrength | None = None  # of the simulation against pitting and bending
    parted: Sequence[str] = ()  # why simulation and standard part
    rests: str = ""  # which of both the verdict rests on

    def strength_under(self, stresses: tuple[float, float]) -> SimulatedStrength | None:
        """The strength where the largest stresses are others."""
        if self.strength is None:
            return None
        flank, root = (other / stress for stress, other in zip(self.stresses, stresses, strict=True))
        return self.strength.times(flank, root)


#: (sample, arrays along the path, quantities) -> outcome
Evaluate = Callable[[Draw, Mapping[str, Any], Mapping[str, Any]], Conclusion]


class SampleValues(NamedTuple):
    """Values (n,) of n samples by name, NaN where one is not known; SI units, temperatures as said."""

    drawn: dict[str, np.ndarray]  # what was drawn
    quantities: dict[str, np.ndarray]  # by the names of the summary
    #: by the names of the standards, safeties included, worst of all places; temperatures in °C
    simulated: dict[str, np.ndarray]
    iso: dict[str, np.ndarray]
    limits: dict[str, np.ndarray]  # what is compared with the limits, by their names


def samples_of(
    draws: Sequence[Draw],
    rows: Mapping[str, np.ndarray],
    accurate: tuple[Mapping[str, Any], Mapping[str, Any]],
    evaluate: Evaluate,
) -> SampleValues:
    """Conclude every sample as the drive with accurate teeth is.

    `rows` are what the studies found of the samples (`Findings.spread`), `accurate` the arrays along the path
    and the quantities of accurate teeth, which stand in for what does not scatter.
    """
    along, quantities = accurate
    outcomes: list[Conclusion | None] = []
    for number, draw in enumerate(draws):
        path, sample = _of_one({name: values[number] for name, values in rows.items()})
        outcome = None
        if np.all(np.isfinite(list(path.values()))) and not _missing(sample) & set(quantities) - set(_PLACES):
            finite = {name: value for name, value in sample.items() if name not in _missing(sample)}
            with suppress(InputError, SimulationError):
                outcome = evaluate(draw, {**along, **path}, {**quantities, **finite})
        outcomes.append(outcome)
    finite = numbers_of(rows)
    contact = [math.nan if one is None else _contact_temperature(one) for one in outcomes]
    simulated = _by_name([None if one is None else one.simulated for one in outcomes])
    finite |= {"contact_temperature_max": np.array(contact)}
    if "lambda_GF" in simulated:
        finite["specific_film_min"] = simulated["lambda_GF"]
    margins = {
        by: _by_name([None if one is None else _margins(one, by) for one in outcomes])
        for by in ("simulated", "iso")
    }
    values = [
        None if one is None else {name: limit["value"] for name, limit in one.judged["limits"].items()}
        for one in outcomes
    ]
    named = {_NAMES.get(name, name): finite[name] for name in (*_NAMES, *_ERRORS) if name in finite}
    return SampleValues(
        drawn_values(draws),
        finite,
        simulated | margins["simulated"] | named,
        _by_name([None if one is None else one.iso for one in outcomes]) | margins["iso"],
        _by_name(values),
    )


_ERRORS = ("loaded_transmission_error_peak_to_peak", "transmission_error_peak_to_peak")


def numbers_of(rows: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Quantities of the samples that are known of some of them."""
    numbers = {name: values for name, values in rows.items() if np.ndim(values) == 1}
    known = {name for name, values in numbers.items() if name in _PLACES or np.any(np.isfinite(values))}
    return {name: values for name, values in numbers.items() if name in known}


def _of_one(values: Mapping[str, Any]) -> tuple[dict[str, np.ndarray], dict[str, float]]:
    """Arrays along the path, and numbers, of one sample."""
    path = {name: value for name, value in values.items() if np.ndim(value)}
    return path, {name: float(value) for name, value in values.items() if name not in path}


def _missing(values: Mapping[str, float]) -> set[str]:
    """What is not known of a sample: nothing is missed that accurate teeth have neither."""
    return {name for name, value in values.items() if not math.isfinite(value)}


def _contact_temperature(outcome: Conclusion) -> float:
    films = outcome.local.films
    return float(films.bulk_temperature + np.nanmax(films.flash_rise))


def _by_name(samples: Sequence[Mapping[str, Any] | None]) -> dict[str, np.ndarray]:
    """Numbers of every sample by name, of values by points the worst; none of what either gear has."""
    numbers = [{} if one is None else _numbers(one) for one in samples]
    names = dict.fromkeys(name for one in numbers for name in one)
    return {name: np.array([one.get(name, math.nan) for one in numbers]) for name in names}


def _margins(outcome: Conclusion, by: str) -> dict[str, Any]:
    """Safeties and temperatures of a sample, of what either gear has the smaller."""
    return {name: least(value) for name, value in outcome.judged["margins"].get(by, {}).items()}


def _numbers(values: Mapping[str, Any]) -> dict[str, float]:
    numbers = {
        name: value.get("worst") if isinstance(value, Mapping) else value for name, value in values.items()
    }
    return {
        name: float(value)
        for name, value in numbers.items()
        if isinstance(value, int | float) and not isinstance(value, bool)
    }


def drawn_values(draws: Sequence[Draw]) -> dict[str, np.ndarray]:
    """What was drawn of every sample, by name."""
    first = draws[0]
    variables = {
        f"bearing_stiffness_factor_{name}": np.array([draw.bearings[name] for draw in draws])
        for name in first.bearings
    }
    variables["damping_ratio"] = np.array([draw.damping_ratio for draw in draws])
    if first.deviation is not None:
        variables["deviation_sample"] = np.array([draw.deviation for draw in draws], dtype=float)
    for key in first.distances:
        name = key if len(first.distances) > 1 else "centre_distance"
        variables[name] = np.array([draw.distances[key] for draw in draws])
    for key, pins in first.pins.items():
        for planet in range(len(pins)):
            name = f"{key.rpartition('.')[0]}.{planet + 1}.pin_error"
            variables[name] = np.array([draw.pins[key][planet] for draw in draws])
    return variables


def counts(samples: SampleValues) -> dict[str, Any]:
    """How many samples there are with a motion, and how many of them lose contact, at any speed looked at."""
    lost = samples.quantities.get("contact_loss_fraction_max", np.zeros(0))
    moved = int(np.sum(np.isfinite(lost)))
    if not moved:
        return {}
    begins = samples.quantities["contact_loss_speed_from"]
    number = {"samples": moved, "contact_lost": int(np.sum(np.nan_to_num(lost) > CONTACT_LOST))}
    number["contact_lost_at_duty"] = int(
        np.sum(np.nan_to_num(samples.quantities["contact_loss_fraction"]) > CONTACT_LOST)
    )
    return number | ({"contact_loss_speed_from": float(np.nanmin(begins))} if number["contact_lost"] else {})


def put_in(summary: Mapping[str, Any], samples: SampleValues) -> dict[str, Any]:
    """A summary with the ranges of its quantities, the samples themselves, and counts beside the limits."""
    spread = {
        f"{name}_spread": [_scatter(values)[part] for part in SPREAD]
        for name, values in samples.quantities.items()
        if name not in _PLACES
    }
    safeties = {name: samples.simulated[name] for name in ("S_B", "S_lambda") if name in samples.simulated}
    safeties |= {name: samples.iso[name] for name in ("S_H", "S_F") if name in samples.iso}
    by_sample = samples.drawn | samples.quantities | safeties
    return {
        **summary,
        **spread,
        "limits": over_samples(summary["limits"], samples.limits),
        "sample_counts": counts(samples),
        "by_sample": {
            **{name: list(map(float, values)) for name, values in by_sample.items()},
            "limit_values": {name: list(map(float, values)) for name, values in samples.limits.items()},
        },
    }


def with_ranges(summary: Mapping[str, Any], samples: SampleValues) -> dict[str, Any]:
    """A summary of a mesh with the ranges of what is simulated and by the standards, and of its limits."""
    parts = (("simulated", samples.simulated), ("iso", samples.iso))
    ranges = {
        name: {**summary[name], "spread": _ranges(values)} for name, values in parts if summary.get(name)
    }
    return {**summary, **ranges, "limits": over_samples(summary["limits"], samples.limits)}


def _ranges(samples: Mapping[str, np.ndarray]) -> dict[str, dict[str, float]]:
    return {name: _scatter(values) for name, values in samples.items() if np.any(np.isfinite(values))}


def _scatter(values: np.ndarray) -> dict[str, float]:
    """Median, 5 and 95 % over the samples, and how many of them are known."""
    percentiles = {name: float(value) for name, value in scatter(values).items()}
    return percentiles | {"samples": int(np.sum(np.isfinite(values)))}
