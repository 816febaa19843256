"""One row of a validation: a published number or claim compared with ours."""

import json
from importlib.resources import files
from typing import Any, NamedTuple

PASS, FAIL, REPORTED = "pass", "fail", "reported"


class Row(NamedTuple):
    """A published value, ours, and how they compare.

    Attributes
    ----------
    id, quantity, unit : str
    published, computed : float, bool, None, or list of float
        Lists where a row of a table is compared column by column.
    difference : float, list of float or None
        Computed less published: relative to the published value where the tolerance is.
    tolerance : float, list of float or None
    tolerance_kind : str
    verdict : {"pass", "fail", "reported"}
        "reported": the published value is not reproducible, or a claim does not hold in our physics.
    note : str
    """

    id: str
    quantity: str
    unit: str
    published: Any
    computed: Any
    difference: float | list[float] | None
    tolerance: float | list[float] | None
    tolerance_kind: str
    verdict: str
    note: str

    def written(self, name: str) -> str:
        """Write a field as a table for people shows it."""
        value = getattr(self, name)
        if value is None:
            return ""
        if isinstance(value, list):
            return " ".join(
                f"{one:.2g}" if name in ("difference", "tolerance") else f"{one:.5g}" for one in value
            )
        if isinstance(value, bool):
            return str(value).lower()
        if name in ("difference", "tolerance") and self.tolerance_kind == "relative":
            return f"{100 * value:.3g} %"
        return f"{value:.5g}" if isinstance(value, float) else str(value)


#: Fields of a row that a table for people shows.
SHOWN = ("quantity", "unit", "published", "computed", "difference", "tolerance", "verdict", "note")


def published(paper: str) -> dict[str, dict[str, Any]]:
    """The published rows of a paper by id, in order.

    What stands in `note` is shown to users, what stands in `for_maintainers` is not.
    """
    text = files("tribodyn.validation").joinpath("published.json").read_text(encoding="utf-8")
    return {row["id"]: row for row in json.loads(text) if row["paper"] == paper}


def compare(row: dict[str, Any], computed: Any, note: str = "") -> Row:
    """Judge a computed value against a published row; `note` is put before the row's own.

    Where the paper has a figure only, the value of another implementation of its equations takes the
    number's place, and the row's `tolerance_kind` and note say so. What cannot be computed yet is None and
    stays "reported".
    """
    figure_only = row["published"] is None and row["independent"] is not None
    value: Any = row["independent"] if figure_only else row["published"]
    tolerance, kind = row["tolerance"], row["tolerance_kind"]
    if figure_only:
        note = "; ".join(text for text in (note, f"compared with another implementation: {value:g}") if text)
    difference: Any = None
    if computed is None:
        verdict = REPORTED
    elif kind == "claim":
        verdict = PASS if bool(computed) == bool(value) else REPORTED
    elif kind == "direction only (below 1)":
        difference = float(computed) - value
        verdict = PASS if computed < 1.0 else FAIL
    elif tolerance is None:
        verdict = REPORTED
        if isinstance(value, (int, float)):
            difference = float(computed) - value
    elif isinstance(value, list):
        difference = [float(mine) - theirs for mine, theirs in zip(computed, value, strict=True)]
        within = [abs(one) <= most for one, most in zip(difference, tolerance, strict=True)]
        verdict = PASS if all(within) else FAIL
    else:
        difference = float(computed) - value
        if kind == "relative":
            difference /= abs(value)
        verdict = PASS if abs(difference) <= tolerance else FAIL
    notes = "; ".join(text for text in (note, row["note"]) if text)
    return Row(
        row["id"],
        row["quantity"],
        row["unit"],
        row["published"],
        computed,
        difference,
        tolerance,
        kind,
        verdict,
        notes,
    )
