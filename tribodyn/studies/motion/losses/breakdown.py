"""Losses of a gearbox by term and element, at its duty or in a run: data for programs, and their table."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from tribodyn.cases.loss_part import TERMS, LossSource
from tribodyn.cases.results import TextTable
from tribodyn.studies.motion.drivetrain.mesh_groups import together

#: Where a summary, and what `check` says for programs, have it.
LOSSES = "losses"


class ElementLoss(NamedTuple):
    """One loss of one element: its power, W, and in words which limits of its formula are exceeded."""

    source: LossSource
    power: float
    exceeded: Sequence[str] = ()


def balance(losses: Sequence[ElementLoss], loads: Sequence[float]) -> dict[str, float]:
    """Powers in and out, W, by what every load takes (negative: gives); the source bears the rest."""
    lost = sum(loss.power for loss in losses)
    powers = [*loads, -(sum(loads) + lost)]
    out = sum(power for power in powers if power > 0.0)
    return {"power_in": out + lost, "power_out": out, "power_lost": lost}


def breakdown(losses: Sequence[ElementLoss], powers: Mapping[str, float]) -> dict[str, Any]:
    """Losses by the names of `TERMS`, by element, numbered from 1, and what goes in and out, W."""
    terms = dict.fromkeys(TERMS, 0.0)
    for loss in losses:
        terms[loss.source.term] += loss.power
    elements = {
        str(number): {
            **loss.source._asdict(),
            "power": loss.power,
            **({"outside": "; ".join(loss.exceeded)} if loss.exceeded else {}),
        }
        for number, loss in enumerate(losses, start=1)
    }
    through = powers["power_in"] > 0.0 and powers["power_out"] > 0.0
    share = {"efficiency": 1.0 - powers["power_lost"] / powers["power_in"]} if through else {}
    return {LOSSES: {"terms": terms, **powers, **share, "elements": elements}}


def listed(data: Mapping[str, Any]) -> dict[str, Any]:
    """A breakdown with its elements in a list."""
    losses = data[LOSSES]
    return {LOSSES: {**losses, "elements": list(losses["elements"].values())}}


def loss_table(losses: Mapping[str, Any]) -> TextTable:
    """The table of a breakdown: every term that is lost, and what of it is lost where."""
    power_in, rows = losses["power_in"], list[tuple[str, ...]]()
    elements = losses["elements"]
    if isinstance(elements, Mapping):  # of a record by number, in any order
        elements = [elements[number] for number in sorted(elements, key=int)]
    for term, about in TERMS.items():
        of_term = [element for element in elements if element["term"] == term]
        if not of_term:
            continue
        rows.append((f"{term}: {about}", "", *_power(losses["terms"][term], power_in)))
        rows += [(f"  {name}", method, *_power(power, power_in)) for name, method, power in _merged(of_term)]
    for what, name in (("all losses", "power_lost"), ("power in", "power_in"), ("power out", "power_out")):
        rows.append((what, "", *_power(losses[name], power_in)))
    return TextTable("Losses by term and element", ("", "method", "W", "% of power in"), rows)


def _power(power: float, power_in: float) -> tuple[str, str]:
    return f"{power:.4g}", f"{100.0 * power / power_in:.4g}" if power_in > 0.0 else "–"


def _merged(elements: Iterable[Mapping[str, Any]]) -> list[tuple[str, str, float]]:
    """Element, method and power in order; meshes and gears of planets, which lose alike, in one line."""
    groups: dict[tuple[str, str, str], list[Mapping[str, Any]]] = {}
    for each in elements:
        name, method, power = str(each["element"]), str(each["method"]), float(each["power"])
        head, _, number = name.rpartition("-")
        alike = each["sort"] in ("mesh", "gear") and number.isdigit() and head
        groups.setdefault((head if alike else name, method, f"{power:.6g}"), []).append(each)
    return [
        (
            together(str(each["element"]) for each in group),
            method,
            sum(float(each["power"]) for each in group),
        )
        for (_, method, _), group in groups.items()
    ]
