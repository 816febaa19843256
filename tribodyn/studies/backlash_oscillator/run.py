"""From a case of the oscillator with backlash to its record: the frequency response, up and down."""

from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np

from tribodyn.cases.results import target, writer
from tribodyn.errors import SimulationError
from tribodyn.solve.branch.arclength import KINDS
from tribodyn.studies.backlash_oscillator.response import (
    CHAOTIC,
    DOWN,
    FAILED,
    QUASI_PERIODIC,
    STABLE,
    UP,
    MeasuredBranch,
    Response,
    frequency_response,
)
from tribodyn.studies.backlash_oscillator.scenario import LAYOUT, LAYOUT_WITH_UNSTABLE, BacklashOscillatorCase
from tribodyn.studies.protocol.branches import branch_values, end_values
from tribodyn.studies.protocol.study import CheckResult, Progress, RunResult, TextTable

#: Relative difference of the RMS above which the ways up and down count as different branches: hundreds of
#: times what the residuals leave.
APART = 1e-3
#: Names of the directions UP and DOWN.
WAYS = ("up", "down")
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
    summary = response_summary(response) | {"wall_time": perf_counter() - begun}
    scales = {"direction": np.array(WAYS), "multiplier": np.array([1, 2])}
    if response.ends:
        scales["end"] = np.arange(1, len(response.ends) + 1)
    unstable_rows = [row for beyond in response.beyond for row in rows_of(beyond)]
    if unstable_rows:
        scales["unstable"] = np.arange(1, len(unstable_rows) + 1)
    layout = LAYOUT_WITH_UNSTABLE if case.unstable else LAYOUT
    with writer(case, path, layout, len(response.frequency), scales=scales, force=force) as record:
        record.write(0, record_arrays(response))
        for row, (direction, end) in enumerate(response.ends):
            record.put(row, end_values(end, "end_frequency") | {"end_direction": direction})
        for beyond in response.beyond:
            record.put(beyond.end, finish_row(beyond))
        for row, values in enumerate(unstable_rows):
            record.put(row, values)
        if np.all(response.motion == FAILED):
            message = response.messages[0][2]
            return RunResult(record.fail(message, summary), "failed", message, summary)
        return RunResult(record.finish(summary), "complete", "", summary)


def quantities_of(case: BacklashOscillatorCase) -> dict[str, Any]:
    """Quantities of a case without a record."""
    response = frequency_response(case)
    if np.all(response.motion == FAILED):
        raise SimulationError(response.messages[0][2])
    return response_summary(response)


def record_arrays(response: Response) -> dict[str, Any]:
    """Datasets of the record, over the frequency first."""
    failed = response.motion == FAILED
    same = {name: values for name, values in response._asdict().items() if name in LAYOUT.samples}
    return same | {
        "frequency": response.frequency,
        "period": np.where(failed, np.nan, response.period),
        "stable": np.where(failed, np.nan, response.motion == STABLE),
        "multiplier_modulus": np.abs(response.multiplier),
        "multiplier_angle": np.angle(response.multiplier),
    }


def rows_of(beyond: MeasuredBranch) -> list[dict[str, Any]]:
    """Rows of the record, one for every motion of a branch."""
    branch, count = beyond.branch, len(beyond.branch.values)
    measures = {f"unstable_{name}": values for name, values in beyond.measures.items()}
    columns = branch_values(branch) | {
        "unstable_end": np.full(count, beyond.end + 1),
        "unstable_frequency": branch.values,
        "unstable_period": np.full(count, branch.period),
        "unstable_section_displacement": branch.states[:, 0],
        "unstable_section_velocity": branch.states[:, 1],
    }
    columns |= {name: values for name, values in measures.items() if name in LAYOUT_WITH_UNSTABLE.others}
    return [{name: values[i] for name, values in columns.items()} for i in range(count)]


def finish_row(beyond: MeasuredBranch) -> dict[str, Any]:
    """What the row of the end holds of the branch beyond it."""
    finish = beyond.branch.finish
    if finish is None:
        return {}
    kind = 1 + KINDS.index(finish.kind)
    return {"end_unstable_finish": kind, "end_unstable_finish_frequency": finish.value}


def described(beyond: MeasuredBranch) -> str:
    """A branch in words, for the summary."""
    branch, finish = beyond.branch, beyond.branch.finish
    goes = "no end in the range" if finish is None else f"{finish.kind} at {finish.value:.6g}"
    return (
        f"period {branch.period} between {np.min(branch.values):.6g} and {np.max(branch.values):.6g}, "
        f"multiplier at most {np.max(np.abs(branch.multipliers)):.4g}: {goes}"
    )


def response_summary(response: Response) -> dict[str, Any]:
    """Summary of the whole sweep."""
    frequency, rms, kind = response.frequency, response.rms_displacement, response.motion
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
        summary["contact_loss_fraction_max"] = _maximum(response.contact_loss_fraction)
        summary["back_contact_fraction_max"] = _maximum(response.back_contact_fraction)
    losing = np.any(np.nan_to_num(response.contact_loss_fraction) > 0.0, axis=1)
    for name, there in (("contact_loss", losing), ("bistable", branches_apart(response))):
        if np.any(there):
            places = frequency[there]
            summary |= {f"{name}_from": float(places[0]), f"{name}_to": float(places[-1])}
    for number, (direction, end) in enumerate(response.ends, 1):
        summary[f"end_{number}"] = f"{end.kind} of period {end.period} at {end.value:.6g}, {WAYS[direction]}"
    for beyond in response.beyond:
        summary[f"unstable_{beyond.end + 1}"] = described(beyond)
    messages = response.messages
    for number, (at, direction, text) in enumerate(messages[:REMARKS]):
        summary[f"remark_{number + 1}"] = f"frequency {at:g}, {WAYS[direction]}: {text}"
    if len(messages) > REMARKS:
        summary["remarks_more"] = len(messages) - REMARKS
    return summary


def branches_apart(response: Response) -> np.ndarray:
    """Where the sweeps up and down ended in different periodic motions (F,)."""
    up, down = response.rms_displacement[:, UP], response.rms_displacement[:, DOWN]
    with np.errstate(invalid="ignore"):
        apart = np.abs(up - down) > APART * np.maximum(up, down)
    return apart & np.all(response.motion == STABLE, axis=1)


def _maximum(values: np.ndarray) -> float | None:
    finite = values[np.isfinite(values)]
    return float(np.max(finite)) if finite.size else None


def check(case: BacklashOscillatorCase) -> CheckResult:
    """Print what linear theory predicts."""
    predicted = linear_theory(case)
    rows = [(name, "none" if value is None else f"{value:.6g}") for name, value in predicted.items()]
    table = TextTable("Linear theory, while contact lasts", ("quantity", "value"), rows)
    return CheckResult({"linear": predicted}, (table,))


def linear_theory(case: BacklashOscillatorCase) -> dict[str, float | None]:
    """Number of frequencies, and by linear theory at constant stiffness the quantities of the sweep.

    `resonance` is the frequency of the largest amplitude; `contact_loss_from` the lowest frequency at which
    the amplitude F_e Ω² / |1 − Ω² + 2iζΩ| reaches the mean force; `tongue_half_width` that of the instability
    at Ω = 2, √(ε²/4 − 4ζ²). None: there is none.
    """
    damping, force, error = case.damping, case.mean_force, case.error_amplitude
    resonance = 1.0 / np.sqrt(1.0 - 2.0 * damping**2) if damping < np.sqrt(0.5) else None
    # F_e² z² = F_m² ((1 − z)² + 4 ζ² z) in z = Ω²
    roots = np.roots([force**2 - error**2, force**2 * (4.0 * damping**2 - 2.0), force**2])
    real = [float(root.real) for root in roots if abs(root.imag) < 1e-12 and root.real > 0.0]
    tongue = case.stiffness_variation**2 / 4.0 - 4.0 * damping**2
    return {
        "frequencies": float(len(case.frequencies)),
        "resonance": None if resonance is None else float(resonance),
        "contact_loss_from": float(np.sqrt(min(real))) if real and error > 0.0 else None,
        "tongue_half_width": float(np.sqrt(tongue)) if tongue > 0.0 else None,
    }
