"""What differs between the kinds of motions that are swept: how cases are prepared, what is told of them."""

from collections.abc import Hashable, Mapping, Sequence
from math import ceil
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.numerics.parameter import Variable
from tribodyn.quantities.quantity import Quantity
from tribodyn.studies.gears.batch.swept import SweepSettings
from tribodyn.studies.gears.over_time.extremes import RunningExtremes
from tribodyn.studies.gears.over_time.running import MeshOfRun
from tribodyn.studies.gears.over_time.sampled import Sampled
from tribodyn.studies.gears.sensed.listening import Listener
from tribodyn.studies.protocol.cost import Driver, Estimate

#: The mesh whose transmission error a sweep samples.
REFERENCE = 0


class Pace(NamedTuple):
    """How fast a case goes."""

    speed: float  # of the reference body, rad/s
    cycles: float  # of the reference mesh in a turn of it
    slowest: float  # and in a turn of the gear that turns slowest


class Form(NamedTuple):
    """What the cases of a sweep have in common."""

    modes: int
    states: tuple[str, ...]  # names
    common: int = 1  # mesh cycles after which all meshes are at their phases again
    meshes: tuple[str, ...] = ()  # names of several


class SweptKind:
    """What differs between kinds of motions that are swept. A prepared case has `model`, `case`, `given`."""

    swept: Sequence[Quantity] = ()  # one number per case
    of_meshes: Mapping[str, Variable] = MappingProxyType({})  # datasets over several meshes
    most_states = 0

    def form(self, cases: Sequence[Any]) -> Form:
        """What the cases of a sweep have in common."""
        raise NotImplementedError

    def table_key(self, case: Any) -> Hashable:
        """Everything that the tables of a case depend on."""
        raise NotImplementedError

    def tables(self, case: Any) -> Any:
        """The case's tables, made once for all cases that share them; raises as `prepare` does."""
        raise NotImplementedError

    def prepare(self, case: Any, tabulated: Any) -> Any:
        """Prepare a case with tables of its `table_key`; raises InputError."""
        raise NotImplementedError

    def refuse_steady(self, case: Any) -> None:
        """Raise InputError for a case that has no steady state that could be sought."""
        if self.differ(case):
            turn = ceil(self.pace(case).slowest)
            rule = "teeth of a gear differ: no steady state repeats with the mesh, and none is sought"
            remedy = (
                f"march: --transient {10 * turn} ({turn} mesh cycles are a turn of the slowest gear), or "
            )
            remedy += "keep what sensors hear: --signals 1s"
            raise InputError("--steady", None, rule, remedy)
        self.refuse(case)

    def refuse(self, case: Any) -> None:
        """Raise InputError for a case that has none for a reason of the kind's own."""

    def meshes(self, prepared: Any) -> list[MeshOfRun]:
        """The meshes, as the summary of a run sees them."""
        raise NotImplementedError

    def differ(self, case: Any) -> bool:
        """Whether teeth of one gear differ, so that no mesh cycle is like the one before."""
        raise NotImplementedError

    def pace(self, case: Any) -> Pace:
        """How fast it goes."""
        raise NotImplementedError

    def listener(self, prepared: Any) -> Listener:
        """What listens to its sensors; raises InputError where one cannot."""
        raise NotImplementedError

    def frequencies(self, prepared: Any) -> np.ndarray:
        """Natural frequencies, Hz, ascending."""
        raise NotImplementedError

    def places(self, prepared: Any, settings: SweepSettings) -> list[int]:
        """Places of a case's states among those of the sweep; InputError where they do not fit."""
        raise NotImplementedError

    def steady_quantities(
        self,
        inside: Sampled,
        work: np.ndarray,
        prepared: Any,
        samples: int,
        extremes: Sequence[RunningExtremes],
    ) -> tuple[dict[str, Any], dict[str, np.ndarray], Sequence[Mapping[str, Any]]]:
        """Quantities over a window: of the case, of each mesh for `of_meshes`, and those to judge."""
        raise NotImplementedError

    def warmer(self, case: Any, row: Mapping[str, Any]) -> Any:
        """The case at the bulk temperature of its own motion, `row` of a sweep; None: it is."""
        raise NotImplementedError

    def warnings(self, _prepared: Any) -> list[str]:
        """What to warn of in a prepared case, whatever its motion; without semicolons."""
        return []

    def sliding(self, case: Any) -> str:
        """Its `friction.sliding`."""
        raise NotImplementedError

    def drivers(self, case: Any) -> tuple[Driver, ...]:
        """Keys that make it large."""
        raise NotImplementedError

    def marching(self, case: Any, cycles: float) -> list[Estimate]:
        """What its tables and so many mesh cycles take, of many cases side by side."""
        raise NotImplementedError
