"""Random values as a scenario gives them, from one generator."""

from collections.abc import Sequence
from typing import Any

import numpy as np


class Draw:
    """Draws values of a case, which follow from some numbers: a seed, the case's own."""

    def __init__(self, *words: int) -> None:
        self._random = np.random.default_rng(np.random.SeedSequence(words))

    def chance(self, share: float) -> bool:
        """Say yes in a share of the draws."""
        return bool(self._random.random() < share)

    def between(self, low: float, high: float) -> float:
        """Return a number, uniform, with four digits as a person would write it."""
        return _short(self._random.uniform(low, high))

    def decades(self, low: float, high: float) -> float:
        """Return a positive number whose logarithm is uniform."""
        return _short(np.exp(self._random.uniform(np.log(low), np.log(high))))

    def whole(self, low: int, high: int) -> int:
        """Return a whole number, both ends included."""
        return int(self._random.integers(low, high + 1))

    def whole_decades(self, low: int, high: int) -> int:
        """Return a whole number whose logarithm is uniform."""
        return round(np.exp(self._random.uniform(np.log(low), np.log(high))))

    def choice(self, choices: Sequence[Any], weights: Sequence[float] | None = None) -> Any:
        """Return one of several values; the weights need no sum of 1."""
        share = None if weights is None else np.array(weights) / np.sum(weights)
        return choices[int(self._random.choice(len(choices), p=share))]


def _short(value: float) -> float:
    return float(f"{value:.4g}")


def quantity(value: float, unit: str) -> str:
    """Write a quantity: 0.003 and "m" as "0.003 m"."""
    return f"{value:.6g} {unit}"
