"""From a case of the oscillator with backlash to its record: the frequency response, up and down."""

from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np

from tribodyn.errors import SimulationError
from tribodyn.solve.branch.family import KINDS, BranchEnd
from tribodyn.studies.backlash_oscillator.case import BacklashOscillatorCase
from tribodyn.studies.backlash_oscillator.layout import LAYOUT, LAYOUT_WITH_UNSTABLE
from tribodyn.studies.backlash_oscillator.response import (
    CHAOTIC,
    DOWN,
    FAILED,
    QUASI_PERIODIC,
    STABLE,
    UP,
    Response,
    frequency_response,
)
from tribodyn.studies.backlash_oscillator.unstable import described, finish_row, rows_of
from tribodyn.studies.protocol.recording import target, writer
from tribodyn.studies.protocol.study import Progress, RunResult

#: Relative difference of the RMS above which the ways up and down count as different branches: hundreds of
#: times what the residuals leave.
APART = 1e-3
#: Maximum number of single points that the summary remarks on.
REMARKS = 3


def run(
    case: BacklashOscillatorCase,
    output: str | Path | None = None,
    *,
    force: bool = False,
    progress: Progress | None = None,
) -> RunResult:
    """Run a case and write its record; see `study.Study.run`.

    It fails if no frequency at all has a bounded motion.
    """
    path = target(case, output, force)
    begun = perf_counter()
    response = frequency_response(case, progress)
    summary = response_figures(response) | {"wall_time": perf_counter() - begun}
    scales = {"direction": np.array(["up", "down"]), "multiplier": np.array([1, 2])}
    if response.ends:
        scales["end"] = np.arange(1, len(response.ends) + 1)
    unstable_rows = [row for one in response.beyond for row in rows_of(one)]
    if unstable_rows:
        scales["unstable"] = np.arange(1, len(unstable_rows) + 1)
    layout = LAYOUT_WITH_UNSTABLE if case.unstable else LAYOUT
    with writer(case, path, layout, len(response.frequency), scales=scales, force=force) as record:
        record.write(0, record_arrays(response))
        for row, (direction, end) in enumerate(response.ends):
            record.put(row, end_row(direction, end))
        for one in response.beyond:
            record.put(one.end, finish_row(one))
        for row, values in enumerate(unstable_rows):
            record.put(row, values)
        if np.all(response.kind == FAILED):
            message = response.messages[0][2]
            return RunResult(record.fail(message, summary), "failed", message, summary)
        return RunResult(record.finish(summary), "complete", "", summary)


def figures(case: BacklashOscillatorCase) -> dict[str, Any]:
    """Figures of a case without a record."""
    response = frequency_response(case)
    if np.all(response.kind == FAILED):
        raise SimulationError(response.messages[0][2])
    return response_figures(response)


def record_arrays(response: Response) -> dict[str, Any]:
    """Datasets of the record, over the frequency first."""
    kind = response.kind.astype(float)
    return {
        "frequency": response.frequency,
        "rms_displacement": response.rms,
        "peak_to_peak_displacement": response.peak_to_peak,
        "mean_displacement": response.mean,
        "contact_loss_fraction": response.free,
        "back_contact_fraction": response.back,
        "period": np.where(response.kind == FAILED, np.nan, response.period),
        "stable": np.where(response.kind == FAILED, np.nan, kind == STABLE),
        "multiplier_modulus": np.abs(response.multiplier),
        "multiplier_angle": np.angle(response.multiplier),
        "motion": response.kind,
        "residual": response.residual,
        "section_displacement": response.displacement,
        "section_velocity": response.velocity,
    }


def end_row(direction: int, end: BranchEnd) -> dict[str, Any]:
    """What the record holds of the end of a branch."""
    return {
        "end_kind": 1 + KINDS.index(end.kind),
        "end_frequency": end.value,
        "end_within": end.within,
        "end_direction": direction,
        "end_period": end.period,
        "end_multiplier_modulus": abs(end.multiplier),
        "end_multiplier_angle": np.angle(end.multiplier),
    }


def response_figures(response: Response) -> dict[str, Any]:
    """Figures of the whole sweep."""
    frequency, rms, kind = response.frequency, response.rms, response.kind
    summary: dict[str, Any] = {
        "points": int(kind.size),
        "points_not_periodic": int(np.sum((kind != STABLE) & (kind != FAILED))),
        "points_quasi_periodic": int(np.sum(kind == QUASI_PERIODIC)),
        "points_chaotic": int(np.sum(kind == CHAOTIC)),
        "points_failed": int(np.sum(kind == FAILED)),
        "points_of_longer_period": int(np.sum(response.period > 1)),
        "residual_max": _maximum(response.residual[kind == STABLE]),
    }
    if np.any(np.isfinite(rms)):
        place = np.unravel_index(np.nanargmax(rms), rms.shape)
        summary |= {"rms_max": float(rms[place]), "rms_max_frequency": float(frequency[place[0]])}
        summary["contact_loss_fraction_max"] = _maximum(response.free)
        summary["back_contact_fraction_max"] = _maximum(response.back)
    losing = np.flatnonzero(np.any(np.nan_to_num(response.free) > 0.0, axis=1))
    if losing.size:
        summary |= {
            "contact_loss_from": float(frequency[losing[0]]),
            "contact_loss_to": float(frequency[losing[-1]]),
        }
    bistable = np.flatnonzero(branches_apart(response))
    if bistable.size:
        summary |= {
            "bistable_from": float(frequency[bistable[0]]),
            "bistable_to": float(frequency[bistable[-1]]),
        }
    for number, (direction, end) in enumerate(response.ends, 1):
        way = "up" if direction == UP else "down"
        summary[f"end_{number}"] = f"{end.kind} of period {end.period} at {end.value:.6g}, {way}"
    for one in response.beyond:
        summary[f"unstable_{one.end + 1}"] = described(one)
    said = response.messages
    for number, (at, direction, text) in enumerate(said[:REMARKS]):
        summary[f"remark_{number + 1}"] = f"frequency {at:g}, {'up' if direction == UP else 'down'}: {text}"
    if len(said) > REMARKS:
        summary["remarks_more"] = len(said) - REMARKS
    return summary


def branches_apart(response: Response) -> np.ndarray:
    """Where the sweeps up and down ended in different periodic motions (F,)."""
    up, down = response.rms[:, UP], response.rms[:, DOWN]
    with np.errstate(invalid="ignore"):
        apart = np.abs(up - down) > APART * np.maximum(up, down)
    return apart & np.all(response.kind == STABLE, axis=1)


def _maximum(values: np.ndarray) -> float | None:
    finite = values[np.isfinite(values)]
    return float(np.max(finite)) if finite.size else None
