"""Evaluation of a few cases: prepared, brought to their steady state or marched, summed up.

A pure function of plain data, so that it runs in this process or in another one on another machine, and gives
the same numbers in both. Nothing of a case depends on the others that it is evaluated with.
"""

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, field
from functools import lru_cache, partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from tribodyn.dynamics.modes import natural_frequencies
from tribodyn.dynamics.parameters import frictionless
from tribodyn.errors import InputError, SimulationError
from tribodyn.record.sweep_schema import DONE, FAILED
from tribodyn.record.trust import TRUST, Judge, judge_tribology, number
from tribodyn.record.withheld import remarked, remarks, warned
from tribodyn.solve.branch.gear_pairs import UnstableRange
from tribodyn.solve.initial import initial_state, static_equilibrium
from tribodyn.solve.right_hand_side import engage_next
from tribodyn.studies.gear_pair.batch.steady import (
    CaseWindow,
    Outcome,
    PreparedAt,
    legs_of,
    marched,
    prepared_between,
    steady,
)
from tribodyn.studies.gear_pair.case import Case
from tribodyn.studies.gear_pair.outputs import MESH
from tribodyn.studies.gear_pair.prepare import PreparedPair, prepare
from tribodyn.studies.gear_pair.report import SWEPT, UNSTABLE_QUANTITIES, layout_of, state_places
from tribodyn.studies.gear_pair.summary import mesh_of_run, steady_quantities
from tribodyn.studies.gears.check import remarks_in_brief
from tribodyn.studies.gears.extremes import RunningExtremes
from tribodyn.studies.gears.prepare import MOST_MOTIONS, at_own_temperature, thermal_quantities
from tribodyn.studies.gears.running import add_extremes, judge_run
from tribodyn.studies.gears.same_table import table_key
from tribodyn.studies.gears.sampled import sampled_with_extremes
from tribodyn.studies.gears.steady import warning_of
from tribodyn.studies.gears.tabulated import Tabulated, tables
from tribodyn.studies.sweeping.batch import Chunk, NeighbourWay
from tribodyn.studies.sweeping.branches import MOTIONS, PREFIX, fill_branch, fill_ends
from tribodyn.train.structure import rotational_error, rotational_error_rate

if TYPE_CHECKING:
    from tribodyn.solve.branch.gear_pairs import ContinuedBranch


def window_quantities(
    prepared: PreparedPair, window: CaseWindow, samples: int
) -> tuple[dict[str, float], dict[str, Any]]:
    """Return the quantities of `report.SWEPT` over a window, SI units, and what is said of their trust."""
    count, last = len(window.states), window.end.copy()
    engage_next(last, window.first_cycle + count // samples, prepared.model)
    cycles = window.first_cycle + np.arange(count + 1) / samples
    states = np.concatenate([window.states, last[None]])
    meshes, layout = [mesh_of_run(prepared)], prepared.model.layout
    block, extreme = sampled_with_extremes(cycles, states, window.extremes, prepared.model)
    extremes = RunningExtremes(prepared.cycle)
    add_extremes([extremes], meshes, block, extreme)
    speed, work = prepared.case.operating.pinion_speed, window.end - window.start
    inside = block.part(slice(count)).meshes[MESH]
    quantities = steady_quantities(inside, work, prepared, samples, speed, extremes)
    quantities |= extremes.values()
    quantities |= thermal_quantities(prepared.thermal, quantities["power_in_mean"], quantities["efficiency"])
    judge = Judge()
    judge_run(judge, meshes, layout, block, extreme)
    judge.take({"efficiency": quantities["efficiency"]})
    judge_tribology(judge, quantities)
    values = ((quantity.name, quantities.get(quantity.name)) for quantity in SWEPT)
    return {name: float("nan") if value is None else value for name, value in values}, judge.summary()


def fill_unstable(
    rows: dict[str, np.ndarray],
    i: int,
    branches: "Sequence[ContinuedBranch]",
    prepared_at: Callable[[float], PreparedPair],
    samples: int,
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
            window = CaseWindow(0, motion.samples, motion.state, motion.end, motion.extremes)
            quantities, _ = window_quantities(prepared_at(value), window, samples)
            for name in UNSTABLE_QUANTITIES:
                rows[PREFIX + name][i, end, m] = quantities[name]
            section = rotational_error(motion.samples[::samples], MESH, prepared_at(value).model)
            rows["unstable_poincare_error"][i, end, m, : len(section)] = section


#: Tables kept in a process; a table is about 100 kB.
TABLES_KEPT = 32
#: Speed of the pinion at which a static equilibrium is sought, rad/s: forces that go with speed vanish there.
CREEP = 1e-3


class SweepSettings(NamedTuple):
    """How every case of a sweep is brought to its window."""

    steady: bool  # whether the periodic motion is sought; otherwise `cycles` mesh cycles are marched
    cycles: int  # mesh cycles to march, or at most to march in search of the steady state
    window: int  # mesh cycles that the quantities are taken from
    points: int  # points of the Poincaré section, one per mesh cycle
    samples: int  # samples in a mesh cycle
    modes: int
    method: str = ""  # integration method instead of the scenario's; empty for the scenario's own
    #: whether steady motions are followed from case to case, to the ends of their branches
    followed: bool = False
    unstable: bool = False  # whether branches are continued beyond these


def evaluate(chunk: Chunk, settings: SweepSettings, workers: int | None = None) -> dict[str, np.ndarray]:
    """Return a row for every case of a chunk, for all datasets of its layout; by default by all cores."""
    rows = _evaluate(chunk, settings, workers)
    for _ in range(MOST_MOTIONS - 1):
        again = _at_own_temperature(chunk, rows)
        if not again:
            break
        places = np.array(list(again))
        cases = tuple(again.get(i, case) for i, case in enumerate(chunk.cases))
        chunk = chunk._replace(cases=cases)
        states = None if chunk.states is None else chunk.states[places]
        part = _evaluate(Chunk(chunk.numbers[places], tuple(again.values()), states), settings, workers)
        for name, values in part.items():
            rows[name][places] = values
    return rows


def _at_own_temperature(chunk: Chunk, rows: dict[str, np.ndarray]) -> dict[int, Case]:
    """Cases, by their place, that are to be solved again at the bulk temperature of their own motion.

    Those that follow a branch stay at the temperature of the quasi-static loss, which their neighbours have.
    """
    found: dict[int, Case] = {}
    for i, case in enumerate(chunk.cases):
        followed = chunk.ways is not None and chunk.ways[i] is not None
        if isinstance(case, str) or case.temperature is None or followed or rows["status"][i] != DONE:
            continue
        warm, lost = float(rows["bulk_temperature"][i]), float(rows["power_friction_mean"][i])
        again = at_own_temperature(case, warm, lost)
        if again is not None:
            found[i] = again
    return found


def _evaluate(chunk: Chunk, settings: SweepSettings, workers: int | None) -> dict[str, np.ndarray]:
    """Evaluate every case once."""
    rows = layout_of(settings).empty_rows(len(chunk.cases))
    ready: dict[int, tuple[PreparedPair, np.ndarray]] = {}
    for i, case in enumerate(chunk.cases):
        if isinstance(case, str):
            _fail(rows, i, case)
            continue
        try:
            prepared = prepare(case, tabulated(case))
            given = None if chunk.states is None or np.isnan(chunk.states[i, 0]) else chunk.states[i]
            start = (
                _start(prepared, settings) if given is None else given[state_places(prepared.model.layout)]
            )
            ready[i] = prepared, start
            frequencies = natural_frequencies(prepared.model, [prepared.cycle])
            rows["mode_frequency"][i, : len(frequencies)] = frequencies
        except (InputError, SimulationError) as error:
            _fail(rows, i, str(error))
    for numbers in _alike({i: prepared.case for i, (prepared, _) in ready.items()}):
        ways = [chunk.ways[i] if chunk.ways else None for i in numbers]
        prepared_at = prepared_between([ready[i][0] for i in numbers], ways, tabulated)
        outcomes = _solve([ready[i] for i in numbers], ways, prepared_at, settings, workers)
        for line, (i, outcome) in enumerate(zip(numbers, outcomes, strict=True)):
            _fill(rows, i, ready[i][0], outcome, settings)
            if outcome.continued:
                fill_unstable(rows, i, outcome.continued, partial(prepared_at, line), settings.samples)
    return rows


def _alike(cases: dict[int, Case]) -> list[list[int]]:
    """Numbers of the cases, grouped by their solver's tolerance, method and limit, which a batch shares."""
    groups: dict[tuple[Any, ...], list[int]] = {}
    for i, case in cases.items():
        groups.setdefault((case.solver.rtol, case.solver.method, case.solver.max_steps), []).append(i)
    return list(groups.values())


def _solve(
    cases: list[tuple[PreparedPair, np.ndarray]],
    ways: Sequence[NeighbourWay | None],
    prepared_at: PreparedAt,
    settings: SweepSettings,
    workers: int | None,
) -> list[Outcome]:
    solver = cases[0][0].case.solver
    common: dict[str, Any] = {
        "cycles": settings.cycles,
        "points": settings.points,
        "samples": settings.samples,
        "rtol": solver.rtol,
        "max_steps": solver.max_steps,
        "method": settings.method or solver.method,
        "workers": workers,
    }
    models, states = [prepared.model for prepared, _ in cases], np.array([state for _, state in cases])
    if settings.steady:
        if settings.followed:
            common["legs"] = legs_of(cases, ways)
            common["model_at"] = lambda line, value: prepared_at(line, value).model
        if settings.unstable:
            # all ways of a chunk are along the same values
            span = next((way.span for way in ways if way is not None), (0.0, 0.0))
            common["unstable"] = UnstableRange(span, MOTIONS)
        return steady(models, states, **common)
    return marched(models, states, window=settings.window, **common)


def _fill(
    rows: dict[str, np.ndarray], i: int, prepared: PreparedPair, outcome: Outcome, settings: SweepSettings
) -> None:
    """Put the outcome of a case into its row."""
    for name in ("period", "stable", "multiplier_max", "residual", "cycles", "solution", "message"):
        rows[name][i] = getattr(outcome, name)
    if outcome.window is None:
        rows["status"][i] = FAILED
        return
    quantities, trust = window_quantities(prepared, outcome.window, settings.samples)
    for name, value in quantities.items():
        rows[name][i] = value
    warning = warning_of(quantities["friction_work_on_vibration"], prepared.case.friction.sliding)
    texts = [*remarks(trust | {"warning": warning}), *remarks_in_brief(prepared.case.toml)]
    rows["message"][i] = remarked(rows["message"][i], *map(warned, texts))
    rows[TRUST][i] = number(trust)
    model, section = prepared.model, outcome.section
    error = rotational_error(outcome.window.states, MESH, model)
    room = settings.window * settings.samples
    whole = room if outcome.period == 0 else room // error.size * error.size
    rows["transmission_error_rotational"][i, :whole] = np.resize(error, whole)
    rows["poincare_error"][i, : len(outcome.section)] = rotational_error(section, MESH, model)
    rows["poincare_rate"][i, : len(outcome.section)] = rotational_error_rate(section, MESH, model)
    rows["state"][i, state_places(model.layout)] = outcome.state
    if settings.followed:
        fill_ends(rows, i, outcome.ends)
    rows["status"][i] = DONE


def tabulated(case: Case) -> Tabulated:
    """The case's table, made once for all cases that share it; raises as `prepare` does."""
    return _tables(_Wanted(table_key(case), lambda: tables(case)))


def _start(prepared: PreparedPair, settings: SweepSettings) -> np.ndarray:
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
    numbers = (*creeping, *model.bodies, *model.links, *(mesh.damping for mesh in model.meshes))
    tables = tuple(id(mesh.table) for mesh in model.meshes)
    key = (tables, model.options, *(np.asarray(value).tobytes() for value in numbers))
    return _equilibria(_Wanted(key, lambda: static_equilibrium(still))).copy()


@dataclass(frozen=True)
class _Wanted:
    """A result that is made once: everything that it depends on, and how it is made."""

    key: Hashable
    make: Callable[[], Any] = field(compare=False)


_tables = lru_cache(maxsize=TABLES_KEPT)(lambda wanted: wanted.make())
_equilibria = lru_cache(maxsize=TABLES_KEPT)(lambda wanted: wanted.make())


def _fail(rows: dict[str, np.ndarray], i: int, reason: str) -> None:
    rows["status"][i] = FAILED
    rows["message"][i] = reason
    rows["solution"][i] = "failed"
