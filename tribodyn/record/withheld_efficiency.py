"""Efficiencies are shares of a power: one outside 0 … 1 is wrong, and is withheld with the reason.

One rule for all studies. The writers apply it to what goes into a file, the readers to what older versions
wrote, `protocol.study.Study` to the quantities that it hands out; what is shown comes from one of these.
"""

import math
from collections.abc import Iterable, Mapping
from numbers import Real
from typing import Any

import numpy as np

from tribodyn.record import trust

#: Quantities and datasets of this name, or whose names begin with it and an underscore, are efficiencies.
EFFICIENCY = "efficiency"
#: Added to a quantity's name: why it is withheld.
WITHHELD = "_withheld"
#: What marks a remark on a case of a sweep as a warning, see `warned`.
WARNING = "warning: "
#: An efficiency that is 1 but for rounding is 1: works are sums of some thousand terms.
ROUNDING = 1e-12


def is_efficiency(name: str) -> bool:
    """Whether a quantity or a dataset of that name is an efficiency."""
    named = name == EFFICIENCY or name.startswith(f"{EFFICIENCY}_")
    return named and not name.endswith(WITHHELD)


def reason_to_withhold(value: float) -> str:
    """Why an efficiency cannot be; empty: it can."""
    if not math.isfinite(value):
        return "no power passes that the loss could be related to"
    if value > 1.0 + ROUNDING:
        return "above 1: more power would come out than is put in"
    if value < -ROUNDING:
        return "below 0: more power would be lost than is put in"
    return ""


def withheld(summary: Mapping[str, Any]) -> dict[str, Any]:
    """Quantities of a run; an efficiency that cannot be is None, and its name with `WITHHELD` says why."""
    result: dict[str, Any] = {}
    for name, value in summary.items():
        result[name] = value
        if isinstance(value, Mapping):
            result[name] = withheld(value)
        elif is_efficiency(name) and isinstance(value, Real):
            reason = reason_to_withhold(float(value))
            if reason:
                result |= {name: None, name + WITHHELD: reason}
        elif name.endswith(WITHHELD):  # from a file, which has no attribute for a quantity without a value
            result.setdefault(name.removesuffix(WITHHELD), None)
    return result


def reasons(summary: Mapping[str, Any]) -> dict[str, str]:
    """Name of every quantity that is withheld -> why; names in nested summaries joined by `/`."""
    by_name = {}
    for name, value in summary.items():
        if isinstance(value, Mapping):
            by_name |= {f"{name}/{inner}": why for inner, why in reasons(value).items()}
        elif name.endswith(WITHHELD):
            by_name[name.removesuffix(WITHHELD)] = str(value)
    return by_name


def samples_withheld(name: str, values: Any) -> Any:
    """Values of a dataset over the samples or the cases; NaN for efficiencies that cannot be."""
    if not is_efficiency(name):
        return values
    values = np.asarray(values, dtype=float)
    return np.where((values >= -ROUNDING) & (values <= 1.0 + ROUNDING), values, np.nan)


def cases_withheld(block: Mapping[str, Any]) -> dict[str, Any]:
    """Rows of cases of a sweep without efficiencies that cannot be; the case's message says why."""
    rows = dict(block)
    for name in filter(is_efficiency, block):
        rows[name] = samples_withheld(name, block[name])
        for i in np.flatnonzero(np.isnan(rows[name]) & np.isfinite(block[name])):
            rows["message"] = np.array(rows["message"], dtype=object)
            why = f"{name} is withheld, {reason_to_withhold(float(block[name][i]))}"
            rows["message"][i] = remarked(rows["message"][i], warned(why))
    return rows


def warnings(summary: Mapping[str, Any]) -> list[str]:
    """What to warn of: what lies outside the model, what the study says, and quantities that are withheld."""
    return trust.warnings(summary) + _own_remarks(summary)


def remarks(summary: Mapping[str, Any]) -> list[str]:
    """The same for one of many cases: without values, so that equal ones can be counted."""
    return [remark for remark in (trust.brief(summary), *_own_remarks(summary)) if remark]


def _own_remarks(summary: Mapping[str, Any]) -> list[str]:
    remarks = [str(summary["warning"])] if summary.get("warning") else []
    by_reason: dict[str, list[str]] = {}
    for name, why in reasons(summary).items():
        by_reason.setdefault(why, []).append(name)
    return remarks + [f"withheld: {', '.join(names)}, {why}" for why, names in by_reason.items()]


def warned(remark: str) -> str:
    """A remark on a case of a sweep that is to be shown with the sweep."""
    return WARNING + remark


def remarked(*remarks: str) -> str:
    """Several remarks on a case as one text; empty ones are left out."""
    return "; ".join(str(remark) for remark in remarks if remark)


def warnings_in(messages: Iterable[str]) -> dict[str, int]:
    """Warnings among the messages of cases, and of how many cases."""
    count: dict[str, int] = {}
    for message in messages:
        for part in str(message).split("; "):
            if part.startswith(WARNING):
                text = part.removeprefix(WARNING)
                count[text] = count.get(text, 0) + 1
    for text in [text for text in count if text.endswith("…")]:  # cut to the room of a record
        longer = (one for one in count if one != text and one.startswith(text.removesuffix("…")))
        if whole := max(longer, key=len, default=""):
            count[whole] += count.pop(text)
    return count
