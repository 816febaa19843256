"""Files of other programs: a scenario or a record as one of their files, and one of theirs as a scenario."""

import math
import tomllib
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from tribodyn.drawing.shapes import PlacedPart, parts_of_pair
from tribodyn.errors import InputError, SimulationError, near_name, quoted
from tribodyn.exchange import FORMATS
from tribodyn.exchange.cad.gltf import binary
from tribodyn.exchange.format import (
    SCENARIO,
    TEXT,
    Deviation,
    ExchangeFormat,
    Exported,
    FormatChoice,
    GearboxInTime,
    Imported,
)
from tribodyn.gears.prepare import assembled
from tribodyn.geometry.limits.checks import check
from tribodyn.input import units
from tribodyn.input.sources import is_file
from tribodyn.input.units import to_si_at
from tribodyn.numerics.files.output_files import check_output, write_output
from tribodyn.record.loss_map import is_map, loss_map
from tribodyn.record.reader import Record
from tribodyn.record.sweep_reader import SweepRecord, open_any
from tribodyn.studies import measured_flanks
from tribodyn.studies.measured_flanks import MeasuredImport, measuring
from tribodyn.studies.protocol.load import Loaded, load, load_data

#: Distance of triangles from the exact surfaces on a page, m.
_ON_A_PAGE = 2e-5
_KINDS = {
    kind.name: kind
    for kind in (units.TEMPERATURE_KIND, units.ANGULAR_SPEED, units.TORQUE, units.INERTIA, units.LENGTH)
}


class HandedOver(NamedTuple):
    """What an export wrote."""

    files: tuple[Path, ...]
    deviations: tuple[Deviation, ...]  # of what was written from what it was made of
    remarks: tuple[str, ...]

    def as_dict(self) -> dict[str, Any]:
        """For programs."""
        return {
            "files": [str(file) for file in self.files],
            "deviations": [each._asdict() for each in self.deviations],
            "remarks": list(self.remarks),
        }


def writers() -> dict[str, ExchangeFormat]:
    """Formats that can be written, by name."""
    return {name: each for name, each in FORMATS.items() if each.write is not None}


def readers() -> dict[str, ExchangeFormat]:
    """Formats that can be read, by name."""
    return {name: each for name, each in FORMATS.items() if each.read is not None or each.measure is not None}


def export(
    source: str | Path, to: str, output: Path | None, settings: Mapping[str, Any], *, force: bool = False
) -> HandedOver:
    """Write a record or a scenario in a format.

    `settings` are choices of the format, and overrides of a scenario. The name of `output` gets the ending of
    the format where it has none, and without one the file is named after the source; formats of several files
    put theirs beside it.
    """
    form = _named(to, "export", writers())
    write = form.write
    assert write is not None
    output = Path(f"{Path(source).stem}{form.endings[0]}") if output is None else output
    if output.suffix and output.suffix not in form.endings:
        rule = f"{to} writes {' or '.join(form.endings)}"
        raise InputError("--output", str(output), rule, f'write "{output.with_suffix(form.endings[0])}"')
    if output.is_dir():
        inside = output / f"{Path(source).stem}{form.endings[0]}"
        raise InputError("--output", str(output), "is a folder", f'write "{inside}"')
    if not output.absolute().parent.is_dir():
        raise InputError("--output", str(output), "its folder is not there", "make it, or choose another")
    check_output(output if output.suffix else output.with_suffix(form.endings[0]), force)
    choices = {
        key: _chosen(key, value, form.choices[key]) for key, value in settings.items() if key in form.choices
    }
    others = {key: value for key, value in settings.items() if key not in form.choices}
    exported = _source(source, others, form)
    takes = [sort for sort in (exported.sort, SCENARIO) if sort in form.takes]
    if not takes:
        due = " or ".join(form.takes)
        raise exported.refused(f"is {exported.sort}, and {to} takes {due}", "name one")
    written = write(exported, output.stem, choices)
    if output.suffix and output.suffix not in written.files:
        wanted = next(iter(written.files))
        rule = f"{to} writes {wanted} alone"
        raise InputError("--output", str(output), rule, f'write "{output.with_suffix(wanted)}"')
    files = {output.with_name(output.stem + ending): content for ending, content in written.files.items()}
    for file in files:
        check_output(file, force)
    for file, content in files.items():
        write_output(file, content, force=force)
    return HandedOver(tuple(files), written.deviations, written.remarks)


def read_scenario(path: Path, name: str | None = None) -> Imported:
    """Make a scenario of a file of another program, of a format that its ending tells, or that is named."""
    form = format_of(path, name)
    if form.read is None:
        rule, remedy = f"{form.name} holds a measured gear, no scenario", "add --into SCENARIO --gear NAME"
        raise InputError("import", str(path), rule, remedy)
    return form.read(path)


def format_of(path: Path, name: str | None = None) -> ExchangeFormat:
    """The format of a file that is read, by its ending or by name; InputError where there is none."""
    known = readers()
    if name is not None:
        form = _named(name, "import", known)
    else:
        endings = {ending: each for each in known.values() for ending in each.endings}
        found = endings.get(path.suffix.lower())
        if found is None:
            rule = "no format that is known has this ending"
            remedy = (
                f"one of {', '.join(endings)}, or --from FORMAT" if endings else "install a package with one"
            )
            raise InputError("import", str(path), rule, remedy)
        form = found
    if not is_file(path):
        raise InputError("import", str(path), "no such file", "name a file")
    return form


def import_measured(
    paths: Sequence[Path],
    into: str | Path | None,
    gear: str = "",
    datum: str = "",
    output: Path | None = None,
    name: str | None = None,
    *,
    force: bool = False,
) -> MeasuredImport:
    """Put the measurement of a gear, of one file or several, into a scenario; see `measured_flanks`."""
    found = []
    for path in paths:
        form = format_of(path, name)
        if form.measure is None:
            rule = f"{form.name} holds no measured gear"
            raise InputError("import", str(path), rule, "leave --into out, or name a file of a measurement")
        found.append((path, form.measure(path)))
    return measured_flanks.import_measured(found, into, gear, datum, output, force=force)


def _named(name: str, verb: str, known: Mapping[str, ExchangeFormat]) -> ExchangeFormat:
    if name in known:
        return known[name]
    what = f"cannot {verb}" if name in FORMATS else "no such format"
    near = near_name(name, known)
    listed = f"one of {', '.join(known)}" if known else "install a package with one"
    raise InputError("format", quoted(name), what, f'did you mean "{near}"? {listed}' if near else listed)


def _chosen(key: str, value: Any, choice: FormatChoice) -> float | str:
    if choice.kind == TEXT:
        return str(value)
    if choice.kind in _KINDS:
        return to_si_at(key, value, _KINDS[choice.kind])
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = math.nan
    if not 0.0 <= number < math.inf:
        raise InputError(key, quoted(value), "is no number from 0 on", "write one, such as 0.05")
    return number


def _source(source: str | Path, overrides: Mapping[str, Any], form: ExchangeFormat) -> Exported:
    path = Path(source)
    if str(source).endswith(".toml") or not (is_file(path) or path.suffix in (".h5", ".hdf5")):
        loaded = load(source, overrides)
        return Exported(
            loaded.path,
            tomllib.loads(loaded.case.toml),
            parts=partial(placed_parts, loaded),
            measured=measuring(lambda: loaded),
            in_time=partial(_in_time, loaded),
        )
    for key in overrides:
        remedy = f"one of {', '.join(form.choices)}" if form.choices else "omit it"
        raise InputError(
            "--set", quoted(key), f"a record is as it is, and {form.name} has no such choice", remedy
        )
    with open_any(path) as record:
        if isinstance(record, SweepRecord):
            raise record.refused("is the record of a sweep", "name one of a map or a run")
        if record.status != "complete":
            raise record.refused(f"is {record.status}", "finish it")
        try:
            losses = loss_map(record) if is_map(record) else None
        except (KeyError, ValueError) as error:
            raise record.refused(f"holds a map that cannot be used: {error}", "make it anew") from None
        scenario = record.scenario
        summary = record.summary
    return Exported(
        path,
        scenario,
        summary,
        losses,
        lambda tolerance: placed_parts(load_data(scenario, path.stem), tolerance),
        measured=measuring(lambda: load_data(scenario, path.stem)),
        in_time=lambda drive, load: _in_time(load_data(scenario, path.stem), drive, load),
    )


def _in_time(loaded: Loaded, drive: str, load: str) -> GearboxInTime:
    """A scenario as a model to be moved on in time."""
    make = loaded.study.in_time()
    if make is None:
        rule = f"is of the kind {loaded.study.kind}, which has no motion in time"
        raise InputError("export", str(loaded.path), rule, "name a gear-pair or a gear-train")
    with loaded.naming():
        return make(loaded.case, drive, load)


def placed_parts(loaded: Loaded, tolerance: float) -> list[PlacedPart]:
    """Gears and shafts of a scenario in space, by its study or of its pair of gears; none: it has none.

    Chords leave the exact surfaces by `tolerance` (m) at most.
    """
    with loaded.naming():
        if (placed := loaded.study.placed_parts()) is not None:
            return placed(loaded.case, tolerance)
        if not loaded.study.has_gears:
            return []
        pair = assembled(loaded.case.pair)
        check(pair.family, pair.drive)
        case = loaded.case.pair
        return parts_of_pair(pair, tolerance, case.mesh.modifications, case.masses)


def bodies_in_space(record: Record | SweepRecord) -> bytes:
    """Gears and shafts of a record as its page has them, one tooth of every gear.

    Nothing where it has none, or this version cannot make its case or draw its teeth.
    """
    try:
        parts = placed_parts(load_data(record.scenario, record.path.stem), _ON_A_PAGE)
        return binary(parts, record.label, by_tooth=True)[0] if parts else b""
    except (InputError, SimulationError, ValueError):
        return b""
