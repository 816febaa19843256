"""Tables of the solved contact: polynomials, error, cache, the duty of a mesh, and laws that read them."""

import math

import numpy as np
import pytest

from tests.support.closures import LIU_NI, under
from tests.support.right_hand_sides import assert_right_hand_sides_agree, at_several_conditions
from tribodyn.errors import InputError
from tribodyn.studies.gear_pair.prepare import prepare
from tribodyn.studies.load import load_scenario
from tribodyn.tribology.closure import closure, duty_range, with_laws
from tribodyn.tribology.contact import local_contact
from tribodyn.tribology.duty_range import DutyRange
from tribodyn.tribology.ehl import table as tables
from tribodyn.tribology.ehl import table_points as points
from tribodyn.tribology.ehl.table_lookup import TERMS, polynomial
from tribodyn.tribology.film import film_law
from tribodyn.tribology.friction import friction_law
from tribodyn.tribology.surface_state import surface_state

DUTY = DutyRange((1e5, 6e5), (0.1, 0.2), (100.0, 130.0), (0.02, 0.8))


def film_of(load, speed, curvature):
    return 2e-6 * speed**0.7 * load**-0.13 * curvature**-0.3


def power_laws(contact, duties):
    """A film and a film's friction of powers, and a constant share, in place of solved contacts."""
    load, speed, curvature, ratio = np.exp(duties).T
    friction = 0.25 * contact.roughness.friction + 0.03 * ratio**0.2
    return np.array([np.log(film_of(load, speed, curvature)), np.log(friction), 0.25 + 0.0 * load]).T


@pytest.fixture
def by_powers(monkeypatch, tmp_path):
    monkeypatch.setenv("TRIBODYN_CACHE", str(tmp_path))
    monkeypatch.setattr(tables, "solve_all", power_laws)
    tables._table.cache_clear()
    yield
    tables._table.cache_clear()


def test_polynomial_is_the_sum_of_its_terms(rng):
    table = rng.standard_normal(len(TERMS))
    point = rng.uniform(-1.0, 1.0, 4)
    terms = [c * np.prod(point ** np.array(powers)) for c, powers in zip(table, TERMS, strict=True)]
    assert polynomial(table, *point) == pytest.approx(sum(terms), rel=1e-12)


def test_laws_read_what_the_table_was_made_of(by_powers):
    given = LIU_NI._replace(duty=lambda: DUTY)
    laws = closure(given, film_law("solved"), friction_law("solved"))
    assert laws.film.parameters.film_error < 1e-3
    assert laws.friction.parameters.friction_error < 1e-3
    state = surface_state(local_contact(3e5, 110.0, 0.15, -0.06, 0.12, 0.18), laws)
    assert state.central_film_thickness == pytest.approx(film_of(3e5, 0.15, 110.0), rel=1e-3)
    rubbing = tables.contact_of(LIU_NI).roughness.friction
    assert state.friction_coefficient == pytest.approx(0.25 * rubbing + 0.03 * 0.4**0.2, rel=1e-3)
    assert state.asperity_load_ratio == pytest.approx(0.25, abs=1e-3)
    # beyond its range a table is held at its end
    beyond = surface_state(local_contact(6e6, 110.0, 0.15, 0.06, 0.18, 0.12), laws)
    assert beyond.central_film_thickness == pytest.approx(film_of(6e5, 0.15, 110.0), rel=1e-3)


def test_contacts_crowd_along_the_path():
    """Curvature and slide-to-roll ratio of a place belong together, at every load and speed of the range."""
    place = np.linspace(-1.0, 1.0, 41)
    places = [(0.15 + 0.02 * one, 200.0 * math.exp(one), 0.7 * abs(one)) for one in place]
    duty = DutyRange((1e5, 6e5), (0.13 * 0.8, 0.17 * 1.2), (73.0, 550.0), (0.02, 0.8), tuple(places))
    found, along = points.spread(duty, 120)
    assert np.mean(along) == pytest.approx(1 - 1 / points.BOXED, abs=0.01)
    load, speed, curvature, ratio = np.exp(found).T
    for values, (low, high) in zip((load, speed, curvature, ratio), duty[:4], strict=True):
        assert low * (1 - 1e-12) <= values.min() < 1.1 * low
        assert 0.95 * high < values.max() <= high * (1 + 1e-12)
    # vibrations change the curvature by 2 % and the ratio by a tenth
    belongs = 0.7 * np.abs(np.log(curvature / 200.0))
    near = np.abs(ratio - belongs) < 0.03 + 0.13 * belongs
    assert np.all(near[along])
    assert np.mean(near[~along]) < 0.5
    box, all_of_it = points.spread(duty._replace(places=()), 64)
    assert box.shape == (64, 4)
    assert np.all(all_of_it)


def test_processes_solve_what_one_solves(monkeypatch):
    contact, (duties, _) = tables.contact_of(LIU_NI), points.spread(DUTY, 4)
    monkeypatch.setattr(points, "usable_cores", lambda: 2)
    monkeypatch.setattr(points, "_WORTH", 2)
    found = points.solve_all(contact, duties)
    np.testing.assert_array_equal(found, [points.solve_one(contact, one) for one in duties])
    monkeypatch.setattr(points, "_COMMAND", ("no such program",))
    np.testing.assert_array_equal(points.solve_all(contact, duties), found)


def test_a_table_is_kept(by_powers, monkeypatch):
    contact = tables.contact_of(LIU_NI)
    first = tables.table_over(contact, DUTY)
    tables._table.cache_clear()
    monkeypatch.setattr(tables, "solve_all", None)
    again = tables.table_over(contact, DUTY)
    np.testing.assert_array_equal(first.friction, again.friction)
    assert first[:8] == again[:8]
    assert first[11:] == again[11:]


def test_without_a_mesh_there_is_no_table():
    with pytest.raises(InputError, match="duty of a mesh"):
        under("solved")


def test_duty_of_a_drive():
    """Liu & Ni: 10 rad/s, 500 N m on the gear; at P u = ω r_p sin α, R = 8.98 mm, no sliding."""
    duty = duty_range(load_scenario("crc-23-47"))
    whole = 500.0 / (70.5e-3 * math.cos(math.radians(25.4))) / 0.02
    assert duty.line_load[0] < whole < duty.line_load[1]
    at_pitch_point = 10.0 * 34.5e-3 * math.sin(math.radians(22.81))
    assert duty.entrainment[0] < at_pitch_point < duty.entrainment[1]
    assert duty.curvature[0] < 1 / 8.98e-3 < duty.curvature[1]
    assert 0.3 < duty.slide_to_roll[1] < 1.5


@pytest.mark.soak
def test_the_laws_run_in_every_compiler(by_powers, rng):
    case = with_laws(load_scenario("crc-23-47"), film="solved", friction="solved")
    assert_right_hand_sides_agree(at_several_conditions(prepare(case).model), rng, 1e-12)


@pytest.mark.soak
def test_error_of_a_table_of_solved_contacts():
    found = tables.table_over(tables.contact_of(LIU_NI), DUTY)
    assert found.film_error < 0.01
    assert found.friction_error < 0.01
    contact = tables.contact_of(LIU_NI)
    state = points.solve_one(contact, np.log([3e5, 0.15, 112.0, 0.3]))
    laws = closure(LIU_NI._replace(duty=lambda: DUTY), film_law("solved"), friction_law("solved"))
    known = surface_state(local_contact(3e5, 112.0, 0.15, 0.045, 0.1725, 0.1275), laws)
    assert math.log(known.central_film_thickness) == pytest.approx(state[0], abs=0.01)
    assert math.log(known.friction_coefficient) == pytest.approx(state[1], abs=0.01)
