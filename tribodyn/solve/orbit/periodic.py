"""Periodic steady states of gears: fixed points of `gear_map.GearMap`, from `search.find`."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from tribodyn.dynamics.parameters import DRIVE_SPEED, Model
from tribodyn.dynamics.recorded.extremes import Extremes, extremes_of
from tribodyn.errors import InputError, SimulationError
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.integrator import MAX_STEPS
from tribodyn.solve.orbit.gear_map import FreeStates, GearMap, moving_states, reasons_of
from tribodyn.solve.orbit.motions import FAILED, Orbit, failed_orbit
from tribodyn.solve.orbit.search import Method, find

#: The integration's relative tolerance for a fixed point, as a share of the residual required: a map that
#: carries more noise than a tenth of the residual does not reach it.
FINE = 1e-2
#: Change of a motion that did not repeat, over the scale, up to which it may be integration noise: that is
#: a few hundred times the tolerance where contact opens and closes. Such a case is marched once more,
#: over so many mesh cycles at the fine tolerance, with fixed points at a hundredth of that.
NOISE, ONCE_MORE = 1e-5, 120
#: Mesh cycles of a motion without period that are sampled: as many common periods as fit in, at least one.
WANDERING = 16


@dataclass(frozen=True)
class SteadyMotion(Orbit):
    """The steady motion of one gear pair: an orbit, of all states, and its samples.

    Its states stand at phase 0 after engagement, with lag and works zero; its multipliers leave the rigid
    rotation out, and displacements are measured by the static deflection, velocities by that times the mesh's
    natural frequency.
    """

    #: over one period of the motion, works counted from its start; of a motion without period over common
    #: periods, see `WANDERING`
    samples: Float[Array, "sample state"]
    #: at the end of the samples, before the next engagement: the works and the lag of whole mesh cycles
    end: Float[Array, " state"]
    extremes: Extremes | None  # of the dense motion over those cycles; None where it failed


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
) -> list[SteadyMotion]:
    """Find the periodic steady states of many gear pairs.

    Parameters
    ----------
    models : they may differ in every number, table and option
    states : where each starts, at phase 0 after engagement; default: the static equilibrium. Where several
        steady states coexist this decides which one results.
    samples : samples per mesh cycle of the steady states
    rtol : of marching; the last steps and the samples are integrated to a hundredth of `tolerance`
    tolerance : maximum scaled change over a period of the motion
    max_cycles : mesh cycles to march before giving up
    method : {"auto", "marching", "shooting"}; see `search.find`
    solver : integration method, as `solver.method` of a scenario
    max_steps : steps allowed in one mesh cycle
    workers : see `ensemble.march`
    progress : called with the share of cases done

    Raises
    ------
    InputError
        For a load that varies in time otherwise than with the mesh.
    """
    for model in models:
        refuse_time_dependent(model)
    motions: dict[int, SteadyMotion] = {}
    groups: dict[FreeStates, dict[int, Float[Array, " state"]]] = {}
    for case, model in enumerate(models):
        try:
            start = static_equilibrium(model) if states is None else states[case]
            groups.setdefault(moving_states(model), {})[case] = np.asarray(start, dtype=float)
        except SimulationError as error:
            motions[case] = _failed(np.zeros(model.layout.states), error.reason)
    settings: dict[str, Any] = {"solver": solver, "max_steps": max_steps, "workers": workers}
    rtols = {"rtol": rtol, "fine_rtol": FINE * tolerance}
    for moving, starts in groups.items():
        begin = np.array(list(starts.values()))
        period_map = GearMap([models[case] for case in starts], begin, moving, **rtols, **settings)
        most = max(1, max_cycles // period_map.cycles)
        limits: dict[str, Any] = {"tolerance": tolerance, "max_periods": most, "method": method}
        orbits = find(period_map, begin[:, list(moving.states)], progress=progress, **limits)
        if method == "auto":
            _search_finely(period_map, orbits, tolerance, settings)
        motions |= zip(starts, sampled(period_map, orbits, samples), strict=True)
    return [motions[case] for case in range(len(models))]


def _search_finely(before: GearMap, orbits: list[Orbit], tolerance: float, settings: dict[str, Any]) -> None:
    """Seek once more, from where marching ended and more finely, what all but repeated."""
    noisy = [
        i
        for i, orbit in enumerate(orbits)
        if not orbit.period and orbit.kind != FAILED and orbit.residual <= NOISE
    ]
    if not noisy:
        return
    models, begin = [before.models[i] for i in noisy], np.array([orbits[i].last for i in noisy])
    rtol = {"rtol": FINE * tolerance, "fine_rtol": FINE**2 * tolerance}
    finest = GearMap(models, before.full(begin), before.kind, **rtol, **settings)
    most = max(1, ONCE_MORE // finest.cycles)
    finer = find(finest, begin, tolerance=tolerance, max_periods=most)
    for i, orbit in zip(noisy, finer, strict=True):
        if orbit.period and orbit.stable:
            orbits[i] = replace(orbit, cycles=orbits[i].cycles + orbit.cycles)


def refuse_time_dependent(model: Model) -> None:
    """Raise InputError where a run has clutches or a start, or a load that does not vary with the meshes.

    With a prescribed speed, harmonics at whole multiples of the frequency of the common period repeat with
    the meshes; that of a single mesh is the mesh frequency.
    """
    operation = model.operation
    if model.layout.clutches:
        rule, remedy = "slips, which is no steady state over the mesh cycle", "run the scenario in time"
        raise InputError("clutch", None, rule, remedy)
    if float(operation.start_slip) != 0.0:
        rule = "is of a run in time: a steady state has the speed that drive and load give it"
        raise InputError("operating.start_speed", None, rule, "leave it out, or run the scenario in time")
    torques = np.asarray(operation.load_torques)
    if len(torques) > 1 and np.ptp(torques) > 0.0:
        raise InputError(
            "operating.gear_torque_table",
            None,
            "a load that changes over time has no steady state over the mesh cycle",
            "omit the table, or run the scenario in time",
        )
    cycles = model.schedule.period
    period = cycles * float(operation.pitch_angle) / float(operation.nominal_speed)
    frequencies = np.asarray(operation.load_frequencies)[np.asarray(operation.load_amplitudes) != 0.0]
    for frequency in frequencies:
        orders = frequency * period / (2.0 * np.pi)
        if model.options.drive != DRIVE_SPEED or abs(orders - round(orders)) > 1e-9:
            over = "the mesh cycle" if cycles == 1 else f"the {cycles} cycles after which all meshes repeat"
            lowest = "the mesh frequency" if cycles == 1 else "the frequency of these"
            raise InputError(
                "operating.gear_torque_harmonics",
                f"{frequency:g} rad/s",
                f"does not repeat with the mesh, so that there is no steady state over {over}",
                f"take a whole multiple of {lowest} ({2.0 * np.pi / period:.6g} rad/s) with a prescribed "
                "speed, or run the scenario in time",
            )


def sampled(period_map: GearMap, orbits: list[Orbit], samples: int) -> list[SteadyMotion]:
    """Each orbit with its samples, marched once more over its period, or over some mesh cycles without."""
    wandering = max(1, WANDERING // period_map.cycles)
    periods = [0 if orbit.kind == FAILED else orbit.period or wandering for orbit in orbits]
    motions: dict[int, SteadyMotion] = {}
    for case, orbit in enumerate(orbits):
        state, last = period_map.full(np.array([orbit.state, orbit.last]))
        whole = vars(orbit) | {"state": state, "last": last}
        motions[case] = SteadyMotion(**whole, samples=np.empty((0, len(state))), end=state, extremes=None)
    for period in sorted({*periods} - {0}):
        cases = np.flatnonzero(np.array(periods) == period)
        states = np.array([motions[case].state for case in cases.tolist()])
        result = period_map.integrate(states, cases, period, samples, True, extremes=True)
        reasons = reasons_of(result.status, result.reached)
        for row, case in enumerate(cases.tolist()):
            if reasons[row]:
                motions[case] = _failed(states[row], reasons[row])
                continue
            window, end, extremes = result.samples[row], result.state[row], extremes_of(result.extremes, row)
            motions[case] = replace(motions[case], samples=window, end=end, extremes=extremes)
    return [motions[case] for case in range(len(orbits))]


def _failed(state: Float[Array, " state"], reason: str) -> SteadyMotion:
    orbit = failed_orbit(state, 0, reason)
    return SteadyMotion(**vars(orbit), samples=np.empty((0, len(state))), end=state, extremes=None)
