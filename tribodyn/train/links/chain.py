"""The laws of a train's links, as kernels are compiled for them.

Links under the laws of this package stand in a table, which kernels read and do not depend on. A link under a
law from outside is part of a chain of types, in which every function hands on what is another link's, and
which ends with the table of all others.
"""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.numerics.elementary import StaticInt, law, namespace, skippable, where
from tribodyn.numerics.shapes import Array, Float
from tribodyn.train.links.law import LinkLaw, linear, try_link_law
from tribodyn.train.links.play import Play, with_play


class PlayOfLinks(NamedTuple):
    """Play of every link, as `play.Play` has it; links that are not in the table are linear."""

    play: Float[Array, " link"]  # rad; 0: linear
    contact_share: Float[Array, " link"]


class TabulatedLinks(NamedTuple):
    """End of a chain: the links of the table."""

    #: (link, twist, stiffness, parameters, laws) -> torque, energy, share of damping; see `LinkLaw`
    act: Callable[..., Any]
    #: (link, twist, difference of twist, stiffness, parameters, laws) -> slopes of torque and share by twist
    slope: Callable[..., Any]


class LawOfLink(NamedTuple):
    """Part of a chain: one link that has a law from outside this package, and the rest."""

    act: Callable[..., Any]
    slope: Callable[..., Any]
    law: Callable[..., Any]
    link: StaticInt  # its number
    rest: Any


class OfLink(NamedTuple):
    """Parameters of the laws of a chain."""

    own: Any
    rest: Any


#: All links are linear.
NO_PLAY = PlayOfLinks(np.zeros(0), np.zeros(0))


@law
def _play_of(link, table):
    """Parameters of a link's play; of one that has none such as give a number."""
    loose = table.play[link] > 0.0
    return Play(where(loose, table.play[link], 1.0), where(loose, table.contact_share[link], 1.0))


@law
def _act_by_table(link, twist, stiffness, table, laws):
    torque, energy, share = linear(twist, stiffness, table)
    share = share + 0.0 * twist
    if link < table.play.shape[0] and not skippable(table.play[link] == 0.0):
        beyond, stored, acting = with_play(twist, stiffness, _play_of(link, table))
        loose = table.play[link] > 0.0
        torque, energy = where(loose, beyond, torque), where(loose, stored, energy)
        share = where(loose, acting, share)
    return torque, energy, share


@law
def _slope_by_table(link, twist, by, stiffness, table, laws):
    slope, rise = stiffness + 0.0 * twist, 0.0 * twist
    if link < table.play.shape[0] and not skippable(table.play[link] == 0.0):
        torque, _, share = _act_by_table(link, twist + by, stiffness, table, laws)
        before, _, less = _act_by_table(link, twist - by, stiffness, table, laws)
        loose = table.play[link] > 0.0
        slope = where(loose, (torque - before) / (2.0 * by), slope)
        rise = where(loose, (share - less) / (2.0 * by), rise)
    return slope, rise


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


BY_TABLE = TabulatedLinks(_act_by_table, _slope_by_table)


def chain_of(
    laws: Sequence[tuple[str, LinkLaw, dict[str, Any]]], stiffness: Sequence[float]
) -> tuple[TabulatedLinks | LawOfLink, Any]:
    """Laws and parameters of a train: of every link its key in the scenario, the law, values of its keys.

    Raises InputError where a law lacks a value, or comes from outside this package and does not work.
    """
    chain: Any = BY_TABLE
    plays = [Play(0.0, 1.0)] * len(laws)
    outside: list[Any] = []
    loose = False
    for link, (key, used, values) in enumerate(laws):
        if used.function is linear:
            continue
        try:
            numbers = used.made(None, values)
            try_link_law(used, stiffness[link], numbers)
        except InputError as error:
            place = f"{key}.{error.key.rpartition('.')[2]}"
            raise InputError(place, error.value, error.rule, error.remedy) from error
        if used.function is with_play:
            plays[link], loose = numbers, True
        else:
            chain = LawOfLink(_act, _slope, used.function, StaticInt(link), chain)
            outside.append(numbers)
    parameters: Any = NO_PLAY
    if loose:
        xp = namespace(*(number for play in plays for number in play))
        parameters = PlayOfLinks(*map(xp.asarray, zip(*plays, strict=True)))
    for numbers in outside:
        parameters = OfLink(numbers, parameters)
    return chain, parameters


def numbers_of(parameters: Any) -> list[Any]:
    """Values of the keys of all laws of a chain, one after the other."""
    return (
        [*parameters.own, *numbers_of(parameters.rest)] if isinstance(parameters, OfLink) else [*parameters]
    )


def are_linear(parameters: Any) -> bool:
    """Whether no link has another law than the linear one."""
    return not isinstance(parameters, OfLink) and not len(parameters.play)


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
