"""`tribodyn signals` and `tribodyn listen`: what sensors gave, as CSV and WAV files, and to be heard."""

from pathlib import Path
from typing import Annotated

import typer

from tribodyn.cli.options import JsonOption, ReplaceOption

SIGNALS_EXAMPLES = (
    "\b\nExamples:\n"
    "  tribodyn signals crc-23-47.h5 -o signals\n"
    "  tribodyn signals crc-23-47.h5 top --wav\n"
    "\b\nA CSV file has the columns time [s], reference_angle [rad] and the signal with its unit; a WAV\n"
    "file the signal at its own rate, where full scale is the value that is printed."
)
LISTEN_EXAMPLES = (
    "\b\nExamples:\n"
    "  tribodyn listen crc-23-47.h5\n"
    "  tribodyn listen crc-23-47.h5 top --shift 8 --seconds 5 -o slow.wav\n"
    "\b\nThe signal is brought to 0.9 of full scale, faded in and out, and repeated where it is short;\n"
    "it is printed by how much, and where frequencies were shifted."
)

RecordArgument = Annotated[Path, typer.Argument(metavar="RECORD", help="A record of tribodyn run.")]


def signals(
    record: RecordArgument,
    sensors: Annotated[
        list[str] | None, typer.Argument(metavar="[SENSOR...]", help="Names; default: all of the record.")
    ] = None,
    *,
    output: Annotated[Path, typer.Option("--output", "-o", help="Folder of the files.")] = Path(),
    wav: Annotated[bool, typer.Option("--wav", help="Also write WAV files, at the sensors' rates.")] = False,
    force: ReplaceOption = False,
    json: JsonOption = False,
) -> None:
    """Write what the sensors of a record gave as CSV files."""
    from tribodyn.cli.printing import print_files, print_json
    from tribodyn.post.signal_files import write_signals
    from tribodyn.record.reader import Record

    with Record(record) as opened:
        files = write_signals(opened, sensors or [], output, as_wav=wav, force=force)
    if json:
        print_json({"files": [str(path) for path in files]})
    else:
        print_files("signal", files)


def listen(
    record: RecordArgument,
    sensor: Annotated[
        str | None, typer.Argument(metavar="[SENSOR]", help="Its name; default: the first one.")
    ] = None,
    *,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="The WAV file; default: RECORD-SENSOR.wav.")
    ] = None,
    rate: Annotated[int, typer.Option(help="Samples per second: 44100 or 48000.")] = 44100,
    seconds: Annotated[float, typer.Option(help="Length at least, by repetition.")] = 3.0,
    shift: Annotated[float, typer.Option(help="Factor on all frequencies.")] = 1.0,
    force: ReplaceOption = False,
    json: JsonOption = False,
) -> None:
    """Write what a sensor gave as a WAV file at a hearable level."""
    from tribodyn.cli.printing import print_files, print_json
    from tribodyn.post.signal_files import write_sound
    from tribodyn.record.reader import Record

    how = {"rate": rate, "seconds": seconds, "shift": shift}
    with Record(record) as opened:
        path, sound, signal = write_sound(opened, sensor, output, force=force, **how)
    if json:
        about = {"gain": sound.gain, "shift": sound.shift, "repeats": sound.repeats, "rate": sound.rate}
        print_json({"sound": str(path), **about, "gain_units": f"1/({signal.units})"})
    else:
        print_files("sound", [path])
        typer.echo(sound.said(signal.units))
