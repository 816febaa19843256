"""Quantities of a train as a differentiable function of some of its numbers.

A mesh is differentiated as a pair of gears; here its numbers are those of the train's scenario: speed and
load reach every mesh by the ratios, losses not counted, and a gear may be in several meshes. The planets of a
set share the load evenly; without a centre distance in its scenario the ring has that of the sun's meshes.
"""

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
import tomli_w
from pydantic import BaseModel

from tribodyn.derivatives.differentiable import Differentiable, known_keys
from tribodyn.derivatives.numbers import numbers_of, unit_at
from tribodyn.derivatives.quantities import ALSO, QUANTITIES
from tribodyn.errors import InputError, quoted, unknown_name
from tribodyn.gears.case import LubricatedCase
from tribodyn.geometry.drive import SIDES
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies.motion.case import Gearbox
from tribodyn.studies.motion.drivetrain.duty import torques_of
from tribodyn.studies.motion.drivetrain.placed_train import (
    TrainKinematics,
    ends_of,
    key_in_train,
    resolve_kinematics,
)
from tribodyn.studies.motion.drivetrain.tables import PlanetaryStage
from tribodyn.studies.motion.train.assessable import pair_tables

#: Quantities of the whole train, of the friction losses of all meshes.
TOTALS = {
    "efficiency": "quasi-static efficiency",
    "friction_power": "quasi-static friction loss of all meshes",
}
#: The duty of a pair, which follows from the train's.
_OF_DUTY = ("operating.pinion_speed", "operating.gear_torque")


class _Part(NamedTuple):
    """A mesh that is evaluated."""

    mesh: int
    function: Differentiable
    places: list[int]  # of its numbers among the keys and, after these, what `_Duty` gives


class DifferentiableTrain:
    """Quantities of a train as a function of some of its numbers.

    Parameters
    ----------
    case : of a train
    schema : of its scenario
    of : of a mesh ``MESH.NAME``, with a name of `QUANTITIES` or `ALSO`; of the whole train one of `TOTALS`
    wrt : dotted keys of the train's scenario, each once; those of a stage move its own mesh alone

    Raises
    ------
    InputError
        For an unknown mesh, quantity or key, and a quantity that a mesh does not have.

    Attributes
    ----------
    of, wrt, about, parts, at, units, key_units : as of a `Differentiable`
    """

    def __init__(self, case: Gearbox, schema: type[BaseModel], of: Sequence[str], wrt: Sequence[str]) -> None:
        table = tomllib.loads(case.toml)
        scenario: Any = schema.model_validate(table)
        train = resolve_kinematics(scenario)
        self.of, self.wrt = tuple(of), tuple(wrt)
        self._wanted = [_mesh_and_name(case, name) for name in of]
        self._duty = _Duty(case, scenario, train)
        value_of = {key: (value, unit_at(schema, key)) for key, value in self._duty.numbers.items()}
        pairs = [_pair(case, table, mesh) for mesh in range(len(case.meshes))]
        names: list[dict[str, str]] = []  # keys of every pair -> those of the train
        for mesh, pair in enumerate(pairs):
            numbers = numbers_of(pair, schema, lambda key, mesh=mesh: _key(key, train, mesh) in self.wrt)
            names.append({key: key_of for key in numbers if (key_of := _key(key, train, mesh))})
            value_of |= {
                key_of: (float(numbers[key].value), numbers[key].unit) for key, key_of in names[-1].items()
            }
        asked = self._keys = known_keys(self.wrt, value_of, schema)
        if twice := [key for key in asked if asked.count(key) > 1]:
            raise InputError("wrt", quoted(twice[0]), "is named twice", "name every key once")
        self.at = np.array([value_of[key][0] for key in asked])
        self.key_units = tuple(value_of[key][1] for key in asked)
        self._parts = []
        # numbers of a mesh that follow from others: its duty, and at a ring the distance of the sun's mesh
        after = len(wrt) + len(_OF_DUTY) * len(pairs)
        suns = {mesh: sun for mesh in range(len(pairs)) if (sun := _distance_from(train, mesh)) is not None}
        self._distances: dict[int, tuple[Differentiable, list[int]]] = {}  # by the sun's mesh
        for mesh, pair in enumerate(pairs):
            places = {key: asked.index(key_of) for key, key_of in names[mesh].items() if key_of in asked}
            if mesh in suns and (
                keys := {k: key_of for k, key_of in names[suns[mesh]].items() if key_of in asked}
            ):
                sun = suns[mesh]
                if sun not in self._distances:
                    distance = Differentiable(pairs[sun], schema, ["centre_distance"], list(keys))
                    self._distances[sun] = distance, [asked.index(key_of) for key_of in keys.values()]
                places["drive.centre_distance"] = after + list(self._distances).index(sun)
            if not places or not self._duty.numbers.keys().isdisjoint(asked):
                places |= {key: len(wrt) + i * len(pairs) + mesh for i, key in enumerate(_OF_DUTY)}
            if needed := self._needed(pairs, mesh):
                try:
                    function = Differentiable(pair, schema, needed, list(places))
                except InputError as error:
                    if error.key != _OF_DUTY[1]:
                        raise
                    rule = f"carries no load: {error.rule}"
                    raise InputError(case.meshes[mesh].key, None, rule, error.remedy) from None
                self._parts.append(_Part(mesh, function, list(places.values())))
        quantities = [QUANTITIES[ALSO.get(name, name)] for _, name in self._wanted]
        self.units = tuple(quantity.unit for quantity in quantities)
        self.about = tuple(
            TOTALS[name] if mesh < 0 else f"{quantity.about}, mesh {case.meshes[mesh].name}"
            for (mesh, name), quantity in zip(self._wanted, quantities, strict=True)
        )
        self.parts = tuple((pairs[part.mesh], name) for part in self._parts for name in part.function.of)

    def values(self, x: Float[Array, " key"]) -> Float[Array, " value"]:
        """As `Differentiable.values`."""
        return self._evaluated(x, slopes=False)[0]

    def jacobian(self, x: Float[Array, " key"]) -> tuple[Float[Array, " value"], Float[Array, "value key"]]:
        """As `Differentiable.jacobian`."""
        return self._evaluated(x, slopes=True)

    def gradient(self, x: Float[Array, " key"]) -> tuple[float, Float[Array, " key"]]:
        """As `Differentiable.gradient`."""
        values, slopes = self.jacobian(x)
        return float(values[0]), slopes[0]

    def _needed(self, pairs: Sequence[LubricatedCase], mesh: int) -> list[str]:
        """Quantities of a mesh that are asked for, or that those of the whole train are made of."""
        names = [name for one, name in self._wanted if one == mesh]
        loaded = [pair.operating.gear_torque != 0.0 for pair in pairs]
        if any(one < 0 for one, _ in self._wanted) and (loaded[mesh] or not any(loaded)):
            names.append("friction_power")
        return list(dict.fromkeys(names))

    def _evaluated(self, x: Any, *, slopes: bool) -> tuple[Any, Any]:
        duty, by_duty = self._duty.at(dict(zip(self._keys, x, strict=True)))
        numbers, by_numbers = np.concatenate([x, duty]), np.vstack([np.eye(len(x)), by_duty])
        power = numbers[-2:], by_numbers[-2:]  # that loads take and put in
        numbers, by_numbers = numbers[:-2], by_numbers[:-2]
        for function, places in self._distances.values():
            distance, by = function.jacobian(numbers[places])
            numbers = np.concatenate([numbers, distance])
            by_numbers = np.vstack([by_numbers, by @ by_numbers[places]])
        evaluated: dict[tuple[int, str], tuple[Any, Any]] = {}
        for mesh, function, places in self._parts:
            at = numbers[places]
            values, by = function.jacobian(at) if slopes else (function.values(at), np.zeros((1, len(at))))
            by = np.broadcast_to(by @ by_numbers[places], (len(values), len(x)))
            evaluated |= {(mesh, name): each for name, *each in zip(function.of, values, by, strict=True)}
        if any(mesh < 0 for mesh, _ in self._wanted):
            lost = [each for (_, name), each in evaluated.items() if name == "friction_power"]
            loss, by_loss = (sum(parts) for parts in zip(*lost, strict=True))
            # what drives, the input or a load, puts in what loads take, and the loss unless the input brakes
            put_in, by_put_in = power[0][0] + loss, power[1][0] + by_loss
            if put_in < power[0][1]:
                put_in, by_put_in = power[0][1], power[1][1]
            evaluated[-1, "friction_power"] = loss, by_loss
            evaluated[-1, "efficiency"] = 1.0 - loss / put_in, (loss * by_put_in / put_in - by_loss) / put_in
        values, by = zip(*(evaluated[wanted] for wanted in self._wanted), strict=True)
        return np.array(values), np.array(by)


DIFFERENTIABLE = DifferentiableTrain


class _Duty:
    """Speeds and torques of all meshes as functions of the numbers of [operating] and [[load]]."""

    def __init__(self, case: Gearbox, scenario: Any, train: TrainKinematics) -> None:
        operating, ratio = scenario.operating, np.array(train.motion.ratio, dtype=float)
        duty_names = [
            name
            for name in ("input_speed", "output_speed", "output_torque", "power", "input_torque")
            if getattr(operating, name) is not None
        ][: 1 if ends_of(scenario)[1] is None else 2]  # an input torque beside a load is the motor's
        self.numbers = {f"operating.{name}": float(getattr(operating, name)) for name in duty_names}
        self.numbers |= {
            f"load.{place}.torque": load.torque
            for place, load in enumerate(scenario.load)
            if load.torque is not None
        }
        self._given = duty_names
        bodies = [load.body for load in case.loads]
        units = np.eye(len(case.bodies))[bodies]
        by_load = [torques_of(train, list(unit)) for unit in units]
        self._torques = np.array([each.driven for each in by_load]).T
        self._source = np.array([each.source for each in by_load])
        self._given_torques = np.array([each.given for each in by_load]).T
        self._ratio, self._given_ratio = np.abs(ratio[bodies]), np.abs(ratio[list(train.motion.given)])
        ends = zip(train.motion.driver, train.motion.carrier, strict=True)
        # of a set against its carrier
        self._driver = np.array([ratio[body] - float(train.motion.carried(body, by)) for body, by in ends])

    def at(self, changed: Mapping[str, float]) -> tuple[Float[Array, " out"], Float[Array, "out key"]]:
        """Speeds of the drivers, torques of the driven gears, powers that loads take and put in; slopes."""
        import jax
        import jax.numpy as jnp

        def function(x: Any) -> Any:
            numbers = self.numbers | dict(zip(changed, x, strict=True))
            speed, *loads = (numbers[key] for key in self.numbers)
            if "output_speed" in self._given:
                speed = speed / self._ratio[0]
            if self._given[-1] in ("power", "input_torque"):
                put_in = loads[0] / speed if self._given[-1] == "power" else loads[0]
                loads[0] = (put_in - jnp.stack([0.0, *loads[1:]])[1:] @ self._source[1:]) / self._source[0]
            torques = jnp.stack(loads)
            given = self._given_torques @ torques * self._given_ratio * speed
            power = jnp.concatenate([torques * self._ratio * speed, -given])
            ends = [jnp.where(sign * power > 0.0, sign * power, 0.0).sum() for sign in (1.0, -1.0)]
            return jnp.concatenate([self._driver * speed, self._torques @ torques, jnp.stack(ends)])

        with jax.enable_x64(True):
            x = jnp.array(list(changed.values()))
            return np.array(function(x)), np.array(jax.jacfwd(function)(x))


def _mesh_and_name(case: Gearbox, asked: str) -> tuple[int, str]:
    """Number of the mesh, −1 for the whole train, and the quantity, that a name means."""
    meshes = [mesh.name for mesh in case.meshes]
    mesh, _, name = asked.rpartition(".")
    if mesh and mesh not in meshes:
        raise unknown_name("of", mesh, meshes, "mesh")
    quantity = ALSO.get(name, name)
    if mesh or quantity in TOTALS:
        return (meshes.index(mesh), name) if mesh else (-1, quantity)
    if quantity not in QUANTITIES:
        raise unknown_name("of", name, QUANTITIES, "quantity that can be differentiated")
    remedy = f'name one: "{meshes[0]}.{name}"; the whole train has: {", ".join(TOTALS)}'
    raise InputError("of", quoted(asked), "is a quantity of a mesh", remedy)


def _key(key: str, train: TrainKinematics, mesh: int) -> str:
    """Where the train's scenario has a number of a mesh's pair; "" where it does not have it as such."""
    key_here = key_in_train(key, train, mesh)
    of_bare_gear = key_here.startswith("mesh.") and key.split(".")[1] in SIDES  # both gears are in one table
    follows = key == "drive.centre_distance" and _distance_from(train, mesh) is not None
    return "" if of_bare_gear or follows or key in _OF_DUTY else key_here


def _distance_from(train: TrainKinematics, mesh: int) -> int | None:
    """The mesh with the sun whose centre distance a mesh with the ring has; None: it has one of its own."""
    meshes = [train.parts.meshes[number] for number in train.motion.meshes]
    part, distance = meshes[mesh], train.drives[mesh].centre_distance
    if distance is None or not isinstance(part.table, PlanetaryStage) or part.table.centre_distance:
        return None
    own = (m for m, other in enumerate(meshes) if other.of_set == part.of_set)
    return next(m for m in own if meshes[m].member == part.table.spaces)


def _pair(case: Gearbox, table: dict[str, Any], mesh: int) -> LubricatedCase:
    """A mesh's pair of gears, with the text of a scenario of its own."""
    one = case.meshes[mesh]
    return replace(one.pair, toml=tomli_w.dumps(pair_tables(case, one, table)))
