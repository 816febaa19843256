"""Periodic steady states over the speed: the sweep of the command line, and LSODA marching to the same.

An expert would march every speed with SciPy's LSODA on the compiled right-hand side until the motion repeats.
LSODA is given beforehand how many mesh cycles that takes: those after which the change over one period is
within TOLERANCE by the sweep's own measure, found by marching at a tight tolerance. It gets the loosest
tolerance with which its transmission error is as exact as the single runs are required to be.
"""

from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time
from typing import Any, NamedTuple

import numpy as np

from tools.marked_block import table as table_of
from tribodyn.dynamics.parameters import Model
from tribodyn.grid.engines import LocalEngine
from tribodyn.grid.grid import Grid
from tribodyn.grid.run import run, settings_of
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.orbit.gear_map import GearMap, moving_states
from tribodyn.solve.tolerances import tolerances_from
from tribodyn.solve.transient import make_integrator
from tribodyn.studies.motion.batch import MOST_CYCLES
from tribodyn.studies.motion.prepare import prepare
from tribodyn.train.structure import rotational_error

Array = Any

SCENARIO, SPEEDS = "crc-23-47-300", "100:600"  # rad/s
#: Speeds of the comparison, every how many LSODA takes one, and the damping ratios.
COUNT, EVERY = 256, 16
DAMPING = (0.05, 0.01)
#: Maximum scaled change over a period: what `steady_states` asks for.
TOLERANCE = 1e-7
#: StepTolerances of LSODA, the loosest first.
LSODA_RTOL = (1e-6, 3e-7, 1e-7, 3e-8)
#: Mesh cycles that LSODA really marches at one speed; what is beyond is taken in proportion.
MOST_MARCHED = 200
PERIODS = (1, 2, 3, 4)


class Ours(NamedTuple):
    """Results of the sweep."""

    seconds: float  # of the processor, all threads, from the grid to the file
    residual: float  # maximum over the periodic states
    solutions: dict[str, int]  # sort of motion -> number of speeds
    windows: Array  # (speeds, samples): transmission error over the window, m
    cycles: Array  # (speeds,): mesh cycles marched


class Theirs(NamedTuple):
    """Results of LSODA at some of the speeds."""

    seconds: Array  # (speeds,), of the processor
    cycles: Array  # (speeds,): mesh cycles marched
    error: float  # maximum error of the transmission error over its range
    sweep_error: float  # that of the sweep


def grid(damping: float, count: int) -> Grid:
    """The speeds of the comparison."""
    vary = f"operating.pinion_speed={SPEEDS}/{count}rad/s"
    return Grid(SCENARIO, [vary], {"mesh.damping_ratio": damping})


def sweep(speeds: Grid, workers: int | None = None) -> Ours:
    """What `tribodyn sweep --steady` does, file included."""
    with TemporaryDirectory() as folder:
        begun = process_time()
        result = run(speeds, settings_of(speeds), LocalEngine(workers), Path(folder) / "steady.h5")
        seconds = process_time() - begun
        with SweepRecord(result.path) as record:
            names, counts = np.unique(record["solution"], return_counts=True)
            return Ours(
                seconds,
                float(np.nanmax(np.where(record["period"] > 0, record["residual"], np.nan))),
                dict(zip(map(str, names), map(int, counts), strict=True)),
                record["transmission_error_rotational"],
                record["cycles"],
            )


def lsoda(speeds: Grid, numbers: list[int], ours: Ours, target: float) -> Theirs:
    """LSODA from the same start at some of the speeds, one after the other.

    At the loosest tolerance of LSODA_RTOL with which its last cycle is within `target` of a march at 1e-11;
    at the tightest if none is.
    """
    models = [prepare(case).model for case in (speeds.case((i,)) for i in numbers)]
    starts = np.array([static_equilibrium(model) for model in models])
    needed = cycles_needed(models, starts)
    marched = np.minimum(needed, MOST_MARCHED)
    samples = speeds.base.output.samples_per_cycle

    def march(method: str, rtol: float) -> tuple[Array, Array]:
        """Transmission error over each last cycle, and processor seconds."""
        windows, seconds = [], []
        for model, start, cycles in zip(models, starts, map(int, marched), strict=True):
            tolerances = tolerances_from(model, start, rtol, 10**6)
            integrator = make_integrator(method, model, samples, tolerances)
            begun = process_time()
            part = integrator.integrate(start, 0, cycles)
            seconds.append(process_time() - begun)
            windows.append(rotational_error(part.samples[-samples:], 0, model))
        return np.array(windows), np.array(seconds)

    exact, _ = march("dopri5", 1e-11)
    whole = marched == needed

    def error(windows: Array) -> float:
        shares = np.max(np.abs(windows - exact), axis=1) / np.ptp(exact, axis=1)
        return float(np.max(shares[whole]))

    windows, seconds = march("lsoda", LSODA_RTOL[0])
    for rtol in LSODA_RTOL[1:]:
        if error(windows) <= target:
            break
        windows, seconds = march("lsoda", rtol)
    return Theirs(seconds * needed / marched, needed, error(windows), error(ours.windows[numbers, :samples]))


def share(ours: Ours, theirs: Theirs) -> float:
    """Processor time of the sweep over that of LSODA at all its speeds."""
    return ours.seconds / (float(np.mean(theirs.seconds)) * len(ours.cycles))


def table(repeats: int, target: float) -> str:
    """Table of both at each damping; the sweep's medians, LSODA once at every sixteenth speed."""
    sweep(grid(DAMPING[0], EVERY))  # compiles
    lsoda(grid(DAMPING[0], 2), [0], sweep(grid(DAMPING[0], 2)), target)
    head = ["damping ratio", "program", "mesh cycles per speed, median (maximum)", "error"]
    head += ["s of one core", "share"]
    rows, remarks = [], []
    for damping in DAMPING:
        speeds = grid(damping, COUNT)
        runs = sorted((sweep(speeds) for _ in range(repeats)), key=lambda run: run.seconds)
        ours = runs[len(runs) // 2]
        theirs = lsoda(speeds, list(range(EVERY // 2, COUNT, EVERY)), ours, target)
        missed = max(theirs.error, theirs.sweep_error) > target
        ratio = f"misses {target:.0e}" if missed else f"{100 * share(ours, theirs):.2g} %"
        for name, result, error, seconds, share_of in (
            ("tribodyn sweep --steady", ours, theirs.sweep_error, ours.seconds, ratio),
            ("SciPy LSODA, numba, marching", theirs, theirs.error, np.mean(theirs.seconds) * COUNT, "100 %"),
        ):
            cycles = f"{np.median(result.cycles):.0f} ({np.max(result.cycles):.0f})"
            rows.append([f"{damping:g}", name, cycles, f"{error:.1e}", f"{seconds:.3g}", share_of])
        kinds = ", ".join(f"{number} {kind}" for kind, number in ours.solutions.items())
        remarks.append(f"at {damping:g}: {kinds}; residual of the periodic ones at most {ours.residual:.0e}")
        print(*rows[-2:], remarks[-1], sep="\n", flush=True)
    lines = table_of(head, rows, "rlrrrr")
    return f"{lines}\n\n{COUNT} speeds from 100 to 600 rad/s; {'; '.join(remarks)};"


def cycles_needed(models: list[Model], starts: Array) -> Array:
    """Mesh cycles after which each motion repeats within TOLERANCE, at most as many as the sweep takes."""
    moving = moving_states(models[0])
    period_map = GearMap(
        models, starts, moving, solver="dopri5", rtol=1e-9, fine_rtol=1e-9, max_steps=10**6, workers=None
    )
    needed = np.full(len(models), MOST_CYCLES)
    way = starts[:, None, list(moving.states)]
    open_cases, before = np.arange(len(models)), 0
    while open_cases.size and before < MOST_CYCLES:
        on = period_map.march(way[:, -1], open_cases, 50, True).states
        way = np.concatenate([way[:, -max(PERIODS) :], on], axis=1)
        kept = way.shape[1] - on.shape[1]
        change = np.array(
            [
                np.abs(on - way[:, kept - p : way.shape[1] - p]) if p <= kept else np.full(on.shape, np.inf)
                for p in PERIODS
            ]
        )
        closed = np.min(np.max(change / period_map.scale[open_cases][:, None], axis=-1), axis=0) <= TOLERANCE
        done = closed.any(axis=1)
        needed[open_cases[done]] = before + 1 + closed[done].argmax(axis=1)
        open_cases, way, before = open_cases[~done], way[~done], before + on.shape[1]
    return np.minimum(needed, MOST_CYCLES)
