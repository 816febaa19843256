"""The table of outcomes."""

import re
from collections import Counter
from collections.abc import Sequence

import numpy as np

from tools.soak.cases import SORTS
from tools.soak.outcome import COMPLETE, FAULTY, REFUSED, STOPPED, Outcome

STATUSES = (COMPLETE, REFUSED, STOPPED, FAULTY)


def table(outcomes: Sequence[Outcome]) -> str:
    """Lay out outcomes by sort of case and family, the reasons of what is not complete, and the energy."""
    rows = ["| | cases | " + " | ".join(STATUSES) + " |", "|---|---|" + "---|" * len(STATUSES)]
    for sort in SORTS:
        of_sort = [one for one in outcomes if one.sort == sort]
        rows.append(_row(sort, of_sort))
    rows.append(_row("all", outcomes))
    for family in sorted({one.family for one in outcomes} - {""}):
        rows.append(_row(f"of gears: {family}", [one for one in outcomes if one.family == family]))
    refused = sum(one.drives_refused for one in outcomes)
    residuals = np.array(
        [one.residual for one in outcomes if one.residual == one.residual and one.sort == "gear-pair"]
    )
    lines = [*rows, "", "| refused or stopped because | cases |", "|---|---|"]
    reasons = Counter(_plain(one.reason) for one in outcomes if one.status in (REFUSED, STOPPED))
    lines += [f"| {reason} | {count} |" for reason, count in reasons.most_common()]
    lines += [
        "",
        f"Drives drawn before those that can be made: {refused}, each refusal put to the test.",
    ]
    if residuals.size:
        parts = ", ".join(f"{np.quantile(residuals, q):.2g}" for q in (0.5, 0.9, 0.99, 1.0))
        lines.append(f"Energy residual of complete runs over rtol; median, 90 %, 99 % and maximum: {parts}.")
    return "\n".join(lines)


def _row(name: str, outcomes: Sequence[Outcome]) -> str:
    count = Counter(one.status for one in outcomes)
    return f"| {name} | {len(outcomes)} | " + " | ".join(str(count[status]) for status in STATUSES) + " |"


def _plain(reason: str) -> str:
    """A reason without files, values and numbers, cut where it goes into detail."""
    text = re.sub(r"^\S*/[^:]*: ", "", reason.splitlines()[0] if reason else "")
    text = re.sub(r"^stopped (at t = \S+ s|after \S+ mesh cycles): ", "", text)
    text = re.sub(r" = .*?: ", ": ", text, count=1)
    text = re.sub(r"-?\d[\d.]*(e[+-]?\d+)?", "#", text)
    return text.partition(";")[0].replace("|", "/")[:140]
