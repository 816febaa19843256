"""One row of a validation: a published number or claim compared with ours."""

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from tribodyn.validation.published import decimals, published

PASS, FAIL, REPORTED = "pass", "fail", "reported"
#: Verdict of a row that compares the direction of a change and not its size.
DIRECTION = "direction"
#: How a row stands, in the order in which rows are counted.
REPRODUCED, CHOSEN, OTHER, ONE_WAY, BESIDE = (
    "reproduced",
    "reproduced, not under every choice",
    "under another choice",
    "direction only",
    "beside another implementation",
)
STANDINGS = (REPRODUCED, CHOSEN, OTHER, ONE_WAY, REPORTED, FAIL, BESIDE)


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
    #: {"pass", "fail", "direction", "reported"} "direction": the change is the published one in its direction
    #: and not in its size; "reported": known not to be reproduced, or a claim that is known not to hold here
    verdict: str
    note: str
    #: {"number", "claim", "implementation"} What the row compares; "implementation": the paper has a figure
    #: only, and the value of another implementation of its equations takes the number's place.
    compared: str = "number"
    #: what of the value matters, where that is not the whole: the "loss" of an efficiency, the "rise" of a
    #: ratio above 1, its "fall" below
    part: str = ""
    part_difference: float | None = None  # computed less published, of this part; the largest of several
    #: the tolerance as a share of the value or of its part; the largest of several columns
    tolerance_share: float | None = None
    tolerance_reason: str = ""  # why this share is larger than `WIDE`
    otherwise: tuple[Otherwise, ...] = ()  # the same row under other choices, where these differ
    printed: str = ""  # the published number as it is printed, where its last digit is the tolerance
    where: str = ""  # section, table or figure of the paper

    @property
    def hangs_on_choice(self) -> bool:
        """Whether the row holds under its own choice and not under each of the others."""
        return self.verdict in (PASS, DIRECTION) and any(
            other.verdict not in (PASS, DIRECTION) for other in self.otherwise
        )

    @property
    def standing(self) -> str:
        """How the row counts, one of `STANDINGS`."""
        if self.verdict == PASS and self.compared == "implementation":
            return BESIDE
        if self.verdict == PASS:
            return CHOSEN if self.hangs_on_choice else REPRODUCED
        if self.verdict == REPORTED and any(other.verdict == PASS for other in self.otherwise):
            return OTHER
        return ONE_WAY if self.verdict == DIRECTION else self.verdict

    def written(self, name: str) -> str:
        """Write a field as a table for people shows it."""
        value = getattr(self, name)
        if name == "quantity" and self.where:
            return f"{value} ({self.where})"
        if name == "tolerance" and self.tolerance_reason and self.tolerance_share:
            shown = self._amount(name, value)
            if self.part or self.tolerance_kind != "relative":
                shown = f"{shown}, {of_part(self.tolerance_share, self.part or 'value')}"
            return f"{shown}: {self.tolerance_reason}"
        if name == "difference" and self.part_difference is not None:
            return f"{self._amount(name, value)}, {of_part(self.part_difference, self.part, '+')}"
        if name == "verdict" and self.hangs_on_choice:
            return f"{value}, not under every choice"
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
        fields = self._asdict() | {"hangs_on_choice": self.hangs_on_choice, "standing": self.standing}
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


def compare(
    row: dict[str, Any], computed: Any, note: str = "", otherwise: Mapping[str, Any] | None = None
) -> Row:
    """Compare a computed value with a row of `published`; `note` is put before the row's own.

    None is not computed, and stays "reported"; `otherwise` has what is computed under other choices.
    """
    implementation = row["published"] is None
    if implementation:
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
        "claim" if row["tolerance_kind"] == "claim" else "implementation" if implementation else "number",
        row.get("part", ""),
        _part_difference(row, computed),
        _tolerance_share(row),
        row.get("tolerance_reason", ""),
        tuple(Otherwise(choice, value, *_verdict(row, value)) for choice, value in (otherwise or {}).items()),
        row.get("printed", ""),
        row.get("where", ""),
    )


def compare_paper(
    paper: str, values: Mapping[str, tuple[Any, str]], choices: Mapping[str, Mapping[str, Any]] | None = None
) -> list[Row]:
    """Compare all rows of a paper: `values` has value and note by row, `choices` the values of other choices.

    A choice need not have every row, and is shown where its value is another one.
    """
    others = {
        key: {
            choice: other[key]
            for choice, other in (choices or {}).items()
            if key in other and other[key] != values[key][0]
        }
        for key in values
    }
    return [compare(row, *values[key], others[key]) for key, row in published(paper).items()]


def _value(row: dict[str, Any]) -> Any:
    return row["independent"] if row["published"] is None else row["published"]


def _verdict(row: dict[str, Any], computed: Any) -> tuple[Any, str]:
    """Difference and verdict of a computed value."""
    value: Any = _value(row)
    tolerance, kind, off = row["tolerance"], row["tolerance_kind"], row.get("off")
    unmet = REPORTED if off else FAIL
    if computed is None:
        return None, unmet
    if kind == "claim":
        return None, PASS if bool(computed) == bool(value) else unmet
    errors = [float(mine) - theirs for mine, theirs in zip(_each(computed), _each(value), strict=True)]
    if kind == "relative":
        errors = [error / abs(theirs) for error, theirs in zip(errors, _each(value), strict=True)]
    difference = errors if isinstance(value, list) else errors[0]
    if all(abs(error) <= most for error, most in zip(errors, _each(tolerance), strict=True)):
        return difference, PASS
    if off == DIRECTION:
        whole = row["whole"]
        pairs = zip(_each(computed), _each(value), strict=True)
        same = all((mine - whole) * (theirs - whole) > 0.0 for mine, theirs in pairs)
        return difference, DIRECTION if same else FAIL
    return difference, unmet


def _each(value: Any) -> list[Any]:
    return value if isinstance(value, list) else [value]


def _part_difference(row: dict[str, Any], computed: Any) -> float | None:
    if "part" not in row or computed is None:
        return None
    whole = row["whole"]
    shares = [
        abs(whole - mine) / abs(whole - theirs) - 1.0
        for mine, theirs in zip(_each(computed), _each(_value(row)), strict=True)
    ]
    return max(shares, key=abs)


def _tolerance_share(row: dict[str, Any]) -> float | None:
    """The tolerance over the value; where a part of it matters, over its distance from the `whole`."""
    if row["tolerance"] is None:
        return None
    values, tolerances = _each(_value(row)), _each(row["tolerance"])
    if row["tolerance_kind"] == "relative":
        tolerances = [most * abs(value) for most, value in zip(tolerances, values, strict=True)]
    parts = [abs(row.get("whole", 0.0) - value) for value in values]
    shares = [most / part for most, part in zip(tolerances, parts, strict=True) if part > 0.0]
    return max(shares) if shares else None


def counts(rows: Iterable[Row]) -> dict[str, int]:
    """How many rows there are, and how many of each standing."""
    standings = [row.standing for row in rows]
    return {"rows": len(standings)} | {standing: standings.count(standing) for standing in STANDINGS}


def counted(rows: Iterable[Row]) -> str:
    """The same in words."""
    total, *numbers = counts(rows).items()
    parts = "; ".join(f"{number} {standing}" for standing, number in numbers if number)
    return f"{total[1]} row{'s' * (total[1] != 1)}: {parts}"
