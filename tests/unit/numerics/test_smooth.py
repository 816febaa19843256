import numpy as np
import pytest

from tribodyn.numerics.smooth import (
    load_with_damping,
    mean_sign,
    onset,
    onset_integral,
    positive_part,
    positive_part_integral,
    power_law_force,
    power_law_stiffness,
    power_law_work,
    ramp,
    sign,
)
from tribodyn.tribology.film.masjedi_khonsari import CAP_WIDTH, asperity_load_ratio

X = np.linspace(-3.0, 3.0, 60001)


@pytest.mark.parametrize(
    ("function", "exact"),
    [
        (lambda x: positive_part(x, 0.5), lambda x: np.maximum(x, 0.0)),
        (sign, np.sign),
        (lambda x: ramp(x, 1.0), lambda x: np.heaviside(x - 0.5, 0.5)),
    ],
    ids=["positive_part", "sign", "ramp"],
)
def test_smoothed_functions_are_c1_and_exact_outside_their_width(function, exact):
    slope = np.gradient(function(X), X)
    assert np.max(np.abs(np.diff(slope))) < 5e-3  # no jump: curvature × step
    outside = np.abs(X) > 1.0001
    np.testing.assert_allclose(function(X)[outside], exact(X)[outside], atol=1e-14)
    assert np.all(np.diff(function(X)) >= -1e-15)


@pytest.mark.parametrize("half", [0.0, 1e-4, 0.3, 1.0, 20.0])
def test_the_mean_sign_is_that_of_a_fine_sum(half):
    at = np.linspace(-25.0, 25.0, 41)
    within = half * np.linspace(-1.0, 1.0, 40001)
    expected = [np.trapezoid(sign(x + within), dx=1.0 / 40000) for x in at]
    np.testing.assert_allclose(mean_sign(at, half), expected, atol=1e-7)


def test_positive_part_integral_is_the_integral():
    integral = np.concatenate(
        [[0.0], np.cumsum(0.5 * np.diff(X) * (positive_part(X, 0.5)[1:] + positive_part(X, 0.5)[:-1]))]
    )
    np.testing.assert_allclose(positive_part_integral(X, 0.5), integral, atol=1e-7)


def test_damping_adds_to_an_elastic_load_and_never_gives_energy():
    """At any load, also far below the width: nothing of it without damping, no pull, force and rate agree."""
    elastic, damping = (values.ravel() for values in np.meshgrid(np.geomspace(1e-9, 1e4, 60), X[::300]))
    load = load_with_damping(elastic, damping * elastic, 0.5)
    assert np.all(load >= 0.0)
    assert np.all((load - elastic) * damping >= 0.0)
    np.testing.assert_array_equal(load_with_damping(elastic, 0.0, 0.5), elastic)
    np.testing.assert_allclose(load[damping > 0], (elastic * (1.0 + damping))[damping > 0], rtol=1e-14)
    heavy = (elastic > 0.5) & (elastic * (1.0 + damping) > 0.5)
    np.testing.assert_allclose(load[heavy], (elastic * (1.0 + damping))[heavy], rtol=1e-14)
    assert load_with_damping(0.0, -1.0, 0.5) == load_with_damping(0.0, 0.0, 0.5) == 0.0


@pytest.mark.parametrize("elastic", [1e-6, 0.2, 2.0])
def test_load_with_damping_is_c1_in_both(elastic):
    for load in (
        load_with_damping(elastic, elastic * X, 0.5) / elastic,
        load_with_damping(elastic * (3.0 + X), -elastic, 0.5) / elastic,
    ):
        assert np.max(np.abs(np.diff(np.gradient(load, X)))) < 5e-3


def test_power_law_force_inverts_the_deflection():
    force = np.geomspace(1e-2, 1e6, 200)
    compliance, coefficient = 2.5e-9, 4e-9
    deflection = compliance * force + coefficient * force**0.9
    np.testing.assert_allclose(power_law_force(deflection, compliance, coefficient), force, rtol=1e-9)
    assert power_law_force(0.0, compliance, coefficient) == 0.0


def test_power_law_stiffness_and_work_belong_to_its_force():
    deflection = np.linspace(1e-6, 40e-6, 2001)
    compliance, coefficient = 2.5e-9, 4e-9
    force = power_law_force(deflection, compliance, coefficient)
    stiffness = power_law_stiffness(force, compliance, coefficient)
    np.testing.assert_allclose(np.gradient(force, deflection, edge_order=2), stiffness, rtol=1e-5)
    work = power_law_work(force, compliance, coefficient)
    np.testing.assert_allclose(np.gradient(work, deflection, edge_order=2)[1:-1], force[1:-1], rtol=1e-5)


def test_onset_meets_load_and_stiffness_at_its_width():
    x, width, load, stiffness = np.linspace(0.0, 1e-7, 4001), 1e-7, 30.0, 3.3e8
    force = onset(x, width, load, stiffness)
    slope = np.gradient(force, x, edge_order=2)
    assert np.all(np.diff(force) > 0.0)
    assert force[0] == onset(-1e-9, width, load, stiffness) == 0.0
    assert force[-1] == pytest.approx(load, rel=1e-12)
    np.testing.assert_allclose([slope[0] / stiffness, slope[-1] / stiffness], [0.0, 1.0], atol=1e-5)
    np.testing.assert_allclose(
        onset_integral(x, width, load, stiffness)[1:],
        np.cumsum(0.5 * np.diff(x) * (force[1:] + force[:-1])),
        rtol=1e-3,
        atol=1e-13,
    )
    linear = stiffness * width  # with the line through the origin it is the positive part
    np.testing.assert_allclose(
        onset(x, width, linear, stiffness), stiffness * positive_part(x, width), atol=1e-12
    )


def test_asperity_load_ratio_is_capped_smoothly():
    """The formula as printed (with 4470) where it is well below 1; at most 1; C1 across the cap."""
    W, G, V, S = 2e-4, 5650.0, 0.0102, 3.3e-5
    U = np.geomspace(1e-15, 1e-10, 4001)
    logarithm = np.log1p(4470 * S**6.015 * V**1.168 * W**0.485 * U**-3.741 * G**-2.898)
    printed = 0.005 * W**-0.408 * U**-0.088 * G**0.103 * logarithm / 100
    ours = asperity_load_ratio(np.log(W), np.log(U), np.log(G), np.log(S), np.log(V), np.log(4470.0))
    low = printed < 1 - CAP_WIDTH
    np.testing.assert_allclose(ours[low], printed[low], rtol=1e-10)
    high = printed > 1 + CAP_WIDTH
    assert high.any()
    np.testing.assert_allclose(ours[high], 1.0, rtol=1e-14)

    def maximum_jump_of_slope(points):
        log_u = np.linspace(np.log(1e-13), np.log(1e-11), points)
        value = asperity_load_ratio(np.log(W), log_u, np.log(G), np.log(S), np.log(V), np.log(4470.0))
        return np.max(np.abs(np.diff(np.gradient(value, log_u))))

    # a kink would keep its jump under refinement; a C1 function halves it
    assert maximum_jump_of_slope(80001) < 0.6 * maximum_jump_of_slope(40001)
