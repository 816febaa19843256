"""What holds for the losses of every gear pair, friction coefficient and friction law."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tests.support.closures import LOCAL_LAWS, VECIANA, coulomb, under
from tribodyn.geometry.families.involute import InvolutePath
from tribodyn.standards.loss_factors import equal_loads, hoehn
from tribodyn.studies.efficiency.published import path_contact, torque_ratio
from tribodyn.tribology.contact import NominalConditions
from tribodyn.tribology.friction.iso_14179_1 import iso_14179_1
from tribodyn.tribology.friction.niemann import niemann
from tribodyn.validation.papers.veciana_study import cycloid_contact

teeth = st.integers(14, 60)
ratios = st.floats(1.0, 5.0)
often = settings(max_examples=60, deadline=None)


def duty(radius):
    """Moderate load and speed for a pinion of that radius: N m, rad/s, m."""
    return 3e5 * radius**2, 10.0 / radius, radius


@st.composite
def contacts(draw):
    """A pair on a straight path or between cycloids, one pitch of which lies on the flanks."""
    count, ratio, radius = draw(teeth), draw(ratios), draw(st.floats(5e-3, 0.2))
    if draw(st.booleans()):
        angle = draw(st.floats(0.3, 0.5))
        # half a pitch must stay off the pinion's base circle
        assume(math.pi / count < 0.9 * math.tan(angle))
        pair = path_contact(InvolutePath(radius, radius * ratio, angle), count)
    else:
        circles = (draw(st.floats(0.1, 0.45)) for _ in range(2))
        pair = cycloid_contact(count, radius, ratio, *circles, exact_speeds=draw(st.booleans()))
        assume(math.pi / count < 0.2)
    return pair, radius


@often
@given(contacts(), st.sampled_from(LOCAL_LAWS))
def test_friction_takes_a_part_and_no_more(contact, law):
    pair, radius = contact
    torque, speed, width = duty(radius)
    found = torque_ratio(pair, torque, speed, width, under(law, VECIANA))
    assert 0.5 < found.efficiency < 1.0
    assert np.all(found.normal_load > 0)
    lost = (
        found.friction_coefficient * found.normal_load * np.abs(pair.pinion_speed - pair.gear_speed) * speed
    )
    out = found.torque_ratio / (pair.gear_normal_arm / pair.pinion_normal_arm) * torque * speed
    np.testing.assert_allclose(out + lost, torque * speed, rtol=1e-9)


@often
@given(contacts(), st.floats(0.0, 0.1), st.floats(0.001, 0.1))
def test_more_friction_loses_more(contact, mu, more):
    pair, radius = contact
    low, high = (torque_ratio(pair, *duty(radius), coulomb(value)).efficiency for value in (mu, mu + more))
    assert high < low <= 1.0 + 1e-12


@often
@given(teeth, st.floats(0.005, 0.1), st.floats(0.1, 0.4), st.floats(0.1, 0.4))
def test_equal_gears_may_change_places(count, mu, approach, recess):
    """i = 1, to first order in μ: driving the other gear swaps approach and recess."""
    closure = coulomb(mu * 1e-3)
    losses = [
        1 - torque_ratio(cycloid_contact(count, 0.03, 1.0, *c), *duty(0.03), closure).efficiency
        for c in ((approach, recess), (recess, approach))
    ]
    assert losses[0] == pytest.approx(losses[1], rel=2e-3)


@often
@given(st.floats(0.0, 1.0), st.floats(0.0, 1.0), teeth, ratios)
def test_loss_factors_agree_inside_the_formulas_range(first, second, count, ratio):
    assume(first + second >= 1.0)
    assert equal_loads(first, second, count, ratio) == pytest.approx(
        hoehn(first, second, count, ratio), rel=1e-9
    )


@often
@given(st.floats(0.3, 2.0), st.floats(0.3, 2.0), teeth, ratios)
def test_loss_factor_does_not_know_who_drives(first, second, count, ratio):
    assert equal_loads(first, second, count, ratio) == pytest.approx(
        equal_loads(second, first, count, ratio), rel=1e-12
    )


@often
@given(
    st.floats(1.4e6, 14e6),
    st.floats(0.01, 0.2),
    ratios,
    st.floats(0.3, 0.45),
    st.floats(2.0, 25.0),
    st.floats(2e-3, 0.1),
)
def test_mean_coefficients_are_coefficients(intensity, radius, ratio, angle, speed, viscosity):
    """Inside the ranges of ISO/TR 14179-1."""
    load = 2.0 * intensity * radius * radius * ratio / (1.0 + ratio)
    conditions = NominalConditions(
        load, radius, radius * ratio, angle, speed / radius, radius, viscosity, 850.0, 0.5e-6, 0.0651
    )
    assert conditions.load_intensity == pytest.approx(intensity)
    assert conditions.pitch_line_speed == pytest.approx(speed)
    assert 0.005 < niemann(conditions) < 0.3
    assert 0.001 < iso_14179_1(conditions) < 0.2
