"""By how much laws are outside their range, and in which share of the contacts."""

import numpy as np
import pytest

from tests.support.closures import under
from tribodyn.tribology.contact import local_contact
from tribodyn.tribology.film import FILM_LAWS
from tribodyn.tribology.film.masjedi_khonsari import FITTED_RANGE
from tribodyn.tribology.friction import FRICTION_LAWS
from tribodyn.tribology.surface_state import exceeded, range_shares, surface_state


def contacts(line_load, entrainment=2.0):
    line_load = np.asarray(line_load, dtype=float)
    return local_contact(line_load, 100.0, entrainment, 1.0, entrainment + 0.5, entrainment - 0.5)


def test_laws_say_one_share_for_each_limit():
    for registry in (FILM_LAWS, FRICTION_LAWS):
        for name in registry:
            law = registry[name]
            assert bool(law.limits) == bool(law.stated), name


def test_a_limit_is_exceeded_by_the_actual_over_the_allowed():
    laws = under("none")
    modulus = float(laws.surfaces.effective_modulus)
    # W = w'/(E' ρ), a tenth of the least, the middle, and twice and four times the most
    W = np.array([0.1 * FITTED_RANGE["W"][0], 1e-4, *(np.array([2.0, 4.0]) * FITTED_RANGE["W"][1])])
    contact = contacts(W * modulus / 100.0)
    film, _ = range_shares(contact, laws)
    found = {entry["limit"]: entry for entry in exceeded(film, FILM_LAWS["masjedi-khonsari"].limits).values()}
    assert found["W ≤ 5e-4"]["factor"] == pytest.approx(4.0)
    assert found["W ≤ 5e-4"]["share"] == pytest.approx(0.5)
    assert found["W ≥ 2e-5"]["factor"] == pytest.approx(10.0)
    assert found["W ≥ 2e-5"]["share"] == pytest.approx(0.25)
    others = [entry for limit, entry in found.items() if not limit.startswith("W")]
    inside = np.array([False, True, False, False]) & (not others)
    np.testing.assert_array_equal(surface_state(contact, laws).closure_in_range, inside)


def test_limits_by_the_solved_contact_are_named():
    """So fast that L is beyond what the contact bears out, by the factor that the speed gives."""
    law = FILM_LAWS["moes"]
    shares, _ = range_shares(contacts([4e5], entrainment=1e3), under("none", film="moes"))
    found = {entry["limit"]: entry["factor"] for entry in exceeded(shares, law.named_limits).values()}
    assert set(found) <= {f"{limit} (judged)" for limit in law.limits}
    laws = under("none", film="moes").surfaces
    sum_speed = 2.0 * 1e3 * 100.0 * laws.inlet_viscosity / laws.effective_modulus
    material = laws.pressure_viscosity * laws.effective_modulus * sum_speed**0.25
    assert found["L ≤ 15 (judged)"] == pytest.approx(material / 15.0)


def test_friction_in_pure_rolling_is_outside():
    """The ratio of two coefficients that both vanish says nothing."""
    laws = under("masjedi-khonsari")
    rolling = local_contact(4e5, 100.0, 2.0, 0.0, 2.0, 2.0)
    assert surface_state(rolling, laws).friction_in_range == 0.0
    _, shares = range_shares(rolling, laws)
    named = exceeded(np.atleast_2d(shares), FRICTION_LAWS["masjedi-khonsari"].named_limits).values()
    assert {"limit": "Newtonian stress ≥ 0.1 Λ_lim p (judged)", "share": 1.0} in named


def test_a_law_may_say_no_more_than_whether_it_is_inside():
    laws = under("none")
    functions = laws.film.functions._replace(in_range=lambda contact, *_: contact.line_load > 1e5)
    plain = laws._replace(film=laws.film._replace(functions=functions))
    contact = contacts([5e4, 2e5])
    np.testing.assert_array_equal(surface_state(contact, plain).closure_in_range, [0.0, 1.0])
    film, _ = range_shares(contact, plain)
    assert exceeded(film, ()) == {}
    (only,) = exceeded(film, ("the load",)).values()
    assert only == {"limit": "the load", "share": 0.5}
