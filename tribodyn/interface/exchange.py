"""Files of other programs from Python."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from tribodyn.exchange.format import Imported
from tribodyn.interface.result import Run
from tribodyn.interface.scenario import public
from tribodyn.studies import handed_over
from tribodyn.studies.handed_over import HandedOver
from tribodyn.studies.measured_flanks import MeasuredImport


@public
def export(
    source: "str | Path | Run",
    to: str,
    output: str | Path,
    overrides: Mapping[str, Any] | None = None,
    *,
    force: bool = False,
) -> HandedOver:
    """Write a map of losses, a record or a scenario for another program.

    Parameters
    ----------
    source : Run, or path of a record, or a scenario's name or path
        What is exported; a format says what it takes.
    to : str
        Name of the format: ``tribodyn list formats`` prints them.
    output : path
        The file; it gets the ending of the format where it has none, and formats of several files put theirs
        beside it.
    overrides : mapping, optional
        What the format lets choose, ``{"oil_temperature": "60 degC"}``; with a scenario also its keys.
    force : bool
        Replace also files that tribodyn did not make.

    Returns
    -------
    HandedOver
        `files`; `deviations` of what was written from the map, found by reading it back; `remarks`.

    Raises
    ------
    InputError
        Of an unknown format, of what the format cannot hold, of a file that is in the way.
    """
    path = source.path if isinstance(source, Run) else source
    return handed_over.export(path, to, Path(output), overrides or {}, force=force)


@public
def import_scenario(path: str | Path, format: str | None = None) -> Imported:
    """Make a scenario of a file of another program.

    Parameters
    ----------
    path : path
        The file; nothing else is read.
    format : str, optional
        Name of its format; default: by the ending.

    Returns
    -------
    Imported
        `scenario`, the tables, which `run` takes; `toml`, the text of a scenario file; `remarks`: what was
        not used, and what is missing.

    Raises
    ------
    InputError
        Of a file that cannot be read, or holds what no scenario can.
    """
    return handed_over.read_scenario(Path(path), format)


@public
def import_measured(
    files: str | Path | Sequence[str | Path],
    into: str | Path | None = None,
    gear: str = "",
    *,
    datum: str = "",
    output: str | Path | None = None,
    format: str | None = None,
    force: bool = False,
) -> MeasuredImport:
    """Evaluate a measured gear by ISO 1328-1, and put it into a scenario.

    Parameters
    ----------
    files : path, or several of one gear
        Files of a gear measuring machine; nothing else is read.
    into : scenario's name or path, optional
        Where the gear belongs; without one nothing is written.
    gear : str
        Its name there: ``"pinion"``, ``"gear"``, or that of a train.
    datum : str
        End of its face that is the datum face: ``"start"``, at the most negative z (default), or ``"end"``.
    output : path, optional
        The scenario that is written, tables beside it; default: that of `into` with ``-measured``.
    format : str, optional
        Name of the files' format; default: by their endings.
    force : bool
        Replace also files that tribodyn did not make.

    Returns
    -------
    MeasuredImport
        `evaluation`: deviations of every flank, m, and their classes; `files` that were written; `remarks`.

    Raises
    ------
    InputError
        Of a file that cannot be read, or is of another gear; of a file that is in the way.
    """
    paths = [files] if isinstance(files, (str, Path)) else files
    to = None if output is None else Path(output)
    return handed_over.import_measured([Path(p) for p in paths], into, gear, datum, to, format, force=force)
