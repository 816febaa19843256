"""A sweep of the oscillator with backlash: what its record and its summary hold, from a made-up response."""

from contextlib import contextmanager
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tribodyn.errors import SimulationError
from tribodyn.solve.branch.end import BranchEnd
from tribodyn.studies.backlash_oscillator import response as responding
from tribodyn.studies.backlash_oscillator import run as running
from tribodyn.studies.backlash_oscillator import unstable
from tribodyn.studies.backlash_oscillator.response import (
    CHAOTIC,
    DOWN,
    FAILED,
    QUASI_PERIODIC,
    STABLE,
    UP,
    Response,
)
from tribodyn.studies.backlash_oscillator.run import REMARKS, branches_apart, record_arrays, response_figures

FOLD = BranchEnd("fold", 0.8, 1e-5, 1, -0.6 + 0.8j)
DOUBLING = BranchEnd("period doubling", 0.7, 1e-5, 2, -1.01 + 0.0j)
RMS = np.array([[0.5, 0.5004], [0.6, 0.6007], [0.9, 0.7], [1.25, np.nan], [0.4, 0.4]])
KIND = np.array(
    [[STABLE, STABLE], [STABLE, STABLE], [STABLE, STABLE], [CHAOTIC, FAILED], [STABLE, QUASI_PERIODIC]]
)


def beyond(end: int, values: list[float], finish: BranchEnd | None) -> Any:
    count = len(values)
    branch: Any = SimpleNamespace(
        values=np.array(values),
        period=2,
        multipliers=np.array([[1.5j * one, 0.1] for one in range(1, count + 1)]),
        residuals=1e-9 * np.arange(1, count + 1),
        states=np.arange(2.0 * count).reshape(count, 2),
        finish=finish,
    )
    return unstable.Beyond(
        end, branch, np.array(values) * 2.0, np.array(values) * 3.0, np.array(values) / 10.0
    )


def response(**changed: Any) -> Response:
    free = np.array([[0.0, 0.0], [0.1, 0.0], [0.2, 0.0], [0.3, np.nan], [0.0, 0.0]])
    given: dict[str, Any] = {
        "frequency": np.array([0.5, 0.6, 0.7, 0.8, 0.9]),
        "rms": RMS,
        "peak_to_peak": RMS * 3.0,
        "mean": RMS + 1.0,
        "free": free,
        "back": free / 4.0,
        "period": np.array([[1, 1], [2, 1], [1, 1], [0, 0], [1, 0]]),
        "kind": KIND,
        "residual": np.array([[1.0, 2.0], [3.0, 4.0], [5.0, 6.0], [70.0, np.nan], [7.0, 80.0]]) * 1e-9,
        "multiplier": np.full((5, 2, 2), 3.0 + 4.0j),
        "displacement": RMS - 2.0,
        "velocity": RMS - 3.0,
        "messages": [(0.5, UP, "one"), (0.6, DOWN, "two"), (0.7, UP, "three"), (0.8, UP, "four")],
        "ends": [(UP, FOLD), (DOWN, DOUBLING)],
        "beyond": [beyond(1, [0.7, 0.75, 0.8], FOLD), beyond(0, [0.8, 0.85], None)],
    }
    return Response(**given | changed)


def test_figures_of_a_sweep():
    found = response_figures(response())
    assert (found["points"], found["points_failed"], found["points_chaotic"]) == (10, 1, 1)
    assert (found["points_quasi_periodic"], found["points_not_periodic"]) == (1, 2)
    assert found["points_of_longer_period"] == 1
    assert found["residual_max"] == pytest.approx(7e-9)
    assert (found["rms_max"], found["rms_max_frequency"]) == (1.25, 0.8)
    assert (found["contact_loss_fraction_max"], found["back_contact_fraction_max"]) == (0.3, 0.075)
    assert (found["contact_loss_from"], found["contact_loss_to"]) == (0.6, 0.8)
    # two thousandths apart at 0.6: 0.0007 of 0.6007; less at 0.5
    assert branches_apart(response()).tolist() == [False, True, True, False, False]
    assert (found["bistable_from"], found["bistable_to"]) == (0.6, 0.7)
    stable = response(kind=np.full((5, 2), STABLE), rms=np.array([[1.0, 1.0], *[[1.0, 2.0]] * 4]))
    assert [response_figures(stable)[f"bistable_{end}"] for end in ("from", "to")] == [0.6, 0.9]
    assert found["end_1"] == "fold of period 1 at 0.8, up"
    assert found["end_2"] == "period doubling of period 2 at 0.7, down"
    assert found["unstable_2"].startswith("period 2 between 0.7 and 0.8, multiplier at most 4.5: fold at 0.8")
    assert found["unstable_1"].endswith("multiplier at most 3: no end in the range")
    assert [found[f"remark_{number}"] for number in (1, 2, 3)] == [
        "frequency 0.5, up: one",
        "frequency 0.6, down: two",
        "frequency 0.7, up: three",
    ]
    assert found["remarks_more"] == 4 - REMARKS
    quiet = response_figures(
        response(free=np.zeros((5, 2)), rms=np.full((5, 2), np.nan), messages=[], ends=[], beyond=[])
    )
    assert not {"contact_loss_from", "rms_max", "bistable_from", "remarks_more", "end_1"} & quiet.keys()


def test_datasets_of_a_sweep():
    found = record_arrays(response())
    np.testing.assert_array_equal(found["period"], [[1, 1], [2, 1], [1, 1], [0, np.nan], [1, 0]])
    np.testing.assert_array_equal(found["stable"], [[1, 1], [1, 1], [1, 1], [0, np.nan], [1, 0]])
    np.testing.assert_allclose(found["multiplier_modulus"], 5.0)
    np.testing.assert_allclose(found["multiplier_angle"], np.arctan2(4.0, 3.0))
    for name, shift in (
        ("mean_displacement", 1.0),
        ("section_displacement", -2.0),
        ("section_velocity", -3.0),
    ):
        np.testing.assert_array_equal(found[name], RMS + shift)


def sweep(monkeypatch: pytest.MonkeyPatch, given: Response, unstably: bool) -> tuple[Any, list[Any]]:
    written: list[Any] = []

    class Writer:
        def write(self, at: int, values: Any) -> None:
            written.append((at, len(values["frequency"])))

        def put(self, row: int, values: Any) -> None:
            written.append((row, values))

        def fail(self, message: str, summary: Any) -> str:
            written.append(message)
            return "path"

        def finish(self, summary: Any) -> str:
            written.append("finished")
            return "path"

    @contextmanager
    def writer(case: Any, path: Any, layout: Any, samples: int, scales: Any, force: bool) -> Any:
        written.append((layout, samples, {name: one.tolist() for name, one in scales.items()}))
        yield Writer()

    monkeypatch.setattr(running, "target", lambda *_: "path")
    monkeypatch.setattr(running, "writer", writer)
    monkeypatch.setattr(running, "frequency_response", lambda case, progress=None: given)
    return running.run(SimpleNamespace(unstable=unstably)), written  # pyright: ignore[reportArgumentType]


def test_the_record_of_a_sweep(monkeypatch: pytest.MonkeyPatch):
    made, (head, block, *rows, last) = sweep(monkeypatch, response(), True)
    assert (made.status, last) == ("complete", "finished")
    layout, samples, scales = head
    assert layout is running.LAYOUT_WITH_UNSTABLE
    assert samples == 5
    assert block == (0, 5)
    assert scales == {
        "direction": ["up", "down"], "multiplier": [1, 2], "end": [1, 2], "unstable": [1, 2, 3, 4, 5]
    }  # fmt: skip
    first, second, finish, none, *motions = rows
    assert (first[0], second[0]) == (0, 1)
    assert first[1]["end_kind"] == 1 + running.KINDS.index("fold")
    assert (first[1]["end_direction"], second[1]["end_direction"]) == (UP, DOWN)
    assert (first[1]["end_frequency"], first[1]["end_within"], second[1]["end_period"]) == (0.8, 1e-5, 2)
    assert first[1]["end_multiplier_modulus"] == pytest.approx(1.0)
    assert first[1]["end_multiplier_angle"] == pytest.approx(np.arctan2(0.8, -0.6))
    assert finish == (1, {"end_unstable_finish": 1, "end_unstable_finish_frequency": 0.8})
    assert none == (0, {})
    assert [row for row, _ in motions] == [0, 1, 2, 3, 4]
    assert [of["unstable_end"] for _, of in motions] == [2, 2, 2, 1, 1]
    assert [of["unstable_frequency"] for _, of in motions] == [0.7, 0.75, 0.8, 0.8, 0.85]
    third = motions[2][1]
    assert third["unstable_multiplier_modulus"] == pytest.approx(4.5)
    assert third["unstable_multiplier_angle"] == pytest.approx(np.pi / 2.0)
    assert (third["unstable_section_displacement"], third["unstable_section_velocity"]) == (4.0, 5.0)
    assert (third["unstable_residual"], third["unstable_period"]) == (pytest.approx(3e-9), 2)
    assert third["unstable_rms_displacement"] == 1.6
    plain, (head, *_) = sweep(monkeypatch, response(ends=[], beyond=[]), False)
    assert head[0] is running.LAYOUT
    assert set(head[2]) == {"direction", "multiplier"}
    assert plain.status == "complete"


def test_a_sweep_fails_where_no_frequency_has_a_motion(monkeypatch: pytest.MonkeyPatch):
    gone = response(kind=np.full((5, 2), FAILED))
    made, written = sweep(monkeypatch, gone, False)
    assert (made.status, made.message, written[-1]) == ("failed", "one", "one")
    with pytest.raises(SimulationError, match="one"):
        running.figures(SimpleNamespace())  # pyright: ignore[reportArgumentType]
    monkeypatch.setattr(running, "frequency_response", lambda case: response())
    assert running.figures(SimpleNamespace())["points"] == 10  # pyright: ignore[reportArgumentType]


def test_unstable_motions_are_measured_over_their_periods():
    """Means over two periods of the excitation each; the root mean square is about the mean."""
    figures = np.zeros((2, 6))
    figures[:, unstable.INTEGRAL], figures[:, unstable.SQUARE] = (4.0, 2.0), (9.0, 0.1)
    figures[:, unstable.MAXIMUM], figures[:, unstable.MINIMUM], figures[:, unstable.FREE] = 2.5, -1.0, 3.0
    branch = beyond(0, [0.8, 1.6], None).branch
    asked: list[Any] = []

    def of(states: np.ndarray, cases: np.ndarray, periods: int) -> np.ndarray:
        asked.append((states is branch.states, cases.tolist(), periods))
        return figures

    oscillator: Any = SimpleNamespace(figures=of)
    found = unstable.measured(3, branch, oscillator)
    assert asked == [(True, [0, 1], 2)]
    for k, frequency in enumerate((0.8, 1.6)):
        duration = 2.0 * 2.0 * np.pi / frequency
        mean = (4.0, 2.0)[k] / duration
        variance = max((9.0, 0.1)[k] / duration - mean**2, 0.0)
        assert found.rms[k] == pytest.approx(variance**0.5)
        assert found.free[k] == pytest.approx(3.0 / duration)
        assert found.peak_to_peak[k] == 3.5


def test_branches_go_on_over_the_whole_range(monkeypatch: pytest.MonkeyPatch):
    """Those of a leg stand behind the ends that were met before it; one that is lost leaves its place."""
    given = response(beyond=[])
    asked: list[Any] = []

    def branches(family: Any, direction: int, seeds: Any, span: Any) -> Any:
        asked.append((direction, seeds, span))
        return ["first", None, "third"]

    branch = SimpleNamespace(values="frequencies")
    monkeypatch.setattr(
        responding, "unstable_branches", lambda *of: [one and branch for one in branches(*of)]
    )
    monkeypatch.setattr(responding, "oscillator_at", lambda case, values: (case, values))
    monkeypatch.setattr(responding, "measured", lambda *of: of)
    family: Any = SimpleNamespace(case="case")
    arrival: Any = SimpleNamespace(seeds="seeds")
    responding._go_on(given, family, DOWN, arrival)
    assert asked == [(DOWN, "seeds", (0.5, 0.9))]
    oscillator = ("case", "frequencies")
    assert given.beyond == [(2, branch, oscillator), (4, branch, oscillator)]
