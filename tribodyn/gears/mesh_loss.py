"""The loss of a mesh in slow rotation at many points of operation together: torques, speeds, temperatures.

The table is that of the nominal load, its nodes thinned out: the mean over the mesh cycle then is that of all
nodes to some 1e-4 (slices) or 1e-6. Loads and friction settle as in `mesh.equilibrium`, by fewer passes.
"""

from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import InputError, SimulationError, quoted
from tribodyn.gears.case import LubricatedCase
from tribodyn.gears.tabulated import Tabulated
from tribodyn.mesh.cycle import MeshCycle, slopes
from tribodyn.mesh.equilibrium import contacts
from tribodyn.mesh.quasi_static import quasi_static
from tribodyn.numerics.shapes import Array, Float
from tribodyn.tribology.closure import closure_of, laws_of, untried_closure_of
from tribodyn.tribology.law import Closure
from tribodyn.tribology.oil import LubricantData, lubricant_from

#: Cells of a segment that are kept, of spur teeth and of slices.
CELLS, CELLS_OF_SLICES = 16, 32
#: Passes of loads and friction, each of which takes a tenth or less of the change before.
PASSES = 2
#: Laws that say what they are told to.
UNBOUNDED = ("coulomb", "none")
#: Torques over the nominal one at which loads are known, from which others begin.
TORQUES = np.geomspace(1e-4, 10.0, 41)
#: Numbers of an array that are worked on together: what a processor's cache holds some of.
TOGETHER = 60_000
#: Shares of the nominal torque and speed at which a mesh with less is taken; its loss falls with the torque.
LEAST_TORQUE, LEAST_SPEED = 1e-6, 1e-3


class MeshPoints(NamedTuple):
    """Points of operation of a mesh."""

    torque: Float[Array, " point"]  # on the driven gear, against its motion, N m; negative: it drives
    speed: Float[Array, " point"]  # magnitude, of the driver, rad/s
    temperature: Float[Array, " point"]  # of the teeth, K
    supply: Float[Array, " point"]  # of the oil around the gears, K


class MeshLoss(NamedTuple):
    """What a mesh loses at every point."""

    drag: Float[Array, " point"]  # power lost over the driver's speed, N m
    #: film_min (m), film_parameter_min, friction_coefficient_mean, hertz_pressure_max (Pa), film_in_range,
    #: friction_in_range (shares of the contacts), NaN without load; friction_held, 1 where `_most` held it
    seen: Mapping[str, Float[Array, " point"]]
    exceeded: tuple[str, ...] = ()  # limits of the tables, or of a standard's formula


class LossTable:
    """A mesh of a case, made ready for points of operation."""

    def __init__(self, tabulated: Tabulated, pair: LubricatedCase) -> None:
        self.tabulated, self.pair = tabulated, pair
        self.nominal = abs(float(pair.operating.gear_torque)) or 1.0  # N m

    @cached_property
    def cycle(self) -> MeshCycle:
        """The table of driving flanks, thinned out."""
        whole = self.tabulated.split()
        return thinned(whole, CELLS_OF_SLICES if whole.slices > 1 else CELLS)

    @cached_property
    def weight(self) -> Float[Array, "segment node slot"]:
        """Weights of a sum over the nodes that is the mean over the mesh cycle, signed as sliding is."""
        return _weights(self.cycle)

    @cached_property
    def loads(self) -> Float[Array, "torque segment node slot"]:
        """Loads without friction over torques at `TORQUES` of the nominal one, per torque."""
        torques = TORQUES * self.nominal
        shared = self.cycle.gear_sense * torques[:, None, None]
        return quasi_static(self.cycle, shared).normal_load / torques[:, None, None, None]

    def _near(self, torque: Float[Array, " point"]) -> Float[Array, "point segment node slot"]:
        """Loads without friction at torques > 0, between those of `loads`."""
        step = np.log(TORQUES[1] / TORQUES[0])
        place = np.clip(np.log(torque / self.nominal / TORQUES[0]) / step, 0.0, len(TORQUES) - 1.0)
        before = np.minimum(place.astype(int), len(TORQUES) - 2)
        share = (place - before)[:, None, None, None]
        between = (1.0 - share) * self.loads[before] + share * self.loads[before + 1]
        return between * torque[:, None, None, None]

    def at(self, points: MeshPoints) -> MeshLoss:
        """Losses at points; raises InputError for a law of one duty, SimulationError where friction locks."""
        solved = _solved_for(self.pair, points)
        count = max(1, TOGETHER // self.cycle.compliance.size)
        several = len(points.torque)
        parts = [
            self._of_some(MeshPoints(*(values[first : first + count] for values in points)), solved)
            for first in range(0, several, count)
        ]
        names = parts[0].seen
        return MeshLoss(
            np.concatenate([part.drag for part in parts]),
            {name: np.concatenate([part.seen[name] for part in parts]) for name in names},
            ("sharing of the load up to 10 times the nominal torque",)
            if np.any(np.abs(points.torque) > 1.000001 * TORQUES[-1] * self.nominal)
            else (),
        )

    def _of_some(self, points: MeshPoints, solved: Closure | None) -> MeshLoss:
        duty, cycle = self.pair.operating, self.cycle
        least = LEAST_TORQUE * self.nominal
        way = np.where(points.torque < 0.0, -1.0, 1.0)
        torque = way * np.maximum(np.abs(points.torque), least)
        speed = np.maximum(points.speed, LEAST_SPEED * (duty.pinion_speed or 1.0))

        def by_contact(values: Any) -> Any:
            return np.asarray(values)[:, None, None, None]

        oil = _oil(self.pair.lubricant, by_contact(points.temperature), by_contact(points.supply))
        operating = replace(duty, pinion_speed=by_contact(speed), gear_torque=by_contact(torque))
        closure = solved or untried_closure_of(replace(self.pair, lubricant=oil, operating=operating))
        seen = contacts(cycle, operating.gear_torque, operating.pinion_speed, closure)
        shared = cycle.gear_sense * np.abs(torque)[:, None, None]
        with np.errstate(all="ignore"):
            load = self._near(np.abs(torque))
            most = self._most(load, torque, speed, oil) if solved is None else np.inf
            for _ in range(PASSES):
                coefficient = np.minimum(seen.under(load).surface.friction_coefficient, most) * seen.carrying
                load = quasi_static(cycle, shared, seen.side * coefficient, near=load).normal_load
            surface = seen.under(load).surface
        coefficient = np.minimum(surface.friction_coefficient, most) * seen.carrying
        held = np.any((surface.friction_coefficient > most) & (seen.carrying > 0.0), axis=(1, 2, 3))
        locked = ~np.isfinite(coefficient * load)
        for normal, tangential in zip(seen.normal_arm, seen.friction_arm, strict=True):
            locked |= normal + seen.side * coefficient * tangential < 0.0
        if np.any(locked):
            point = int(np.argmax(np.any(locked, axis=(1, 2, 3))))
            raise SimulationError(
                f"friction locks a mesh in slow rotation at {points.torque[point]:.4g} N m and "
                f"{points.speed[point]:.4g} rad/s: use another friction law, or conditions nearer to those "
                "that it holds for"
            )
        sliding = np.abs(seen.pinion_speed - seen.gear_speed)
        rate = load * (seen.pinion_speed - seen.gear_speed) * way[:, None, None, None]
        drag = np.einsum("psnq,snq->p", coefficient * rate, self.weight) / speed
        drag = np.maximum(drag, 0.0) * np.minimum(np.abs(points.torque) / least, 1.0)
        loaded = (load > 0.0) & (seen.carrying > 0.0)
        some = np.any(loaded, axis=(1, 2, 3)) & (np.abs(points.torque) >= least)
        rubbing = np.sum(load * sliding * loaded, axis=(1, 2, 3))

        def over(values: Any, start: float, worst: Any) -> Any:
            values = np.broadcast_to(values, load.shape)
            return np.where(some, worst(values, axis=(1, 2, 3), where=loaded, initial=start), np.nan)

        def share(inside: Any) -> Any:
            return np.where(
                some, np.mean(np.broadcast_to(inside, load.shape), axis=(1, 2, 3), where=loaded), np.nan
            )

        film = over(surface.central_film_thickness, np.inf, np.min)
        with np.errstate(all="ignore"):
            mean = np.sum(coefficient * load * sliding * loaded, axis=(1, 2, 3)) / rubbing
            return MeshLoss(
                drag,
                {
                    "film_min": film,
                    "film_parameter_min": film / self.pair.roughness,
                    "friction_coefficient_mean": np.where(some, mean, np.nan),
                    "hertz_pressure_max": over(surface.hertz_pressure, 0.0, np.max),
                    "film_in_range": share(surface.closure_in_range),
                    "friction_in_range": share(surface.friction_in_range),
                    "friction_held": np.where(held, 1.0, 0.0),
                },
            )

    def _most(
        self,
        load: Float[Array, "point segment node slot"],
        torque: Float[Array, " point"],
        speed: Float[Array, " point"],
        oil: LubricantData,
    ) -> Any:
        """The most that a law may say of friction: regressions grow without bound towards rest and no load.

        Below the nominal speed and torque they are held at the friction of asperities, or at what they say
        of the nominal ones where that is more.
        """
        _, law = laws_of(self.pair)
        duty, sizes = self.pair.operating, np.abs(torque)
        nominal = float(duty.pinion_speed), self.nominal
        below = (speed < nominal[0]) | (sizes < nominal[1])
        if law.reads_film or law.name in UNBOUNDED or not np.any(below):
            return np.inf
        faster, more = np.maximum(speed, nominal[0]), np.maximum(sizes, nominal[1])
        signed = (np.sign(torque) * more)[:, None, None, None]
        raised = replace(duty, pinion_speed=faster[:, None, None, None], gear_torque=signed)
        closure = untried_closure_of(replace(self.pair, lubricant=oil, operating=raised))
        seen = contacts(self.cycle, raised.gear_torque, raised.pinion_speed, closure)
        surface = seen.under(load * (more / sizes)[:, None, None, None]).surface
        least = np.maximum(surface.friction_coefficient, oil.asperity_friction)
        return np.where(below[:, None, None, None], least, np.inf)


def thinned(cycle: MeshCycle, cells: int) -> MeshCycle:
    """The table with so many cells a segment, or fewer if it has not that many, linear between its nodes."""
    nodes = cycle.phase.shape[1]
    place = np.linspace(0.0, nodes - 1.0, min(cells, nodes - 1) + 1)
    before = np.minimum(place.astype(int), nodes - 2)
    changed = {}
    for name, values in zip(cycle._fields, cycle, strict=True):
        if name in ("in_contact", "side") or np.ndim(values) < 2:
            continue
        values = np.asarray(values)
        if values.shape[1] == nodes:
            share = (place - before).reshape(-1, *[1] * (values.ndim - 2))
            changed[name] = (1.0 - share) * values[:, before] + share * values[:, before + 1]
    return cycle._replace(**changed)


def _weights(cycle: MeshCycle) -> Float[Array, "segment node slot"]:
    """Of the integral over a cycle: spur teeth turn their sliding between segments, slices within one."""
    cells, slots = cycle.phase.shape[1] - 1, cycle.slots
    if cycle.slices == 1:
        unit = np.eye(cells + 1)
        slope = slopes(unit[None])[0]
        whole = (unit[:-1] + unit[1:]) / 2.0 + (slope[:-1] - slope[1:]) / 12.0
        even = whole.sum(axis=0) / cells
        side = np.sign(cycle.signed_distance[:, cells // 2, :])
        return np.diff(cycle.boundary)[:, None, None] * even[:, None] * side[:, None, :]
    late = cycle.face_position * cycle.pitch_slope / (cycle.pinion_pitch_radius * cycle.pitch_angle)
    pairs = slots // cycle.slices
    passed = cycle.pitch_point_phase - np.arange(pairs - 1.0, -1.0, -1.0)
    place = np.clip((passed[:, None] + late).reshape(-1), 0.0, 1.0) * cells
    u = np.clip(place - np.arange(cells)[:, None], 0.0, 1.0)  # (cell, slot), what is passed of each
    weight = np.zeros((cells + 1, slots))  # after the pitch point less before it, linear between nodes
    weight[:-1] += 0.5 - 2.0 * (u - u**2 / 2.0)
    weight[1:] += 0.5 - u**2
    return weight[None] / cells


def _oil(oil: LubricantData, temperature: Any, supply: Any) -> LubricantData:
    """The oil at temperatures of the teeth, and of what is around them; of one temperature as it is."""
    if oil.sheet is None:
        return oil
    return replace(lubricant_from(oil.sheet, temperature, oil.fzg), supply=supply)


#: Torques over the nominal one between which a law that is solved for the scenario's duty serves.
NEAR = (0.5, 2.0)


def _solved_for(pair: LubricatedCase, points: MeshPoints) -> Closure | None:
    """The closure of laws that are solved for the scenario's duty before; None: all laws are formulas.

    Raises InputError for points at other speeds, temperatures or far other torques.
    """
    solved = [law for law in laws_of(pair) if law.table_error is not None]
    if not solved:
        return None
    duty, first = pair.operating, points.temperature[0]
    torques = points.torque / (duty.gear_torque or 1.0)
    alike = np.allclose(points.speed, duty.pinion_speed, rtol=1e-9, atol=0.0)
    alike = alike and np.array_equal(points.temperature, np.full(torques.shape, first), equal_nan=True)
    if not alike or np.any(torques < NEAR[0]) or np.any(torques > NEAR[1]):
        raise InputError(
            f"{solved[0].table}.law",
            quoted(solved[0].name),
            "is solved for the scenario's own duty, and points of operation are at others",
            "choose a law that is a formula; tribodyn list laws names them",
        )
    oil = pair.lubricant
    return closure_of(
        pair if oil.sheet is None else replace(pair, lubricant=_oil(oil, first, points.supply[0]))
    )
