"""Followed sweeps of random drives, up and down, against marching from neighbour to neighbour by SciPy."""

from pathlib import Path

import numpy as np
import pytest

from tests.support.foreign_marching import Compared, Reported, compared, gear_march, oscillator_march
from tribodyn.gears.tabulated import tables
from tribodyn.grid.engines import LocalEngine
from tribodyn.grid.grid import Grid
from tribodyn.grid.run import run, settings_of
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.record.sweep_schema import DIRECTIONS, DONE
from tribodyn.solve.orbit.gear_map import moving_states
from tribodyn.solve.tolerances import state_scales
from tribodyn.studies.backlash_oscillator.response import FAILED, frequency_response
from tribodyn.studies.backlash_oscillator.scenario import BacklashOscillatorCase
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.load import load_scenario

SEED, OSCILLATORS, GEARS = 12, 12, 8
#: Change over a period, over the size, that the foreign integrator may see in a motion with a period. Where
#: contact opens and closes the package's own integration is a few hundred times its 1e-9 off.
CLOSES = 1e-5

ROWS: dict[str, list[Compared]] = {}


def drawn(rng: np.random.Generator, count: int, points: int) -> list[tuple[int, int]]:
    """Places along the sweep and directions, no place without a neighbour behind it."""
    every = [(place, way) for place in range(count) for way in (0, 1) if 0 <= place - 1 + 2 * way < count]
    return [every[i] for i in rng.choice(len(every), points, replace=False)]


def said(name: str, rows: list[Compared]) -> str:
    """A line of the table."""
    words = ("same", "no period", "behind an end", "differs")
    counts = "  ".join(f"{sum(row.verdict == word for row in rows):3d} {word}" for word in words)
    same = [row for row in rows if row.verdict == "same"]
    closes, away = (max((getattr(row, key) for row in same), default=0.0) for key in ("closes", "away"))
    several = f"{sum(row.period > 1 for row in rows):3d} of several periods"
    return f"{name:34s} {len(rows):3d} points: {counts}  {several}  closes {closes:.1e}  away {away:.1e}"


def judged(name: str, rows: list[Compared]) -> None:
    ROWS[name] = rows
    print(said(name, rows), flush=True)
    assert all(row.verdict != "differs" for row in rows), rows
    assert max((row.closes for row in rows if row.verdict == "same"), default=0.0) <= CLOSES


@pytest.mark.soak
@pytest.mark.parametrize("number", range(OSCILLATORS))
def test_an_oscillator(number: int):
    rng = np.random.default_rng([SEED, number])
    damping, mean = rng.uniform(0.02, 0.06), rng.uniform(0.05, 0.3)
    error, variation = rng.uniform(0.0, 0.1), rng.uniform(0.0, 0.5)
    frequencies = tuple(map(float, np.round(np.arange(0.5, 2.2, 0.05), 6)))
    given = damping, mean, error, variation
    response = frequency_response(BacklashOscillatorCase("", "", "", "", "", *given, frequencies))

    def march(value: float, state: np.ndarray, periods: int) -> np.ndarray:
        return oscillator_march((*given, value), state, periods, rtol=1e-10, max_step=0.2)

    def reported(place: int, way: int) -> Reported:
        state = np.array([response.section_displacement[place, way], response.section_velocity[place, way]])
        return Reported(frequencies[place], state, int(response.period[place, way]))

    rows = []
    for place, way in drawn(rng, len(frequencies), 12):
        behind = place - 1 + 2 * way
        if FAILED in (response.motion[place, way], response.motion[behind, way]):
            continue
        ends = [end.value for direction, end in response.ends if direction == way]
        rows.append(compared(march, reported(behind, way), reported(place, way), ends))
        if rows[-1].verdict == "differs":
            print(frequencies[place], DIRECTIONS[way], response.period[place, way], rows[-1], ends)
    judged(f"oscillator ζ {damping:.3f} F {mean:.2f} {error:.3f} ε {variation:.2f}", rows)


@pytest.mark.soak
@pytest.mark.parametrize("number", range(GEARS))
def test_a_gear_pair(number: int, tmp_path: Path):
    rng = np.random.default_rng([SEED, 1000 + number])
    name = str(rng.choice(["crc-23-47", "involute-23-47"]))
    overrides = {
        "mesh.damping_ratio": round(float(rng.uniform(0.008, 0.03)), 4),
        "operating.gear_torque": f"{rng.uniform(50.0, 200.0):.0f} N*m",
        "output.samples_per_cycle": 20,
    }
    overrides |= {"friction.law": "none"} if rng.random() < 0.7 else {}
    stiffness = f"{rng.uniform(2.4e8, 3.2e8):.3g} N/m"
    overrides |= {"mesh.compliance": "constant", "mesh.stiffness": stiffness} if rng.random() < 0.5 else {}
    # about the resonance of the mesh, where motions jump, or twice its frequency, where periods double
    first = float(np.round(rng.uniform(380.0, 480.0) * (1 + rng.integers(2))))
    grid = Grid(name, [f"operating.pinion_speed={first}:{1.12 * first}/9rad/s"], overrides)
    result = run(grid, settings_of(grid), LocalEngine(2), tmp_path / "sweep.h5", directions=DIRECTIONS)
    speeds = list(grid.axes[0].values)
    mesh = tables(load_scenario(name, {**overrides, "operating.pinion_speed": f"{first} rad/s"}).pair)

    def model_at(value: float):
        case = load_scenario(name, {**overrides, "operating.pinion_speed": f"{value!r} rad/s"})
        return prepare(case, (mesh,)).model

    with SweepRecord(result.path) as record:
        states, period, status = record["state"], record["period"], record["status"]
        located = [record["end_value"][:, way].ravel() for way in (0, 1)]
    model = model_at(first)
    moving = moving_states(model).states
    scale = state_scales(model, states[0, 0])

    def march(value: float, state: np.ndarray, cycles: int) -> np.ndarray:
        full = np.zeros(len(scale))
        full[list(moving)] = state * scale[list(moving)]
        return (gear_march(model_at(value), full, cycles, 1e-9 * scale) / scale)[:, list(moving)]

    def reported(place: int, way: int) -> Reported:
        state = (states[place, way] / scale)[list(moving)]
        return Reported(float(speeds[place]), state, int(period[place, way]))

    rows = []
    for place, way in drawn(rng, len(speeds), 10):
        behind = place - 1 + 2 * way
        if status[place, way] != DONE or status[behind, way] != DONE:
            continue
        ends = [float(value) for value in located[way] if np.isfinite(value)]
        rows.append(compared(march, reported(behind, way), reported(place, way), ends))
        if rows[-1].verdict == "differs":
            print(speeds[place], DIRECTIONS[way], period[place, way], rows[-1], ends)
    friction = "dry" if "friction.law" in overrides else "film"
    judged(f"{name} {first:.0f} rad/s {overrides['operating.gear_torque']} {friction}", rows)


@pytest.mark.soak
def test_they_are_many():
    rows = [row for rows in ROWS.values() for row in rows]
    print(said(f"all {len(ROWS)}", rows))
    assert len(ROWS) >= 10
    assert len(rows) >= 200
