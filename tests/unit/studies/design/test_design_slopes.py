"""Slopes of objectives and margins: the chain rule over duties and samples, and JAX against differences."""

from typing import Any

import numpy as np
import pytest

from tribodyn.studies.design.candidates.candidates import cases_of, chosen
from tribodyn.studies.design.candidates.evaluation import evaluate
from tribodyn.studies.design.candidates.scoring import Scoring, derivatives_of
from tribodyn.studies.design.scenario import loaded_search

F, G = "efficiency", "contact_ratio"
FREE = [{"key": f"drive.{side}.profile_shift", "from": -1.0, "to": 1.0} for side in ("pinion", "gear")]
TOLERANCE = {"key": "operating.gear_torque", "plus_minus": "10 N*m"}
#: Coefficients of figures that are linear in two keys, at two duties and three samples.
LINEAR = np.random.default_rng(3).normal(size=(2, 2, 3, 3))


def figures(x: np.ndarray) -> list[dict[str, float]]:
    rows = LINEAR[..., 0] + LINEAR[..., 1:] @ x
    return [{F: float(rows[0, i, j]), G: float(rows[1, i, j])} for i in range(2) for j in range(3)]


@pytest.mark.parametrize("over", ["mean", "worst", "quantile"])
@pytest.mark.parametrize("over_duties", ["mean", "worst"])
@pytest.mark.parametrize("weighted", [False, True])
def test_the_chain_rule(over: str, over_duties: str, weighted: bool):
    terms = [{"quantity": F, "weight": -2.0}, {"quantity": G, "weight": 1.0}]
    design = {
        "free": FREE,
        "minimise": terms if weighted else G,
        "subject_to": [f"{F} >= 0.3", f"{G} <= 0.5"],
        "over_duties": over_duties,
        "duty": [{"set": {"operating.pinion_speed": f"{n} rpm"}, "weight": n} for n in (1.0, 2.0)],
        "tolerance": [TOLERANCE],
        "robust": {"over": over, "samples": 3, "quantile": 0.5},
    }
    case = loaded_search("efficiency-involute-18-36", design, {}).case
    scoring = Scoring(case, figures(np.zeros(2)))
    x, step = np.array([0.3, -0.2]), 1e-6
    slopes: Any = [[{F: LINEAR[0, i, j, 1:], G: LINEAR[1, i, j, 1:]} for j in range(3)] for i in range(2)]
    around = [(scoring.score(figures(x + e)), scoring.score(figures(x - e))) for e in step * np.eye(2)]
    expected = [(up.objectives[0] - down.objectives[0]) / (2 * step) for up, down in around]
    found = scoring.objective_slope(case.objectives[0], figures(x), slopes)
    np.testing.assert_allclose(found, expected, rtol=1e-6)
    for place, constraint in enumerate(case.constraints):
        expected = [(up.margins[place] - down.margins[place]) / (2 * step) for up, down in around]
        np.testing.assert_allclose(scoring.margin_slope(constraint, figures(x), slopes), expected, rtol=1e-6)


@pytest.mark.parametrize(
    ("scenario", "quantity", "key"),
    [
        ("involute-18-36", "dynamic_factor", "drive.pinion.profile_shift"),
        ("load-contact-18-36", "peak_to_peak", "drive.pinion.profile_shift"),
        ("efficiency-involute-18-36", "specific_sliding_max", "drive.pinion.profile_shift"),
    ],
)
def test_what_cannot_be_differentiated(scenario: str, quantity: str, key: str):
    free = [{"key": key, "from": -0.1, "to": 0.1}]
    assert derivatives_of(loaded_search(scenario, {"free": free, "minimise": quantity}, {}).case) is None


@pytest.mark.soak
@pytest.mark.parametrize("scenario", ["efficiency-involute-18-36", "efficiency-cycloidal-23-47"])
def test_jax_agrees_with_differences(scenario: str):
    keys = ("drive.pinion.addendum", "drive.gear.addendum")
    free = [{"key": key, "from": 0.8, "to": 1.05} for key in keys]
    bounds = ["contact_ratio >= 1.2", "hertz_pressure_max <= 1 GPa"]
    design = {"free": free, "minimise": "loss", "subject_to": bounds}
    case = loaded_search(scenario, design, {"output.samples_per_cycle": 200}).case

    def found(x: np.ndarray) -> Any:
        return evaluate(case.scenarios, cases_of(case, chosen(case, x)))

    scoring, x, step = Scoring(case, evaluate(case.scenarios, cases_of(case, {}))), np.array([0.5, 0.4]), 2e-3
    derivatives = derivatives_of(case)
    assert derivatives is not None
    slopes = derivatives.at(x)
    around = [(scoring.score(found(x + e)), scoring.score(found(x - e))) for e in step * np.eye(2)]
    value = scoring.objective_slope(case.objectives[0], found(x), slopes)
    np.testing.assert_allclose(
        value, [(up.objectives[0] - down.objectives[0]) / (2 * step) for up, down in around], rtol=1e-2
    )
    for place, constraint in enumerate(case.constraints):
        margin = scoring.margin_slope(constraint, found(x), slopes)
        expected = [(up.margins[place] - down.margins[place]) / (2 * step) for up, down in around]
        # samples do not meet the narrow peak of a cycloid's pressure at the pitch point to the last digit
        np.testing.assert_allclose(margin, expected, rtol=1e-3, atol=5e-3, err_msg=constraint.text)
