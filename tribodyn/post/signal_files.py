"""What sensors gave, as files: CSV, WAV at their own rate, and WAV to be heard."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from tribodyn.errors import InputError, unknown_name
from tribodyn.numerics.files.output_files import WRITTEN, check_output, make_folder, write_output
from tribodyn.record.reader import Record
from tribodyn.record.sensors import SensorSignal, read_sensed
from tribodyn.signals.sound import LEVEL, SOUND_RATES, Hearable, hearable, wav


def signals_named(record: Record, names: Sequence[str]) -> list[SensorSignal]:
    """Signals of a record by their names, all where none is named; InputError where there is no such one."""
    by_name = {signal.name: signal for signal in read_sensed(record).signals if len(signal.values) > 1}
    if not by_name:
        rule, remedy = "holds no signals of sensors", "add a [[sensor]] to its scenario and run it again"
        raise record.refused(rule, remedy)
    for name in names:
        if name not in by_name:
            raise unknown_name("sensor", name, by_name, "sensor")
    return [by_name[name] for name in names or by_name]


def write_signals(
    record: Record, names: Sequence[str], folder: Path, *, as_wav: bool = False, force: bool = False
) -> list[Path]:
    """Write signals as CSV files, with `as_wav` also as WAV files at their rates; returns the files.

    A WAV file has the signal over the largest magnitude in it, at `LEVEL` of full scale, its mean left in.
    """
    signals = signals_named(record, names)
    endings = (".csv", ".wav") if as_wav else (".csv",)
    files = {folder / f"{record.label}-{signal.name}{end}": signal for signal in signals for end in endings}
    make_folder(folder)
    for path in files:
        check_output(path, force)
    return [
        write_output(path, as_csv(signal) if path.suffix == ".csv" else as_wave(signal), force=force)
        for path, signal in files.items()
    ]


def as_csv(signal: SensorSignal) -> str:
    """A signal as a CSV file: time, rotation of the reference, values, each with its unit."""
    mark = WRITTEN[".csv"].decode()
    about = f"{mark}: {signal.name}, {signal.about}, {signal.rate:.12g} Hz"
    name = signal.name.replace(",", " ")
    lines = [about, f"time [s],reference_angle [rad],{name} [{signal.units}]"]
    rows = zip(signal.time.tolist(), signal.angle.tolist(), signal.values.tolist(), strict=True)
    lines += [f"{time:.12g},{angle:.12g},{value:.9g}" for time, angle, value in rows]
    return "\n".join(lines) + "\n"


def as_wave(signal: SensorSignal) -> bytes:
    """A signal as a WAV file at its own rate."""
    top = float(np.max(np.abs(signal.values), initial=0.0))
    return wav(signal.values * (LEVEL / top if top else 0.0), round(signal.rate))


def write_sound(
    record: Record,
    name: str | None,
    path: Path | None,
    *,
    rate: int = SOUND_RATES[0],
    seconds: float = 3.0,
    shift: float = 1.0,
    force: bool = False,
) -> tuple[Path, Hearable, SensorSignal]:
    """Write a signal, the first by default, so that it can be heard; what was done to it."""
    if rate not in SOUND_RATES:
        raise InputError("rate", rate, "no rate of sound", f"{SOUND_RATES[0]} or {SOUND_RATES[1]}")
    if not 0.0 < seconds <= 600.0:
        raise InputError("seconds", seconds, "must be above 0 and at most 600", "3 is usual")
    signal = signals_named(record, [name] if name else [])[0]
    target = path or Path(f"{record.label}-{signal.name}.wav")
    if target.suffix != ".wav":
        raise InputError(
            "output", str(target), "no name of a WAV file", f"write {target.with_suffix('.wav')}"
        )
    check_output(target, force)
    sound = hearable(signal.values, signal.rate, rate, seconds, shift)
    return write_output(target, wav(sound.samples, sound.rate), force=force), sound, signal
