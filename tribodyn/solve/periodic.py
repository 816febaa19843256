"""Periodic steady states of gear pairs: the map over one mesh cycle, given to `steady_orbit.find`.

The map takes the mechanical state at phase 0, just after engagement, to the same place a mesh cycle later.
The rigid rotation has no part in it: the independent variable is the mesh's phase, and the time lag, on which
nothing depends while the load is steady, is left out together with the audit's works. With prescribed speed
ten states remain, with a torque source eleven, with a shaft thirteen.
"""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.dynamics.parameters import (
    DISPLACEMENTS,
    DRIVE_SHAFT,
    DRIVE_SPEED,
    ENERGY_CONSISTENT,
    MOTOR_SLIP,
    SLIP,
    STATES,
    TWIST,
    VELOCITIES,
    XI,
    Model,
)
from tribodyn.errors import InputError, SimulationError
from tribodyn.solve.choice import choose
from tribodyn.solve.engagement import engage_next
from tribodyn.solve.ensemble import march
from tribodyn.solve.initial import static_deflection, static_equilibrium
from tribodyn.solve.integrator import MAX_STEPS, REASONS, Status
from tribodyn.solve.period_map import DIFFERENCE, Marched, Tangent, by_differences
from tribodyn.solve.steady_orbit import Method, Orbit, find
from tribodyn.solve.tolerances import absolute_tolerances

#: The integration's relative tolerance for a fixed point, as a share of the residual asked for: a map that
#: carries more noise than a tenth of the residual cannot be brought to it.
FINE = 1e-2
#: Least change of a motion that did not repeat, over the scale, which may be noise of the fine integration:
#: where contact opens and closes it is a few hundred times the tolerance. Such a case is marched once more,
#: over so many mesh cycles at the fine tolerance, with fixed points at a hundredth of that.
NOISE, ONCE_MORE = 1e-5, 120


class Steady(NamedTuple):
    """The steady state of one gear pair, or what can be said instead.

    Attributes
    ----------
    state : (STATES,)
        At phase 0 after engagement; lag and works zero. Where there is no periodic state, as `last`.
    last : (STATES,)
        Where marching ended, likewise: the place to start a neighbouring case from.
    period : int
        Mesh cycles in one period of the motion; 0 where none was found.
    residual : float
        Greatest change of the mechanical state over one period, each over its scale: displacements over the
        static deflection, velocities over that times the mesh's natural frequency.
    multipliers : (N,) complex
        Floquet multipliers over one period of the motion, greatest first, rigid rotation left out.
    stable : bool
    kind : str
        "period-1" … "period-4", "unstable", "not periodic", "failed".
    method : str
        "marching" or "shooting".
    cycles : int
        Mesh cycles marched before the state was found or given up.
    samples : (period · samples, STATES)
        Over one period of the motion, works counted from its start; empty without a periodic state.
    end : (STATES,)
        At the end of that period, before the next engagement: the works and the lag of a whole period.
    message : str
    """

    state: np.ndarray
    last: np.ndarray
    period: int
    residual: float
    multipliers: np.ndarray
    stable: bool
    kind: str
    method: str
    cycles: int
    samples: np.ndarray
    end: np.ndarray
    message: str


def steady_states(
    models: Sequence[Model],
    states: np.ndarray | None = None,
    *,
    samples: int = 200,
    rtol: float = 1e-6,
    tolerance: float = 1e-7,
    max_cycles: int = 2000,
    method: Method = "auto",
    solver: str = "auto",
    max_steps: int = MAX_STEPS,
    workers: int | None = None,
    progress: Callable[[float], None] | None = None,
) -> list[Steady]:
    """Find the periodic steady states of many gear pairs.

    Parameters
    ----------
    models : sequence of C Models
        They may differ in every number, table and option.
    states : (C, STATES), optional
        Where each starts, at phase 0 after engagement; default: the static equilibrium. Where several steady
        states coexist this decides which is found.
    samples : int
        Samples per mesh cycle of the states found.
    rtol : float
        Of marching; the last steps and the samples are integrated to a hundredth of `tolerance`.
    tolerance : float
        Greatest scaled change over a period of the motion.
    max_cycles : int
        Mesh cycles to march before giving up.
    method : {"auto", "marching", "shooting"}
        See `steady_orbit.find`.
    solver : str
        Integration method, as `solver.method` of a scenario.
    max_steps : int
        Steps allowed in one mesh cycle.
    workers : int, optional
        See `ensemble.march`.
    progress : callable, optional
        Called with the share of cases done.

    Raises
    ------
    InputError
        For a load that varies in time otherwise than with the mesh.
    """
    found: list[Steady | None] = [None] * len(models)
    for model in models:
        refuse_time_dependent(model)
    starts: dict[int, np.ndarray] = {}
    for case, model in enumerate(models):
        try:
            given = static_equilibrium(model) if states is None else states[case]
            starts[case] = np.asarray(given, dtype=float)
        except SimulationError as error:
            found[case] = _without_state(np.zeros(STATES), error.reason)
    groups: dict[tuple[int, ...], list[int]] = {}
    for case in starts:
        groups.setdefault(moving_states(models[case]), []).append(case)
    for moving, cases in groups.items():
        settings: dict[str, Any] = {"solver": solver, "max_steps": max_steps, "workers": workers}
        begin = np.array([starts[case] for case in cases])
        rtols = {"rtol": rtol, "fine_rtol": FINE * tolerance}
        period_map = GearMap([models[case] for case in cases], begin, moving, **rtols, **settings)
        limits: dict[str, Any] = {"tolerance": tolerance, "max_periods": max_cycles, "method": method}
        orbits = find(period_map, begin[:, list(moving)], progress=progress, **limits)
        if method == "auto":
            _once_more(period_map, orbits, tolerance, settings)
        for case, steady in zip(cases, _sampled(period_map, orbits, samples), strict=True):
            found[case] = steady
    return [steady for steady in found if steady is not None]


def _once_more(before: "GearMap", orbits: list[Orbit], tolerance: float, settings: dict[str, Any]) -> None:
    """Seek from where marching ended, more finely, what all but repeated."""
    noisy = [i for i, one in enumerate(orbits) if one.kind == "not periodic" and one.residual <= NOISE]
    if not noisy:
        return
    models, begin = [before.models[i] for i in noisy], np.array([orbits[i].last for i in noisy])
    rtol = {"rtol": FINE * tolerance, "fine_rtol": FINE**2 * tolerance}
    finest = GearMap(models, before.full(begin), tuple(before.moving), **rtol, **settings)
    found = find(finest, begin, tolerance=tolerance, max_periods=ONCE_MORE)
    for i, orbit in zip(noisy, found, strict=True):
        if orbit.period and orbit.stable:
            orbits[i] = orbit._replace(marched=orbits[i].marched + orbit.marched)


def refuse_time_dependent(model: Model) -> None:
    """Raise InputError where the load varies in time otherwise than with the mesh.

    Harmonics at whole multiples of the mesh frequency of a prescribed speed repeat with the mesh.
    """
    mechanics = model.mechanics
    torques = np.asarray(mechanics.load_torques)
    if len(torques) > 1 and np.ptp(torques) > 0.0:
        raise InputError(
            "operating.gear_torque_table",
            None,
            "a load that changes over time has no steady state over the mesh cycle",
            "leave the table out, or run the scenario in time",
        )
    period = float(model.table.pitch_angle) / float(mechanics.nominal_speed)
    frequencies = np.asarray(mechanics.load_frequencies)[np.asarray(mechanics.load_amplitudes) != 0.0]
    for frequency in frequencies:
        orders = frequency * period / (2.0 * np.pi)
        if model.options.drive != DRIVE_SPEED or abs(orders - round(orders)) > 1e-9:
            raise InputError(
                "operating.gear_torque_harmonics",
                f"{frequency:g} rad/s",
                "does not repeat with the mesh, so that there is no steady state over the mesh cycle",
                f"take a whole multiple of the mesh frequency ({2.0 * np.pi / period:.6g} rad/s) with a "
                "prescribed speed, or run the scenario in time",
            )


def moving_states(model: Model) -> tuple[int, ...]:
    """Indices of the states that the map over a mesh cycle acts on."""
    free = {*DISPLACEMENTS, *VELOCITIES}
    if model.options.drive != DRIVE_SPEED:
        free |= {SLIP}
    if model.options.drive == DRIVE_SHAFT:
        free |= {TWIST, MOTOR_SLIP}
    return tuple(sorted(free))


class GearMap:
    """Maps over a mesh cycle of gear pairs with the same moving states, as `period_map.PeriodMap`.

    Parameters
    ----------
    models : sequence of C Models
    starts : (C, STATES)
        States that scale and integration method are judged by.
    moving : tuple of int
        See `moving_states`.
    solver, rtol, fine_rtol, max_steps, workers
        Method, tolerances of marching and of fixed points, steps a cycle, threads.
    """

    blur = DIFFERENCE

    def __init__(
        self,
        models: Sequence[Model],
        starts: np.ndarray,
        moving: tuple[int, ...],
        *,
        solver: str,
        rtol: float,
        fine_rtol: float,
        max_steps: int,
        workers: int | None,
    ):
        self.models = models
        self.moving = list(moving)
        self.rtol = {False: rtol, True: min(rtol, fine_rtol)}
        self.settings: dict[str, Any] = {"max_steps": max_steps, "workers": workers}
        self.solvers = [choose(solver, m, y).method for m, y in zip(models, starts, strict=True)]
        self.scale = np.array(
            [
                absolute_tolerances(model, 1.0, _deflection(model, start))[self.moving]
                for model, start in zip(models, starts, strict=True)
            ]
        )

    def full(self, states: np.ndarray) -> np.ndarray:
        """States of the model (R, STATES) from states of the map (R, N)."""
        whole = np.zeros((len(states), STATES))
        whole[:, self.moving] = states
        return whole

    def march(self, states: np.ndarray, cases: np.ndarray, periods: int, fine: bool) -> Marched:
        """See `period_map.PeriodMap`."""
        samples, end, reasons = self.integrate(self.full(states), cases, periods, 1, fine)
        for row, case in enumerate(cases):
            if self.models[case].options.formulation == ENERGY_CONSISTENT and not reasons[row]:
                engage_next(end[row], self.models[case])
        after = np.concatenate([samples[:, 1:], end[:, None]], axis=1)[..., self.moving]
        after[[bool(reason) for reason in reasons]] = np.nan
        return Marched(after, reasons)

    def tangent(self, states: np.ndarray, cases: np.ndarray, periods: int) -> Tangent:
        """See `period_map.PeriodMap`; by differences."""
        return by_differences(self.march, states, cases, periods, self.scale)

    def integrate(
        self, states: np.ndarray, cases: np.ndarray, periods: int, samples: int, fine: bool
    ) -> tuple[np.ndarray, np.ndarray, list[str]]:
        """Samples (R, periods · samples, STATES), states at the end before engagement, and reasons."""
        found = np.full((len(states), periods * samples, STATES), np.nan)
        end = states.copy()
        reasons = [""] * len(states)
        for solver in sorted(set(self.solvers)):
            rows = [row for row, case in enumerate(cases) if self.solvers[case] == solver]
            if not rows:
                continue
            batch = march(
                [self.models[cases[row]] for row in rows],
                states[rows],
                cycles=periods,
                window=periods,
                samples=samples,
                rtol=self.rtol[fine],
                method=solver,
                **self.settings,
            )
            found[rows], end[rows] = batch.samples, batch.state
            for row, status, reached in zip(rows, batch.status, batch.reached, strict=True):
                if status != Status.DONE:
                    reasons[row] = f"{REASONS[Status(status)]} (after {reached:.2f} mesh cycles)"
        return found, end, reasons


def _deflection(model: Model, start: np.ndarray) -> float:
    return max(abs(float(start[XI])), static_deflection(model, float(model.mechanics.load_torque)), 1e-9)


def _sampled(period_map: GearMap, orbits: list[Orbit], samples: int) -> list[Steady]:
    """Each orbit with its samples, marched once more over its period."""
    found: dict[int, tuple[np.ndarray, np.ndarray, str]] = {}
    for period in sorted({orbit.period for orbit in orbits} - {0}):
        cases = np.array([case for case, orbit in enumerate(orbits) if orbit.period == period])
        states = period_map.full(np.array([orbits[case].state for case in cases]))
        batch = period_map.integrate(states, cases, period, samples, True)
        found |= {int(case): row for case, row in zip(cases, zip(*batch, strict=True), strict=True)}
    steadies = []
    for case, orbit in enumerate(orbits):
        state, last = period_map.full(np.array([orbit.state, orbit.last]))
        window, end, reason = found.get(case, (np.empty((0, STATES)), state, ""))
        steady = Steady(
            state,
            last,
            orbit.period,
            orbit.residual,
            orbit.multipliers,
            orbit.stable,
            orbit.kind,
            orbit.method,
            orbit.marched,
            window,
            end,
            orbit.message,
        )
        steadies.append(_without_state(state, reason) if reason else steady)
    return steadies


def _without_state(state: np.ndarray, reason: str) -> Steady:
    nothing = np.empty(0, dtype=complex)
    empty = np.empty((0, STATES))
    return Steady(state, state, 0, np.inf, nothing, False, "failed", "marching", 0, empty, state, reason)
