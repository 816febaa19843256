"""Motions of a train every mesh of which is located by its own driver's actual rotation.

The package locates the reference mesh so, and the others by the reference's: a driver that is twisted against
the reference by ϑ is z ϑ/2π cycles further in its mesh. Here the same right-hand side is asked at the places
so found, and pairs enter and leave where these come to the boundaries of the tables, found by root finding.

The rates of gaps and pressure angles stay those of the reference's rotation: they are nothing in meshes of
involutes without deviations. Of the works that of the change of stiffness is not right.
"""

from math import floor
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

from tribodyn.dynamics.approach import NORMAL_LOAD
from tribodyn.dynamics.parameters import CLASSICAL, Model, with_shared_code
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.right_hand_side import rhs, work_array
from tribodyn.train.structure import turned

#: Of the integration; that of displacements is over a micrometre, of rates over 1 mm/s or 1 mrad/s.
TOLERANCE = 1e-8
#: Cycles by which a place on a boundary is taken to lie behind it.
_BEHIND = 1e-9

State = Float[Array, " state"]


class LocatedMotion(NamedTuple):
    """Samples: reference cycles, states, and the total normal load of every mesh (N)."""

    cycles: Float[Array, " sample"]
    states: Float[Array, "sample state"]
    load: Float[Array, "sample mesh"]


class LocatedMeshes:
    """A train's right-hand side with its meshes where a share of the actual twist puts them.

    `phases` are the meshes' at turn 0 of the reference without any twist; a share of 0 is the package's
    nominal rotation.
    """

    def __init__(self, model: Model, phases: Float[Array, " mesh"], share: float):
        assert model.options.formulation == CLASSICAL  # no impulse where pairs enter and leave
        count = model.layout.meshes
        self.boundaries = [np.asarray(mesh.table.boundary) for mesh in model.meshes]
        self._phases, self._rate = phases, np.asarray(model.schedule.rate)
        teeth = [2.0 * np.pi / float(mesh.table.pitch_angle) for mesh in model.meshes]
        self._further = share * np.array(teeth) / (2.0 * np.pi)
        self._offset, self._segment = np.zeros((1, count)), np.zeros((1, count))
        self._model = with_shared_code(model)._replace(
            schedule=model.schedule._replace(rate=np.zeros(count), offset=self._offset, segment=self._segment)
        )
        self._work = work_array(model)

    def place(self, m: int, cycle: float, y: State) -> float:
        """Cycles that a mesh has done."""
        layout = self._model.layout
        return (
            self._phases[m]
            + self._rate[m] * cycle
            + self._further[m] * float(turned(layout.driver[m], y, layout))
        )

    def segment(self, m: int, cycle: float, y: State) -> tuple[int, int]:
        """Whole cycles of a mesh, and the segment of its table."""
        place = self.place(m, cycle, y) + _BEHIND
        return floor(place), int(np.searchsorted(self.boundaries[m], place - floor(place), "right")) - 1

    def rates(self, cycle: float, y: State, where: list[tuple[int, int]]) -> State:
        """Derivatives per reference cycle, in these segments; leaves the loads."""
        for m, (whole, segment) in enumerate(where):
            self._offset[0, m], self._segment[0, m] = self.place(m, cycle, y) - whole, segment
        found = np.empty_like(y)
        rhs(0.0, cycle, 0, np.ascontiguousarray(y), self._model, self._work, found)
        return found

    def loads(self, cycle: float, y: State, where: list[tuple[int, int]]) -> list[float]:
        """Total normal load of every mesh, N."""
        self.rates(cycle, y, where)
        return [
            float(work[NORMAL_LOAD, : mesh.table.side.shape[0]].sum())
            for work, mesh in zip(self._work, self._model.meshes, strict=True)
        ]


def located_motion(
    model: Model, start: State, phases: Float[Array, " mesh"], cycles: int, samples: int, share: float = 1.0
) -> LocatedMotion:
    """Integrate over reference cycles, with so many samples in each; see `LocatedMeshes`."""
    layout, meshes = model.layout, LocatedMeshes(model, np.asarray(phases), share)
    size = np.full(layout.states, 1e-6)
    size[layout.half : layout.mechanical], size[layout.mechanical :] = 1e-3, 1.0
    wanted = np.arange(cycles * samples + 1) / samples
    cycle, y = 0.0, np.array(start, dtype=float)
    where = [meshes.segment(m, cycle, y) for m in range(layout.meshes)]
    states, forces = [y], [meshes.loads(cycle, y, where)]
    while len(states) < len(wanted):
        ends = [whole + meshes.boundaries[m][segment + 1] for m, (whole, segment) in enumerate(where)]
        solution = solve_ivp(
            meshes.rates,
            (cycle, float(cycles) + _BEHIND),
            y,
            "DOP853",
            wanted[wanted > cycle],
            events=[_arrival(meshes, m, end) for m, end in enumerate(ends)],
            args=(where,),
            rtol=TOLERANCE,
            atol=TOLERANCE * size,
        )
        states += list(solution.y.T)
        forces += [meshes.loads(at, y, where) for at, y in zip(solution.t, solution.y.T, strict=True)]
        if solution.status:
            m = next(m for m, times in enumerate(solution.t_events) if len(times))
            cycle, y = float(solution.t_events[m][-1]), solution.y_events[m][-1]
            whole, segment = where[m]
            where = list(where)
            where[m] = (whole, segment + 1) if segment + 2 < len(meshes.boundaries[m]) else (whole + 1, 0)
    return LocatedMotion(wanted, np.array(states), np.array(forces))


def _arrival(meshes: LocatedMeshes, m: int, end: float):
    """Event: a mesh comes to the end of its segment."""

    def left(cycle: float, y: State, _: object) -> float:
        return end - meshes.place(m, cycle, y)

    left.terminal, left.direction = True, -1.0  # pyright: ignore[reportFunctionMemberAccess]
    return left
