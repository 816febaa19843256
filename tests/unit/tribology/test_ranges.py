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
            assert bool(law.limits) == bool(law.range), name


def test_a_limit_is_exceeded_by_the_actual_over_the_allowed():
    laws = under("none")
    modulus = float(laws.surfaces.effective_modulus)
    # W = w'/(E' ρ), a tenth of the least, the middle, and twice and four times the most
    W = np.array([0.1 * FITTED_RANGE["W"][0], 1e-4, *(np.array([2.0, 4.0]) * FITTED_RANGE["W"][1])])
    contact = contacts(W * modulus / 100.0)
    film, _ = range_shares(contact, laws)
    found = {one["limit"]: one for one in exceeded(film, FILM_LAWS["masjedi-khonsari"].limits).values()}
    assert found["W ≤ 5e-4"]["factor"] == pytest.approx(4.0)
    assert found["W ≤ 5e-4"]["share"] == pytest.approx(0.5)
    assert found["W ≥ 2e-5"]["factor"] == pytest.approx(10.0)
    assert found["W ≥ 2e-5"]["share"] == pytest.approx(0.25)
    others = [one for limit, one in found.items() if not limit.startswith("W")]
    inside = np.array([False, True, False, False]) & (not others)
    np.testing.assert_array_equal(surface_state(contact, laws).closure_in_range, inside)


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
