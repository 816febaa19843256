"""Sensors on a page: their sound, to be played, and the lines of their spectra by name."""

import base64
from collections.abc import Sequence
from html import escape
from itertools import islice
from typing import NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.record.reader import Record
from tribodyn.record.sensors import Sensed, SensorSignal, read_sensed
from tribodyn.signals.lines import named_orders, names_at
from tribodyn.signals.resampling import PASSED
from tribodyn.signals.sound import hearable, wav
from tribodyn.signals.spectra import order_spectrum

#: Sensors that can be heard on a page, and lines of each in the table, at most.
_HEARD, _LINES = 4, 6
#: Samples per second of the sound on a page: half those of a disc, which halves the page.
_SOUND_RATE = 22050
#: Orders that have names, at most.
_NAMED = 20_000
_FEWEST = 32
#: A line stands out by so many times the median beside it.
_ABOVE, _BESIDE = 4.0, 25


class SensedSection(NamedTuple):
    """What a page has of the sensors of a record."""

    sounds: str = ""  # HTML
    #: title, columns, rows
    lines: tuple[str, Sequence[str], Sequence[Sequence[str]]] | None = None


def sensed_section(record: Record) -> SensedSection:
    """Sound and lines of a record's sensors; nothing where it has none."""
    sensed = read_sensed(record)
    signals = [signal for signal in sensed.signals if len(signal.values) >= _FEWEST]
    if not signals:
        return SensedSection()
    rows = [row for signal in signals for row in _lines(signal, sensed)]
    head = ("sensor", "order", "Hz", "amplitude", "unit", "line")
    return SensedSection(
        "".join(_sound(signal) for signal in signals[:_HEARD]),
        (f"Largest lines, orders per turn of {sensed.reference}", head, rows) if rows else None,
    )


def _sound(signal: SensorSignal) -> str:
    try:
        sound = hearable(signal.values, signal.rate, _SOUND_RATE)
    except InputError:  # too slow or too fast to be heard
        return ""
    data = base64.b64encode(wav(sound.samples, sound.rate)).decode("ascii")
    caption = f"{signal.about}; {sound.said(signal.units)}"
    return (
        f'<p class="sound"><b>{escape(signal.name)}</b> {escape(caption)}<br>'
        f'<audio controls preload="metadata" src="data:audio/wav;base64,{data}"></audio></p>'
    )


def _lines(signal: SensorSignal, sensed: Sensed) -> list[list[str]]:
    """The largest lines of a signal's order spectrum that stand out, with what they are called."""
    spectrum = order_spectrum(signal.values, signal.turns)
    turning = float(np.ptp(signal.turns) / np.ptp(signal.time))
    limit = PASSED * signal.rate / turning
    a = spectrum.amplitudes
    inner = np.arange(1, min(len(a) - 1, int(limit / spectrum.step)))
    peaks = inner[(a[inner] >= a[inner - 1]) & (a[inner] > a[inner + 1])]
    named = list(islice(named_orders(sensed.lines, limit), _NAMED))
    rows = []
    for place in peaks[np.argsort(-a[peaks])][: 4 * _LINES]:
        if a[place] < _ABOVE * float(np.median(a[max(1, place - _BESIDE) : place + _BESIDE + 1])):
            continue
        order = float(spectrum.frequencies[place])
        names = names_at(order, named, 1.01 * spectrum.step)
        rows.append(
            [
                signal.name,
                f"{order:.5g}",
                f"{order * turning:.5g}",
                f"{spectrum.at(order):.4g}",
                signal.units,
                names[0].label if names else "",
            ]
        )
        if len(rows) == _LINES:
            break
    return rows
