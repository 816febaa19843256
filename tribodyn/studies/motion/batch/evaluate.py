"""Evaluation of a few cases: prepared, brought to their steady state or marched, summed up.

A pure function of plain data, so that it runs in this process or in another one on another machine, and gives
the same numbers in both. Nothing of a case depends on the others that it is evaluated with.
"""

import dataclasses
from collections.abc import Callable, Sequence
from functools import lru_cache, partial
from typing import TYPE_CHECKING, Any

import numpy as np

from tribodyn.dynamics.modes import natural_frequencies
from tribodyn.dynamics.parameters import frictionless
from tribodyn.dynamics.recorded.outputs import evaluated_with_extremes
from tribodyn.errors import InputError, SimulationError
from tribodyn.gears.motion.extremes import RunningExtremes
from tribodyn.gears.motion.running import add_extremes, judge_run
from tribodyn.gears.motion.steady import warning_of
from tribodyn.gears.prepare import MOST_MOTIONS
from tribodyn.gears.tabulated import TABLES_KEPT, MadeOnce
from tribodyn.record.sweep_schema import DONE, FAILED, SweepLayout
from tribodyn.record.trust import TRUST, Judge, judge_tribology, number
from tribodyn.record.withheld_efficiency import remarked, remarks, warned
from tribodyn.solve.branch.gear_pairs import UnstableRange
from tribodyn.solve.initial import initial_state, static_equilibrium
from tribodyn.solve.right_hand_side import engage_next
from tribodyn.studies.motion.batch.gearboxes import (
    keys_of_tables,
    mesh_places,
    places_of,
    quantities_over,
    refuse_steady,
    states_of,
    warmer,
)
from tribodyn.studies.motion.batch.steady import (
    CaseWindow,
    Outcome,
    PreparedAt,
    legs_of,
    marched,
    prepared_between,
    steady,
)
from tribodyn.studies.motion.batch.swept import UNSTABLE_QUANTITIES, SweepSettings
from tribodyn.studies.motion.heat.settled import prepare_settled
from tribodyn.studies.motion.planetary.jamming import jams
from tribodyn.studies.motion.report import SWEPT
from tribodyn.studies.motion.summary import meshes_of_run
from tribodyn.studies.protocol.batch import Chunk, NeighbourWay
from tribodyn.studies.protocol.branches import MOTIONS, PREFIX, fill_branch, fill_ends
from tribodyn.train.links.chain import numbers_of
from tribodyn.train.structure import rotational_error, rotational_error_rate

if TYPE_CHECKING:
    from tribodyn.solve.branch.gear_pairs import ContinuedBranch


def window_quantities(
    prepared: Any, window: CaseWindow, samples: int
) -> tuple[dict[str, float], dict[str, np.ndarray], dict[str, Any]]:
    """Return the swept quantities over a window (SI), those of meshes, and what is said of their trust."""
    model, meshes = prepared.model, meshes_of_run(prepared)
    count, last = len(window.states), window.end.copy()
    engage_next(last, window.first_cycle + count // samples, model)
    cycles = window.first_cycle + np.arange(count + 1) / samples
    states = np.concatenate([window.states, last[None]])
    _, block, extreme = evaluated_with_extremes(cycles, states, window.extremes, model)
    extremes = [RunningExtremes(mesh.cycle) for mesh in meshes]
    add_extremes(extremes, meshes, block, extreme)
    inside, work = block.part(slice(count)), last - window.states[0]  # both behind their engagement
    quantities, of_meshes, judged = quantities_over(inside, work, prepared, samples, extremes)
    judge = Judge()
    judge_run(judge, meshes, model.layout, block, extreme)
    judge.take({"efficiency": quantities["efficiency"]})
    for each in judged:
        judge_tribology(judge, each)
    values = ((quantity.name, quantities.get(quantity.name)) for quantity in SWEPT)
    by_name = {name: float("nan") if value is None else value for name, value in values}
    return by_name, of_meshes, judge.summary()


def fill_unstable(
    rows: dict[str, np.ndarray],
    i: int,
    branches: "Sequence[ContinuedBranch]",
    prepared_at: Callable[[float], Any],
    settings: SweepSettings,
) -> None:
    """Put branches into the row of a case, with the quantities of their motions over one period each.

    `prepared_at` gives the prepared case at a value of the first parameter.
    """
    for end, branch, steadies in branches:
        if end >= rows["unstable_period"].shape[1]:
            break
        fill_branch(rows, i, end, branch)
        for m, (value, motion) in enumerate(zip(branch.values.tolist(), steadies, strict=True)):
            if not len(motion.samples):  # it cannot be integrated over its period once more
                continue
            window = CaseWindow(0, motion.samples, motion.end, motion.extremes)
            prepared = prepared_at(value)
            quantities, _, _ = window_quantities(prepared, window, settings.samples)
            for name in UNSTABLE_QUANTITIES:
                rows[PREFIX + name][i, end, m] = quantities[name]
            every = settings.samples * prepared.model.schedule.period
            row = rows["unstable_poincare_error"][i][..., end, m, :]
            _put(row, _of_meshes(rotational_error, motion.samples[::every], prepared), prepared, settings)


def _of_meshes(error: Callable[..., Any], states: np.ndarray, prepared: Any) -> np.ndarray:
    """An error of every mesh (mesh, point) over states."""
    model = prepared.model
    return np.stack([error(states, m, model) for m in range(len(model.meshes))])


def _put(row: np.ndarray, errors: np.ndarray, prepared: Any, settings: SweepSettings) -> None:
    """Put errors (mesh, point) of a case into a row; of a sweep of one mesh it has no axis of meshes."""
    if row.ndim == 1:
        row[: errors.shape[1]] = errors[0]
    else:
        row[mesh_places(prepared.case, settings), : errors.shape[1]] = errors


#: Speed of the pinion at which a static equilibrium is sought, rad/s: forces that go with speed vanish there.
CREEP = 1e-3


def evaluate(
    layout: SweepLayout, chunk: Chunk, settings: SweepSettings, workers: int | None = None
) -> dict[str, np.ndarray]:
    """Return a row for every case of a chunk, for all datasets of its layout; by default by all cores."""
    rows = _evaluate(layout, chunk, settings, workers)
    for _ in range(MOST_MOTIONS - 1):
        again = _at_own_temperature(chunk, rows, settings)
        if not again:
            break
        places = np.array(list(again))
        cases = tuple(again.get(i, case) for i, case in enumerate(chunk.cases))
        chunk = chunk._replace(cases=cases)
        states = None if chunk.states is None else chunk.states[places]
        warmer = Chunk(chunk.numbers[places], tuple(again.values()), states)
        part = _evaluate(layout, warmer, settings, workers)
        for name, values in part.items():
            rows[name][places] = values
    return rows


def _at_own_temperature(chunk: Chunk, rows: dict[str, np.ndarray], settings: SweepSettings) -> dict[int, Any]:
    """Cases, by their place, that are to be solved again at the bulk temperature of their own motion.

    Those that follow a branch stay at the temperature of the quasi-static loss, which their neighbours have.
    """
    again_at: dict[int, Any] = {}
    for i, case in enumerate(chunk.cases):
        followed = chunk.ways is not None and chunk.ways[i] is not None
        if isinstance(case, str) or followed or rows["status"][i] != DONE:
            continue
        again = warmer(case, {name: values[i] for name, values in rows.items()}, settings)
        if again is not None:
            again_at[i] = again
    return again_at


def _evaluate(
    layout: SweepLayout, chunk: Chunk, settings: SweepSettings, workers: int | None
) -> dict[str, np.ndarray]:
    """Evaluate every case once."""
    rows = layout.empty_rows(len(chunk.cases))
    ready: dict[int, tuple[Any, np.ndarray]] = {}
    for i, case in enumerate(chunk.cases):
        if isinstance(case, str):
            _fail(rows, i, case)
            continue
        try:
            if settings.steady:
                refuse_steady(case)
            prepared = prepare_settled(at_length(case, settings))
            places = places_of(prepared, settings)
            start_state = None if chunk.states is None else chunk.states[i][places]
            # a neighbour of another structure lacks states
            start = (
                _start(prepared, settings)
                if start_state is None or np.isnan(start_state).any()
                else start_state
            )
            ready[i] = prepared, start
            frequencies = natural_frequencies(
                prepared.model, [tabulated.cycle for tabulated in prepared.tables]
            )
            rows["mode_frequency"][i, : len(frequencies)] = frequencies
        except (InputError, SimulationError) as error:
            _fail(rows, i, str(error))
    for numbers in _alike({i: prepared.case for i, (prepared, _) in ready.items()}):
        ways = [chunk.ways[i] if chunk.ways else None for i in numbers]
        between = partial(prepared_between, prepare=prepare_settled)
        prepared_at = between([ready[i][0] for i in numbers], ways)
        outcomes = _solve([ready[i] for i in numbers], ways, prepared_at, settings, workers)
        for line, (i, outcome) in enumerate(zip(numbers, outcomes, strict=True)):
            _fill(rows, i, ready[i][0], outcome, settings)
            if outcome.continued:
                at = partial(prepared_at, line)
                fill_unstable(rows, i, outcome.continued, at, settings)
    return rows


def at_length(case: Any, settings: SweepSettings) -> Any:
    """The case as long as it is marched, over which the numbers of teeth that differ are tabulated."""
    if settings.steady:
        return case
    return dataclasses.replace(case, solver=dataclasses.replace(case.solver, cycles=settings.cycles))


def _alike(cases: dict[int, Any]) -> list[list[int]]:
    """Numbers of the cases, grouped by structure, common period and settings of the solver."""
    groups: dict[tuple[Any, ...], list[int]] = {}
    for i, case in cases.items():
        solver = case.solver.rtol, case.solver.method, case.solver.max_steps
        groups.setdefault((states_of(case), case.period, *solver), []).append(i)
    return list(groups.values())


def _solve(
    cases: list[tuple[Any, np.ndarray]],
    ways: Sequence[NeighbourWay | None],
    prepared_at: PreparedAt,
    settings: SweepSettings,
    workers: int | None,
) -> list[Outcome]:
    solver, period = cases[0][0].case.solver, cases[0][0].case.period
    window = settings.window_of(period)
    common: dict[str, Any] = {
        "cycles": settings.cycles,
        "points": settings.points,
        "common": period,
        "samples": settings.samples,
        "rtol": solver.rtol,
        "max_steps": solver.max_steps,
        "method": settings.method or solver.method,
        "workers": workers,
    }
    models, states = [prepared.model for prepared, _ in cases], np.array([state for _, state in cases])
    if settings.steady:
        if settings.followed:
            common["legs"] = legs_of(cases, ways, keys_of_tables)
            common["model_at"] = lambda line, value: prepared_at(line, value).model
        if settings.unstable:
            # all ways of a chunk are along the same values
            span = next((way.span for way in ways if way is not None), (0.0, 0.0))
            common["unstable"] = UnstableRange(span, MOTIONS)
        return steady(models, states, wandering=2 * window, **common)
    return marched(models, states, window=window, **common)


def _fill(
    rows: dict[str, np.ndarray],
    i: int,
    prepared: Any,
    outcome: Outcome,
    settings: SweepSettings,
) -> None:
    """Put the outcome of a case into its row."""
    for name in ("period", "stable", "multiplier_max", "residual", "cycles", "solution", "message"):
        rows[name][i] = getattr(outcome, name)
    if outcome.window is None:
        rows["status"][i] = FAILED
        return
    quantities, of_meshes, trust = window_quantities(prepared, outcome.window, settings.samples)
    for name in quantities.keys() & rows.keys():
        rows[name][i] = quantities[name]
    for name, value in of_meshes.items():
        rows[name][i, mesh_places(prepared.case, settings)] = value
    if settings.periods_differ:
        rows["common_period"][i] = prepared.case.period
    warning = warning_of(quantities["friction_work_on_vibration"], prepared.warm_pairs[0].friction.sliding)
    texts = [*jams(prepared), *remarks(trust | {"warning": warning})]
    texts += prepared.case.remarks_in_brief()
    rows["message"][i] = remarked(rows["message"][i], *map(warned, texts))
    rows[TRUST][i] = number(trust)
    error = _of_meshes(rotational_error, outcome.window.states, prepared)
    room, size = settings.window * settings.samples, error.shape[1]
    whole = min(room, size) if outcome.period == 0 else room // size * size
    for name, values in (
        ("transmission_error_rotational", error[:, np.arange(whole) % size]),
        ("poincare_error", _of_meshes(rotational_error, outcome.section, prepared)),
        ("poincare_rate", _of_meshes(rotational_error_rate, outcome.section, prepared)),
    ):
        _put(rows[name][i], values, prepared, settings)
    rows["state"][i, places_of(prepared, settings)] = outcome.state
    if settings.followed:
        fill_ends(rows, i, outcome.ends)
    rows["status"][i] = DONE


def _start(prepared: Any, settings: SweepSettings) -> np.ndarray:
    """Where a case begins: as its scenario says, or for a steady state at the equilibrium without friction.

    The latter is taken at `CREEP`, where it is the same at all speeds, and is therefore found once. At the
    case's own speed damping of a moving error of transmission would make it another one.
    """
    model, initial = prepared.model, prepared.case.solver.initial
    if not settings.steady or initial != "static":
        return initial_state(model, initial)
    creeping = model.operation._replace(nominal_speed=CREEP)
    # the model, which is kept with the result, keeps another table from taking this one's identity
    still = frictionless(model._replace(operation=creeping))
    # of a mesh where it is and how it is damped: laws of its contacts have no part in this
    places = (mesh._replace(table=(), surfaces=(), film=(), friction=(), teeth=()) for mesh in model.meshes)
    tooth_tables = (mesh.teeth for mesh in model.meshes)
    teeth = (number for each in tooth_tables for number in (*each.driver, *each.driven, *each[2:]))
    meshes = (*(number for mesh in places for number in mesh), *teeth)
    plain = model.links._replace(own=(), coupled=(), bearings=())
    links = (*plain, *numbers_of(model.links.own), *model.links.coupled, *model.links.bearings)
    operation = (*creeping._replace(clutches=()), *creeping.clutches)
    numbers = (*operation, *model.bodies, *links, *meshes, *model.schedule)
    tables = tuple(id(mesh.table) for mesh in model.meshes)
    key = (tables, model.options, *(np.asarray(value).tobytes() for value in numbers))
    return _equilibria(MadeOnce(key, lambda: static_equilibrium(still))).copy()


_equilibria = lru_cache(maxsize=TABLES_KEPT)(lambda wanted: wanted.make())


def _fail(rows: dict[str, np.ndarray], i: int, reason: str) -> None:
    rows["status"][i] = FAILED
    rows["message"][i] = reason
    rows["solution"][i] = "failed"
