"""A mesh by the standards beside its simulation: quantities, points of the path, factors, reasons."""

from collections.abc import Mapping
from typing import Any

from tribodyn.gears.rating.rating_text import COLUMNS, rating_rows, unit_of
from tribodyn.geometry.drive import SIDES
from tribodyn.quantities.catalogue import SPREAD, quantities
from tribodyn.quantities.quantity import Quantity
from tribodyn.standards.contact_path import POINTS
from tribodyn.studies.assessment.pages.first_page import listed, numbers_table

#: What is said of a range.
_ENDS = ("p5", "p95")
#: What stands in ``iso`` and ``simulated`` beside each other, in the spread, and in the margins.
_COMPARED = quantities(
    *("theta_M", "mu_m", "h_Y", "lambda_GF", "c_prime", "c_gamma_alpha", "K_v", "K_Halpha", "H_v", "loss"),
    *("sigma_H", "sigma_F", "S_H", "S_F"),
)
_SCATTERED = quantities("K_Hbeta", "transmission_error_peak_to_peak")
_MARGINS = quantities("theta_B", "S_B", "S_intS", "S_lambda")
_HEADS = ("", "ISO 6336", "5 to 95 % of samples", "simulated", "5 to 95 % of samples", "")


def by_standard(summary: Mapping[str, Any]) -> str:
    """Both parts beside each other, with ranges where there are samples."""
    both = summary.get("iso", {}), summary["simulated"]
    margins = [summary["margins"].get(part, {}) for part in ("iso", "simulated")]
    rows = []
    for quantity in (*_COMPARED, *_MARGINS):
        values = [part.get(quantity.name) for part in (margins if quantity in _MARGINS else both)]
        if values == [None, None]:
            continue
        ranges = [_between(part.get("spread", {}).get(quantity.name), quantity) for part in both]
        cells = [_shown(value, quantity) for value in values]
        rows.append(
            (
                quantity.title,
                *(text for pair in zip(cells, ranges, strict=True) for text in pair),
                unit_of(quantity),
            )
        )
    scattered, rated = any(part.get("spread") for part in both), bool(both[0])
    columns = [0, *[1, 2] * rated, 3, 4, 5]
    columns = [column for column in columns if scattered or column not in (2, 4)]
    heading = "Standard and simulation, both" if rated else "The simulation"
    heading = f"{heading} with K_A {float(summary['load_factors']['K_A']):g}"
    rows = [[row[column] for column in columns] for row in rows]
    return numbers_table(heading, [_HEADS[column] for column in columns], rows, " ranges" * scattered)


def _between(percentiles: Mapping[str, float] | None, quantity: Quantity) -> str:
    """A range; nothing of what does not scatter."""
    if percentiles is None:
        return ""
    ends = [quantity.written(float(percentiles[end])) for end in _ENDS]
    return " to ".join(ends) if ends[0] != ends[1] else ""


def reasons(summary: Mapping[str, Any]) -> str:
    """Why both part, where they do."""
    reasons = summary.get("reasons", {})
    return listed("Where standard and simulation part by more than 5 %", reasons) if reasons else ""


def scatter(summary: Mapping[str, Any]) -> str:
    """Quantities over the samples that stand nowhere else, where there are any."""
    spread = summary.get("simulated", {}).get("spread", {})
    rows = [
        (quantity.title, *(_shown(spread[quantity.name][part], quantity) for part in SPREAD), quantity.unit)
        for quantity in _SCATTERED
        if quantity.name in spread
    ]
    if not rows:
        return ""
    samples = min(int(percentiles["samples"]) for percentiles in spread.values())
    heading = f"Scatter over {samples} samples of what is not known"
    return numbers_table(heading, ("", "median", "5 %", "95 %", ""), rows, " scatter")


def _shown(value: Any, quantity: Quantity) -> str:
    if isinstance(value, Mapping):
        if "worst" not in value:  # of pinion and gear
            return " / ".join(_shown(value[side], quantity) for side in SIDES)
        value = value["worst"]
    return "–" if value is None else quantity.written(float(value))


def points(summary: Mapping[str, Any]) -> str:
    """Film, contact temperature and exposure of the material at the points of the path of contact."""
    names = (*POINTS, "worst")
    rows = []
    for quantity in quantities("lambda_GF", "h_Y", "theta_B", "A_FF"):
        for by, part in (("ISO", "iso"), ("simulated", "simulated")):
            if values := summary.get(part, {}).get(quantity.name):
                label = f"{quantity._replace(unit=unit_of(quantity)).titled}, {by}"
                rows.append((label, *(_shown(values.get(name), quantity) for name in names)))
    return numbers_table("Along the path of contact", ("", *names), rows, " points")


def factors(summary: Mapping[str, Any]) -> str:
    """Every factor of the standards, folded."""
    rows = rating_rows(summary.get("iso", {}))
    if not rows:
        return ""
    inside = numbers_table("Factors of ISO 6336", COLUMNS, rows)
    page = f'<details class="factors"><summary>Every factor of ISO 6336</summary>{inside}</details>'
    if american := rating_rows(summary.get("agma", {})):
        page += numbers_table("Rating by AGMA 2101", COLUMNS, american)
    return page
