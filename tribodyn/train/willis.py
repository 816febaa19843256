"""Speeds and torques of any train of gears, shafts and epicyclic sets: one linear system over its bodies.

A mesh that a body c carries asks (ω_1 − ω_c) z_1 + (ω_2 − ω_c) z_2 = 0, teeth of an internal gear negative
(Willis); a coupling ω_1 − ω_2 = 0; a held or driven body ω = its speed. What these leave open are degrees of
freedom. Without losses torques are in balance by the same rows, transposed. Speeds and torques are
counter-clockwise.
"""

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import NamedTuple

import numpy as np


class Equation(NamedTuple):
    """One equation: Σ factor · speed of a body = value."""

    factors: Mapping[int, Fraction | float]
    value: Fraction = Fraction(0)


class Speeds(NamedTuple):
    """Solution of the rows."""

    speed: tuple[Fraction | None, ...]  # of every body; None: the rows leave it open
    freedom: int  # degrees of freedom that are left
    against: tuple[int, ...]  # rows that contradict those before them


def of_mesh(one: int, two: int, teeth: tuple[int, int], carrier: int = -1) -> Equation:
    """The row of a mesh of two bodies; carrier -1: the axes stand still."""
    factors = dict[int, Fraction]()
    for body, factor in ((one, teeth[0]), (two, teeth[1]), (carrier, -sum(teeth))):
        if body >= 0:
            factors[body] = factors.get(body, Fraction(0)) + factor
    return Equation(factors)


def of_coupling(one: int, two: int) -> Equation:
    """The row of two bodies that turn alike."""
    return Equation({one: Fraction(1), two: Fraction(-1)})


def of_speed(body: int, speed: Fraction = Fraction(0)) -> Equation:
    """The row of a body whose speed is given; 0: it is held."""
    return Equation({body: Fraction(1)}, speed)


def solve(count: int, rows: Sequence[Equation]) -> Speeds:
    """Speeds of so many bodies, exactly; rows that contradict those before them are left out and named."""
    solved: dict[int, tuple[dict[int, Fraction], Fraction]] = {}  # by the body that each row gives
    against = []
    for number, row in enumerate(rows):
        factors, value = _reduced({k: Fraction(f) for k, f in row.factors.items() if f}, row.value, solved)
        if not factors:
            if value:
                against.append(number)
            continue
        pivot = min(factors)
        by = factors.pop(pivot)
        factors, value = {body: factor / by for body, factor in factors.items()}, value / by
        for body, (others, constant) in solved.items():
            if share := others.pop(pivot, None):
                for other, factor in factors.items():
                    others[other] = others.get(other, Fraction(0)) - share * factor
                    if not others[other]:
                        del others[other]
                solved[body] = others, constant - share * value
        solved[pivot] = factors, value
    speed = tuple(
        solved[body][1] if body in solved and not solved[body][0] else None for body in range(count)
    )
    return Speeds(speed, count - len(solved), tuple(against))


def _reduced(
    factors: dict[int, Fraction], value: Fraction, solved: Mapping[int, tuple[dict[int, Fraction], Fraction]]
) -> tuple[dict[int, Fraction], Fraction]:
    """A row less what other rows give already."""
    for body in [body for body in factors if body in solved]:
        share = factors.pop(body)
        others, constant = solved[body]
        value -= share * constant
        for other, factor in others.items():
            factors[other] = factors.get(other, Fraction(0)) - share * factor
    return {body: factor for body, factor in factors.items() if factor}, value


def reactions(rows: Sequence[Equation], loads: Mapping[int, float]) -> list[float]:
    """Multiplier λ of every row that balances torques from outside (N m) on bodies: Σ λ · factor + load = 0.

    A mesh bears the torque λ z_1 on its first body, λ z_2 on its second, −λ (z_1 + z_2) on its carrier; the
    row of a held or driven body the torque λ that is put in there. Where rows share a load, the sum of the
    squares of λ is least. What no row can bear is left out.
    """
    bodies = sorted({body for row in rows for body in row.factors})
    place = {body: number for number, body in enumerate(bodies)}
    balance = np.zeros((len(bodies), len(rows)))
    for column, row in enumerate(rows):
        for body, factor in row.factors.items():
            balance[place[body], column] = float(factor)
    wanted = np.zeros(len(bodies))
    for body, load in loads.items():
        wanted[place[body]] -= load
    scale = np.linalg.norm(balance, axis=0)
    teeth = float(np.median(scale)) if len(rows) else 1.0
    for column, row in enumerate(rows):  # a torque counts like that of a gear of the usual size
        if len(row.factors) < 3 and scale[column] < 2.0:
            balance[:, column] *= teeth
    found, *_ = np.linalg.lstsq(balance, wanted, rcond=None)
    weights = [teeth if len(row.factors) < 3 and scale[k] < 2.0 else 1.0 for k, row in enumerate(rows)]
    return [float(value * weight) for value, weight in zip(found, weights, strict=True)]
