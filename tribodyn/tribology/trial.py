"""A law from outside this package, tried on ordinary contacts before a run relies on it."""

from collections.abc import Iterator
from types import FunctionType
from typing import Any

import numpy as np

from tribodyn.errors import InputError, quoted
from tribodyn.numerics import elementary
from tribodyn.tribology.contact import local_contact
from tribodyn.tribology.law import Closure, FilmLaw, FrictionLaw, KeyedLaw

#: Line load (N/m), curvature (1/m), entrainment, sliding, speeds of both flanks (m/s) of an ordinary gear
#: contact on either side of the pitch point.
_CONTACTS = ((4e5, 100.0, 2.0, 1.0, 2.5, 1.5), (2e5, 150.0, 2.0, -1.0, 1.5, 2.5))
REMEDY = "write it for scalars, with arithmetic and tribodyn.numerics.elementary: where() and not if"


def try_laws(film: FilmLaw, friction: FrictionLaw, closure: Closure) -> None:
    """Try the laws that are not this package's own, on numbers and on arrays.

    Raises InputError if a law calls what kernels cannot compile, fails, or gives no film or coefficient.
    """
    for law in (film, friction):
        if (law.function.__module__ or "").partition(".")[0] != "tribodyn":
            _try(law, closure)


def _try(law: FilmLaw | FrictionLaw, closure: Closure) -> None:
    key, name = f"{law.table}.law", quoted(law.name)
    refuse_unmarked(key, law)
    several = local_contact(*np.array(_CONTACTS).T)
    for how, contact in (("a number", local_contact(*_CONTACTS[0])), ("arrays", several)):
        try:
            with np.errstate(all="ignore"):
                value = _value(law, contact, closure)
        except Exception as error:
            why = " ".join(f"{type(error).__name__}: {error}".split())
            raise InputError(key, name, f"fails on {how}: {why}", REMEDY) from error
        if not np.all(np.isfinite(value)) or np.any(np.asarray(value) < 0.0):
            rule = f"gives {value} in an ordinary contact, where a number of at least 0 is due"
            raise InputError(key, name, rule, "mend its formula or its parameters")


def refuse_unmarked(key: str, law: KeyedLaw) -> None:
    """Raise InputError of a key if a law calls a function that is not marked as part of one."""
    for called in {other.__name__ for function in law.functions for other in _unmarked(function)}:
        rule = f"calls {called}, which is not marked as part of a law"
        raise InputError(key, quoted(law.name), rule, "put @law of tribodyn.numerics.elementary over it")


def _value(law: FilmLaw | FrictionLaw, contact: Any, closure: Closure) -> Any:
    """Film thickness or friction coefficient."""
    surfaces, film, friction = closure
    if isinstance(law, FilmLaw):
        log_smooth, rough, share = film.functions.film(contact, surfaces, film.parameters)
        film.functions.in_range(contact, surfaces, film.parameters)
        return elementary.exp(log_smooth) * rough + 0.0 * share
    coefficient = friction.functions.coefficient(contact, film, surfaces, friction.parameters)
    friction.functions.flash_temperature(contact, film, surfaces, friction.parameters, coefficient)
    friction.functions.in_range(contact, film, surfaces, friction.parameters)
    return coefficient


def _unmarked(function: Any) -> Iterator[FunctionType]:
    """Functions in Python that a law refers to by name and that are neither elementary nor marked."""
    cells = dict(zip(function.__code__.co_freevars, function.__closure__ or (), strict=True))
    names = {**function.__globals__, **{name: cell.cell_contents for name, cell in cells.items()}}
    for name in (*function.__code__.co_names, *function.__code__.co_freevars):
        other = names.get(name)
        if (
            isinstance(other, FunctionType)
            and other.__module__ != elementary.__name__
            and not any(other is marked for marked in elementary.LAWS)
        ):
            yield other
