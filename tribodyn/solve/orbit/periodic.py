"""Periodic steady states of gear pairs: fixed points of `gear_map.GearMap`, from `steady_orbit.find`."""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.dynamics.extremes import Extremes, extremes_of
from tribodyn.dynamics.parameters import (
    DRIVE_SPEED,
    STATES,
    Model,
)
from tribodyn.errors import InputError, SimulationError
from tribodyn.numerics.shapes import Array, Complex, Float
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.integrator import MAX_STEPS
from tribodyn.solve.orbit.gear_map import GearMap, moving_states
from tribodyn.solve.orbit.result import FAILED, Orbit
from tribodyn.solve.orbit.steady_orbit import Method, find

#: The integration's relative tolerance for a fixed point, as a share of the residual required: a map that
#: carries more noise than a tenth of the residual does not reach it.
FINE = 1e-2
#: Change of a motion that did not repeat, over the scale, up to which it may be integration noise: that is
#: a few hundred times the tolerance where contact opens and closes. Such a case is marched once more,
#: over so many mesh cycles at the fine tolerance, with fixed points at a hundredth of that.
NOISE, ONCE_MORE = 1e-5, 120
#: Mesh cycles of a motion without period that are sampled.
WANDERING = 16


class Steady(NamedTuple):
    """The steady motion of one gear pair: state, samples and end are of the motion that `kind` names.

    Attributes
    ----------
    state : (STATES,)
        At phase 0 after engagement; lag and works zero.
    last : (STATES,)
        Where marching ended, likewise: the place to start a neighbouring case from.
    period : int
        Mesh cycles in one period of the motion; 0 where it has none.
    residual : float
        Maximum change of the mechanical state over one period, each over its scale: displacements over the
        static deflection, velocities over that times the mesh's natural frequency.
    multipliers : (N,) complex
        Floquet multipliers over one period of the motion, largest first, without the rigid rotation; NaN
        where it has none.
    stable : bool
        Whether the motion is periodic and stable.
    kind : str
        "period-1" … "period-8"; "longer period"; "quasi-periodic", "chaotic", or "not periodic" where it is
        undecided which; "failed"; "unstable" only with `method="shooting"`.
    method : str
        "marching" or "shooting".
    cycles : int
        Mesh cycles marched before the state was found or given up.
    samples : (cycles · samples, STATES)
        Over one period of the motion, works counted from its start; over `WANDERING` mesh cycles of a motion
        without period.
    end : (STATES,)
        At the end of the samples, before the next engagement: the works and the lag of whole mesh cycles.
    extremes : Extremes or None
        Of the dense motion over those cycles; None where it failed.
    message : str
    """

    state: Float[Array, " state"]
    last: Float[Array, " state"]
    period: int
    residual: float
    multipliers: Complex[Array, " multiplier"]
    stable: bool
    kind: str
    method: str
    cycles: int
    samples: Float[Array, "sample state"]
    end: Float[Array, " state"]
    extremes: Extremes | None
    message: str


def steady_states(
    models: Sequence[Model],
    states: Float[Array, "case state"] | None = None,
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
        states coexist this decides which one results.
    samples : int
        Samples per mesh cycle of the steady states.
    rtol : float
        Of marching; the last steps and the samples are integrated to a hundredth of `tolerance`.
    tolerance : float
        Maximum scaled change over a period of the motion.
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
    steadies: list[Steady | None] = [None] * len(models)
    for model in models:
        refuse_time_dependent(model)
    starts: dict[int, Float[Array, " state"]] = {}
    for case, model in enumerate(models):
        try:
            given = static_equilibrium(model) if states is None else states[case]
            starts[case] = np.asarray(given, dtype=float)
        except SimulationError as error:
            steadies[case] = _without_state(np.zeros(STATES), error.reason)
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
        for case, steady in zip(cases, sampled(period_map, orbits, samples), strict=True):
            steadies[case] = steady
    return [steady for steady in steadies if steady is not None]


def _once_more(before: "GearMap", orbits: list[Orbit], tolerance: float, settings: dict[str, Any]) -> None:
    """Seek from where marching ended, more finely, what all but repeated."""
    wandering = [i for i, one in enumerate(orbits) if not one.period and one.kind != FAILED]
    noisy = [i for i in wandering if orbits[i].residual <= NOISE]
    if not noisy:
        return
    models, begin = [before.models[i] for i in noisy], np.array([orbits[i].last for i in noisy])
    rtol = {"rtol": FINE * tolerance, "fine_rtol": FINE**2 * tolerance}
    finest = GearMap(models, before.full(begin), tuple(before.moving), **rtol, **settings)
    finer = find(finest, begin, tolerance=tolerance, max_periods=ONCE_MORE)
    for i, orbit in zip(noisy, finer, strict=True):
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
            "omit the table, or run the scenario in time",
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


def sampled(period_map: GearMap, orbits: list[Orbit], samples: int) -> list[Steady]:
    """Each orbit with its samples, marched once more over its period, or over some mesh cycles without."""
    sampled: dict[int, tuple[Float[Array, "sample state"], Float[Array, " state"], str, Extremes | None]] = {}
    cycles = [0 if orbit.kind == FAILED else orbit.period or WANDERING for orbit in orbits]
    for period in sorted({*cycles} - {0}):
        cases = np.array([case for case, count in enumerate(cycles) if count == period])
        states = period_map.full(np.array([orbits[case].state for case in cases]))
        *batch, extremes = period_map.integrate(states, cases, period, samples, True, extremes=True)
        rows = zip(*batch, (extremes_of(extremes, row) for row in range(len(cases))), strict=True)
        sampled |= {int(case): row for case, row in zip(cases, rows, strict=True)}
    steadies = []
    for case, orbit in enumerate(orbits):
        state, last = period_map.full(np.array([orbit.state, orbit.last]))
        window, end, reason, extremes = sampled.get(case, (np.empty((0, STATES)), state, "", None))
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
            extremes,
            orbit.message,
        )
        steadies.append(_without_state(state, reason) if reason else steady)
    return steadies


def _without_state(state: Float[Array, " state"], reason: str) -> Steady:
    nothing = np.empty(0, dtype=complex)
    empty = np.empty((0, STATES))
    return Steady(state, state, 0, np.inf, nothing, False, FAILED, "marching", 0, empty, state, None, reason)
