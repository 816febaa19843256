"""What the schema of REXS 2.0.0 says of a file, by its own tables."""

import xml.etree.ElementTree as ET
from functools import cache
from pathlib import Path

from tests.support.rexs_models import sample


class RexsSchema:
    """Attributes of components with units, types and choices; relations and who may be in them."""

    def __init__(self, path: Path) -> None:
        root = ET.parse(path).getroot()

        def named(table: str) -> dict[str, str]:
            return {each.attrib["id"]: each.attrib["name"] for each in root.iterfind(f"{table}/*")}

        units, kinds = named("units"), named("valueTypes")
        self.attributes = {
            each.attrib["attributeId"]: (
                units[each.attrib["unit"]],
                kinds[each.attrib["valueType"]],
                {choice.attrib["value"] for choice in each.iter("enumValue")},
            )
            for each in root.iterfind("attributes/attribute")
        }
        self.of_parts: dict[str, set[str]] = {
            each.attrib["componentId"]: set() for each in root.iterfind("components/component")
        }
        for each in root.iterfind("componentAttributeMappings/*"):
            self.of_parts[each.attrib["componentId"]].add(each.attrib["attributeId"])
        self.relations = {
            (
                relation.attrib["relationId"],
                frozenset((role.attrib["roleId"], role.attrib["componentId"]) for role in combination),
            )
            for relation in root.iterfind("relations/relation")
            for combination in relation.iter("allowedCombination")
        }

    def faults(self, text: str) -> list[str]:
        """What a file says that the schema does not know."""
        model = ET.fromstring(text)
        types = {each.attrib["id"]: each.attrib["type"] for each in model.iterfind("components/component")}
        found = []
        for part in model.iter("component"):
            if part.attrib["type"] not in self.of_parts:
                found.append(f"no component {part.attrib['type']}")
            for attribute in part:
                name, unit = attribute.attrib["id"], attribute.attrib["unit"]
                if name.startswith("custom_tribodyn_"):
                    continue
                where = f"{part.attrib['type']}.{name}"
                if name not in self.of_parts.get(part.attrib["type"], ()):
                    found.append(f"no attribute {where}")
                    continue
                due, kind, choices = self.attributes[name]
                value = attribute.text or ""
                if unit != due:
                    found.append(f"{where} in {unit}, due is {due}")
                if kind == "enum" and value not in choices:
                    found.append(f"{where} = {value}: no choice")
                if kind == "integer" and not value.lstrip("-").isdecimal():
                    found.append(f"{where} = {value}: not whole")
                if kind == "boolean" and value not in ("true", "false"):
                    found.append(f"{where} = {value}: neither true nor false")
                if kind.endswith("_array") != (attribute.find("array") is not None):
                    found.append(f"{where} is {kind}")
        for relation in model.iterfind("relations/relation"):
            roles = frozenset((ref.attrib["role"], types[ref.attrib["id"]]) for ref in relation)
            if (relation.attrib["type"], roles) not in self.relations:
                found.append(f"no relation {relation.attrib['type']} of {sorted(roles)}")
        return sorted(set(found))


@cache
def schema() -> RexsSchema:
    """That of version 2.0.0; the test is skipped where it is not at hand."""
    return RexsSchema(sample("rexs_schema_2.0.0.xml"))
