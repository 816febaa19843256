"""All that is known of a contact under the laws in use: what is recorded of it."""

from collections.abc import Sequence
from functools import reduce
from typing import Any, NamedTuple

import numpy as np

from tribodyn.numerics.elementary import exp, is_jax, law, minimum, namespace, where
from tribodyn.numerics.shapes import Array, Float
from tribodyn.tribology.contact import (
    MAXIMUM_OVER_MEAN,
    LocalContact,
    averaged_radius,
    hertz_half_width,
    local_contact,
)
from tribodyn.tribology.law import ActiveLaw, Closure, FilmFunctions, film_range_not_stated


class SurfaceState(NamedTuple):
    """Film, pressure, temperature and friction of contacts; SI, named as in a record."""

    friction_coefficient: Any  # μ
    asperity_load_ratio: Any  # share λ of the load that asperities carry; 0 of a film law of smooth surfaces
    central_film_thickness: Any  # of the film law, m; the minimum film where the law gives that
    flash_temperature_rise: Any  # ΔT, K
    hertz_pressure: Any  # maximum Hertz pressure p_H, Pa
    #: closure_in_range, friction_in_range: 1.0 where the film law and the friction law are inside their
    #: range, 0.0 outside, NaN: none stated.
    closure_in_range: Any
    friction_in_range: Any


@law
def film_given(contact, surfaces, evaluated):
    """What the film law gave, as parameters of a law that evaluates nothing."""
    return evaluated


@law
def _film_and_heat(contact, surfaces, film, friction):
    """Evaluate the laws in use once: the film law's results, friction coefficient, flash temperature rise."""
    evaluated = film.functions.film(contact, surfaces, film.parameters)
    # so that no friction law evaluates the film again
    film_as_given = ActiveLaw(FilmFunctions(film_given, film_range_not_stated), evaluated)
    coefficient = friction.functions.coefficient(contact, film_as_given, surfaces, friction.parameters)
    temperature = friction.functions.flash_temperature(
        contact, film_as_given, surfaces, friction.parameters, coefficient
    )
    return evaluated, film_as_given, coefficient, temperature


@law
def film_and_temperature(contact, surfaces, film, friction):
    """Film thickness (m) and flash temperature rise (K), as `surface_state`."""
    evaluated, _, _, temperature = _film_and_heat(contact, surfaces, film, friction)
    log_smooth, rough, _ = evaluated
    return exp(log_smooth) * rough, temperature


def surface_state(contact: LocalContact, closure: Closure) -> SurfaceState:
    """Evaluate the laws in use; arrays broadcast."""
    return surface_and_limits(contact, closure)[0]


def surface_and_limits(contact: LocalContact, closure: Closure) -> tuple[SurfaceState, tuple[Any, Any]]:
    """`surface_state`, and what film and friction law say of their limits, one array per limit."""
    surfaces, film, friction = closure
    evaluated, film_as_given, coefficient, temperature = _film_and_heat(contact, surfaces, film, friction)
    log_smooth, rough, share = evaluated
    zero = 0.0 * log_smooth
    half_width = hertz_half_width(contact.line_load, contact.curvature, surfaces.effective_modulus)
    of_film = film.functions.in_range(contact, surfaces, film.parameters)
    of_friction = friction.functions.in_range(contact, film_as_given, surfaces, friction.parameters)
    state = SurfaceState(
        zero + coefficient,
        zero + share,
        exp(log_smooth) * rough,
        zero + temperature,
        zero + MAXIMUM_OVER_MEAN * (contact.line_load / (2.0 * half_width)),
        _inside(of_film),
        _inside(of_friction),
    )
    return state, (of_film, of_friction)


class ContactFriction(NamedTuple):
    """What the laws give, and the contact they saw; arrays of one shape, SI."""

    surface: SurfaceState
    #: radius, entrainment: averaged over the contact's own width where they vanish at the pitch point
    radius: Float[Array, "*contact"]
    entrainment: Float[Array, "*contact"]
    contact: LocalContact  # as the laws see it


def contact_friction(
    closure: Closure,
    line_load: Float[Array, "*contact"],
    radius: Float[Array, "*contact"],
    pinion_speed: Float[Array, "*contact"],
    gear_speed: Float[Array, "*contact"],
    pitch_point_length: Any = 0.0,
    pitch_point_rate: Any = 0.0,
) -> ContactFriction:
    """Evaluate the laws in use at line loads (N/m), radii (m) and rolling speeds (m/s).

    `pitch_point_length` and `pitch_point_rate` are M (m) and entrainment over equivalent radius (1/s) of
    `geometry.pitch_point`; 0: nothing vanishes, or is averaged. A traced length is taken as positive.
    """
    sliding = pinion_speed - gear_speed
    seen, speeds = radius + 0.0 * line_load, (pinion_speed, gear_speed)
    if is_jax(pitch_point_length) or pitch_point_length > 0.0:
        seen = averaged_radius(radius, line_load, closure.surfaces.effective_modulus, pitch_point_length)
        # entrainment is averaged with the radius, to which it is proportional there; sliding is not
        added = pitch_point_rate * (seen - radius)
        speeds = pinion_speed + added, gear_speed + added
    entrainment = (speeds[0] + speeds[1]) / 2.0
    with np.errstate(over="ignore", under="ignore"):
        contact = local_contact(line_load, 1.0 / seen, entrainment, sliding, *speeds)
        return ContactFriction(surface_state(contact, closure), seen, entrainment, contact)


def range_shares(contact: LocalContact, closure: Closure) -> tuple[np.ndarray, np.ndarray]:
    """Shares allowed by each limit of film and friction law, (…, limits); below 1 outside, NaN: unstated."""
    of_film, of_friction = surface_and_limits(contact, closure)[1]
    return limits_last(of_film), limits_last(of_friction)


def _several(shares: Any) -> Any:
    return shares if isinstance(shares, (tuple, list)) else (shares,)


def limits_last(shares: Any) -> Any:
    """What a law says of its range as an array, its limits last."""
    several = _several(shares)
    xp = namespace(several)
    return xp.stack(xp.broadcast_arrays(*several), axis=-1)


def _inside(shares: Any) -> Any:
    """1.0 where every share is at least 1, 0.0 elsewhere, NaN where none is stated."""
    least = reduce(minimum, _several(shares))
    return where(least != least, np.nan, least >= 1.0)


def exceeded(shares: np.ndarray, limits: Sequence[str]) -> dict[str, dict[str, Any]]:
    """Which limits (in words) of a law are exceeded, by how much and in which share of the contacts.

    From the shares (contacts, limits) of `range_shares`, of loaded contacts, to number as text -> `limit`,
    `share` of the contacts outside, `factor` by which the limit is exceeded at most; without the factor where
    the law does not give it. The largest factor first. None of a law without limits.
    """
    if len(limits) != shares.shape[-1]:
        return {}
    exceedances = []
    for column, limit in zip(shares.T, limits, strict=True):
        outside = column < 1.0
        if np.any(outside):
            least = float(np.min(column[outside]))
            factor = {"factor": 1.0 / least} if least > 0.0 else {}
            exceedances.append({"limit": limit, "share": float(np.mean(outside)), **factor})
    exceedances.sort(key=lambda limit: -limit.get("factor", np.inf))
    return {str(number): value for number, value in enumerate(exceedances, start=1)}


def fraction_in_range(in_range: Any) -> float | None:
    """Share of contacts in which a law is inside its range; None where it states none, 1 without contacts."""
    in_range = np.asarray(in_range, dtype=float)
    if in_range.size == 0:
        return 1.0
    return None if np.isnan(in_range).all() else float(np.mean(in_range))
