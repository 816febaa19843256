"""Order tracking: amplitudes of lines that are known, at a speed that is known."""

import types
from pathlib import Path

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.post.figures.spectrum import HOP, MOST_HOPPED, WINDOW, track, worth_tracking
from tribodyn.record.reader import Record
from tribodyn.studies.pages import figure

TEETH, PER_CYCLE, CYCLES = 20, 32, 120
PITCH = 2 * np.pi / TEETH


class RunUp(types.SimpleNamespace):
    """A run whose speed rises linearly in the phase, with orders 1 and 2.5 in its transmission error."""

    names_meshes, meshes = False, ("mesh",)
    over_meshes, over_bodies, of_mesh = Record.over_meshes, Record.over_bodies, Record.of_mesh
    refused = Record.refused

    def __init__(self, cycles: int = CYCLES, rise: float = 1.0):
        phase = np.arange(cycles * PER_CYCLE + 1) / PER_CYCLE
        speed = 100.0 * (1 + rise * phase / cycles)
        error = 5e-6 + 3e-6 * np.cos(2 * np.pi * phase + 0.3) + 1e-6 * np.sin(5 * np.pi * phase)
        self.data = {
            "pinion_angle": phase * PITCH,
            "time": np.concatenate([[0.0], np.cumsum(2 * PITCH / PER_CYCLE / (speed[1:] + speed[:-1]))]),
            "velocity": np.stack([speed, speed], axis=1),
            "dof": np.array(["theta_p", "theta_g"]),
            "transmission_error_rotational": error,
        }
        super().__init__(
            samples=phase.size,
            mesh_cycle={"pinion_teeth": TEETH},
            _group={"mesh_cycle": {"pinion_teeth": TEETH}}.get,
            kind="gear-pair",
            path=Path("run-up.h5"),
            label="run-up",
            scenario={"title": "Run-up"},
            summary={"cycles_done": float(cycles)},
            status="complete",
            trust="",
        )

    def __contains__(self, name: str) -> bool:
        return name in self.data

    def __getitem__(self, name: str) -> np.ndarray:
        return self.data[name]

    def dims_of(self, name: str) -> tuple[str, ...]:
        return ("time",)


def test_lines_have_the_amplitudes_of_their_cosines():
    found = track(RunUp())  # type: ignore[arg-type]
    near = {order: found.amplitudes[:, round(order * WINDOW)] for order in (1, 2.5, 4)}
    np.testing.assert_allclose(near[1], 3e-6, rtol=1e-9)
    np.testing.assert_allclose(near[2.5], 1e-6, rtol=1e-9)
    assert np.max(near[4]) < 1e-15


def test_speeds_are_those_in_the_middle_of_the_windows():
    """Of a linear rise the mean is the middle's."""
    found = track(RunUp())  # type: ignore[arg-type]
    # at least a mesh cycle apart, and so close that there are sixty where that is possible
    hop = max(1, min(HOP, (CYCLES - WINDOW) // MOST_HOPPED))
    middle = WINDOW / 2 + hop * np.arange(len(found.speed)) - 0.5 / PER_CYCLE
    np.testing.assert_allclose(found.speed, 100 * (1 + middle / CYCLES), rtol=1e-12)
    assert np.all(np.diff(found.time) > 0)


@pytest.mark.parametrize(
    ("record", "answer"), [(RunUp(), True), (RunUp(rise=0.01), False), (RunUp(20), False)]
)
def test_only_long_runs_at_changing_speed_are_tracked_unasked(record, answer: bool):
    assert worth_tracking(record) is answer


@pytest.mark.parametrize("against", ["phase", "time"])
def test_the_figure_has_a_map_and_the_orders(against: str):
    drawn = figure("orders", [RunUp()], against=against)  # type: ignore[list-item]
    above, below = drawn.axes[:2]
    assert above.get_ylabel().startswith("Order")
    assert [line.get_label() for line in below.lines] == [f"order {n}" for n in (1, 2, 3, 4)]
    assert below.get_xlabel() == ("Time (ms)" if against == "time" else "Pinion speed (rpm)")


def test_a_short_run_is_refused():
    with pytest.raises(InputError, match="too few to track orders"):
        figure("orders", [RunUp(20)])  # type: ignore[list-item]


def test_the_cycles_that_were_run_count_beside_those_that_are_kept():
    """Of a run by revolutions the record keeps the last one, and cycles have no effect."""
    record = RunUp(TEETH)
    record.scenario["solver"] = {"revolutions": 4, "cycles": 20}
    record.summary["cycles_done"] = 4.0 * TEETH
    with pytest.raises(
        InputError, match=f"holds {TEETH} mesh cycles of the {4 * TEETH} that were run"
    ) as found:
        figure("orders", [record])  # type: ignore[list-item]
    assert found.value.remedy == 'keep all samples: output.window = "all"'
    record.scenario["solver"] = {"revolutions": 1}
    record.summary["cycles_done"] = 1.0 * TEETH
    with pytest.raises(InputError, match=f"holds {TEETH} mesh cycles, too few") as found:
        figure("orders", [record])  # type: ignore[list-item]
    assert found.value.remedy == (
        'run at least 32: solver.revolutions = 40, and keep all samples: output.window = "all"'
    )


def test_orders_of_a_falling_speed_are_over_time():
    drawn = figure("orders", [RunUp(rise=-0.5)])  # type: ignore[list-item]
    assert drawn.axes[1].get_xlabel() == "Time (ms)"
