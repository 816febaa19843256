"""Derivatives of trains by their scenario's numbers: central differences of other scenarios, closed forms."""

import numpy as np
import pytest

import tribodyn as td
from tribodyn.derivatives.differentiable import fixed_of
from tribodyn.derivatives.quantities import PairEvaluation, quantity_of

REDUCER, IDLER = "two-stage-reducer", "idler-train"
#: Units in which keys are written, by the end of their names.
WRITTEN = {"module": "m", "face_width": "m", "output_torque": "N*m", "input_speed": "rad/s"}


def of_mesh(case, name):
    """A quantity of a mesh of a case, worked out of its pair without a compiled program."""
    mesh, _, quantity = name.partition(".")
    (pair,) = (one.pair for one in case.meshes if one.name == mesh)
    return float(quantity_of(pair, quantity).function(PairEvaluation(pair, fixed_of(pair))))


def slope_of_scenarios(source, name, key, at):
    """Central difference over two scenarios that are written and loaded."""
    at = float(at)
    step, unit = 1e-5 * max(abs(at), 0.1), WRITTEN.get(key.rpartition(".")[2])
    ends = [
        of_mesh(td.scenario(source, {key: f"{value!r} {unit}" if unit else value}), name)
        for value in (at + step, at - step)
    ]
    return (ends[0] - ends[1]) / (2 * step)


@pytest.mark.parametrize(
    ("source", "keys"),
    [
        (
            REDUCER,
            [
                *("operating.output_torque", "gear.pinion-1.profile_shift", "gear.wheel-2.addendum"),
                *("stage.0.module", "stage.1.module", "gear.pinion-2.face_width"),
            ],
        ),
        (IDLER, ["operating.output_torque", "gear.idler.profile_shift", "gear.idler.addendum"]),
    ],
    ids=[REDUCER, IDLER],
)
def test_slopes_are_those_of_scenarios(source, keys):
    """A gear in two meshes moves both; a load reaches every mesh by the ratios."""
    of = ("hertz_pressure", "contact_ratio", "centre_distance")
    names = [f"{mesh.name}.{name}" for mesh in td.scenario(source).meshes for name in of]
    function = td.differentiable(source, names, keys)
    values, slopes = function.jacobian(function.at)
    case = td.scenario(source)
    np.testing.assert_allclose(values, [of_mesh(case, name) for name in names], rtol=1e-10)
    for i, name in enumerate(names):
        for j, key in enumerate(keys):
            expected = slope_of_scenarios(source, name, key, function.at[j])
            scale = abs(values[i]) / max(abs(function.at[j]), 0.1)
            assert slopes[i, j] == pytest.approx(expected, rel=2e-5, abs=1e-6 * scale), (name, key)


@pytest.mark.soak
def test_losses_of_all_meshes():
    """Of a constant coefficient: in proportion to load and speed; the efficiency is what they leave."""
    law = {"friction.law": "coulomb", "friction.coefficient": 0.05}
    keys = ["operating.output_torque", "operating.input_speed"]
    function = td.differentiable(REDUCER, ["friction_power", "efficiency"], keys, law)
    (loss, efficiency), slopes = function.jacobian(function.at)
    case = td.scenario(REDUCER, law)
    assert loss == pytest.approx(
        sum(of_mesh(case, f"{m.name}.friction_power") for m in case.meshes), rel=1e-9
    )
    np.testing.assert_allclose(slopes[0] * function.at, loss, rtol=1e-8)
    np.testing.assert_allclose(slopes[1] * function.at, 0.0, atol=1e-10)
    power = function.at[0] * function.at[1] * 23.0 / 69.0 * 23.0 / 57.0
    assert efficiency == pytest.approx(1.0 - loss / (power + loss), rel=1e-12)


@pytest.mark.parametrize(
    ("of", "wrt", "said"),
    [
        ("third.hertz_pressure", "operating.output_torque", 'of = "third": no such mesh'),
        ("hertz_pressure", "operating.output_torque", "is a quantity of a mesh"),
        ("first.nonsense", "operating.output_torque", "nonsense"),
        ("first.hertz_pressure", "gear.nobody.addendum", "gear.nobody.addendum"),
        ("first.hertz_pressure", ["stage.0.module"] * 2, "is named twice"),
    ],
)
def test_mistakes_are_said(of, wrt, said):
    with pytest.raises(td.InputError, match=said):
        td.gradient(REDUCER, of, wrt)
