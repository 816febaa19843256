"""Scenario, record, summary and figures of the oscillator with backlash."""

import numpy as np
import pytest

from tribodyn.record.reader import Record
from tribodyn.studies.pages import figure, names
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run

NAME = "backlash-oscillator"
COARSE = {"frequency.step": 0.02}


@pytest.fixture(scope="module")
def record(tmp_path_factory):
    path = tmp_path_factory.mktemp("sweep") / "coarse.h5"
    result = run(load_scenario(NAME, COARSE), path)
    assert result.status == "complete"
    with Record(path) as opened:
        yield opened


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        ([0.5, 0.6, 2.0], (0.5, 0.6, 2.0)),
        ({"from": 0.5, "to": 0.8, "step": 0.1}, (0.5, 0.6, 0.7, 0.8)),
        ({"from": 0.5, "to": 0.75, "step": 0.1}, (0.5, 0.6, 0.7, 0.75)),
    ],
)
def test_frequencies_are_a_list_or_a_range(given, expected):
    case = load_scenario(NAME, {"frequency": given})
    assert case.frequencies == pytest.approx(expected, abs=1e-12)
    assert case.frequencies[-1] == expected[-1]


def test_the_summary_tells_the_jumps(record):
    summary = record.summary
    assert summary["points"] == 142
    assert summary["points_not_periodic"] == summary["points_failed"] == 0
    assert summary["residual_max"] <= 1e-7
    # harmonic balance: folds at 0.7079 and 0.8285
    assert summary["bistable_from"] == pytest.approx(0.7079, abs=0.02)
    assert summary["bistable_to"] == pytest.approx(0.8285, abs=0.02)
    assert summary["contact_loss_from"] == pytest.approx(summary["bistable_from"], abs=1e-9)


@pytest.mark.parametrize("name", ["response", "multipliers", "overview"])
def test_figures_show_every_point(record, name):
    drawn = figure(name, [record])
    assert names([record]) == ("response", "multipliers")
    assert drawn.axes[-1].get_xlabel().startswith("Frequency")
    line = drawn.axes[0].get_lines()[-1 if name == "multipliers" else 1]
    assert np.sum(np.isfinite(np.asarray(line.get_xdata(), dtype=float))) >= 2
    if name != "multipliers":
        arrows = [text for text in drawn.axes[0].texts if text.arrowprops and not text.get_text()]
        assert len(arrows) == 2  # one jump up, one down
        (up, _), (down, _) = sorted((text.xy for text in arrows), reverse=True)
        assert up == pytest.approx(0.84, abs=1e-9)
        assert down == pytest.approx(0.70, abs=1e-9)


def test_two_records_share_a_figure(record):
    drawn = figure("response", [record, record])
    assert len({line.get_color() for line in drawn.axes[0].get_lines() if line.get_linewidth() < 4}) == 2


def test_the_summary_counts_points_of_longer_period(tmp_path):
    """Of a varying stiffness near twice the natural frequency; its motions have the period 1 or 2."""
    varying = {"error_amplitude": 0.0, "stiffness_variation": 0.3, "frequency": [1.7, 1.8, 1.9]}
    result = run(load_scenario(NAME, {"damping": 0.05, "mean_force": 0.1, **varying}), tmp_path / "two.h5")
    with Record(result.path) as found:
        periods = found["period"]
    assert np.unique(periods).tolist() == [1, 2]
    assert result.summary["points_of_longer_period"] == np.sum(periods == 2)
