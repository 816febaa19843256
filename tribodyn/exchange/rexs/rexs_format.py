"""REXS as one of the formats of other programs."""

from itertools import groupby
from pathlib import Path

from tribodyn.exchange.format import RECORD, SCENARIO, ExchangeFormat, Imported
from tribodyn.exchange.rexs.file.sheet import NotUsed
from tribodyn.exchange.rexs.reading.scenario import scenario_of
from tribodyn.exchange.rexs.writing.export import write


def read(path: Path) -> Imported:
    """Make a scenario of a REXS file."""
    found = scenario_of(path)
    remarks = [f"REXS {found.version} of {found.application or 'an unknown program'}"]
    remarks += [f"changed: {each}" for each in found.changed]
    remarks += [f"not in the file, assumed: {each}" for each in found.assumed]
    for head, each in groupby(found.not_used, lambda one: f"{one.component} ({one.type} {one.number})"):
        remarks.append(f"not used: {head}: {', '.join(map(_line, each))}")
    details = {
        "version": found.version,
        "application": found.application,
        "changed": list(found.changed),
        "assumed": list(found.assumed),
        "not_used": [each._asdict() for each in found.not_used],
    }
    return Imported(found.toml, tuple(remarks), details)


def _line(each: NotUsed) -> str:
    value = " ".join(filter(None, (each.value, each.unit if each.unit != "none" else "")))
    return f"{each.attribute} = {value}{f' ({each.why})' if each.why else ''}"


FORMAT = ExchangeFormat(
    "rexs",
    "gearboxes of calculation programs, REXS 1.0 to 2.0.0: gears, shafts, bearings, oil, loads",
    (".rexs", ".rexsj", ".rexsz"),
    (SCENARIO, RECORD),
    write,
    read,
)
