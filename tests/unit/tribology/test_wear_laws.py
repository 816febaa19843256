"""Wear laws: their limits, their defaults and sources, and what they refuse."""

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.tribology.wear import WEAR_LAWS
from tribodyn.tribology.wear.law import WearContact, WearLaw


def contact(film: float = 0.0, friction: float = 0.1, asperities: float = 1.0, size: int = 3) -> WearContact:
    every = np.ones(size)
    return WearContact(1e9 * every, friction * every, film * every, asperities * every)


def coefficient(name: str, seen: WearContact, **values: float) -> np.ndarray:
    law = WEAR_LAWS[name]
    return law.functions.coefficient(seen, law.made(None, values))


@pytest.mark.parametrize("name", [*WEAR_LAWS])
def test_a_law_is_an_object(name: str):
    law = WEAR_LAWS[name]
    assert isinstance(law, WearLaw)
    assert law.about
    for key in law.keys:
        assert key.default is None or key.source
    values = {key.name: 1e-18 if key.default is None else key.default for key in law.keys}
    found = coefficient(name, contact(film=1.0), **values)
    assert found.shape == (3,)
    assert np.all(found > 0.0)


@pytest.mark.parametrize(
    ("film", "share"), [(0.0, 1.0), (0.5, 1.0), (2.25, 0.5), (3.0, 2.0 / 7.0), (4.0, 0.0), (9.0, 0.0)]
)
def test_wear_in_mixed_lubrication_is_that_of_priest_and_taylor(film: float, share: float):
    """K/k = (2/7)(4 − λ) between 1/2 and 4."""
    np.testing.assert_allclose(coefficient("priest-taylor", contact(film), coefficient=1e-18), share * 1e-18)


def test_archard_knows_no_film_and_asperities_wear_by_their_share():
    np.testing.assert_allclose(coefficient("archard", contact(9.0), coefficient=1e-18), 1e-18)
    seen = contact(9.0, asperities=0.3)
    np.testing.assert_allclose(coefficient("archard-asperities", seen, coefficient=1e-18), 0.3e-18)


def test_energy_wears_by_friction():
    seen = contact(0.2, friction=0.07)
    np.testing.assert_allclose(coefficient("energy", seen, energy_coefficient=1e-16), 0.07e-16)
    thick = contact(5.0, friction=0.07)
    np.testing.assert_allclose(coefficient("energy", thick, energy_coefficient=1e-16), 0.0)


def test_limits_of_the_film_that_contradict_each_other_are_refused():
    with pytest.raises(InputError, match="lubrication is mixed") as error:
        WEAR_LAWS["priest-taylor"].made(
            None, {"boundary_film_parameter": 2.0, "separating_film_parameter": 1.0}
        )
    assert error.value.key == "wear.separating_film_parameter"


def test_the_energy_law_has_no_default():
    with pytest.raises(InputError, match="missing") as error:
        WEAR_LAWS["energy"].made(None, {})
    assert error.value.key == "wear.energy_coefficient"
