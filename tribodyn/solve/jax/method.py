"""What a method of diffrax is to the integrator."""

from collections.abc import Callable
from typing import Any, NamedTuple


class DiffraxMethod(NamedTuple):
    """A method of diffrax.

    Attributes
    ----------
    solver : () -> diffrax's solver
    stages : evaluations of the right-hand side in a step, without those of an implicit method's iteration
    proportional, integral : gains of the step-size controller
    """

    solver: Callable[[], Any]
    stages: int
    proportional: float
    integral: float
