"""From a case of the solved contact study to its record."""

from contextlib import suppress
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np

from tribodyn.cases.results import target, writer
from tribodyn.errors import InputError
from tribodyn.gears.check import check_gears
from tribodyn.mesh.record_arrays import as_arrays
from tribodyn.numerics.shapes import Array
from tribodyn.record.trust import Judge, heat_of, judge_tribology
from tribodyn.studies.ehl import along_path
from tribodyn.studies.ehl.scenario import BEGIN, END, PLACES, SAMPLES, EhlCase, layout_of, unsolved
from tribodyn.studies.ehl.squeezed import SteadyContact, squeezed, steady_of
from tribodyn.studies.protocol.study import CheckResult, Progress, RunResult
from tribodyn.tribology.ehl.of_case import friction_band
from tribodyn.tribology.film import FILM_LAWS
from tribodyn.tribology.friction import FRICTION_LAWS
from tribodyn.tribology.high_pressure import contact_viscosity

#: Slide-to-roll ratios of the traction curve.
TRACTION = np.array([0.001, 0.003, 0.01, 0.02, 0.05, 0.1, 0.2, 0.4, 0.8])
#: Positions over which the band of the friction coefficient is taken.
_BAND = 5
#: Share of the time that the steady contacts take, of a way that is solved with squeeze too.
_STEADY = 0.7


def run(
    case: EhlCase, output: str | Path | None = None, *, force: bool = False, progress: Progress | None = None
) -> RunResult:
    """Run a case and write its record; see `study.Study.run`."""
    path = target(case, output, force)
    begun = perf_counter()
    study = along_path.prepare(case)
    over = along_path.way(study)
    laws = by_laws(study, over)
    arrays = solve(study, over, progress or (lambda _share: None))
    summary = _summary(study, over, arrays, laws)
    scales: dict[str, Array] = {"place": np.linspace(BEGIN, END, PLACES), "slide_to_roll": TRACTION}
    for what, by_name in laws.items():
        scales[f"{what}_law"] = np.array(list(by_name))
        arrays[f"{what}_by_law"] = np.stack(list(by_name.values()), axis=1)
    groups = {"mesh_cycle": as_arrays(study.cycle)}
    layout = layout_of(case.transient, study.cycle.slices)
    with writer(case, path, layout, case.positions, groups=groups, scales=scales, force=force) as record:
        if summary["positions_solved"] == 0:
            failure = "the contact could be solved at no position of the pair"
            return RunResult(record.fail(failure, summary), "failed", failure, summary)
        record.write(0, {name: arrays[name] for name in ("phase", *layout.samples)})
        for row, value in enumerate(_traction(study, over)):
            record.put(row, {"traction": value})
        summary["wall_time"] = perf_counter() - begun
        return RunResult(record.finish(summary), "complete", "", summary)


def check(case: EhlCase) -> CheckResult:
    """Check a case, tabulate its mesh, and say what gears and oil it describes, how stiff the gears are."""
    return check_gears(along_path.prepare(case))


def quantities_of(case: EhlCase) -> dict[str, Any]:
    """Summary of a case without a record."""
    study = along_path.prepare(case)
    over = along_path.way(study)
    return _summary(study, over, solve(study, over, lambda _share: None), by_laws(study, over))


def solve(study: along_path.PreparedEhl, over: along_path.PairWay, progress: Progress) -> dict[str, Array]:
    """Datasets of all positions; NaN where the pair carries nothing or the contact was not solved."""
    case, seen = study.case, along_path.seen_by(study, over)
    (start, _), count = along_path.roll_limits(study), len(over.roll)
    arrays = unsolved(SAMPLES, count) | {
        "phase": (over.roll - start) / float(study.cycle.pitch_angle),
        "roll_angle": over.roll,
        "normal_load": over.normal_load,
        "line_load": over.line_load,
        "equivalent_radius": np.asarray(seen.radius),
        "entrainment_speed": np.asarray(seen.entrainment),
        "sliding_speed": over.sliding,
        "hertz_pressure": np.asarray(seen.surface.hertz_pressure),
    }
    steady: list[SteadyContact | None] = [None] * count
    for at in map(int, np.flatnonzero(along_path.loaded(over))):
        contact = along_path.solved_at(study, over, seen, at)
        if contact is not None:
            solution, problem = contact.solution, contact.solution.problem
            gap = solution.mean_gap
            central = float(np.interp(0.0, solution.place, gap))
            values = along_path.profiles(contact) | {
                "half_width": problem.half_width,
                "central_film_thickness": central,
                "minimum_film_thickness": float(np.min(gap)),
                "film_parameter": central / case.roughness,
                "friction_coefficient": abs(contact.friction) / problem.line_load,
                "asperity_load_ratio": solution.asperity_load_ratio,
                "temperature_rise_max": float(np.max(contact.temperature)),
                "moes_load": problem.moes_load,
                "moes_material": problem.moes_material,
                "residual": solution.imbalance,
            }
            for name, value in values.items():
                arrays[name][at] = value
            if case.transient:
                steady[at] = steady_of(contact)
        flat = along_path.solved_at(study, over, seen, at, smooth=True)
        if flat is not None:
            arrays["central_film_smooth"][at] = flat.solution.central_film_thickness
            arrays["minimum_film_smooth"][at] = flat.solution.minimum_film_thickness
        progress((at + 1) / count * (_STEADY if case.transient else 1.0))
    if case.transient:
        rest = lambda share: progress(_STEADY + (1.0 - _STEADY) * share)  # noqa: E731
        arrays |= squeezed(over, case, steady, rest)
    return arrays


def by_laws(study: along_path.PreparedEhl, over: along_path.PairWay) -> dict[str, dict[str, Array]]:
    """Film by every film law and friction by every friction law that needs no values of its own.

    The solved law is left out: it is tabulated from the contacts that are solved here.
    """
    seen = {name: along_path.seen_by(study, over, name) for name in FILM_LAWS if name != "solved"}
    films = {name: np.asarray(of_law.surface.central_film_thickness) for name, of_law in seen.items()}
    frictions = {}
    for name in FRICTION_LAWS:
        if name not in ("solved", "none"):
            with suppress(InputError):  # it wants a value of its own
                coefficient = along_path.seen_by(study, over, friction=name).surface.friction_coefficient
                frictions[name] = np.abs(np.asarray(coefficient)) + 0.0 * over.roll
    return {"film": films, "friction": frictions}


def _traction(study: along_path.PreparedEhl, over: along_path.PairWay) -> list[float]:
    """Friction coefficient over slide-to-roll ratio, where the load is highest; NaN: not solved."""
    seen, at = along_path.seen_by(study, over), int(np.argmax(over.line_load))
    curve = []
    for ratio in TRACTION:
        contact = along_path.solved_at(study, over, seen, at, slide_to_roll=ratio)
        curve.append(np.nan if contact is None else abs(contact.friction) / float(over.line_load[at]))
    return curve


def _summary(
    study: along_path.PreparedEhl,
    over: along_path.PairWay,
    arrays: dict[str, Array],
    laws: dict[str, dict[str, Array]],
) -> dict[str, Any]:
    solved = np.isfinite(arrays["central_film_thickness"])
    if not np.any(solved):
        return {"contact_ratio": float(study.cycle.contact_ratio), "positions_solved": 0}

    def of(name: str) -> Array:
        return arrays[name][solved]

    central = arrays["central_film_thickness"]
    mean = _mean_by_loss(arrays, arrays["friction_coefficient"], solved)
    return {
        **(squeeze_summary(arrays) if study.case.transient else {}),
        **_judged(study.case, arrays, solved),
        **_viscosity(study, over),
        "contact_ratio": float(study.cycle.contact_ratio),
        "positions_solved": int(np.count_nonzero(solved)),
        "positions": study.case.positions,
        "loads": "quasi-static" if study.case.loads is None else "given",
        "central_film_min": float(np.min(of("central_film_thickness"))),
        "minimum_film_min": float(np.min(of("minimum_film_thickness"))),
        "film_parameter_min": float(np.min(of("film_parameter"))),
        "friction_coefficient_mean": mean,
        "asperity_load_ratio_max": float(np.max(of("asperity_load_ratio"))),
        "temperature_rise_max": float(np.max(of("temperature_rise_max"))),
        "hertz_pressure_max": float(np.max(of("hertz_pressure"))),
        "residual_max": float(np.max(of("residual"))),
        "pressure_max": float(np.max(of("pressure"))),
        "normal_load_max": float(np.max(of("normal_load"))),
        "film_over_solved": {
            name: float(np.nanmedian(values / central)) for name, values in laws["film"].items()
        },
        "friction_over_solved": {
            name: _mean_by_loss(arrays, values, solved) / mean for name, values in laws["friction"].items()
        },
    }


def _viscosity(study: along_path.PreparedEhl, over: along_path.PairWay) -> dict[str, Any]:
    """Where the viscosity under pressure is from, and by what its band changes the friction coefficient."""
    places = along_path.loaded_places(study, over, _BAND)
    low, high = friction_band(along_path.contact_for(study.case), places)
    band = {"friction_band_low": low, "friction_band_high": high} if low < high else {}
    return {"viscosity_origin": contact_viscosity(study.case.lubricant).origin, **band}


def _judged(case: EhlCase, arrays: dict[str, Array], solved: Array) -> dict[str, Any]:
    """Whether the solved contacts lie within their model, see `record.trust`."""
    judge, solutions = Judge(), {name: values[solved] for name, values in arrays.items() if name in SAMPLES}
    judge.take(
        {name: solutions[name] for name in ("friction_coefficient", "hertz_pressure")}
        | heat_of(solutions["temperature_rise_max"], case.lubricant.temperature),
        {"phase": arrays["phase"][solved]},
    )
    measured, pressure, temperature = along_path.contact_for(case).viscosity_limits
    beyond = (solutions["hertz_pressure"] > pressure) | (min(measured, temperature) < 1.0)
    judge.take({"viscosity_unmeasured": np.mean(beyond)})
    film = np.min(solutions["minimum_film_thickness"]), np.min(solutions["film_parameter"])
    judge_tribology(judge, dict(zip(("film_min", "film_parameter_min"), film, strict=True)))
    return judge.summary()


def _mean_by_loss(arrays: dict[str, Array], values: Array, solved: Array) -> float:
    """Mean of a friction coefficient over the way, weighted by what it loses."""
    weight = arrays["normal_load"][solved] * np.abs(arrays["sliding_speed"][solved])
    return float(np.sum(weight * values[solved]) / np.sum(weight))


def squeeze_summary(arrays: dict[str, Array]) -> dict[str, Any]:
    """How far films and friction with squeeze depart from the steady ones."""
    solved = np.isfinite(arrays["transient_central_film_thickness"])
    quantities: dict[str, Any] = {
        "transient_positions_solved": int(np.count_nonzero(solved)),
        "transient_restarts": int(arrays["restarts"]),
    }
    if not np.any(solved):
        return quantities

    def of(name: str) -> Array:
        return arrays[name][solved]

    for name in ("central", "minimum"):
        departure = np.abs(of(f"transient_{name}_film_thickness") / of(f"{name}_film_thickness") - 1.0)
        quantities[f"{name}_film_departure_max"] = float(np.max(departure))
        quantities[f"{name}_film_departure_mean"] = float(np.mean(departure))
    friction, steady = (
        _mean_by_loss(arrays, arrays[name], solved)
        for name in ("transient_friction_coefficient", "friction_coefficient")
    )
    return quantities | {
        "transient_minimum_film_min": float(np.min(of("transient_minimum_film_thickness"))),
        "transient_friction_coefficient_mean": friction,
        "friction_departure_mean": friction / steady - 1.0,
    }
