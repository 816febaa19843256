"""A scenario of a train as a REXS model: gears, stages, planetary sets, oil, loads."""

import math
from collections.abc import Mapping
from typing import Any

from tribodyn.errors import InputError, quoted
from tribodyn.exchange.rexs.file import attributes as rexs
from tribodyn.exchange.rexs.writing.builder import ModelText, si, value_in
from tribodyn.exchange.rexs.writing.layout import RexsPlaces, centre_distance, layout_of
from tribodyn.exchange.rexs.writing.shafts import Shafts
from tribodyn.exchange.rexs.writing.teeth import GearText, said

_SPEEDS, _LOADS = ("input_speed", "output_speed"), ("input_torque", "output_torque", "power")


class TrainText:
    """Writes a train; `meshes` are the components of its stages, by the names of the meshes."""

    def __init__(self, tables: Mapping[str, Any]) -> None:
        self.tables, self.model = tables, ModelText()
        self.layout: RexsPlaces = layout_of(tables)
        self.meshes: dict[str, int] = {}
        self.unit = self.model.add("gear_unit", str(tables.get("title", "")))
        self.casing = self.model.add("gear_casing", "casing")
        self.model.relate("assembly", assembly=self.unit, part=self.casing)
        self.model.place(self.unit, (0.0, 0.0, 0.0))
        self.shafts = Shafts(self.model, tables, self.layout, self.casing)
        self.teeth = GearText(self.model, tables)
        self._gears: dict[str, int] = {}
        planets = {stage["planet"] for stage in self._sets}
        carriers = {stage["carrier"] for stage in self._sets}
        for name in dict.fromkeys(self.layout.shaft_of.values()):
            own = {each for each, shaft in self.layout.shaft_of.items() if shaft == name}
            if own - planets:
                self.shafts.shaft(name)
        for name in tables["gear"]:
            if name not in planets:
                self._gears[name] = self._gear(name, self.layout.shaft_of[name])
        for stage in tables["stage"]:
            self._pair(stage) if stage.get("type", "pair") == "pair" else self._set(stage)
        for body in tables.get("body", ()):
            self.shafts.body(body)
        self.shafts.links()
        drawn = {each["name"] for each in tables.get("shaft", ()) if each.get("drawn")}
        floating = {stage[member] for stage in self._sets for member in stage.get("floating", ())}
        held = {stage[stage["held"]] for stage in self._sets}
        for name, shaft in self.layout.shaft_of.items():
            if shaft not in self.shafts.numbers or shaft in drawn or name in held:
                continue
            number, place = self.shafts.numbers[shaft], self.layout.position.get(name, 0.0)
            if name in carriers or (name in tables["gear"] and not self._grouped(name)):
                self.shafts.springs(name, number, place, floating=name in floating)
            elif name == shaft and self._shaft_table(shaft):
                self.shafts.springs(name, number, 0.0)
        self._oil()
        self._loads()

    @property
    def _sets(self) -> list[Mapping[str, Any]]:
        return [stage for stage in self.tables["stage"] if stage.get("type", "pair") != "pair"]

    def _shaft_table(self, name: str) -> bool:
        return any(each["name"] == name for each in self.tables.get("shaft", ()))

    def _grouped(self, gear: str) -> bool:
        """Whether a gear is on a shaft of several, which has the bearings."""
        return self._shaft_table(self.layout.shaft_of[gear])

    def _gear(
        self, name: str, shaft: str, called: str = "", angle: float | None = None, away: float = 0.0
    ) -> int:
        """Add a gear on its shaft, of planets at an angle about the axis of the set."""
        number = self.teeth.gear(name, called)
        place = self.layout.position[name]
        x, y = self.layout.centre[shaft]
        if angle is not None:
            x, y = x + away * math.cos(angle), y + away * math.sin(angle)
        self.model.put(number, rexs.U_ON_SHAFT, float(f"{1e3 * place:.12g}"))
        self.model.place(number, (self.layout.start[shaft] + place, x, y))
        if angle is None:
            self.model.relate("assembly", assembly=self.shafts.numbers[shaft], part=number)
        return number

    def _stage(self, name: str, first: int, second: int, distance: float, azimuth: float) -> int:
        """Add a cylindrical stage; `azimuth` (rad) from the first gear's axis to that of the second."""
        turned = math.degrees(math.remainder(0.5 * math.pi - azimuth, 2 * math.pi))
        values: dict[rexs.RexsKey, Any] = {
            rexs.CENTRE_DISTANCE: float(f"{1e3 * distance:.12g}"),
            rexs.ROTATING_ANGLE: float(f"{turned:.12g}") + 0.0,
        }
        number = self.meshes[name] = self.model.add("cylindrical_stage", name, values)
        self.model.relate("stage", stage=number, gear_1=first, gear_2=second)
        for gear in (first, second):
            data = self.model.add("cylindrical_stage_gear_data")
            self.model.relate("stage_gear_data", stage=number, gear=gear, stage_gear_data=data)
        return number

    def _pair(self, stage: Mapping[str, Any]) -> None:
        first, second = stage["gears"]
        here, there = (self.layout.centre[self.layout.shaft_of[name]] for name in (first, second))
        azimuth = math.atan2(there[1] - here[1], there[0] - here[0])
        name = stage.get("name") or f"{first} and {second}"
        distance = centre_distance(self.tables, stage, first, second)
        number = self._stage(name, self._gears[first], self._gears[second], distance, azimuth)
        self.model.relate("assembly", assembly=self.unit, part=number)

    def _set(self, stage: Mapping[str, Any]) -> None:
        """A planetary set: sun, ring and carrier on their shafts, each planet on a pin."""
        model, name = self.model, stage["name"]
        number = model.add("planetary_stage", name)
        model.relate("assembly", assembly=self.unit, part=number)
        carrier = model.add("planet_carrier", stage["carrier"])
        model.relate("assembly", assembly=number, part=carrier)
        shafts = {
            member: self.shafts.numbers[self.layout.shaft_of[stage[member]]]
            for member in ("sun", "ring", "carrier")
        }
        model.relate("assembly", assembly=carrier, part=shafts["carrier"])
        for member in ("sun", "ring"):
            model.relate("central_shaft", planetary_stage=number, shaft=shafts[member])
        model.relate("planet_carrier_shaft", planetary_stage=number, shaft=shafts["carrier"])
        held = model.add("coupling", f"{stage['held']} of {name} held", self._support(stage))
        model.relate("side", assembly=held, inner_part=shafts[stage["held"]], outer_part=self.casing)
        distance = centre_distance(self.tables, stage, stage["sun"], stage["planet"])
        count = stage["planets"]
        told = [math.radians(si(angle, "deg")) for angle in stage.get("angles") or ()]
        angles = told or [2 * math.pi * each / count for each in range(count)]
        base = self.layout.shaft_of[stage["sun"]]
        where = (
            self.layout.start[base]
            + self.layout.position[stage["sun"]]
            - self.layout.position[stage["planet"]]
        )
        self.layout.start[f"{name}-planet"], self.layout.centre[f"{name}-planet"] = (
            where,
            self.layout.centre[base],
        )
        x, y = self.layout.centre[base]
        for place, angle in enumerate(angles, start=1):
            own = where, x + distance * math.cos(angle), y + distance * math.sin(angle)
            planet, pin = (
                model.add("shaft", f"{stage['planet']} {what} @ {place}") for what in ("shaft", "pin")
            )
            for shaft, relation in ((planet, "planet_shaft"), (pin, "planet_pin")):
                model.place(shaft, own)
                model.relate(relation, planetary_stage=number, shaft=shaft)
            model.relate("assembly", assembly=self.unit, part=planet)
            model.relate("assembly", assembly=carrier, part=pin)
            gear = self._gear(
                stage["planet"], f"{name}-planet", f"{stage['planet']} @ {place}", angle, distance
            )
            model.relate("assembly", assembly=planet, part=gear)
            self.shafts.springs(stage["planet"], pin, self.layout.position[stage["planet"]], planet)
            meshes = (
                self._stage(f"{name}-sun-{place}", self._gears[stage["sun"]], gear, distance, angle),
                self._stage(
                    f"{name}-ring-{place}", gear, self._gears[stage["ring"]], distance, angle + math.pi
                ),
            )
            for mesh in meshes:
                model.relate("assembly", assembly=number, part=mesh)

    def _support(self, stage: Mapping[str, Any]) -> dict[rexs.RexsKey, Any]:
        """How stiff the held member is in the casing."""
        values = self.shafts.stiffness(stage[stage["held"]])
        found = {
            key: values[key]
            for key in (rexs.RADIAL_STIFFNESS, rexs.AXIAL_STIFFNESS, rexs.TILT_STIFFNESS)
            if key in values
        }
        if stage.get("support_stiffness") is not None:
            found[rexs.TORSIONAL_STIFFNESS] = value_in(stage["support_stiffness"], rexs.TORSIONAL_STIFFNESS)
        return found

    def _oil(self) -> None:
        oil = self.tables["lubricant"]
        values = said(oil, rexs.LUBRICANT) | {
            rexs.OIL_NAME: str(oil.get("title", "own values")),
            rexs.OIL_KIND: "oil",
        }
        if len(values) == 2:
            self.shafts.remarks.append(
                "lubricant: given at one temperature, without a data sheet; REXS has no such keys"
            )
        if oil.get("type") in rexs.OIL_TYPES:
            values[rexs.OIL_TYPE] = rexs.OIL_TYPES[oil["type"]]
        number = self.model.add("lubricant", str(oil.get("title", "")), values)
        self.model.relate("reference", origin=self.casing, referenced=number)

    def _loads(self) -> None:
        """Loads where power enters and leaves; speeds and torques of the duties are those of load cases."""
        operating = self.tables["operating"]
        ends = {}
        sense = 1.0 if operating.get("sense", "clockwise") == "counter-clockwise" else -1.0
        for end in ("input", "output"):
            name = operating.get(end)
            if name is None:
                raise InputError(
                    f"operating.{end}", None, "missing: REXS has one place where power leaves", "name it"
                )
            shaft = self.layout.shaft(name)
            turns = (
                sense if end == "input" else sense * self.layout.turns[shaft] / self.layout.turns[self._input]
            )
            values = {
                rexs.U_ON_SHAFT: float(f"{1e3 * self.layout.position.get(name, 0.0):.12g}"),
                rexs.TRANSMITS: True,
            }
            load = self.model.add("external_load", end, values)
            self.model.relate("assembly", assembly=self.shafts.numbers[shaft], part=load)
            ends[end] = load, self.shafts.numbers[shaft], 1.0 if turns > 0 else -1.0
        duties = self.tables.get("duty") or ()
        total = sum(duty["share"] for duty in duties)
        for duty in duties:
            values = self._case(_under(operating, duty), ends)
            values[self.unit] = {rexs.SHARE: float(f"{100 * duty['share'] / total:.12g}")}
            self.model.case(values)
        if not duties:
            for number, each in self._case(operating, ends).items():
                for key, value in each.items():
                    self.model.put(number, key, value)

    @property
    def _input(self) -> str:
        name = self.tables["operating"]["input"]
        return self.layout.shaft(name)

    def _case(
        self, operating: Mapping[str, Any], ends: Mapping[str, tuple[int, int, float]]
    ) -> dict[int, dict[rexs.RexsKey, Any]]:
        found: dict[int, dict[rexs.RexsKey, Any]] = {}
        speed = next((key for key in _SPEEDS if operating.get(key) is not None), None)
        load = next((key for key in reversed(_LOADS) if operating.get(key) is not None), None)
        if speed is None or load is None:
            raise InputError("operating", None, "has no speed or no load", "REXS needs both")
        _, shaft, turns = ends[speed.partition("_")[0]]
        found[shaft] = {rexs.SPEED: turns * value_in(operating[speed], rexs.SPEED)}
        end = "input" if load == "power" else load.partition("_")[0]
        number, _, turns = ends[end]
        with_motion = 1.0 if end == "input" else -1.0
        if load == "power":
            found[number] = {rexs.POWER: value_in(operating[load], rexs.POWER)}
        else:
            found[number] = {rexs.TORQUE: with_motion * turns * value_in(operating[load], rexs.TORQUE)}
        self.model.put(shaft, rexs.DEFINES_SPEED, True)
        self.model.put(number, rexs.DEFINES_TORQUE, True)
        if operating.get("oil_temperature") is not None:
            found[self.casing] = {
                rexs.OIL_TEMPERATURE: value_in(operating["oil_temperature"], rexs.OIL_TEMPERATURE)
            }
        return found


def _under(operating: Mapping[str, Any], duty: Mapping[str, Any]) -> dict[str, Any]:
    """What a duty leaves of the common speed and load."""
    own = {key: value for key, value in duty.items() if value is not None}
    common = dict(operating)
    for group in (_SPEEDS, _LOADS):
        if any(key in own for key in group):
            common = {key: value for key, value in common.items() if key not in group}
    return common | own


def refuse_what_rexs_has_not(tables: Mapping[str, Any]) -> None:
    """Raise InputError for parts that would be another gearbox without them."""
    for key, what in (("load", "a [[load]] beside the output"), ("clutch", "a friction clutch")):
        for each in tables.get(key) or ():
            name = each.get("at") or each.get("name") or " and ".join(each.get("ends", ()))
            raise InputError(
                f"{key}", quoted(name), f"{what}: REXS has none", "leave it out, or export another scenario"
            )
    if not tables.get("stage"):
        raise InputError(
            "stage", None, "missing: meshes without gears are none of REXS", "export a train with gears"
        )
    for number, stage in enumerate(tables["stage"]):
        kind, family = stage.get("type", "pair"), stage.get("family", "involute")
        if family != "involute":
            raise InputError(f"stage.{number}.family", quoted(family), "REXS has involute gears alone", "")
        if kind not in ("pair", "planetary") or (kind == "planetary" and stage.get("held") is None):
            rule = "REXS has planetary sets of sun, planets, ring and carrier, of which one is held"
            raise InputError(f"stage.{number}.type", quoted(kind), rule, "export the other stages")
