"""Where the axes and faces of a scenario's gears stand, and which way they turn: what REXS writes out."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from tribodyn.errors import InputError, quoted
from tribodyn.exchange.rexs.writing.builder import si

#: Along a shaft that is not drawn, between the faces of its gears, m.
_GAP = 0.01


@dataclass
class RexsPlaces:
    """Gears and bodies by their shafts; shafts by axis and start (m), and by turns over the input."""

    shaft_of: dict[str, str] = field(default_factory=dict)
    position: dict[str, float] = field(default_factory=dict)  # on its shaft, m
    centre: dict[str, tuple[float, float]] = field(default_factory=dict)  # of shafts
    start: dict[str, float] = field(default_factory=dict)
    turns: dict[str, float] = field(default_factory=dict)

    def shaft(self, name: Any) -> str:
        """The shaft of a gear or a body; of a shaft itself."""
        return self.shaft_of.get(str(name)) or str(name)


def centre_distance(tables: Mapping[str, Any], stage: Mapping[str, Any], first: str, second: str) -> float:
    """The centre distance of a stage, m; where none is written that of teeth without backlash."""
    written = stage.get("centre_distance")
    if written is not None:
        return si(written)
    gears = [tables["gear"][name] for name in (first, second)]
    signs = [-1 if gear.get("internal") else 1 for gear in gears]
    teeth = [sign * gear["teeth"] for sign, gear in zip(signs, gears, strict=True)]
    shifts = [
        sign * gear.get("profile_shift", 0.0) * (-1 if gear.get("profile_shift_of") == "gap" else 1)
        for sign, gear in zip((1, 1), gears, strict=True)
    ]
    helix, normal = (
        math.radians(si(stage[key], "deg")) if stage.get(key) else fallback
        for key, fallback in (("helix_angle", 0.0), ("pressure_angle", math.radians(20)))
    )
    module = si(stage["module"])
    angle = math.atan(math.tan(normal) / math.cos(helix))
    involute = math.tan(angle) - angle + 2 * sum(shifts) / sum(teeth) * math.tan(normal)
    wide = abs(sum(teeth)) * module / (2 * math.cos(helix)) * math.cos(angle) / math.cos(_angle_of(involute))
    return float(f"{1e3 * wide:.12g}") / 1e3  # with the digits of the file


def _angle_of(involute: float) -> float:
    """The angle whose involute function is given, by Newton's method."""
    angle = max((3 * involute) ** (1 / 3), 0.1) if involute > 0 else 0.1
    for _ in range(50):
        angle -= (math.tan(angle) - angle - involute) / math.tan(angle) ** 2
    return angle


def layout_of(tables: Mapping[str, Any]) -> RexsPlaces:
    """Place everything; the input's axis is at the origin."""
    found = RexsPlaces()
    _shafts(tables, found)
    start = found.shaft(tables["operating"]["input"])
    if start not in found.shaft_of.values():
        raise InputError("operating.input", quoted(start), "is on no shaft that REXS can hold", "name a gear")
    found.centre[start], found.start[start], found.turns[start] = (0.0, 0.0), 0.0, 1.0
    edges = list(_edges(tables, found))
    for _ in range(len(edges) + 1):
        for edge in edges:
            edge.place(found)
    planets = {stage.get("planet") for stage in tables["stage"]}
    lost = sorted(
        {shaft for name, shaft in found.shaft_of.items() if name not in planets} - set(found.centre)
    )
    if lost:
        raise InputError("stage", quoted(lost[0]), "no stage or link joins it with the input", "join it")
    return found


def _shafts(tables: Mapping[str, Any], found: RexsPlaces) -> None:
    for shaft in tables.get("shaft", ()):
        drawn = shaft.get("drawn") or {}
        places = drawn.get("positions") or ({shaft["gears"][0]: drawn["gear_position"]} if drawn else {})
        along = 0.0
        for name in dict.fromkeys((*shaft["gears"], *places)):
            found.shaft_of[name] = shaft["name"]
            if name in places:
                found.position[name] = si(places[name])
            else:
                width = si(tables["gear"][name]["face_width"])
                found.position[name], along = along + width / 2, along + width + _GAP
        found.shaft_of[shaft["name"]] = shaft["name"]
    bodies: list[str] = [body["name"] for body in tables.get("body", ())]
    for name in (*map(str, tables.get("gear", {})), *bodies):
        if name in found.shaft_of:
            continue
        own = name if name in bodies else f"{name}-shaft"
        while own in found.shaft_of.values():
            own += "-"
        width = 0.0 if name in bodies else si(tables["gear"][name]["face_width"])
        found.shaft_of[name], found.position[name] = own, width / 2


@dataclass(frozen=True)
class _Edge:
    """Two shafts: from one axis to the other, places whose faces stand opposite, ratio."""

    shafts: tuple[str, str]
    apart: float
    azimuth: float | None
    places: tuple[float, float]
    ratio: float  # turns of the second over the first

    def place(self, found: RexsPlaces) -> None:
        first, second = self.shafts
        for here, there, sign in ((first, second, 1), (second, first, -1)):
            if here not in found.centre or there in found.centre:
                continue
            azimuth = self.azimuth if self.azimuth is not None else 0.0 if sign > 0 else math.pi
            x, y = found.centre[here]
            away = sign * self.apart
            found.centre[there] = x + away * math.cos(azimuth), y + away * math.sin(azimuth)
            own, other = self.places[::sign]
            found.start[there] = found.start[here] + own - other
            found.turns[there] = found.turns[here] * (self.ratio if sign > 0 else 1 / self.ratio)


def _edges(tables: Mapping[str, Any], found: RexsPlaces) -> Iterable[_Edge]:
    for stage in tables.get("stage", ()):
        if stage.get("type", "pair") == "pair":
            yield _pair(tables, found, stage)
        else:
            yield from _set(tables, found, stage)
    for link in tables.get("link", ()):
        if "ground" not in link["ends"]:
            first, second = (found.shaft(end) for end in link["ends"])
            yield _Edge((first, second), 0.0, 0.0, (0.2, 0.0), 1.0)


def _pair(tables: Mapping[str, Any], found: RexsPlaces, stage: Mapping[str, Any]) -> _Edge:
    first, second = stage["gears"]
    gears = [tables["gear"][name] for name in (first, second)]
    azimuth = stage.get("azimuth")
    sign = 1.0 if any(gear.get("internal") for gear in gears) else -1.0
    return _Edge(
        (found.shaft_of[first], found.shaft_of[second]),
        centre_distance(tables, stage, first, second),
        None if azimuth is None else math.radians(si(azimuth, "deg")),
        (found.position[first], found.position[second]),
        sign * gears[0]["teeth"] / gears[1]["teeth"],
    )


def _set(tables: Mapping[str, Any], found: RexsPlaces, stage: Mapping[str, Any]) -> Iterable[_Edge]:
    sun, ring = (tables["gear"][stage[key]]["teeth"] for key in ("sun", "ring"))
    turns = {
        "ring": {"sun": 1.0, "carrier": sun / (sun + ring), "ring": 1e-9},
        "carrier": {"sun": 1.0, "ring": -sun / ring, "carrier": 1e-9},
        "sun": {"ring": 1.0, "carrier": ring / (sun + ring), "sun": 1e-9},
    }[stage["held"]]
    first = next(iter(turns))
    for other in list(turns)[1:]:
        shafts = found.shaft_of[stage[first]], found.shaft_of[stage[other]]
        places = found.position[stage[first]], found.position[stage[other]]
        yield _Edge(shafts, 0.0, 0.0, places, turns[other] / turns[first])
