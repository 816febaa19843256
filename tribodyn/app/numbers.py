"""Numbers of results by group, beside those of a variant."""

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.app.picture import Result

#: Significant digits of a difference.
_FEW = 3
#: Headings of a run's rows that say nothing of the design.
_LEFT_OUT = ("Solver",)
#: The first column of tables whose rows are quantities.
_QUANTITY = "quantity"
_NUMBER = re.compile(r"[-−+]?\d[\d,]*(?:\.\d+)?(?:e[-+]?\d+)?")


class ShownNumber(NamedTuple):
    """A quantity of a result."""

    group: str
    name: str
    label: str
    text: str
    unit: str
    value: float | None
    about: str
    stage: str


def numbers_of(results: Mapping[str, Result]) -> list[ShownNumber]:
    """All numbers, those of the motion first."""
    return [*_of_rows(results), *_of_slow_rotation(results), *_of_tables(results)]


def _of_rows(results: Mapping[str, Result]) -> Iterator[ShownNumber]:
    for stage in ("motion", "strength", "check"):
        for row in results.get(stage, {}).get("rows", ()):
            if row["heading"] in _LEFT_OUT:
                continue
            yield ShownNumber(
                f"In motion: {row['heading'].lower()}" if stage == "motion" else "Strength by ISO 6336",
                row["name"],
                row["label"],
                row["text"],
                row["unit"],
                row["value"],
                row["definition"],
                stage,
            )


def _of_slow_rotation(results: Mapping[str, Result]) -> Iterator[ShownNumber]:
    group = "Quasi-static"
    about = "Over a mesh cycle in slow rotation, of the teeth alone, on rigid bearings."
    for stage in ("static", "torques"):
        result = results.get(stage, {})
        for number, (torque, swing) in enumerate(
            zip(result.get("torques", ()), result.get("peak_to_peak", ()), strict=False)
        ):
            place = number - int(result["nominal"])
            if (place == 0) is (stage == "static"):
                label = f"Transmission error, peak to peak, at {float(torque):.4g} N·m"
                name, value = f"static-{place}", float(swing)
                yield ShownNumber(group, name, label, f"{value:.4g}", "µm", value, about, stage)
        load = np.asarray(result.get("load", ()))
        if load.size:
            most, about_load = float(np.nanmax(load)), "Of one pair in slow rotation at the nominal torque."
            label = "Maximum load of a pair"
            yield ShownNumber(group, "static-load", label, f"{most:,.0f}", "N", most, about_load, stage)


def _of_tables(results: Mapping[str, Result]) -> Iterator[ShownNumber]:
    seen = set()
    for stage in ("check", "geometry"):
        for table in results.get(stage, {}).get("tables", ()):
            first, *columns = table["columns"]
            if first != _QUANTITY or table["title"] in seen:
                continue
            seen.add(table["title"])
            if "unit" in columns or len(columns) > 2:
                continue
            for row in table["rows"]:
                for column, text in zip(columns, row[1:], strict=True):
                    label = row[0] if len(columns) == 1 else f"{row[0]}, {column}"
                    number, unit = _split(text)
                    shown = text if number is None else text[: len(text) - len(unit)].strip()
                    yield ShownNumber(
                        table["title"], f"{table['title']} {label}", label, shown, unit, number, "", stage
                    )


def _split(text: str) -> tuple[float | None, str]:
    """The number that a text begins with, and the unit behind it."""
    found = _NUMBER.match(text)
    if not found:
        return None, ""
    return float(found.group().replace(",", "").replace("−", "-")), text[found.end() :].strip()


def other_tables(results: Mapping[str, Result]) -> list[dict[str, Any]]:
    """Tables of the check that are no list of quantities."""
    tables = results.get("check", {}).get("tables", ())
    return [
        dict(table)
        for table in tables
        if table["columns"][0] != _QUANTITY or "unit" in table["columns"] or len(table["columns"]) > 3
    ]


def compared(results: Mapping[str, Result], pinned: Mapping[str, Result]) -> list[dict[str, Any]]:
    """Rows by group, with the pinned variant's numbers and the differences."""
    before = {number.name: number for number in numbers_of(pinned)}
    groups: dict[str, dict[str, Any]] = {}
    for number in numbers_of(results):
        group = groups.setdefault(number.group, {"title": number.group, "rows": []})
        old = before.get(number.name)
        group["rows"].append(
            {
                "name": number.name,
                "label": number.label,
                "about": number.about,
                "value": number.text,
                "unit": number.unit,
                "pinned": old.text if old else "–",
                "difference": difference(number, old) if old else "–",
            }
        )
    return list(groups.values())


def difference(now: ShownNumber, before: ShownNumber) -> str:
    """Difference of two numbers with its share of the older one, as text; "0" where there is none."""
    if now.value is None or before.value is None:
        return "0" if now.text == before.text else "changed"
    if now.text == before.text and now.unit == before.unit:
        return "0"
    if now.unit != before.unit:
        return "changed"
    change = now.value - before.value
    part = 100.0 * change / abs(before.value) if before.value else 0.0
    share = f" ({part:+.0f} %)" if abs(part) >= 10.0 else f" ({part:+.1g} %)" if part else ""
    return f"{change:+.{_FEW}g}{share}".replace("-", "−")


def side_by_side(columns: Sequence[Mapping[str, Result]]) -> list[dict[str, Any]]:
    """Rows by group with the number of each state."""
    found = [{number.name: number for number in numbers_of(results)} for results in columns]
    groups: dict[str, dict[str, Any]] = {}
    for name, number in found[0].items():
        group = groups.setdefault(number.group, {"title": number.group, "rows": []})
        unit = f" ({number.unit})" if number.unit else ""
        texts = [each[name].text if name in each else "…" for each in found]
        if len(set(texts)) > 1:  # what is the same everywhere says nothing
            group["rows"].append({"name": name, "label": number.label + unit, "values": texts})
    return [group for group in groups.values() if group["rows"]]
