"""A measured gear as a GDE file."""

import math
from collections.abc import Iterable, Iterator
from xml.sax.saxutils import escape, quoteattr

from tribodyn.exchange.gde import words
from tribodyn.exchange.heading import without_double_hyphens
from tribodyn.exchange.measured_gear import HELIX, ROLL_LENGTH, FlankTrace, MeasuredGear

VERSION = "3.4"


def text_of(gear: MeasuredGear, head: str) -> str:
    """The file; `head` stands in it as a comment. Profiles are over length of roll."""
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        f"<!-- {without_double_hyphens(head.strip())} -->",
        f'<{words.ROOTS[0]} version="{VERSION}">',
        f"  <{words.GEARS[0]} name={quoteattr(gear.name)}>",
        f"    <{words.GEOMETRY[0]}>",
        *_nominal(gear),
        f"    </{words.GEOMETRY[0]}>",
        f"    <{words.INSPECTION[0]}>",
        *(f"      {line}" for line in _measured(gear)),
        f"    </{words.INSPECTION[0]}>",
        f"  </{words.GEARS[0]}>",
        f"</{words.ROOTS[0]}>",
    ]
    return "\n".join(lines) + "\n"


def _nominal(gear: MeasuredGear) -> Iterator[str]:
    for field, (names, kind) in words.NOMINAL.items():
        value = getattr(gear.nominal, field)
        if value is None:
            continue
        if kind == "length":
            yield f"      {_element(names[0], [1e3 * value], 'mm')}"
        elif kind == "angle":
            yield f"      {_element(names[0], [math.degrees(value)], 'deg')}"
        else:
            text = ("internal" if value else "external") if kind == "type" else str(value)
            yield f"      <{names[0]}>{escape(text)}</{names[0]}>"


def _measured(gear: MeasuredGear) -> Iterator[str]:
    for trace in gear.traces:
        yield from _trace(trace)
    for flank, index in gear.pitch.items():
        yield f"<{words.PITCHES[0]}>"
        yield f"  <{words.FLANK[0]}>{flank}</{words.FLANK[0]}>"
        if gear.diameter is not None:
            yield f"  {_element(words.DIAMETERS[0], [1e3 * gear.diameter], 'mm')}"
        yield f"  {_element(words.CUMULATIVE[0], 1e6 * index, 'um')}"
        yield f"</{words.PITCHES[0]}>"
    if gear.radial is not None:
        yield f"<{words.RUNOUTS[0]}>"
        yield f"  {_element(words.RADIAL[0], 1e6 * gear.radial, 'um')}"
        yield f"</{words.RUNOUTS[0]}>"


def _trace(trace: FlankTrace) -> Iterator[str]:
    assert trace.over == ROLL_LENGTH, trace.over
    helix = trace.kind == HELIX
    name = (words.HELICES if helix else words.PROFILES)[0]
    place, at = (words.FACES, words.DIAMETERS) if helix else (words.ROLL_LENGTHS, words.FACES)
    yield f"<{name}>"
    yield f"  <{words.TOOTH[0]}>{trace.tooth}</{words.TOOTH[0]}>"
    yield f"  <{words.FLANK[0]}>{trace.flank}</{words.FLANK[0]}>"
    if trace.at is not None:
        yield f"  {_element(at[0], [1e3 * trace.at], 'mm')}"
    for end, value in zip((words.BEGIN, words.END), trace.evaluated or (), strict=False):
        yield f"  {_element(end[0], [1e3 * value], 'mm')}"
    yield f"  {_element(place[0], 1e3 * trace.place, 'mm')}"
    yield f"  {_element(words.DEVIATIONS[0], 1e6 * trace.deviation, 'um')}"
    yield f"</{name}>"


def _element(name: str, values: Iterable[float], unit: str) -> str:
    numbers = " ".join(f"{value:.12g}" for value in values)
    return f'<{name} unit="{unit}">{numbers}</{name}>'
