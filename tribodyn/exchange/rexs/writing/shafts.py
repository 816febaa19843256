"""Shafts, bearings, bodies and links: from the tables of a scenario to components."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from tribodyn.errors import InputError, quoted
from tribodyn.exchange.rexs.file import attributes as rexs
from tribodyn.exchange.rexs.writing.builder import ModelText, si, value_in
from tribodyn.exchange.rexs.writing.layout import RexsPlaces
from tribodyn.exchange.rexs.writing.teeth import said

_CATALOGUE, _CONCEPT = "rolling_bearing_with_catalog_geometry", "concept_bearing"
#: Axial force of the first row, and of the second, that a pair takes: X holds outwards, O inwards.
_PAIRS = {"X": ("negative", "positive"), "O": ("positive", "negative")}
_NO_WAY = "cylindrical-roller", "needle-roller"
#: Metal of a shaft of which the scenario says none.
_METAL = {"youngs_modulus": "206 GPa", "poisson_ratio": 0.3, "density": "7850 kg/m**3"}


class Shafts:
    """Writes shafts and what holds and joins them."""

    def __init__(self, model: ModelText, tables: Mapping[str, Any], layout: RexsPlaces, casing: int) -> None:
        self.model, self.tables, self.layout, self.casing = model, tables, layout, casing
        self.numbers: dict[str, int] = {}
        self.remarks: list[str] = []

    def shaft(self, name: str) -> int:
        """Add a shaft in its place, with its sections and bearings where it is drawn; its id."""
        model, layout = self.model, self.layout
        number = self.numbers[name] = model.add("shaft", name)
        model.relate("assembly", assembly=1, part=number)
        model.place(number, (layout.start.get(name, 0.0), *layout.centre.get(name, (0.0, 0.0))))
        drawn = next(
            (each.get("drawn") for each in self.tables.get("shaft", ()) if each["name"] == name), None
        )
        if drawn:
            self._drawn(number, name, drawn)
        return number

    def _drawn(self, number: int, name: str, drawn: Mapping[str, Any]) -> None:
        model, along = self.model, 0.0
        for section in drawn["section"]:
            outer, inner = (
                value_in(section["diameter"], rexs.OUTER_BEGIN),
                value_in(section.get("bore") or "0 mm", rexs.INNER_BEGIN),
            )
            values = {
                rexs.U_ON_SHAFT: float(f"{1e3 * along:.12g}"),
                rexs.LENGTH: value_in(section["length"], rexs.LENGTH),
            }
            values |= {
                rexs.OUTER_BEGIN: outer,
                rexs.OUTER_END: outer,
                rexs.INNER_BEGIN: inner,
                rexs.INNER_END: inner,
            }
            model.relate("assembly", assembly=number, part=model.add("shaft_section", "", values))
            along += si(section["length"])
        metal = {key: drawn.get(key) or value for key, value in _METAL.items()}
        values = said(metal, rexs.MATERIAL[:3])
        assert rexs.DENSITY in values
        model.relate("reference", origin=number, referenced=model.add("material", f"shaft {name}", values))
        for count, bearing in enumerate(drawn["bearing"], start=1):
            self._bearing(number, f"{name}-{count}", bearing)

    def _bearing(self, shaft: int, name: str, table: Mapping[str, Any]) -> None:
        """A bearing of a drawn shaft."""
        model, kind = self.model, table.get("type")
        if table.get("matrix") is not None or (kind is not None and kind not in rexs.BEARING_TYPES):
            what = "a matrix" if kind is None else f"a {kind} bearing"
            raise InputError(
                f"bearing {name}", None, f"is {what}, which REXS has not", "write springs instead"
            )
        place = value_in(table["position"], rexs.U_INNER)
        if kind is None:
            values = _springs(
                [table.get(key) for key in ("stiffness_x", "stiffness_y")], table, self.remarks, name
            )
            self._held(model.add(_CONCEPT, name, values), shaft, place)
            return
        rows = 2 if table.get("arrangement") or table.get("rows") == 2 else 1
        thrust = {"+z": "positive", "-z": "negative"}.get(table.get("thrust") or "")
        way = (
            "no_direction"
            if kind in _NO_WAY or table.get("locating") is False
            else thrust or "both_directions"
        )
        values = {
            rexs.BEARING_TYPE: rexs.BEARING_TYPES[str(kind)][0],
            rexs.AXIAL_ABSORPTION: way,
            rexs.RADIAL_ABSORPTION: True,
            rexs.ROWS: rows,
        }
        values |= said(table, (rexs.INNER, rexs.OUTER, *rexs.RATINGS, rexs.ROW_DISTANCE, rexs.PRELOAD_FORCE))
        for key in (rexs.CLEARANCE, rexs.PRELOAD):
            if table.get(key.key) is not None and si(table[key.key]):
                values[key] = value_in(table[key.key], key)
        number = model.add(_CATALOGUE, name, values)
        self._held(number, shaft, place)
        for row in range(rows):
            held = _PAIRS.get(str(table.get("arrangement")), (way, way))[row]
            inside = model.add(
                "rolling_bearing_row",
                "",
                said(table, (rexs.CONTACT_ANGLE, *rexs.ROW)) | {rexs.ROW_ABSORPTION: held},
            )
            model.relate("ordered_assembly", row + 1, assembly=number, part=inside)
            if element := said(table, rexs.ELEMENT):
                model.relate(
                    "ordered_assembly", 1, assembly=inside, part=model.add("rolling_element", "", element)
                )

    def _held(self, bearing: int, shaft: int, place: Any, outer: int | None = None) -> None:
        """Let a bearing hold a shaft in the casing, or in another shaft."""
        self.model.put(bearing, rexs.U_INNER, place)
        self.model.put(bearing, rexs.U_OUTER, None if outer is None else place)
        casing = self.casing if outer is None else outer
        self.model.relate("side", assembly=bearing, inner_part=shaft, outer_part=casing)

    def stiffness(self, name: str) -> dict[rexs.RexsKey, Any]:
        """The stiffness of [bearings.NAME]; nothing where there is none."""
        bearings = self.tables.get("bearings") or {}
        table = bearings.get(name) or bearings.get("default") or bearings.get("gear")
        if not table:
            return {}
        for what in ("rolling", "matrix"):
            if table.get(what):
                rule = "REXS has no such bearing"
                raise InputError(f"bearings.{name}.{what}", None, rule, "write stiffness_x and stiffness_y")
        both = [table.get(key) for key in ("stiffness_x", "stiffness_y")]
        values = _springs(both, table, self.remarks, name)
        if (
            table.get("span") is not None
            and rexs.TILT_STIFFNESS not in values
            and rexs.RADIAL_STIFFNESS in values
        ):
            tilt = (
                values[rexs.RADIAL_STIFFNESS] * (si(table["span"]) / 2) ** 2
            )  # of two bearings at this distance
            values[rexs.TILT_STIFFNESS] = float(f"{1e3 * tilt:.12g}")
        return values

    def springs(
        self, name: str, shaft: int, place: float, outer: int | None = None, *, floating: bool = False
    ) -> None:
        """The bearings of something that no drawn shaft carries, as one concept bearing."""
        values = self.stiffness(name)
        if floating:  # no bearing holds it in x and y
            values = {key: value for key, value in values.items() if key is not rexs.RADIAL_STIFFNESS}
            values[rexs.RADIAL_ABSORPTION] = False
        if not values or (floating and rexs.AXIAL_STIFFNESS not in values):
            return
        here = float(f"{1e3 * place:.12g}")
        self._held(self.model.add(_CONCEPT, f"bearing of {name}", values), shaft, here, outer)

    def body(self, table: Mapping[str, Any]) -> None:
        """A body without teeth on its shaft."""
        name = table["name"]
        values = said(table, (rexs.MASS, rexs.INERTIA))
        values[rexs.U_ON_SHAFT] = float(f"{1e3 * self.layout.position[name]:.12g}")
        number = self.model.add("additional_mass", name, values)
        self.model.relate("assembly", assembly=self.numbers[self.layout.shaft_of[name]], part=number)

    def links(self) -> None:
        """Couplings between shafts."""
        for link in self.tables.get("link", ()):
            name = link.get("name") or " and ".join(link["ends"])
            if "ground" in link["ends"] or link.get("law", "linear") != "linear":
                rule = "a link to the ground, or with a law of its own, which REXS has not"
                raise InputError("link", quoted(name), rule, "leave it out")
            first, second = (self.numbers[self.layout.shaft(end)] for end in link["ends"])
            values: dict[rexs.RexsKey, Any] = {}
            if link.get("stiffness") is not None:
                values[rexs.TORSIONAL_STIFFNESS] = value_in(link["stiffness"], rexs.TORSIONAL_STIFFNESS)
            number = self.model.add("coupling", name, values)
            self.model.relate("side", assembly=number, inner_part=first, outer_part=second)


def _springs(
    both: Sequence[Any], table: Mapping[str, Any], remarks: list[str], name: str
) -> dict[rexs.RexsKey, Any]:
    """Of a concept bearing: one radial stiffness, the geometric mean where x and y differ."""
    told = [si(each, "N/m") for each in both if each is not None]
    values: dict[rexs.RexsKey, Any] = {rexs.RADIAL_ABSORPTION: bool(told)}
    if told:
        values[rexs.RADIAL_STIFFNESS] = float(f"{math.prod(told) ** (1 / len(told)):.12g}")
        if min(told) != max(told):
            remarks.append(f"bearing {name}: REXS has one radial stiffness; the mean of x and y stands there")
    values[rexs.AXIAL_ABSORPTION] = (
        "both_directions" if table.get("stiffness_axial") is not None else "no_direction"
    )
    return values | said(table, (rexs.AXIAL_STIFFNESS, rexs.TILT_STIFFNESS))
