"""Laws from outside are tried before a run relies on them; the package's own are not."""

import math
from typing import Any

import pytest

from tests.support.closures import LIU_NI
from tribodyn.errors import InputError
from tribodyn.numerics.elementary import absolute, exp, law
from tribodyn.tribology.closure import closure
from tribodyn.tribology.film import FILM_LAWS
from tribodyn.tribology.friction import FRICTION_LAWS
from tribodyn.tribology.law import FilmLaw, FrictionLaw
from tribodyn.tribology.trial import try_laws


def tried(film: Any = None, friction: Any = None, **functions: Any) -> None:
    """Try one law of a function, the other one of the package."""
    if film is not None:
        tested, other = FilmLaw("mine", "", film, **functions), FRICTION_LAWS["none"]
    else:
        tested, other = FILM_LAWS["moes"], FrictionLaw("mine", "", friction, **functions)
    try_laws(tested, other, closure(LIU_NI, tested, other))


def twice(x):
    return 2.0 * x


@law
def marked_twice(x):
    return 2.0 * x


def test_laws_that_work():
    tried(film=lambda contact, *_: (-14.0 + 0.0 * contact.line_load, 1.0, 0.0))
    tried(friction=lambda contact, *_: 0.02 * exp(-absolute(contact.sliding)))
    tried(friction=lambda contact, *_: 0.02 * marked_twice(absolute(contact.sliding)))
    # zero is a friction coefficient
    tried(friction=lambda contact, *_: 0.0 * contact.sliding)


def test_laws_of_the_package_are_not_tried():
    made = closure(LIU_NI, FILM_LAWS["moes"], FRICTION_LAWS["none"])
    broken: Any = made._replace(surfaces=None)
    try_laws(FILM_LAWS["moes"], FRICTION_LAWS["none"], broken)


def test_they_may_only_call_what_is_marked():
    with pytest.raises(InputError, match=r'friction\.law = "mine": calls twice, which is not marked'):
        tried(friction=lambda contact, *_: twice(absolute(contact.sliding)))

    def helper(x):
        return x

    with pytest.raises(InputError, match=r'film\.law = "mine": calls helper, which is not marked'):
        tried(film=lambda contact, *_: (helper(-14.0), 1.0, 0.0))
    with pytest.raises(InputError, match="calls twice"):
        tried(
            friction=lambda contact, *_: 0.1 + 0.0 * contact.sliding,
            flash_temperature=lambda contact, *_: twice(contact.sliding),
        )


@pytest.mark.parametrize("value", [-1e-3, math.nan, math.inf])
def test_what_is_no_coefficient(value):
    with pytest.raises(InputError, match="in an ordinary contact, where a number of at least 0 is due"):
        tried(friction=lambda contact, *_: value + 0.0 * contact.sliding)


def test_both_directions_of_sliding_are_tried():
    with pytest.raises(InputError, match="in an ordinary contact"):
        tried(friction=lambda contact, *_: 0.1 * contact.sliding)
    with pytest.raises(InputError, match="in an ordinary contact"):
        tried(friction=lambda contact, *_: -0.1 * contact.sliding)


def test_a_film_that_is_none():
    with pytest.raises(InputError, match=r"film\.law"):
        tried(film=lambda contact, *_: (math.nan, 1.0, 0.0))
    with pytest.raises(InputError, match=r"film\.law"):
        tried(film=lambda contact, *_: (-14.0, -1.0, 0.0))
    with pytest.raises(InputError, match=r"film\.law"):
        tried(film=lambda contact, *_: (-14.0, 1.0, math.nan))


def test_what_fails_says_on_what():
    def branching(contact, *_):
        return 0.1 if contact.sliding > 0.0 else 0.2

    with pytest.raises(InputError, match=r"fails on arrays: ValueError.*where\(\) and not if"):
        tried(friction=branching)
    with pytest.raises(InputError, match=r"fails on a number: AttributeError"):
        tried(friction=lambda contact, *_: contact.no_such_thing)
    for name in ("in_range", "flash_temperature"):
        with pytest.raises(InputError, match="fails on a number: ZeroDivisionError"):
            tried(friction=lambda contact, *_: 0.1 + 0.0 * contact.sliding, **{name: lambda *_: 1 / 0})
    with pytest.raises(InputError, match="fails on a number: ZeroDivisionError"):
        tried(film=lambda contact, *_: (-14.0, 1.0, 0.0), in_range=lambda *_: 1 / 0)
