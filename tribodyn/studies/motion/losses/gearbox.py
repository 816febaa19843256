"""What a gearbox loses at any points of operation: meshes in slow rotation, and drags without load.

Torques balance with all losses downstream of a mesh. Flanks of both sides are taken to be alike. The tables
of the meshes are those of the scenario's own loads.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from tribodyn.cases.loss_part import LossesOver, LossSource, OperatingPoints
from tribodyn.errors import InputError, SimulationError
from tribodyn.gears.case import LubricatedCase
from tribodyn.gears.mesh_loss import LEAST_SPEED, LossTable, MeshLoss, MeshPoints
from tribodyn.gears.rating.mesh_loss import loss_by_formula
from tribodyn.gears.tabulated import Tabulated
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies.motion.case import Gearbox
from tribodyn.studies.motion.heat.meshes import bulk_in_oil
from tribodyn.studies.motion.heat.nodes import heat_of
from tribodyn.studies.motion.losses.elements import Drag, drags_of, torques_at
from tribodyn.studies.motion.losses.temperatures import Warmth, warmth
from tribodyn.studies.motion.planetary.powers import loads_of, rows_of, speeds_of
from tribodyn.train.power_flow import Influence, LossyMesh, influence
from tribodyn.tribology.closure import laws_of
from tribodyn.tribology.losses.loss import Torque, oil_state
from tribodyn.tribology.oil import LubricantData, lubricant_from

#: Passes over torques and temperatures at most, and changes that end them: of temperatures, K, and of torques
#: as a share of the largest.
PASSES, SETTLED, STEADY = 30, 0.02, 1e-4
#: Torque of a mesh per drag of another below which it does not depend on that.
DEPENDS = 1e-9


class GearboxLoss:
    """A gearbox with its tables, and how torques and drags flow through it."""

    def __init__(self, case: Gearbox, tabulated: Sequence[Tabulated]) -> None:
        self.case, self.tabulated = case, tabulated
        tables: dict[int, LossTable] = {}
        for each, mesh in zip(tabulated, case.meshes, strict=True):
            tables.setdefault(id(each), LossTable(each, mesh.pair))
        self.tables = [tables[id(each)] for each in tabulated]
        self.speeds = speeds_of(case)
        teeth = [
            (case.gears[one].teeth, case.gears[two].teeth) for one, two in (m.gears for m in case.meshes)
        ]
        meshes = [
            LossyMesh(mesh.driver, mesh.driven, each, mesh.carrier)
            for mesh, each in zip(case.meshes, teeth, strict=True)
        ]
        self.flow = influence(meshes, rows_of(case), self.speeds, loads_of(case, self.speeds))
        self.groups = _downstream_first(self.flow, self.tables)
        self.drags: list[Drag] = drags_of(case, tabulated)
        self.sources = tuple(
            [LossSource("P_VZP", mesh.name, "mesh", _method(mesh.pair)) for mesh in case.meshes]
            + [source for drag in self.drags for source in drag.sources]
        )
        #: what every load takes at nominal speed, and all of them, W
        self.load_powers = [load.torque * abs(self.speeds[load.body]) for load in case.loads]
        self.output_power = sum(self.load_powers)
        #: of the drivers of meshes against their carriers, and of what drags brake, over that of the input
        self.turning = (
            np.array([mesh.pair.operating.pinion_speed for mesh in case.meshes]) / case.source.speed
        )
        self.heat = heat_of(case)
        self.warms = self.heat is not None or any(pair.temperature is not None for pair in case.pairs)
        self.braked = [(drag.body, drag.turn) for drag in self.drags for _ in drag.sources]
        self.of_bodies = np.array([turn for _, turn in self.braked]) / case.source.speed

    def at(self, points: OperatingPoints) -> LossesOver:
        """Losses at points of operation; torques, temperatures and losses settle together."""
        given = [np.atleast_1d(np.asarray(values, dtype=float)) for values in points[:3]]
        load, speed, supplied = np.broadcast_arrays(*given)
        _refuse_no_points(load, speed, supplied)
        _refuse_other_temperatures(self.case.pair.lubricant, supplied)
        speed = np.maximum(np.abs(speed), LEAST_SPEED * self.case.source.speed)
        bulk = np.repeat(supplied[:, None], len(self.case.meshes), axis=1)
        warm = Warmth(
            bulk if points.bulk_temperature is None else np.asarray(points.bulk_temperature), supplied
        )
        drag, losses = np.zeros((len(self.tables), len(load))), list[MeshLoss]()
        idle = self.drags_at(speed, supplied, load)
        change = moved = 0.0
        for _ in range(PASSES):
            outside = self.flow.load[:, None] * load + self.flow.body @ self._on_bodies(idle)
            losses, torque = self._of_meshes(outside, drag, speed, warm)
            drag = np.array([each.drag for each in losses])
            moved = np.max(np.abs(outside + self.flow.mesh @ drag - torque))
            change = 0.0
            if points.bulk_temperature is None and self.warms:
                warmer = self._warmth(drag, idle, speed, supplied)
                change = max(np.max(np.abs(warmer.bulk - warm.bulk)), np.max(np.abs(warmer.oil - warm.oil)))
                warm, idle = warmer, self.drags_at(speed, warmer.oil, load)
            if change < SETTLED and moved <= STEADY * np.max(np.abs(torque)):
                break
        else:
            raise SimulationError(
                "torques and temperatures of the meshes do not settle with their losses: still moving by "
                f"{moved:.2g} N m and {change:.2g} K"
            )
        of_meshes = [each.drag * ratio for each, ratio in zip(losses, self.turning, strict=True)]
        others = [torque * ratio for (torque, _), ratio in zip(idle, self.of_bodies, strict=True)]
        seen = {name: np.stack([each.seen[name] for each in losses], axis=1) for name in losses[0].seen}
        exceeded = [_outside(mesh.pair, each) for mesh, each in zip(self.case.meshes, losses, strict=True)]
        return LossesOver(
            self.sources,
            np.stack([*of_meshes, *others], axis=1),
            (*exceeded, *(limits for _, limits in idle)),
            {**seen, "bulk_temperature": warm.bulk},
        )

    def drags_at(
        self,
        speed: Float[Array, " point"],
        temperature: Float[Array, " point"],
        load: Float[Array, " point"],
    ) -> list[Torque]:
        """Torques of the drags, in oil at temperatures, K; those of bearings under multiples of the load."""
        oil = self.case.pair.lubricant
        if oil.sheet is not None:
            oil = lubricant_from(oil.sheet, temperature, oil.fzg)
        return torques_at(self.drags, speed / self.case.source.speed, oil_state(oil), load)

    def _on_bodies(self, idle: Sequence[Torque]) -> Float[Array, "body point"] | Float[Array, "body 1"]:
        """Sum of these torques by body, of those of planets against carriers what takes the same power."""
        bodies = np.zeros((len(self.speeds), len(idle[0][0]) if idle else 1))
        for (body, turn), (torque, _) in zip(self.braked, idle, strict=True):
            if self.speeds[body]:
                bodies[body] += torque * turn / abs(self.speeds[body])
        return bodies

    def _warmth(
        self,
        drag: Float[Array, "mesh point"],
        idle: Sequence[Torque],
        speed: Float[Array, " point"],
        supplied: Float[Array, " point"],
    ) -> Warmth:
        """Temperatures that these losses give; a gearbox in balance has its oil as it is supplied."""
        friction = drag * self.turning[:, None] * speed
        if self.heat is not None:
            return Warmth(bulk_in_oil(self.heat, friction, speed, supplied), supplied)
        power = {"bearing": 0.0 * speed, "gear": 0.0 * speed}
        sources = self.sources[len(self.tables) :]
        for source, (torque, _), ratio in zip(sources, idle, self.of_bodies, strict=True):
            place = "bearing" if source.sort in ("bearing", "seal") else "gear"
            power[place] = power[place] + torque * ratio * speed
        return warmth(self.case, self.tabulated, list(friction), power["gear"], power["bearing"], supplied)

    def _of_meshes(
        self,
        outside: Float[Array, "mesh point"],
        drag: Float[Array, "mesh point"],
        speed: Float[Array, " point"],
        warm: Warmth,
    ) -> tuple[list[MeshLoss], Float[Array, "mesh point"]]:
        """Losses of the meshes, and the torques that they are of: those downstream first.

        `outside` are torques without drags of meshes, which are known from before. Planets, which are alike,
        are looked at once.
        """
        drag, torque, losses = drag.copy(), outside.copy(), dict[int, MeshLoss]()
        for group in self.groups:
            torque[group] = outside[group] + self.flow.mesh[group] @ drag
            found = list[tuple[MeshPoints, MeshLoss]]()
            for m in group:
                at = MeshPoints(torque[m], speed * self.turning[m], warm.bulk[:, m], warm.oil)
                loss = next((of for other, of in found if alike(other, at)), None)
                if loss is None:
                    loss = self._of_mesh(m, at)
                    found.append((at, loss))
                losses[m], drag[m] = loss, loss.drag
        return [losses[m] for m in range(len(self.tables))], torque

    def _of_mesh(self, m: int, at: MeshPoints) -> MeshLoss:
        """Loss by film and friction laws, or by the formula that [losses] names: film and pressure stay."""
        loss, pair = self.tables[m].at(at), self.case.meshes[m].pair
        formula = formula_of(pair)
        if formula is None:
            return loss
        found = loss_by_formula(formula, pair, self.tabulated[m].assembly, at.torque, at.speed, at.supply)
        nothing = np.full(len(at.torque), np.nan)
        seen = {
            **loss.seen,
            "friction_coefficient_mean": found.coefficient,
            "friction_in_range": nothing,
            "friction_held": 0.0 * nothing,
        }
        return MeshLoss(found.drag, seen, found.exceeded)


def formula_of(pair: LubricatedCase) -> str | None:
    """The standard's formula that [losses] names for the meshes under load."""
    return None if pair.losses is None else pair.losses.mesh


def _method(pair: LubricatedCase) -> str:
    return formula_of(pair) or laws_of(pair)[1].name


def _downstream_first(flow: Influence, tables: Sequence[LossTable]) -> list[list[int]]:
    """Meshes whose torques depend on the losses of fewest others first; those of planets together."""
    depends = np.sum(np.abs(flow.mesh) > DEPENDS, axis=1)
    groups: dict[tuple[int, int, str], list[int]] = {}
    for m in np.argsort(depends, kind="stable").tolist():
        groups.setdefault((int(depends[m]), id(tables[m]), f"{flow.load[m]:.6g}"), []).append(m)
    return list(groups.values())


def alike(one: MeshPoints, two: MeshPoints) -> bool:
    """Whether points of two meshes are the same but for rounding."""
    scale = np.max(np.abs(one.torque), initial=0.0)
    return bool(np.allclose(one.torque, two.torque, rtol=1e-9, atol=1e-9 * scale)) and all(
        np.allclose(a, b, rtol=1e-12, equal_nan=True) for a, b in zip(one[1:], two[1:], strict=True)
    )


def _refuse_no_points(*points: Float[Array, " point"]) -> None:
    """Refuse points that are none: their temperature may be NaN where the oil is known at one."""
    load, speed, temperature = points
    for key, values, allowed, rule in (
        ("load", load, np.isfinite(load), "is not a finite multiple of the scenario's loads"),
        ("speed", speed, np.isfinite(speed), "is not a finite speed"),
        ("oil_temperature", temperature, ~(temperature <= 0.0), "is not above absolute zero"),
    ):
        if not len(values):
            raise InputError(key, [], "has no point of operation", "give one at least")
        if not np.all(allowed):
            raise InputError(key, float(values[~allowed][0]), rule)


def _refuse_other_temperatures(oil: LubricantData, asked: Float[Array, " point"]) -> None:
    """Refuse temperatures of an oil that is known at one."""
    known = asked[0] if oil.temperature is None else float(oil.temperature)
    if oil.sheet is None and np.any(np.abs(asked - known) > 1e-6):
        raise InputError(
            "lubricant",
            None,
            "is known at one temperature, and points of operation are at others",
            "give its data sheet: type, viscosity_40, viscosity_100 and density_15",
        )


def _outside(pair: Any, loss: MeshLoss) -> tuple[str, ...]:
    """Laws of a mesh that are outside their range in some contact at some point."""
    film, friction = laws_of(pair)
    said = []
    for law, share in ((film, "film_in_range"), (friction, "friction_in_range")):
        if np.any(np.nan_to_num(loss.seen[share], nan=1.0) < 1.0):
            said.append(f"range of the {law.table} law {law.name}")
    if np.any(loss.seen["friction_held"] > 0.0):
        said.append(f"{friction.name} at low speed or load, held at the friction of asperities")
    return (*said, *loss.exceeded)
