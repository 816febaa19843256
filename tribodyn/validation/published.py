"""Published numbers and claims, and how near a computed one has to be."""

import json
from collections.abc import Iterable
from functools import cache
from importlib.resources import files
from typing import Any

from tribodyn.numerics.files.rows import table_rows

#: The tolerance of a number: this share of the value, or of the part of it that matters, or half a unit of
#: its last printed digit, whichever is larger. Rows of geometry and closed forms name a smaller share.
WIDE = 0.05
#: Parts of a value that matter where the whole does not, and what they are counted from; of a value in per
#: cent from a hundred times that.
PARTS = {"loss": 1.0, "rise": 1.0, "fall": 1.0}
#: Why the tolerance of a number of few digits is a large share of it.
_LAST_DIGIT = "half a unit of the last printed digit"
#: Room for the rounding of a number that lies on the edge of its last digit.
_EDGE = 1.0 + 1e-6


def decimals(printed: str) -> int:
    """Digits after the point of a printed number, of its mantissa."""
    return len(printed.partition("e")[0].partition(".")[2])


def last_digit(printed: str) -> float:
    """A unit of the last digit of a printed number."""
    return 10.0 ** (int(printed.partition("e")[2] or 0) - decimals(printed))


def published(paper: str) -> dict[str, dict[str, Any]]:
    """The published rows of a paper by id, in order.

    What stands in `note` is shown to users, what stands in `for_maintainers` is not. A row that is `off` is
    known to differ, and its note has the reason: it is reported, or of its "direction" only; every other
    fails where it differs.
    """
    if files("tribodyn.validation.books").joinpath(f"{paper}.csv").is_file():
        return {row["id"]: row for row in _of_book(paper)}
    return {row["id"]: _completed(row) for row in _papers()[paper]}


@cache
def _papers() -> dict[str, list[dict[str, Any]]]:
    return json.loads(files("tribodyn.validation").joinpath("published.json").read_text(encoding="utf-8"))


def _completed(row: dict[str, Any]) -> dict[str, Any]:
    """A row of the file with its numbers for their printed digits, and the tolerance that these give."""
    base = {"unit": "1", "note": "", "tolerance": WIDE, "tolerance_kind": "absolute", "independent": None}
    chosen = "tolerance" in row and not isinstance(row["published"], list)
    row = base | row
    printed = row["published"]
    if printed is True:
        return row | {"tolerance": None, "tolerance_kind": "claim", "unit": "claim"}
    digits = [0.0 if chosen else last_digit(text) for text in _each(printed or ())]
    if printed is not None:
        row["published"] = [float(text) for text in printed] if isinstance(printed, list) else float(printed)
    if "part" in row:
        row["whole"] = PARTS[row["part"]] * (100.0 if row["unit"] == "%" else 1.0)
    values = list(_each(row["published"] if printed is not None else row["independent"]))
    parts = [abs(value - row.get("whole", 0.0)) for value in values]
    of_digit = [0.5 * _EDGE * digit for digit in digits] or [0.0] * len(values)
    of_share = [row["tolerance"] * part for part in parts]
    most = [max(pair) for pair in zip(of_digit, of_share, strict=True)]
    if "part" not in row and len(most) == 1 and not isinstance(printed, list) and most == of_share:
        return row | {"tolerance_kind": "relative"}
    wide = any(limit > WIDE * part * (1.0 + 1e-9) > 0.0 for limit, part in zip(most, parts, strict=True))
    tolerance = most if isinstance(printed, list) else most[0]
    return row | {"tolerance": tolerance, "tolerance_reason": _LAST_DIGIT if wide else ""}


def _each(value: Any) -> Iterable[Any]:
    return value if isinstance(value, (list, tuple)) else [value]


def _of_book(paper: str) -> Iterable[dict[str, Any]]:
    """Rows of a book: a listing's numbers as printed, one or (pinion, gear) per line of its file."""
    for line in table_rows("tribodyn.validation.books", f"{paper}.csv"):
        for side in ("pinion", "gear") if line["gear"] else ("pinion",):
            printed = line[side]
            tolerance = 0.5 * _EDGE * last_digit(printed)
            reason = line["reason"]
            of, colon, text = reason.partition(": ")
            if colon and of in ("pinion", "gear"):
                reason = text if of == side else ""
            wide = float(printed) != 0.0 and tolerance > WIDE * abs(float(printed))
            yield {
                "id": f"{paper}/{line['name']}" + (f"-{side}" if line["gear"] else ""),
                "quantity": line["quantity"] + (f", {side}" if line["gear"] else ""),
                "unit": line["unit"],
                "published": float(printed),
                "printed": printed,
                "tolerance": tolerance,
                "tolerance_kind": "absolute",
                "tolerance_reason": _LAST_DIGIT if wide else "",
                "independent": None,
                "note": reason,
                "off": bool(reason),
            }
