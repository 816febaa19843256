"""Numbers of a drive from what was measured on it."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from html import escape
from typing import Any, Literal

import numpy as np

from tribodyn.cases.cost import refuse_large, say_beforehand
from tribodyn.errors import InputError, quoted
from tribodyn.identification.fit import WHITE, Fit, Search, evolution, fitted, sobol, whiteness
from tribodyn.identification.simulated import SignalComparison, measured_of, turn_of
from tribodyn.identification.unknowns import Unknown, case_at, shares_of, unknowns_of
from tribodyn.input import units
from tribodyn.input.units import to_si_at
from tribodyn.interface import shown
from tribodyn.interface.scenario import Source, in_toml, public, scenario
from tribodyn.post.progress import Report, progress_of
from tribodyn.studies import STUDIES
from tribodyn.studies.protocol.batch import RUN_IN

#: Level of the intervals, and starts that are tried beside the scenario's own: a power of two, per unknown.
LEVEL, STARTS = 0.95, 8
#: Share of a range within which an estimate counts as at its end, where no interval holds.
AT_END = 1e-3
#: Times that sensors of several units are weighed anew by what is left of each.
WEIGHINGS = 2


@dataclass(frozen=True)
class Identified:
    """Estimates of unknowns; `identify` makes one.

    Attributes
    ----------
    values : dict
        Unknown to its estimate, SI.
    intervals : dict
        Unknown to the ends of its 95 % interval, SI: of noise that is independent from sample to sample;
        NaN of an estimate at an end of its range.
    units : dict
        Unknown to its SI unit.
    correlation : ndarray
        Of the estimates, in the order of `values`.
    noise : dict
        Sensor to the deviation of what is left of its signal, SI.
    whiteness : dict
        Sensor to the probability of so much autocorrelation in noise (Ljung & Box); small: the model lacks
        something, and intervals are too narrow.
    residuals : dict
        Sensor to what was measured less what the fitted scenario gives, SI.
    evaluations : int
        Runs that it took.
    remarks : tuple of str
        What to mind.
    scenario : case
        The scenario with the estimates, which `run` takes.
    """

    values: dict[str, float]
    intervals: dict[str, tuple[float, float]]
    units: dict[str, str]
    correlation: np.ndarray
    noise: dict[str, float]
    whiteness: dict[str, float]
    residuals: dict[str, np.ndarray] = field(repr=False)
    evaluations: int
    remarks: tuple[str, ...]
    scenario: Any = field(repr=False)

    def __getitem__(self, key: str) -> float:
        return self.values[key]

    def __repr__(self) -> str:
        parts = [f"{key} = {self._shown(key)}" for key in self.values]
        remarks = "".join(f"; {remark}" for remark in self.remarks)
        return f"<tribodyn identified: {'; '.join(parts)} ({100 * LEVEL:g} % intervals){remarks}>"

    def _repr_html_(self) -> str:
        rows = []
        for key in self.intervals:
            rows.append((key, f"{self.values[key]:.6g}{self._unit(key)}", self._interval(key, 6)))
        remarks = "".join(f"<li>{escape(remark)}</li>" for remark in self.remarks)
        table = shown.table(("unknown", "estimate", f"{100 * LEVEL:g} % interval"), rows)
        return shown.block(table, f"<ul>{remarks}</ul>" if remarks else "")

    def _shown(self, key: str) -> str:
        return f"{self.values[key]:.5g}{self._unit(key)} ({self._interval(key, 5)})"

    def _interval(self, key: str, digits: int) -> str:
        low, high = self.intervals[key]
        if not low <= high:
            return "no interval"
        return f"{low:.{digits}g} to {high:.{digits}g}{self._unit(key)}"

    def _unit(self, key: str) -> str:
        return "" if self.units[key] == "1" else f" {self.units[key]}"


@public
def identify(
    source: Source,
    measured: Any,
    unknowns: Mapping[Any, Any],
    overrides: Mapping[str, Any] | None = None,
    *,
    start: Any = "0 s",
    run_in: float = RUN_IN,
    without_mean: bool = False,
    method: Literal["least-squares", "cma-es"] = "least-squares",
    seed: int = 0,
    workers: int | None = None,
    progress: Report | bool | None = None,
    allow_large: bool = False,
) -> Identified:
    """Find numbers of a drive from the signals of its sensors, through the simulation of its scenario.

    Parameters
    ----------
    source, overrides
        As `scenario` takes them: a gear pair or a train whose ``[[sensor]]`` tables say what was measured,
        where, and at which rate.
    measured : path or mapping
        A record with these sensors; or their names to arrays of samples in SI units, also an xarray.Dataset.
    unknowns : mapping
        Dotted key to its range, (lowest, highest), as a scenario would have them: ``{"mesh.damping_ratio":
        (0.01, 0.2), "drive.pinion.eccentricity": ("0 um", "30 um")}``. A tuple of keys has one value.
    start : str or quantity
        Of arrays: time of the first sample, from the start of the run on, at which the first tooth of the
        driver enters contact.
    run_in : float
        Turns of the driver of the first mesh that are left out: what the start of the run was is forgotten.
    without_mean : bool
        Whether the mean of every signal is left out, where its zero is arbitrary.
    method : {"least-squares", "cma-es"}
        The latter searches by CMA-ES first (``pip install "tribodyn[design]"``).
    seed : int
        Of the starts.
    workers : int, optional
        Threads; default: one per core.
    progress : callable or bool, optional
        As `run` takes it; the share is of the most evaluations.
    allow_large : bool
        Allow what is above the resource limits.

    Returns
    -------
    Identified
        Estimates, their 95 % intervals, and what is left.

    Raises
    ------
    InputError
        For an unknown that is none, no or too few data, a sensor that cannot hear the teeth, ranges in which
        the scenario cannot be run.

    Notes
    -----
    Least squares within the ranges; intervals by the covariance s² (JᵀJ)⁻¹ and Student's t. They hold for
    noise that is independent from sample to sample. See `docs/identify.md`.
    """
    case = scenario(source, overrides)
    if not hasattr(case, "sensors"):
        kinds = [quoted(kind) for kind in STUDIES if "sensor" in STUDIES[kind].table().model_fields]
        raise InputError("kind", quoted(case.kind), "has no sensors", f"use kind = {' or '.join(kinds)}")
    if method not in ("least-squares", "cma-es"):
        raise InputError("method", quoted(method), "no such method", '"least-squares" or "cma-es"')
    sought = unknowns_of(case, unknowns)
    first = to_si_at("start", in_toml(start), units.TIME)
    data = measured_of(measured, case, first, run_in * turn_of(case))
    count = sum(len(one.values) for one in data)
    if count <= len(sought) + len(data):
        rule = f"{count} samples for {len(sought)} unknowns"
        raise InputError("measured", count, rule, "measure longer, or seek less")
    compare = SignalComparison(case, sought, data, run_in, without_mean, workers)
    estimate = compare.estimate(_most(sought))
    refuse_large(estimate, allow_large)
    with progress_of(progress, case.name) as report:
        say_beforehand(estimate)
        fit = _fit(compare, sought, method, seed, report)
    return _identified(case, sought, compare, fit)


def _most(sought: Sequence[Unknown]) -> int:
    """Runs that an estimate usually takes at most."""
    return (16 + STARTS) * len(sought) + 40


def _fit(compare: SignalComparison, sought: Sequence[Unknown], method: str, seed: int, report: Report) -> Fit:
    most = _most(sought)
    done = 0

    def residuals(places: np.ndarray) -> list[np.ndarray]:
        nonlocal done
        done += len(places)
        report(min(1.0, done / most))
        return compare(places)

    initial = shares_of(sought)
    power = 2 ** int(np.ceil(np.log2(STARTS * len(sought))))
    starts = [initial, *sobol(len(sought), power, seed)]
    fit = fitted(residuals, starts, _evolution(seed) if method == "cma-es" else None)
    if compare.failure and np.all(np.abs(fit.residuals) >= 1.0) and fit.deviation >= 1.0:
        raise InputError(
            "unknowns", None, f"the scenario cannot be run there: {compare.failure}", "narrow them"
        )
    total = fit.evaluations
    for _ in range(WEIGHINGS if len(compare.scales) > 1 else 0):
        parts = compare.apart(fit.shares[None])[0]
        compare.scales = [max(float(np.std(part)), 1e-300) for part in parts]
        fit = fitted(residuals, [fit.shares])
        total += fit.evaluations
    return fit._replace(evaluations=total)


def _evolution(seed: int) -> Search:
    try:
        return evolution(seed)
    except ImportError:
        remedy = 'install it: pip install "tribodyn[design]"'
        raise InputError("method", '"cma-es"', "needs the package cma", remedy) from None


def _identified(case: Any, sought: Sequence[Unknown], compare: SignalComparison, fit: Fit) -> Identified:
    half = fit.half_width(LEVEL)
    deviations = np.sqrt(np.diag(fit.covariance))
    with np.errstate(invalid="ignore", divide="ignore"):
        correlation = fit.covariance / np.outer(deviations, deviations)
    parts = dict(zip(compare.names, compare.apart(fit.shares[None])[0], strict=True))
    white = {name: whiteness(part) for name, part in parts.items()}
    remarks = []
    values, intervals = {}, {}
    for unknown, share, width in zip(sought, fit.shares.tolist(), half.tolist(), strict=True):
        values[unknown.name] = unknown.value(share)
        intervals[unknown.name] = unknown.value(share - width), unknown.value(share + width)
        if not AT_END < share < 1.0 - AT_END:
            intervals[unknown.name] = math.nan, math.nan
            remarks.append(f"{unknown.name} is at the end of its range: no interval holds, widen it")
        if not np.isfinite(width):
            remarks.append(f"the data do not tell {unknown.name} from the other unknowns")
    for name, probability in white.items():
        if probability < WHITE:
            remarks.append(
                f"what is left of {name} is no noise (probability {probability:.1g}): the scenario lacks "
                "something, and the intervals are too narrow"
            )
    return Identified(
        values,
        intervals,
        {unknown.name: unknown.units for unknown in sought},
        correlation,
        {name: float(np.std(part)) for name, part in parts.items()},
        white,
        parts,
        fit.evaluations,
        tuple(dict.fromkeys(remarks)),
        case_at(case, sought, fit.shares),
    )
