"""The oscillator's response where contact lasts, against the linear oscillator's, and its figures by hand."""

from typing import Any

import numpy as np
import pytest

from tribodyn.solve.branch.arclength import FOLD, KINDS, BranchEnd
from tribodyn.solve.branch.unstable import UnstableBranch
from tribodyn.solve.orbit import motions as orbit
from tribodyn.solve.orbit.motions import Orbit
from tribodyn.studies.backlash_oscillator.motion import OscillatorMap
from tribodyn.studies.backlash_oscillator.response import (
    CHAOTIC,
    FAILED,
    NOT_PERIODIC,
    QUASI_PERIODIC,
    STABLE,
    WINDOW,
    Response,
    _put,
    at_rest,
    frequency_response,
    measured_branch,
)
from tribodyn.studies.backlash_oscillator.run import (
    branches_apart,
    described,
    finish_row,
    record_arrays,
    response_summary,
    rows_of,
)
from tribodyn.studies.backlash_oscillator.scenario import BacklashOscillatorCase, estimate
from tribodyn.studies.protocol.branches import end_values


def case(frequencies, force=0.4, error=0.02, **more):
    given = dict.fromkeys(("title", "name", "kind", "toml", "sha256"), "")
    return BacklashOscillatorCase(
        **given,
        damping=0.07,
        mean_force=force,
        error_amplitude=error,
        stiffness_variation=0.0,
        frequencies=frequencies,
        **more,
    )


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_while_contact_lasts_the_response_is_the_linear_oscillators(sign):
    """x = ±1 + F_m + A cos(Ωτ − φ), multipliers exp((−ζ ± i √(1 − ζ²)) 2π/Ω); both ways, on either side."""
    swept = case((0.3, 0.6, 1.3, 2.2), force=0.4 * sign)
    told = []
    found = frequency_response(swept, told.append)
    assert told == pytest.approx([0.25, 0.5, 0.75, 1.0])
    for place, frequency in enumerate(swept.frequencies):
        shape = 0.02 * frequency**2 / (1.0 - frequency**2 + 2j * 0.07 * frequency)
        for way in (0, 1):
            at = place, way
            assert found.motion[at] == STABLE
            assert found.period[at] == 1
            assert found.mean_displacement[at] == pytest.approx(1.4 * sign, rel=1e-7)
            assert found.rms_displacement[at] == pytest.approx(abs(shape) / np.sqrt(2.0), rel=1e-6)
            assert found.peak_to_peak_displacement[at] == pytest.approx(2.0 * abs(shape), rel=1e-5)
            assert found.contact_loss_fraction[at] == 0.0
            assert found.back_contact_fraction[at] == pytest.approx(1.0 if sign < 0 else 0.0, abs=1e-12)
            assert found.section_displacement[at] == pytest.approx(1.4 * sign + shape.real, abs=2e-7)
            assert found.section_velocity[at] == pytest.approx(-frequency * shape.imag, abs=2e-7)
            turn = np.exp(complex(-0.07, np.sqrt(1 - 0.07**2)) * 2.0 * np.pi / frequency)
            np.testing.assert_allclose(
                np.sort_complex(found.multiplier[at]), np.sort_complex([turn, turn.conjugate()]), rtol=1e-9
            )
            assert found.residual[at] <= 1e-7
    assert not found.messages
    assert not found.ends


def test_at_rest_the_force_of_the_flank_balances_the_mean_force():
    assert [at_rest(force) for force in (0.3, -0.2, 0.0)] == pytest.approx([1.3, -1.2, 0.0])


def test_a_motion_without_period_is_measured_over_its_window():
    """A free oscillator that is pushed through the backlash at a constant speed."""
    response = made(2)
    gap = OscillatorMap(np.array([[0.0, 0.0, 0.0, 0.0, 10.0]]).repeat(2, axis=0))
    state = np.array([-0.9, 1e-4])
    none = np.full(2, np.nan, dtype=complex)
    moving = orbit.Orbit(state, state, 0, 0.5, none, False, orbit.CHAOTIC, "marching", 9, "it wanders")
    response.frequency[1] = 10.0
    _put(response, 1, 0, moving, gap)
    assert response.motion[1, 0] == CHAOTIC
    assert response.period[1, 0] == 0
    way = 1e-4 * WINDOW * 2.0 * np.pi / 10.0
    assert response.peak_to_peak_displacement[1, 0] == pytest.approx(way, rel=2e-3)
    assert response.mean_displacement[1, 0] == pytest.approx(-0.9 + way / 2.0, rel=1e-9)
    assert response.rms_displacement[1, 0] == pytest.approx(way / np.sqrt(12.0), rel=1e-6)
    assert response.contact_loss_fraction[1, 0] == pytest.approx(1.0, rel=1e-12)
    assert response.messages[-1] == (10.0, 0, "it wanders")
    _put(response, 0, 1, orbit.failed_orbit(state, 3, "lost"), gap)
    assert response.motion[0, 1] == FAILED
    assert np.isnan(response.rms_displacement[0, 1])


def made(count, **columns):
    """A response of NaN over so many frequencies, but for some columns."""
    given: dict[str, Any] = {name: np.full((count, 2), np.nan) for name in Response._fields} | {
        "frequency": 0.5 + 0.25 * np.arange(count),
        "period": np.zeros((count, 2), dtype=int),
        "motion": np.full((count, 2), int(FAILED)),
        "multiplier": np.full((count, 2, 2), np.nan, dtype=complex),
        "messages": [],
        "ends": [],
        "beyond": [],
    }
    return Response(**(given | columns))


S, F, Q, C, N = map(int, (STABLE, FAILED, QUASI_PERIODIC, CHAOTIC, NOT_PERIODIC))


def test_the_figures_of_a_response_are_counted():
    nan = np.nan
    response = made(
        6,
        rms_displacement=np.array(
            [[0.1, 0.1], [0.2, 0.25], [0.3, 0.31], [0.5, 0.6], [0.4, 0.40003], [nan, 0.2]]
        ),
        contact_loss_fraction=np.array([[0, 0], [0, 0.1], [0.2, 0], [0.3, 0.05], [0, 0], [nan, 0]]),
        back_contact_fraction=np.array([[0, 0], [0, 0.02], [0, 0], [0.01, 0], [0, 0], [nan, 0]], dtype=float),
        period=np.array([[1, 1], [1, 2], [1, 3], [0, 0], [1, 1], [0, 1]]),
        motion=np.array([[S, S], [S, S], [S, S], [Q, C], [S, S], [F, N]]),
        residual=np.array([[1, 2], [3, 9], [4, 5], [99, 98], [6, 7], [nan, 97]]) * 1e-9,
        messages=[(0.5 + 0.25 * i, i % 2, f"said {i}") for i in range(5)],
        ends=[(0, BranchEnd(FOLD, 0.8, 1e-4, 1, 0.99 + 0j)), (1, BranchEnd(FOLD, 0.7, 1e-4, 2, 0.98j))],
    )
    found = response_summary(response)
    counted = {name: found[name] for name in found if name.startswith("points")}
    assert counted == {
        "points": 12,
        "points_not_periodic": 3,
        "points_quasi_periodic": 1,
        "points_chaotic": 1,
        "points_failed": 1,
        "points_of_longer_period": 2,
    }
    assert found["residual_max"] == pytest.approx(9e-9)
    assert (found["rms_max"], found["rms_max_frequency"]) == (0.6, 1.25)
    assert (found["contact_loss_fraction_max"], found["back_contact_fraction_max"]) == (0.3, 0.02)
    assert (found["contact_loss_from"], found["contact_loss_to"]) == (0.75, 1.25)
    # the ways differ at 1.25 too, but in motions without period; at 1.5 by a ten-thousandth only
    assert np.flatnonzero(branches_apart(response)).tolist() == [1, 2]
    assert (found["bistable_from"], found["bistable_to"]) == (0.75, 1.0)
    assert found["end_1"] == "fold of period 1 at 0.8, up"
    assert found["end_2"] == "fold of period 2 at 0.7, down"
    assert [found[f"remark_{i}"] for i in (1, 2, 3)] == [
        "frequency 0.5, up: said 0",
        "frequency 0.75, down: said 1",
        "frequency 1, up: said 2",
    ]
    assert found["remarks_more"] == 2
    assert "remark_4" not in found
    assert "remarks_more" not in response_summary(response._replace(messages=response.messages[:3]))
    arrays = record_arrays(response)
    assert arrays["stable"][:5].tolist() == [[1, 1], [1, 1], [1, 1], [0, 0], [1, 1]]
    assert np.isnan(arrays["stable"][5, 0])
    assert np.isnan(arrays["period"][5, 0])
    assert (arrays["stable"][5, 1], arrays["period"][5, 1]) == (0.0, 1.0)
    row = end_values(response.ends[1][1], "end_frequency")
    assert row["end_kind"] == 1 + KINDS.index(FOLD)
    assert (row["end_frequency"], row["end_period"]) == (0.7, 2)
    assert row["end_multiplier_modulus"] == pytest.approx(0.98)
    assert row["end_multiplier_angle"] == pytest.approx(np.pi / 2)
    nothing = response_summary(made(2))
    assert nothing["residual_max"] is None
    assert not any(name.startswith(("rms", "contact", "bistable")) for name in nothing)


def test_figures_of_unstable_motions():
    """Of motions that are linear: the same figures as the response's, numbered from one."""
    frequencies = np.array([0.6, 1.3])
    shapes = 0.02 * frequencies**2 / (1.0 - frequencies**2 + 2j * 0.07 * frequencies)
    states = np.column_stack([1.4 + shapes.real, -frequencies * shapes.imag])
    multipliers = np.array([[1.2j, 0.1], [-1.5 + 0j, 0.2]])
    finish = BranchEnd(FOLD, 0.9, 1e-5, 2, 1 + 0j)
    orbits = [
        Orbit(state, state, 2, 1e-9, largest, False, "unstable", "shooting", 0, "")
        for state, largest in zip(states, multipliers, strict=True)
    ]
    branch = UnstableBranch(2, frequencies, orbits, finish)
    found = measured_branch(case((0.6, 1.3)), 3, branch)
    np.testing.assert_allclose(found.measures["rms_displacement"], np.abs(shapes) / np.sqrt(2.0), rtol=1e-7)
    np.testing.assert_allclose(found.measures["peak_to_peak_displacement"], 2.0 * np.abs(shapes), rtol=1e-7)
    np.testing.assert_array_equal(found.measures["contact_loss_fraction"], 0.0)
    first, last = rows_of(found)
    assert (first["unstable_end"], first["unstable_frequency"], first["unstable_period"]) == (4, 0.6, 2)
    assert last["unstable_multiplier_modulus"] == pytest.approx(1.5)
    assert first["unstable_multiplier_angle"] == pytest.approx(np.pi / 2)
    assert (last["unstable_section_displacement"], last["unstable_section_velocity"]) == tuple(states[1])
    assert finish_row(found) == {
        "end_unstable_finish": 1 + KINDS.index(FOLD),
        "end_unstable_finish_frequency": 0.9,
    }
    assert described(found) == "period 2 between 0.6 and 1.3, multiplier at most 1.5: fold at 0.9"
    going = found._replace(branch=branch._replace(finish=None))
    assert finish_row(going) == {}
    assert described(going).endswith("no end in the range")


def test_what_a_sweep_takes_goes_with_its_points_periods_and_damping():
    """A motion settles in periods by the inverse of its damping, but in no more than it may take."""
    base, twice = estimate(case((1.0, 1.0))), estimate(case((1.0, 1.0, 1.0, 1.0)))
    assert twice.seconds == pytest.approx(2.0 * base.seconds)
    more = estimate(case((1.0,) * 8)).record - twice.record
    assert more == 2.0 * (twice.record - base.record) > 0.0
    slow = estimate(case((0.25, 0.25)))
    # of a period of 2π/Ω radians: two parts, one of which goes with the radians
    assert base.seconds < slow.seconds < 4.0 * base.seconds
    capped = [estimate(case((1.0, 1.0), max_periods=count)).seconds for count in (20, 40, 6000, 60000)]
    assert capped[1] == pytest.approx(2.0 * capped[0])
    assert capped[2] == capped[3]
    # 30/ζ periods
    assert capped[2] / capped[0] == pytest.approx(30.0 / 0.07 / 20.0)
    assert base.drivers[2].value == pytest.approx(2.0 * np.pi)
