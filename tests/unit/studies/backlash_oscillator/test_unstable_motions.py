"""Unstable motions of the oscillator with backlash in its record, summary and figures."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tribodyn.record.reader import Record
from tribodyn.studies.pages import figure
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run

NAME = "backlash-oscillator"
ABOUT_THE_FOLDS = {"frequency": [0.65, 0.75, 0.9]}


@pytest.fixture(scope="module")
def record(tmp_path_factory):
    path = tmp_path_factory.mktemp("unstable") / "unstable.h5"
    assert run(load_scenario(NAME, ABOUT_THE_FOLDS | {"solver.unstable": True}), path).status == "complete"
    with Record(path) as opened:
        yield opened


def test_the_branch_leads_from_fold_to_fold(record):
    assert set(record["unstable_end"]) == {1, 2}
    for end in (0, 1):
        of_it = record["unstable_end"] == end + 1
        frequency = record["unstable_frequency"][of_it]
        assert frequency[0] == pytest.approx(record["end_frequency"][end], rel=1e-4)
        assert record["end_unstable_finish_frequency"][end] == pytest.approx(
            record["end_frequency"][1 - end], rel=1e-4
        )
        assert record["end_unstable_finish"][end] == record["end_kind"][end] == 1
        assert abs(np.sum(np.sign(np.diff(frequency)))) >= len(frequency) - 3
    assert np.all(record["unstable_multiplier_modulus"] > 1.0)
    assert np.all(record["unstable_residual"] <= 1e-7)
    assert np.all(record["unstable_period"] == 1)
    # at 0.75 both stable motions are there, and the unstable one between them
    number = int(np.argmin(np.abs(record["unstable_frequency"] - 0.75)))
    up, down = record["rms_displacement"][1]
    assert up < record["unstable_rms_displacement"][number] < down


def test_figures_are_those_of_the_motion(record):
    """Integrated by SciPy over the one period that it stays near the unstable motion."""
    case = load_scenario(NAME, ABOUT_THE_FOLDS)
    number = int(np.argmin(np.abs(record["unstable_frequency"] - 0.75)))
    frequency = record["unstable_frequency"][number]

    def rates(t, y):
        cosine = np.cos(frequency * t)
        force = y[0] - np.clip(y[0], -1.0, 1.0)
        push = case.mean_force + case.error_amplitude * frequency**2 * cosine
        return [y[1], push - 2.0 * case.damping * y[1] - (1.0 + case.stiffness_variation * cosine) * force]

    start = [record[f"unstable_section_{name}"][number] for name in ("displacement", "velocity")]
    t = np.linspace(0.0, 2.0 * np.pi / frequency, 40001)
    x = solve_ivp(rates, t[[0, -1]], start, "DOP853", t, rtol=1e-11, atol=1e-12, max_step=0.01).y[0]
    mean = np.trapezoid(x, t) / t[-1]
    rms = np.sqrt(np.trapezoid((x - mean) ** 2, t) / t[-1])
    assert record["unstable_rms_displacement"][number] == pytest.approx(rms, rel=1e-6)
    assert record["unstable_peak_to_peak_displacement"][number] == pytest.approx(np.ptp(x), rel=1e-6)
    lost = np.mean(np.abs(x[:-1]) < 1.0)
    assert lost > 0.05
    assert record["unstable_contact_loss_fraction"][number] == pytest.approx(lost, abs=1e-4)


def test_it_is_said_and_drawn(record):
    assert record.summary["unstable_1"].startswith("period 1 between 0.70")
    assert "fold at" in record.summary["unstable_1"]
    for name in ("response", "multipliers"):
        labels = [text.get_text() for text in figure(name, [record]).legends[0].get_texts()]
        assert "unstable" in labels


def test_nothing_of_it_is_there_unless_asked_for(tmp_path):
    run(load_scenario(NAME, ABOUT_THE_FOLDS), tmp_path / "plain.h5")
    with Record(tmp_path / "plain.h5") as plain:
        assert "unstable_frequency" not in plain
        assert "end_unstable_finish" not in plain
        assert not any(name.startswith("unstable") for name in plain.summary)


def test_where_no_branch_ends_there_is_none(tmp_path):
    run(load_scenario(NAME, {"frequency": [1.2, 1.3], "solver.unstable": True}), tmp_path / "none.h5")
    with Record(tmp_path / "none.h5") as none:
        assert "unstable_frequency" not in none
