"""Scenarios drawn from the schema: every key is drawn, with values of its type, on the day it lands."""

from random import Random
from typing import Annotated, Any

import pytest
from pydantic import TypeAdapter, ValidationError

from tools.by_schema.changes import at, changed, keys_of, opened, taken
from tools.by_schema.keys import Pattern, SchemaKey, every_key, patterns
from tools.by_schema.values import Surroundings, drawn_value
from tribodyn.input.names import OF_PAIR
from tribodyn.input.schema import EACH
from tribodyn.numerics.parameter import Parameter
from tribodyn.studies import STUDIES
from tribodyn.studies.protocol.load import json_schema

#: Draws until one is of the key's type.
DRAWS = 40


def in_json_schema(part: Any, definitions: dict[str, Any], above: Pattern = ()) -> set[Pattern]:
    """Keys of a JSON schema, with `EACH` for names and places."""
    if "$ref" in part:
        return in_json_schema(definitions[part["$ref"].rpartition("/")[2]], definitions, above)
    found: set[Pattern] = set()
    for choice in (*part.get("anyOf", ()), *part.get("oneOf", ())):
        found |= in_json_schema(choice, definitions, above)
    for name, inner in part.get("properties", {}).items():
        found |= {(*above, name)} | in_json_schema(inner, definitions, (*above, name))
    inside = [
        part.get("items"),
        part.get("additionalProperties"),
        *part.get("patternProperties", {}).values(),
    ]
    for inner in inside:
        if isinstance(inner, dict):
            found |= in_json_schema(inner, definitions, (*above, EACH))
    return found


def test_keys_are_those_of_the_json_schema():
    """`tribodyn schema` is made by pydantic, which walks the tables by itself; `like` is the loader's.

    Keys that have two names are drawn under that of their field.
    """
    schema = json_schema()
    definitions = schema["$defs"]
    for kind, reference in schema["discriminator"]["mapping"].items():
        known = in_json_schema({"$ref": reference}, definitions)
        known = {key for key in known if key[-1] not in ("like", EACH) and not OF_PAIR.keys() & set(key)}
        drawn = {key for key in patterns(STUDIES[kind].table()) if "shape" not in key[:-1]}
        assert drawn == known, kind


def every_field() -> dict[tuple[str, str], SchemaKey]:
    """Every key of every table of every kind, each once."""
    keys = (key for kind in STUDIES for key in every_key(STUDIES[kind].table()))
    return {(key.holder.__name__, f"{key.pattern[-1]} {key.owner}".strip()): key for key in keys}


def test_every_key_is_drawn_with_a_value_of_its_type():
    lacking = []
    for name, key in every_field().items():
        if isinstance(key.field, Parameter):
            continue
        marked: Any = Annotated[(key.field.annotation, *key.field.metadata, None)]
        adapter = TypeAdapter(marked)
        random, around = Random(str(name)), Surroundings(("pinion", "gear"))
        if not any(valid(adapter, drawn_value(random, key, around)) for _ in range(DRAWS)):
            lacking.append(name)
    assert lacking == []


def valid(adapter: TypeAdapter[Any], value: Any) -> bool:
    try:
        adapter.validate_python(value)
    except ValidationError:
        return False
    return True


@pytest.mark.parametrize("name", ["irefc", "sensors-18-36", "planetary-24-84", "design-shift-23-47"])
def test_every_key_can_be_put_into_a_scenario(name: str):
    """Tables and lists on the way to it are made where there are none."""
    data = opened(name)
    lacking = []
    for key in keys_of(data):
        dotted, made = changed(Random(".".join(key.pattern)), data, key)
        if at(made, dotted) is None:
            lacking.append(dotted)
    assert lacking == []


@pytest.mark.parametrize(
    ("name", "key"),
    [
        ("involute-18-36", "drive.gear.modification.pitch_errors"),  # as many as there are teeth
        ("involute-18-36", "drive.pinion.over_pins"),  # needs pin_diameter, and a value that fits the tooth
        ("involute-18-36", "mesh.deviation_sample"),  # needs quality, in another table
        ("involute-18-36", "operating.power"),  # in place of gear_torque
        ("involute-18-36", "mesh.table.stiffness.values"),  # needs another compliance
        ("involute-18-36", "sensor.*.bits"),  # needs a sensor, with a full scale
        ("wear-18-36", "drive.gear.modification.pitch_errors"),  # needs wear.teeth = "each"
        ("irefc", "friction.rolling_arm"),
    ],
)
def test_what_a_key_needs_is_added(name: str, key: str):
    """Refusals name what is missing or contradicts, and that is followed."""
    data = opened(name)
    wanted = next(one for one in keys_of(data) if ".".join(one.pattern) == key)
    tries = (taken(Random(f"{key} {number}"), data, wanted) for number in range(8))
    found = next(made for made in tries if made is not None)
    assert at(found.data, found.key) == found.value
    assert found.case.kind == data.get("kind", found.case.kind)
