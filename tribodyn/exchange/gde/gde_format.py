"""GDE as one of the formats of other programs."""

from collections.abc import Mapping
from typing import Any

from tribodyn.exchange.format import SCENARIO, TEXT, ExchangeFormat, Exported, FormatChoice, Written
from tribodyn.exchange.gde.gde_reading import read
from tribodyn.exchange.gde.gde_writing import text_of
from tribodyn.exchange.heading import heading
from tribodyn.exchange.measured_gear import FLANKS


def write(exported: Exported, name: str, choices: Mapping[str, Any]) -> Written:
    """A gear of a scenario as it would be measured."""
    if exported.measured is None:
        raise exported.refused("has no gears whose teeth have deviations", "name a gear pair or a train")
    gear = exported.measured(choices.get("gear", ""), choices.get("datum", ""))
    each = [f"{len({t.tooth for t in gear.traces if t.flank == flank})} {flank}" for flank in FLANKS]
    remarks = f"{gear.name}: traces of teeth: {', '.join(each)}"
    return Written({".gde": text_of(gear, heading(exported, ""))}, remarks=(remarks, *gear.remarks))


FORMAT = ExchangeFormat(
    "gde",
    "measured gears, GDE (VDI/VDE 2610): profile, helix, pitch, runout",
    (".gde", ".xml"),
    (SCENARIO,),
    write,
    choices={
        "gear": FormatChoice(TEXT, "the gear: pinion, gear, or its name in a train"),
        "datum": FormatChoice(TEXT, "the datum face: start (at the most negative z) or end"),
    },
    measure=read,
)
