"""The scenario of ``kind = "map"``: the scenario of a gearbox, and the table with the axes of its map."""

import tomllib
from collections.abc import Iterator, Mapping
from functools import lru_cache
from itertools import pairwise
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import AfterValidator, Discriminator, Field, Tag, create_model

from tribodyn.errors import InputError, quoted
from tribodyn.input import units
from tribodyn.input.fields import ScenarioHead, head_of
from tribodyn.input.quantity import InUnit, Table, broken, scenario_file, written
from tribodyn.input.tables.lubricant import broken_lubricant_rules
from tribodyn.studies import study_of
from tribodyn.studies.map.case import BACK, BOTH, FORWARD, NAMES, MapCase
from tribodyn.studies.protocol.load import broken_rules as rules_broken_by
from tribodyn.studies.protocol.load import load_data, schema_inside
from tribodyn.tribology.oil import ZERO_CELSIUS

KIND = "map"
#: Values of one axis.
MOST_VALUES = 1000
#: Temperatures closer than this are the same, K.
_SAME = 1e-6


class AxisRange(Table):
    """Values of an axis from one to another, both included."""

    points: Annotated[int, Field(strict=True, ge=2, le=MOST_VALUES)]
    spacing: Literal["linear", "log"] = "linear"

    def model_post_init(self, _: Any) -> None:
        """Refuse ranges that do not increase, and logarithms of what has none."""
        first, last = self.ends
        if last <= first:
            raise broken(f"ends at {last:g} and starts at {first:g}", "let to be greater than from")
        if self.spacing == "log" and first <= 0.0 <= last:
            remedy = 'start above 0, or write spacing = "linear", or a list with 0 in front'
            raise broken("0 has no logarithm", remedy)

    @property
    def ends(self) -> tuple[float, float]:
        """First and last value, SI."""
        return getattr(self, "from"), getattr(self, "to")  # noqa: B009

    def values(self) -> tuple[float, ...]:
        """All values, SI."""
        spaced = np.geomspace if self.spacing == "log" else np.linspace
        inner = spaced(*self.ends, self.points)[1:-1]
        return self.ends[0], *map(float, inner), self.ends[1]


def _increasing(values: tuple[float, ...]) -> tuple[float, ...]:
    if not values:
        raise broken("an empty list", "write at least one value")
    for number, (before, after) in enumerate(pairwise(values), start=2):
        if after == before:
            raise broken(f"value {number} repeats the one before it", "write each value once")
        if after < before:
            raise broken(f"value {number} is below the one before it", "write them in increasing order")
    return values


def _axis(name: str, kind: units.Kind, first: str, last: str) -> Any:
    """A field: a list of quantities of a kind, or a table with from, to, points and spacing."""
    value: Any = Annotated[float, InUnit(kind)]
    fields: dict[str, Any] = {
        "from": (value, Field(examples=[first])),
        "to": (value, Field(examples=[last])),
    }
    table: Any = create_model(f"{name}Range", __base__=AxisRange, __doc__=AxisRange.__doc__, **fields)
    several: Any = Annotated[
        tuple[value, ...], Field(max_length=MOST_VALUES), AfterValidator(_increasing), Tag("(list)")
    ]
    chosen = Discriminator(lambda given: "(range)" if isinstance(given, dict | AxisRange) else "(list)")
    axis: Any = Annotated[Annotated[table, Tag("(range)")] | several, chosen]
    return axis | None, Field(None, examples=[{"from": first, "to": last, "points": 11}])


_Axes: Any = create_model(
    "MapAxes",
    __base__=Table,
    __doc__="Axes of a map.",
    torque=_axis("Torque", units.TORQUE, "0 N*m", "500 N*m"),
    speed=_axis("Speed", units.ANGULAR_SPEED, "0 rpm", "3000 rpm"),
    oil_temperature=_axis("Temperature", units.TEMPERATURE_KIND, "20 degC", "90 degC"),
)


class MapTable(_Axes):
    """Over what the losses are mapped, and how well interpolation holds them."""

    directions: Literal["forward", "back", "both"] | None = None
    accuracy: Annotated[float, Field(strict=True, ge=0.0, le=0.5)] = 0.01
    most_points: Annotated[int, Field(strict=True, ge=1, le=2_000_000)] = 20_000


class MapScenario(ScenarioHead):
    """A scenario file of a map."""

    kind: Literal["map"]
    scenario: Annotated[dict[str, Any], scenario_file()]
    map: MapTable = written({})


def table_for(data: Mapping[str, Any]) -> type[Table]:
    """Return the schema for data: of a gearbox, where it is opened, by its kind."""
    return _around(schema_inside(data.get("scenario"), KIND))


@lru_cache(maxsize=16)
def _around(base: type[Table] | None) -> type[Table]:
    if base is None:
        return MapScenario
    field: Any = (Annotated[base, scenario_file()], ...)
    return create_model("MapScenario", __base__=MapScenario, __doc__=MapScenario.__doc__, scenario=field)


def case_of(scenario: Any, toml: str, sha256: str) -> MapCase:
    """Return the case of a scenario that has passed schema and rules."""
    inner, table = tomllib.loads(toml)["scenario"], scenario.map
    return MapCase(
        **head_of(scenario, toml, sha256),
        subject=load_data(inner, str(inner.get("name") or "gearbox")),
        asked=tuple(_values(getattr(table, name)) for name in NAMES),
        directions=table.directions or FORWARD,
        accuracy=table.accuracy,
        most_points=table.most_points,
    )


def _values(axis: Any) -> tuple[float, ...] | None:
    return axis.values() if isinstance(axis, AxisRange) else axis


def broken_rules(scenario: Any) -> Iterator[InputError]:
    """Go through the rules that such a scenario breaks, those of the gearbox included."""
    inner, table = scenario.scenario, scenario.map
    kind = inner.get("kind") if isinstance(inner, dict) else inner.kind
    study = study_of({"kind": kind})
    if not isinstance(inner, Table) or study.losses() is None:
        rule = "is no gearbox: it has no losses over torque, speed and temperature"
        yield InputError("scenario.kind", quoted(kind), rule, "name a scenario of a gear pair or a train")
        return
    for error in rules_broken_by(study, inner):
        yield InputError(f"scenario.{error.key}", error.value, error.rule, error.remedy, error.file)
    yield from _directions(_values(table.torque), table.directions)
    yield from _temperatures(inner, _values(table.oil_temperature))


def _directions(torque: tuple[float, ...] | None, stated: str | None) -> Iterator[InputError]:
    """Refuse torques of a direction that is not stated, or not the one that is."""
    if torque is None or (torque[0] >= 0.0 and stated != BACK) or (stated == BOTH and torque[-1] > 0.0):
        return
    key, value = "map.torque", f"{torque[0]:g} … {torque[-1]:g} N*m"
    through = torque[0] < 0.0 < torque[-1]
    if stated is None:
        where = "passes through 0" if through else "lies below 0"
        rule = f"{where}, where the load drives and power flows back, and no direction is stated"
        yield InputError(key, value, rule, f'write directions = "{BOTH if through else BACK}"')
    elif stated == BACK and through:
        yield InputError(key, value, f'passes through 0, and directions = "{BACK}"', f'write "{BOTH}"')
    elif stated != BACK:
        rule = f'lies below 0, where power flows back, and directions = "{stated}"'
        yield InputError(key, value, rule, f'write directions = "{BOTH if through else BACK}"')


def _temperatures(inner: Any, temperatures: tuple[float, ...] | None) -> Iterator[InputError]:
    """Refuse temperatures at which the oil is not known, and an oil at a temperature that nobody says."""
    known, operating = inner.lubricant.viscosity_40 is not None, inner.operating.oil_temperature
    if not known and operating is None and (temperatures is None or len(temperatures) == 1):
        if temperatures is None:
            rule = (
                "is not given, and the lubricant's numbers are those of one temperature, which is not known"
            )
            yield InputError("map.oil_temperature", None, rule, 'write the one that they are of: ["60 degC"]')
        return
    if temperatures is None:
        return
    for number, temperature in enumerate(temperatures):
        key, value = f"map.oil_temperature.{number}", f"{temperature - ZERO_CELSIUS:.6g} degC"
        if known:
            for error in broken_lubricant_rules(inner.lubricant, temperature):
                if error.key == "operating.oil_temperature":
                    yield InputError("map.oil_temperature", value, error.rule, error.remedy)
        elif operating is None or abs(temperature - operating) > _SAME:
            rule = "the lubricant is given at one temperature, and not known at another"
            yield InputError(key, value, rule, "give its data sheet, or leave map.oil_temperature out")
            return
