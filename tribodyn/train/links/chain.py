"""The laws of a train's links, as kernels are compiled for them.

Links whose law is not the linear one make a chain in which every function hands on what is another link's; it
ends with the linear law of all others. A train of linear links has the end alone.
"""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.numerics.elementary import law
from tribodyn.numerics.static import StaticInt
from tribodyn.train.links.law import LinkLaw, try_link_law
from tribodyn.train.links.linear import linear


class LinearLinks(NamedTuple):
    """End of a chain: the links that are linear."""

    #: (link, twist, stiffness, parameters, laws) -> torque, energy, share of damping; see `LinkLaw`
    act: Callable[..., Any]
    #: (link, twist, difference of twist, stiffness, parameters, laws) -> slopes of torque and share by twist
    slope: Callable[..., Any]


class LawOfLink(NamedTuple):
    """Part of a chain: one link that has a law of its own, and the rest."""

    act: Callable[..., Any]
    slope: Callable[..., Any]
    law: Callable[..., Any]
    link: StaticInt  # its number
    rest: Any


class OfLink(NamedTuple):
    """Parameters of the laws of a chain."""

    own: Any
    rest: Any


class NoLinkParameters(NamedTuple):
    """Parameters of the linear law."""


@law
def _act_linearly(link, twist, stiffness, parameters, laws):
    return linear(twist, stiffness, parameters)


@law
def _slope_of_linear(link, twist, by, stiffness, parameters, laws):
    return stiffness, 0.0


@law
def _act(link, twist, stiffness, parameters, laws):
    if link == laws.link:
        torque, energy, share = laws.law(twist, stiffness, parameters.own)
    else:
        torque, energy, share = laws.rest.act(link, twist, stiffness, parameters.rest, laws.rest)
    return torque + 0.0 * twist, energy + 0.0 * twist, share + 0.0 * twist


@law
def _slope(link, twist, by, stiffness, parameters, laws):
    if link == laws.link:
        torque, _, share = laws.law(twist + by, stiffness, parameters.own)
        before, _, less = laws.law(twist - by, stiffness, parameters.own)
        torque, share = (torque - before) / (2.0 * by), (share - less) / (2.0 * by)
    else:
        torque, share = laws.rest.slope(link, twist, by, stiffness, parameters.rest, laws.rest)
    return torque + 0.0 * twist, share + 0.0 * twist


LINEAR = LinearLinks(_act_linearly, _slope_of_linear)


def chain_of(
    laws: Sequence[tuple[str, LinkLaw, dict[str, Any]]], stiffness: Sequence[float]
) -> tuple[LinearLinks | LawOfLink, Any]:
    """Laws and parameters of a train: of every link its key in the scenario, the law, values of its keys.

    Raises InputError where a law lacks a value, or comes from outside this package and does not work.
    """
    chain: Any = LINEAR
    parameters: Any = NoLinkParameters()
    for link, (key, own, values) in enumerate(laws):
        if own.function is not linear:
            try:
                numbers = own.made(None, values)
                try_link_law(own, stiffness[link], numbers)
            except InputError as error:
                place = f"{key}.{error.key.rpartition('.')[2]}"
                raise InputError(place, error.value, error.rule, error.remedy) from error
            chain = LawOfLink(_act, _slope, own.function, StaticInt(link), chain)
            parameters = OfLink(numbers, parameters)
    return chain, parameters


def numbers_of(parameters: Any) -> list[Any]:
    """Values of the keys of all laws of a chain, one after the other."""
    return [*parameters.own, *numbers_of(parameters.rest)] if parameters else []


def _torque(link: int, twist: float, model: Any) -> float:
    stiffness = float(np.asarray(model.links.stiffness)[link, -1])
    return float(model.options.links.act(link, twist, stiffness, model.links.own, model.options.links)[0])


def twist_under(link: int, torque: float, model: Any) -> float:
    """The least twist at which a link bears a torque, rad; where none does, that of a linear one."""
    linear_twist = torque / float(np.asarray(model.links.stiffness)[link, -1])
    if abs(_torque(link, linear_twist, model) - torque) <= 1e-12 * abs(torque):
        return linear_twist
    low, high = 0.0, linear_twist
    for _ in range(60):
        if abs(_torque(link, high, model)) >= abs(torque):
            break
        low, high = high, 2.0 * high
    else:
        return linear_twist
    for _ in range(80):
        middle = 0.5 * (low + high)
        short = abs(_torque(link, middle, model)) < abs(torque)
        low, high = (middle, high) if short else (low, middle)
    return high


def tangent_stiffness(link: int, torque: float, model: Any) -> float:
    """Slope of a link's torque by twist under a torque, N m/rad."""
    stiffness, laws = float(np.asarray(model.links.stiffness)[link, -1]), model.options.links
    twist = twist_under(link, torque, model)
    by = 1e-6 * max(abs(twist), 1e-9)
    return float(laws.slope(link, twist, by, stiffness, model.links.own, laws)[0])
