"""What becomes of a handful of cases: prepared, brought to their steady state or marched, summed up.

A pure function of plain data, so that it runs in this process or in another one on another machine, and gives
the same numbers in both. Nothing of a case depends on the others that it is evaluated with.
"""

import threading
from collections import OrderedDict
from collections.abc import Hashable, Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.case import Case
from tribodyn.dynamics.modes import natural_frequencies
from tribodyn.dynamics.parameters import LAG, STATES, WORKS, XI
from tribodyn.errors import InputError, SimulationError
from tribodyn.prepare import Prepared, Tabulated, prepare, table_key, tables
from tribodyn.record.sweep_schema import CASES, DONE, FAILED, UNKNOWN
from tribodyn.solve import engine
from tribodyn.solve.ensemble import march
from tribodyn.solve.initial import initial_state, static_equilibrium
from tribodyn.sweep.figures import Passage, section, window_figures
from tribodyn.tribology.friction import NONE

#: Tables kept in a process; a table is about 100 kB.
TABLES_KEPT = 32


class Settings(NamedTuple):
    """How every case of a sweep is brought to its window.

    Attributes
    ----------
    steady : bool
        Whether the periodic motion is sought; otherwise `cycles` mesh cycles are marched.
    cycles : int
        Mesh cycles to march, or at most to march in search of the steady state.
    window : int
        Mesh cycles that the figures are taken from.
    points : int
        Points of the Poincaré section, one a mesh cycle.
    samples : int
        Samples in a mesh cycle.
    modes : int
    """

    steady: bool
    cycles: int
    window: int
    points: int
    samples: int
    modes: int


class Chunk(NamedTuple):
    """Cases to be evaluated together.

    Attributes
    ----------
    numbers : (n,) int
        Of the cases in the sweep's record.
    cases : tuple of n Case or str
        A text where the case could not even be made: why.
    states : (n, STATES) or None
        Where to start from, before the engagement at phase 0; NaN, or None for all, where a case begins by
        itself.
    """

    numbers: np.ndarray
    cases: tuple[Case | str, ...]
    states: np.ndarray | None = None


def evaluate(chunk: Chunk, settings: Settings, workers: int | None = None) -> dict[str, np.ndarray]:
    """Return a row for every case of a chunk, for all datasets of `sweep_schema.CASES`.

    Parameters
    ----------
    chunk : Chunk
    settings : Settings
    workers : int, optional
        Threads; by default one a core.
    """
    rows = _empty_rows(len(chunk.cases), settings)
    ready: dict[int, Prepared] = {}
    states = np.full((len(chunk.cases), STATES), np.nan) if chunk.states is None else chunk.states.copy()
    continued = np.isfinite(states[:, 0])
    for i, case in enumerate(chunk.cases):
        try:
            if isinstance(case, str):
                raise InputError("case", rule=case)
            prepared = prepare(case, tabulated(case))
            if not continued[i]:
                states[i] = _start(prepared, settings)
            ready[i] = prepared
            rows["mode_frequency"][i] = _padded(natural_frequencies(prepared.model), settings.modes)
        except (InputError, SimulationError) as error:
            _fail(rows, i, case if isinstance(case, str) else str(error))
    for fresh in (True, False):  # a start and a continuation stand on different sides of an engagement
        chosen = [i for i in ready if continued[i] != fresh]
        for group in _alike([ready[i].case for i in chosen]):
            numbers = [chosen[k] for k in group]
            _solve(rows, numbers, [ready[i] for i in numbers], states[numbers], fresh, settings, workers)
    return rows


def _alike(cases: Sequence[Case]) -> list[list[int]]:
    """Positions of the cases grouped by their solver's tolerance, method and limit, which a batch shares."""
    groups: dict[tuple[Any, ...], list[int]] = {}
    for i, case in enumerate(cases):
        solver = case.solver
        groups.setdefault((solver.rtol, solver.method, solver.max_steps), []).append(i)
    return list(groups.values())


def _solve(
    rows: dict[str, np.ndarray],
    numbers: list[int],
    prepared: list[Prepared],
    states: np.ndarray,
    fresh: bool,
    settings: Settings,
    workers: int | None,
) -> None:
    """Bring cases to the start of their window, march through it, and fill their rows."""
    solver = prepared[0].case.solver
    models = [one.model for one in prepared]
    common: dict[str, Any] = {
        "rtol": solver.rtol,
        "max_steps": solver.max_steps,
        "method": solver.method,
        "workers": workers,
    }
    before = settings.cycles - settings.window
    good = np.arange(len(numbers))
    sections: list[np.ndarray] = []
    if settings.steady:
        from tribodyn.sweep.steady import seek

        states, good = seek(rows, numbers, models, states, fresh, settings, common)
        before = 0
    elif before:
        points = min(settings.points - settings.window, before) if settings.points > settings.window else 0
        led = march(models, states, cycles=before, window=points, samples=1, started=not fresh, **common)
        good = _sound(rows, numbers, led.status, led.reached)
        states, sections = led.state, list(led.samples)
        rows["cycles"][numbers] += led.reached.astype(int)
    if not len(good):
        return
    lengths = np.array([_whole(settings.window, int(rows["period"][numbers[k]])) for k in good])
    for length in np.unique(lengths):
        chosen = good[lengths == length]
        ran = march(
            [models[k] for k in chosen],
            states[chosen],
            cycles=int(length),
            window=int(length),
            samples=settings.samples,
            started=settings.steady or before > 0 or not fresh,
            first_cycle=before,
            **common,
        )
        for row, k in enumerate(chosen):
            i = numbers[k]
            rows["cycles"][i] += int(ran.reached[row])
            if ran.status[row] != engine.DONE:
                _fail(rows, i, _reason(int(ran.status[row]), before + float(ran.reached[row])))
                continue
            passed = Passage(before, ran.samples[row], states[k], ran.state[row], settings.samples)
            led_in = sections[k] if sections else np.empty((0, STATES))
            _fill(rows, i, prepared[k], passed, led_in, settings)


def _whole(window: int, period: int) -> int:
    """Mesh cycles of the window that are whole periods."""
    return window // period * period if 0 < period <= window else window


def _fill(
    rows: dict[str, np.ndarray],
    i: int,
    prepared: Prepared,
    passed: Passage,
    led_in: np.ndarray,
    settings: Settings,
) -> None:
    for name, value in window_figures(prepared, passed).items():
        rows[name][i] = value
    error = passed.window[:, XI]
    rows["transmission_error_rotational"][i, : len(error)] = error
    rows["poincare_error"][i], rows["poincare_rate"][i] = section(led_in, passed, settings.points)
    rows["state"][i] = _continued(passed.start if settings.steady else passed.end)
    rows["status"][i] = DONE


def tabulated(case: Case) -> Tabulated:
    """The case's table, made once for all cases that share it; raises as `prepare` does."""
    key = table_key(case)
    with _lock:
        if key in _tables:
            _tables.move_to_end(key)
            return _tables[key]
    made = tables(case)
    with _lock:
        _tables[key] = made
        while len(_tables) > TABLES_KEPT:
            _tables.popitem(last=False)
    return made


_lock = threading.Lock()
_tables: OrderedDict[Hashable, Tabulated] = OrderedDict()


def _start(prepared: Prepared, settings: Settings) -> np.ndarray:
    """Where a case begins: as its scenario says, or for a steady state at the equilibrium without friction.

    The latter is the same at all speeds and therefore found once; a steady state does not remember it.
    """
    if not settings.steady or prepared.case.solver.initial != "static":
        return initial_state(prepared.model, prepared.case.solver.initial)
    model = prepared.model
    speedless = model.mechanics._replace(nominal_speed=0.0)
    key = (id(model.table), model.options, *(np.asarray(value).tobytes() for value in speedless))
    with _lock:
        found = _equilibria.get(key)
    if found is None or found[0] is not model.table:
        frictionless = model._replace(options=model.options._replace(friction_law=NONE))
        found = model.table, static_equilibrium(frictionless)
        with _lock:
            _equilibria[key] = found
            while len(_equilibria) > TABLES_KEPT:
                _equilibria.popitem(last=False)
    return found[1].copy()


_equilibria: OrderedDict[Hashable, tuple[Any, np.ndarray]] = OrderedDict()


def _continued(state: np.ndarray) -> np.ndarray:
    """The state that a neighbour starts from: its clock and its audit begin anew."""
    state = state.copy()
    state[[LAG, *WORKS]] = 0.0
    return state


def _sound(rows: dict[str, np.ndarray], numbers: list[int], status: np.ndarray, reached: np.ndarray) -> Any:
    """Positions of the cases that can go on; the others fail."""
    for k in np.flatnonzero(status != engine.DONE):
        _fail(rows, numbers[k], _reason(int(status[k]), float(reached[k])))
    return np.flatnonzero(status == engine.DONE)


def _reason(status: int, reached: float) -> str:
    return f"stopped after {reached:.4g} mesh cycles: {engine.REASONS[status]}"


def _fail(rows: dict[str, np.ndarray], i: int, reason: str) -> None:
    rows["status"][i] = FAILED
    rows["message"][i] = reason
    rows["solution"][i] = "failed"


def _empty_rows(count: int, settings: Settings) -> dict[str, np.ndarray]:
    """Rows without results."""
    inner = {
        "sample": settings.window * settings.samples,
        "cycle": settings.points,
        "mode": settings.modes,
        "state_variable": STATES,
    }
    rows = {}
    for name, variable in CASES.items():
        shape = (count, *(inner[dim] for dim in variable.inner))
        text = variable.dtype.startswith("S")
        rows[name] = np.full(shape, "" if text else variable.fill, object if text else variable.dtype)
    rows["stable"][...] = UNKNOWN
    return rows


def _padded(values: np.ndarray, length: int) -> np.ndarray:
    return np.append(values, np.full(max(0, length - len(values)), np.nan))[:length]
