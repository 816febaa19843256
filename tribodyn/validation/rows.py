"""One row of a validation: a published number or claim compared with ours."""

import csv
import json
from collections.abc import Iterable, Mapping
from importlib.resources import files
from typing import Any, NamedTuple

PASS, FAIL, REPORTED = "pass", "fail", "reported"
#: Verdict of a row that compares the direction of a change and not its size.
DIRECTION = "direction"
#: What a row compares, in the order in which rows are counted, with the words of one and of several.
KINDS = {
    "number": ("number", "numbers"),
    "claim": ("claim", "claims"),
    "direction": ("row by direction", "rows by direction"),
    "implementation": ("value beside another implementation", "values beside another implementation"),
}
_CHOSEN = "not under every choice"
_BELOW_ONE = "direction only (below 1)"


class Otherwise(NamedTuple):
    """What a row would be under another choice than its own."""

    #: the program's default where the row is computed as published, another reading where the paper leaves
    #: one open
    choice: str
    #: computed, difference, verdict: As of the row.
    computed: Any
    difference: float | list[float] | None
    verdict: str


class Row(NamedTuple):
    """A published value, ours, and how they compare."""

    id: str
    quantity: str
    unit: str
    #: published, computed: lists where a row of a table is compared column by column
    published: Any
    computed: Any
    #: computed less published: relative to the published value where the tolerance is
    difference: float | list[float] | None
    tolerance: float | list[float] | None
    tolerance_kind: str
    #: {"pass", "fail", "direction", "reported"} "direction": only the direction is compared, and it is the
    #: published one; "reported": the published value is not reproducible, or a claim does not hold in our
    #: physics.
    verdict: str
    note: str
    #: {"number", "claim", "direction", "implementation"} What the row compares; "implementation": the paper
    #: has a figure only, and the value of another implementation of its equations takes the number's place.
    compared: str = "number"
    #: what of the value matters, where that is not the whole: the "loss" of an efficiency, the "rise" of a
    #: ratio above 1
    part: str = ""
    part_difference: float | None = None  # computed less published, of this part
    #: the tolerance as a share of the value or of its part; the largest of several columns
    tolerance_share: float | None = None
    tolerance_reason: str = ""  # why this share is larger than `WIDE`
    otherwise: tuple[Otherwise, ...] = ()  # the same row under other choices, where these differ
    printed: str = ""  # the published number as it is printed, where its last digit is the tolerance

    @property
    def hangs_on_choice(self) -> bool:
        """Whether the row holds under its own choice and not under each of the others."""
        return self.verdict in (PASS, DIRECTION) and any(
            other.verdict not in (PASS, DIRECTION) for other in self.otherwise
        )

    def written(self, name: str) -> str:
        """Write a field as a table for people shows it."""
        value = getattr(self, name)
        if name == "tolerance" and self.tolerance_reason and self.tolerance_share:
            shown = self._amount(name, value)
            if self.part or self.tolerance_kind != "relative":
                shown = f"{shown}, {of_part(self.tolerance_share, self.part or 'value')}"
            return f"{shown}: {self.tolerance_reason}"
        if name == "difference" and self.part_difference is not None:
            return f"{self._amount(name, value)}, {of_part(self.part_difference, self.part, '+')}"
        if name == "verdict" and self.hangs_on_choice:
            return f"{value}, {_CHOSEN}"
        return self._amount(name, value)

    def _amount(self, name: str, value: Any) -> str:
        if value is None:
            return ""
        if isinstance(value, tuple):
            return "; ".join(
                f"{choice}: "
                + ", ".join(
                    part
                    for part in (self._amount("computed", mine), self._amount("difference", off), verdict)
                    if part
                )
                for choice, mine, off, verdict in value
            )
        if isinstance(value, list):
            return " ".join(
                f"{number:.2g}" if name in ("difference", "tolerance") else f"{number:.5g}"
                for number in value
            )
        if isinstance(value, bool):
            return str(value).lower()
        if self.printed and name == "published":
            return self.printed
        if self.printed and name == "computed":
            return f"{value:.{decimals(self.printed) + 1}{'e' if 'e' in self.printed else 'f'}}"
        if name in ("difference", "tolerance") and self.tolerance_kind == "relative":
            return per_cent(value)
        return f"{value:.5g}" if isinstance(value, float) else str(value)

    def plain(self) -> dict[str, Any]:
        """The row as JSON has it."""
        fields = self._asdict() | {"hangs_on_choice": self.hangs_on_choice}
        return fields | {"otherwise": [other._asdict() for other in self.otherwise]}


def of_part(share: float, part: str, sign: str = "") -> str:
    """Write a share of a part with two digits."""
    return f"{float(f'{100.0 * share:.2g}'):{sign}g} % of the {part}"


def per_cent(share: float) -> str:
    """Write a share with two decimals, a small one with two digits."""
    value = 100.0 * share
    return f"{value:.2g} %" if abs(value) < 1.0 else f"{round(value, 2):g} %"


#: Fields of a row that a table for people shows.
SHOWN = (
    "quantity",
    "unit",
    "published",
    "computed",
    "difference",
    "tolerance",
    "verdict",
    "otherwise",
    "note",
)
#: A tolerance of a larger share has its reason beside it.
WIDE = 0.05


def decimals(printed: str) -> int:
    """Digits after the point of a printed number, of its mantissa."""
    return len(printed.partition("e")[0].partition(".")[2])


def last_digit(printed: str) -> float:
    """A unit of the last digit of a printed number."""
    return 10.0 ** (int(printed.partition("e")[2] or 0) - decimals(printed))


#: Why the tolerance of a number of few digits is a large share of it.
_LAST_DIGIT = "half a unit of the last printed digit"


def _of_book(paper: str) -> Iterable[dict[str, Any]]:
    """Rows of a book: a listing's numbers as printed, one or (pinion, gear) per line of its file."""
    text = files("tribodyn.validation.books").joinpath(f"{paper}.csv").read_text(encoding="utf-8")
    for line in csv.DictReader(text.splitlines()):
        for side in ("pinion", "gear") if line["gear"] else ("pinion",):
            printed = line[side]
            tolerance = 0.5 * (1.0 + 1e-6) * last_digit(printed)
            reason = line["reason"]
            of, colon, text = reason.partition(": ")
            if colon and of in ("pinion", "gear"):
                reason = text if of == side else ""
            wide = float(printed) != 0.0 and tolerance > WIDE * abs(float(printed))
            yield {
                "id": f"{paper}/{line['name']}" + (f"-{side}" if line["gear"] else ""),
                "paper": paper,
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


def published(paper: str) -> dict[str, dict[str, Any]]:
    """The published rows of a paper by id, in order.

    What stands in `note` is shown to users, what stands in `for_maintainers` is not. A row that is `off` is
    known to differ: its note has the reason, and it is reported; every other fails where it differs.
    """
    if files("tribodyn.validation.books").joinpath(f"{paper}.csv").is_file():
        return {row["id"]: row for row in _of_book(paper)}
    text = files("tribodyn.validation").joinpath("published.json").read_text(encoding="utf-8")
    return {row["id"]: row for row in json.loads(text) if row["paper"] == paper}


def compare(
    row: dict[str, Any], computed: Any, note: str = "", otherwise: Mapping[str, Any] | None = None
) -> Row:
    """Compare a computed value with a row of `published`; `note` is put before the row's own.

    None is not computed, and stays "reported"; `otherwise` has what is computed under other choices.
    """
    compared = _compared(row)
    if compared == "implementation":
        text = f"compared with another implementation: {row['independent']:g}"
        note = "; ".join(part for part in (note, text) if part)
    difference, verdict = _verdict(row, computed)
    return Row(
        row["id"],
        row["quantity"],
        row["unit"],
        row["published"],
        computed,
        difference,
        row["tolerance"],
        row["tolerance_kind"],
        verdict,
        "; ".join(text for text in (note, row["note"]) if text),
        compared,
        row.get("part", ""),
        _part_difference(row, computed),
        _tolerance_share(row),
        row.get("tolerance_reason", ""),
        tuple(Otherwise(choice, value, *_verdict(row, value)) for choice, value in (otherwise or {}).items()),
        row.get("printed", ""),
    )


def compare_paper(
    paper: str, values: Mapping[str, tuple[Any, str]], beside: Mapping[str, Mapping[str, Any]] | None = None
) -> list[Row]:
    """Compare all rows of a paper: `values` has value and note by row, `beside` the values of other choices.

    A choice need not have every row, and is shown where its value is another one.
    """
    others = {
        key: {
            choice: other[key]
            for choice, other in (beside or {}).items()
            if key in other and other[key] != values[key][0]
        }
        for key in values
    }
    return [compare(row, *values[key], others[key]) for key, row in published(paper).items()]


def _compared(row: dict[str, Any]) -> str:
    if row["tolerance_kind"] == _BELOW_ONE:
        return "direction"
    if row["tolerance_kind"] == "claim":
        return "claim"
    return "implementation" if row["published"] is None and row["independent"] is not None else "number"


def _value(row: dict[str, Any]) -> Any:
    return row["independent"] if row["published"] is None else row["published"]


def _verdict(row: dict[str, Any], computed: Any) -> tuple[Any, str]:
    """Difference and verdict of a computed value."""
    value: Any = _value(row)
    tolerance, kind = row["tolerance"], row["tolerance_kind"]
    if computed is None:
        return None, REPORTED
    if kind == "claim":
        return None, PASS if bool(computed) == bool(value) else REPORTED if row.get("off") else FAIL
    if kind == _BELOW_ONE:
        return float(computed) - value, DIRECTION if computed < 1.0 else FAIL
    if isinstance(value, list):
        off = [float(mine) - theirs for mine, theirs in zip(computed, value, strict=True)]
        within = [abs(error) <= most for error, most in zip(off, tolerance, strict=True)]
        return off, PASS if all(within) else FAIL
    if not isinstance(value, (int, float)):
        return None, REPORTED
    difference = float(computed) - value
    if tolerance is None:
        return difference, REPORTED
    if kind == "relative":
        difference /= abs(value)
    return difference, PASS if abs(difference) <= tolerance else REPORTED if row.get("off") else FAIL


def _part_difference(row: dict[str, Any], computed: Any) -> float | None:
    if "part" not in row or computed is None:
        return None
    published_part = abs(row["whole"] - _value(row))
    return (abs(row["whole"] - computed) - published_part) / published_part


def _tolerance_share(row: dict[str, Any]) -> float | None:
    """The tolerance over the value; where a part of it matters, over its distance from the `whole`."""
    if row["tolerance"] is None:
        return None
    values, tolerances = (
        given if isinstance(given, list) else [given] for given in (_value(row), row["tolerance"])
    )
    if row["tolerance_kind"] == "relative":
        tolerances = [most * abs(value) for most, value in zip(tolerances, values, strict=True)]
    parts = [abs(row.get("whole", 0.0) - value) for value in values]
    shares = [most / part for most, part in zip(tolerances, parts, strict=True) if part > 0.0]
    return max(shares) if shares else None


def counts(rows: Iterable[Row]) -> dict[str, dict[str, int]]:
    """How many rows of each kind there are, by verdict, and how many of them hold under their choice only."""
    found = {kind: {"rows": 0, PASS: 0, DIRECTION: 0, FAIL: 0, REPORTED: 0, _CHOSEN: 0} for kind in KINDS}
    for row in rows:
        count = found[row.compared]
        count["rows"] += 1
        count[row.verdict] += 1
        count[_CHOSEN] += row.hangs_on_choice
    return {kind: count for kind, count in found.items() if count["rows"]}


def counted(rows: Iterable[Row]) -> str:
    """The same in words."""
    sentences = []
    for kind, count in counts(rows).items():
        words = {DIRECTION: "agree", _CHOSEN: f"of them {_CHOSEN}"}
        parts = [
            f"{number} {words.get(name, name)}" for name, number in count.items() if number and name != "rows"
        ]
        sentences.append(f"{count['rows']} {KINDS[kind][count['rows'] != 1]}: {', '.join(parts)}")
    return "; ".join(sentences)
