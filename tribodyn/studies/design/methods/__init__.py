"""The methods of a search, one sort a file; all of them ask the archive and return nothing."""

import math
from collections.abc import Callable
from importlib.util import find_spec

import numpy as np

from tribodyn.errors import InputError
from tribodyn.studies.design.candidates.archive import Archive
from tribodyn.studies.design.candidates.scoring import derivatives_of
from tribodyn.studies.design.case import DesignCase
from tribodyn.studies.design.methods.local import epsilon_constraint, local
from tribodyn.studies.design.methods.population import cma_es, differential_evolution, every, nsga2

Method = Callable[[Archive, np.ndarray], None]
"""Searches from the shares at which the base scenario stands."""

METHODS: dict[str, Method] = {
    "cobyqa": local("cobyqa"),
    "slsqp": local("slsqp"),
    "trust-constr": local("trust-constr"),
    "differential-evolution": differential_evolution,
    "cma-es": cma_es,
    "epsilon-constraint": epsilon_constraint,
    "nsga2": nsga2,
    "every": every,
}
FRONTS = ("epsilon-constraint", "nsga2")
#: Packages that methods are from.
PACKAGES = {"cma-es": "cma", "nsga2": "pymoo"}
#: Free keys above which derivatives are worth their program.
MANY = 6
#: Those that need values between which there are others.
SMOOTH = ("cobyqa", "slsqp", "trust-constr", "epsilon-constraint")


def method_of(case: DesignCase) -> tuple[str, str]:
    """Name of the method for a search, and why it is that one.

    Raises InputError for a method that does not fit what is searched, or whose package is not installed.
    """
    name, reason = _fitting(case)
    package = PACKAGES.get(name)
    if package and find_spec(package) is None:
        rule = f"the package {package} is not installed"
        raise InputError("design.method", f'"{name}"', rule, 'install it: pip install "tribodyn[design]"')
    return name, reason


def _fitting(case: DesignCase) -> tuple[str, str]:
    """The method that is wanted, or that fits, and why."""
    wanted = case.search.method
    count = math.prod(free.number_of_values for free in case.free)
    smooth = all(free.continuous for free in case.free)
    two = len(case.objectives) == 2
    if wanted == "auto":
        if not smooth and not two and count <= case.search.evaluations:
            return "every", "few enough values to evaluate every one"
        if two:
            name = "epsilon-constraint" if smooth else "nsga2"
            return name, "two objectives" + ("" if smooth else ", and whole numbers or choices")
        if not smooth:
            return "differential-evolution", "whole numbers or choices"
        if len(case.free) > MANY and derivatives_of(case):
            return "slsqp", "many continuous values, derivatives through JAX"
        return "cobyqa", "continuous values, quantities that may have kinks"
    if two != (wanted in FRONTS) and wanted != "every":
        rule = "needs two objectives" if not two else "takes one objective"
        remedy = "choose auto, or " + ("another method" if not two else " or ".join(FRONTS))
        raise InputError("design.method", f'"{wanted}"', rule, remedy)
    if wanted in SMOOTH and not smooth:
        rule = "whole numbers and choices are free, which it cannot search"
        raise InputError("design.method", f'"{wanted}"', rule, "choose differential-evolution or nsga2")
    if wanted == "every" and not count <= case.search.evaluations:
        rule = "there are more values than design.evaluations"
        raise InputError("design.method", f'"{wanted}"', rule, "choose another method, or more evaluations")
    return wanted, "chosen by the scenario"
