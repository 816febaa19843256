"""A case of the dynamics of a gear pair: everything one simulation needs to know, in SI units."""

from dataclasses import dataclass

from tribodyn.dynamics.data import BearingData
from tribodyn.solve.data import SolverData
from tribodyn.studies.gears.case import LubricatedCase


@dataclass(frozen=True)
class OutputData:
    """What is recorded."""

    samples_per_cycle: int = 200


@dataclass(frozen=True, kw_only=True)
class Case(LubricatedCase):
    """One simulation, complete: gears, oil and laws, bearings of pinion and gear, solver, output."""

    bearings: tuple[BearingData, BearingData]
    solver: SolverData
    output: OutputData
