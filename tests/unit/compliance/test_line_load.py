"""Ratios of an uneven line load: triangles and power laws in closed form; table and slices."""

import numpy as np
import pytest

from tests.support.closures import known, of_case
from tests.support.faces_in_slices import CASES, model, table
from tribodyn.compliance.sharing.slices import friction_ratio, peak_ratio
from tribodyn.geometry.modification import FlankModification, LeadRelief, Modifications

LIKE = {**CASES, "crowned": (Modifications(FlankModification(lead=LeadRelief(crowning=20e-6))), 11)}


def test_a_triangle_in_closed_form():
    """⟨s ln s⟩ of s = 2 x over 0 … 1: ∫ s ln s ds/2 from 0 to 2 = ln 2 − ½."""
    place = (np.arange(4000) + 0.5) / 4000
    assert friction_ratio(3.0 * place) == pytest.approx(2.0 * np.exp(-0.5), rel=1e-5)
    assert peak_ratio(3.0 * place) == pytest.approx(2.0, rel=1e-3)


def test_even_and_absent_loads_change_nothing():
    np.testing.assert_array_equal(friction_ratio(np.array([[5.0, 5.0, 5.0], [0.0, 0.0, 0.0]])), 1.0)
    np.testing.assert_array_equal(peak_ratio(np.array([[5.0, 5.0, 5.0], [0.0, 0.0, 0.0]])), 1.0)
    # half the face carries all: both see twice the line load
    assert friction_ratio(np.array([1.0, 0.0])) == pytest.approx(2.0)
    assert peak_ratio(np.array([1.0, 0.0])) == pytest.approx(2.0)


@pytest.mark.parametrize("power", [0.02, -0.05])
def test_what_is_left_of_friction_that_goes_like_a_small_power(power):
    """½ m² (⟨s ln² s⟩ − ⟨s ln s⟩²), the next term of the series in m."""
    load = np.exp(np.random.default_rng(3).normal(0.0, 0.7, (50, 21)))
    share = load / load.mean(axis=-1, keepdims=True)
    first, second = (np.mean(share * np.log(share) ** n, axis=-1) for n in (1, 2))
    left = 1.0 - friction_ratio(load) ** power / np.mean(share ** (1.0 + power), axis=-1)
    np.testing.assert_allclose(left, power**2 / 2.0 * (second - first**2), rtol=0.05)


@pytest.mark.parametrize("name", ["tilt", "crowned"])
def test_the_table_has_the_friction_film_and_pressure_of_the_slices(case, name):
    """Friction power of the mixed law summed over the slices that the load contact model finds."""
    modified, slices = LIKE[name]
    cycle = table(case, modified, slices)
    shared = model(case, cycle, modified, slices, case.operating.gear_torque)
    total, width, closure = shared.normal_load, float(cycle.face_width), of_case(case, "masjedi-khonsari")

    def flat(values):
        return np.asarray(values)[..., : cycle.front_pairs].reshape(total.shape)

    carrying = total > 0.05 * total.max()
    radius = flat(cycle.equivalent_radius)[carrying]
    speeds = [200.0 * flat(speed)[carrying] for speed in (cycle.pinion_speed, cycle.gear_speed)]
    load = shared.slice_load[carrying]
    mean = total[carrying] / width

    def surface(line_load):
        shape = (..., *[None] * (line_load.ndim - 1))
        rolling = [speed[shape] for speed in speeds]
        with np.errstate(under="ignore", over="ignore"):
            return known(
                closure,
                np.maximum(line_load, 1.0),
                1.0 / radius[shape],
                sum(rolling) / 2.0,
                rolling[0] - rolling[1],
                rolling[0],
                rolling[1],
            )

    sliding = np.abs(speeds[0] - speeds[1])
    each = surface(load * slices / width)
    power = np.sum(sliding * np.sum(each[0] * load, axis=-1))

    def lost(line_load):
        return np.sum(sliding * surface(line_load)[0] * mean * width) / power - 1.0

    # by the mean line load friction is 6 % (tilt) and 17 % (crowned) too great
    assert abs(lost(mean * flat(cycle.line_load_friction)[carrying])) < 0.012
    assert lost(mean) > 0.05
    heaviest = surface(mean * flat(cycle.line_load_peak)[carrying])
    minimum = np.min(np.where(load > 0.0, each[2], np.inf), axis=-1)
    assert np.min(heaviest[2]) == pytest.approx(np.min(minimum), rel=3e-3)
    assert np.max(heaviest[4]) == pytest.approx(np.max(each[4]), rel=3e-3)
