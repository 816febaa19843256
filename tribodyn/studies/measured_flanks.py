"""Measured gears into a scenario, and the gears of a scenario as they would be measured."""

import math
from collections.abc import Callable, Mapping, Sequence
from copy import deepcopy
from functools import reduce
from pathlib import Path
from typing import Any, NamedTuple

from tribodyn.errors import InputError, near_name, quoted
from tribodyn.exchange.measured_gear import DIAMETER, ROLL_ANGLE, MeasuredGear, NominalGear
from tribodyn.gears.measured.evaluated import Evaluation, evaluation_of
from tribodyn.gears.measured.from_scenario import measured_of
from tribodyn.gears.measured.mounted_gear import END, START, MountedGear
from tribodyn.gears.measured.to_scenario import FlankKeys, ToothErrors, keys_of
from tribodyn.input.edit import Models, put, with_values
from tribodyn.input.messages import Key
from tribodyn.input.quantity import defaults_written_out
from tribodyn.input.sources import MOST_TOML, find_scenario, laid_out_like, read_text, read_toml
from tribodyn.numerics.files.output_files import check_output, write_output
from tribodyn.studies.protocol.load import Loaded, load, load_data, table_of

_MARK = "# written by tribodyn from a measurement\n"
_DATUMS = START, END


class MeasuredImport(NamedTuple):
    """What became of a measurement."""

    files: tuple[Path, ...]  # the scenario and its tables; none: it was evaluated alone
    evaluation: Evaluation
    remarks: tuple[str, ...]

    def as_dict(self) -> dict[str, Any]:
        """For programs."""
        return {
            "files": [str(file) for file in self.files],
            "evaluation": self.evaluation.as_dict(),
            "remarks": list(self.remarks),
        }


def mounted(loaded: Loaded) -> Mapping[str, MountedGear]:
    """Gears of a scenario by name; InputError of a kind in which teeth are all alike."""
    gears = loaded.study.mounted_gears()
    if gears is None:
        rule = "takes all teeth of a gear alike"
        remedy = "name a scenario of a gear pair or a train over time"
        raise InputError("kind", loaded.study.kind, rule, remedy, str(loaded.path))
    with loaded.naming():
        return gears(loaded.case)


def gear_named(gears: Mapping[str, MountedGear], name: str, key: str) -> MountedGear:
    """One of the gears; InputError, which names them all."""
    if name not in gears:
        near = near_name(name, gears)
        rule = "is not a gear of the scenario" if name else "the gear is not said"
        listed = f"one of {', '.join(gears)}"
        remedy = f'did you mean "{near}"? {listed}' if near else listed
        raise InputError(key, quoted(name) if name else None, rule, remedy)
    return gears[name]


def datum_named(name: str, key: str) -> str:
    """An end of the face; "": its start."""
    if name not in ("", *_DATUMS):
        raise InputError(key, quoted(name), "is no end of the face", f"one of {', '.join(_DATUMS)}")
    return name or START


def measuring(loading: Callable[[], Loaded]) -> Callable[[str, str], MeasuredGear]:
    """(gear, datum face) -> a gear of a scenario, which is loaded then, as it would be measured."""

    def measured(name: str, datum: str) -> MeasuredGear:
        gears = mounted(loading())
        own = [gear.name for gear in gears.values() if gear.own]
        gear = gear_named(gears, name or (own or list(gears))[0], "gear")
        return measured_of(gear, datum_named(datum, "datum"))

    return measured


def evaluated(measured: MeasuredGear, file: str) -> Evaluation:
    """The numbers of a measurement by itself, as far as it says what gear it is of."""
    of = measured.nominal
    if any(trace.over in (ROLL_ANGLE, DIAMETER) for trace in measured.traces):
        if of.teeth is None or of.module is None or of.pressure_angle is None:
            rule = "profiles over a roll angle or a diameter need the base circle, and the gear is not said"
            raise InputError("import", file, rule, "add --into SCENARIO --gear NAME")
        stretch = math.cos(of.helix_angle or 0.0)
        transverse = math.atan(math.tan(of.pressure_angle) / stretch)
        measured = _rolled(measured, of.teeth * of.module / stretch / 2.0 * math.cos(transverse))
    return _naming(file, measured, of)


def _naming(file: str, measured: MeasuredGear, of: NominalGear, edition: int = 2013) -> Evaluation:
    """Evaluate a measurement, and put its file into the errors."""
    try:
        return evaluation_of(measured, of, edition)
    except InputError as error:
        raise error.moved(lambda _: file) from None


def _rolled(measured: MeasuredGear, base_radius: float) -> MeasuredGear:
    return measured._replace(traces=tuple(trace.over_roll_length(base_radius) for trace in measured.traces))


def import_measured(
    measurements: Sequence[tuple[Path, MeasuredGear]],
    into: str | Path | None,
    gear: str = "",
    datum: str = "",
    output: Path | None = None,
    *,
    force: bool = False,
) -> MeasuredImport:
    """Put a gear's measurement, of one file or several, into a scenario; without one evaluate it.

    Written are a scenario, by default `into` with "-measured" beside it, and the tables that it names.
    """
    file = str(measurements[0][0])
    measured = reduce(MeasuredGear.beside, (each for _, each in measurements))
    if into is None:
        if gear or datum or output is not None:
            raise InputError("import", file, "goes into a scenario that is not said", "add --into SCENARIO")
        return MeasuredImport((), evaluated(measured, file), measured.remarks)
    source = find_scenario(str(into))
    loaded = load(source)
    mounting = gear_named(mounted(loaded), gear, "--gear")
    keys = keys_of(measured, mounting, datum_named(datum, "--datum"), file)
    rolled = _rolled(measured, mounting.base_radius)
    evaluation = _naming(file, rolled, mounting.nominal, mounting.edition)
    target = output or Path(f"{source.stem}-measured.toml")
    if output is None and str(into).endswith(".toml"):
        target = source.with_name(target.name)
    if target.suffix != ".toml":
        raise InputError("--output", str(target), "a scenario ends in .toml", f'write "{target.stem}.toml"')
    tables, inline, values = _written(keys, mounting, target)
    data, text = read_toml(source), read_text(source, MOST_TOML)
    models = Models(defaults_written_out(data, table_of(data)), table_of(data), source)
    try:
        tried = deepcopy(data)  # many numbers take tomlkit minutes
        for key, meaning in inline.items():
            put(tried, key, meaning, models)
        load_data(tried, str(target.with_suffix("")))
    except InputError as error:  # the scenario by itself was right
        raise error.moved(lambda _: file) from None
    for path in (target, *tables):
        check_output(path, force)
    for path, content in tables.items():
        write_output(path, content, force=force)
    write_output(target, laid_out_like(source, with_values(text, values, models)), force=force)
    remarks = [*measured.remarks, *keys.remarks]
    if not values:
        remarks.append("the scenario is as before: what was measured is no deviation of a tooth")
    return MeasuredImport((target, *tables), evaluation, tuple(remarks))


def _written(
    keys: FlankKeys, gear: MountedGear, target: Path
) -> tuple[dict[Path, str], dict[Key, Any], dict[Key, Any]]:
    """Tables with their contents; what the keys mean; and the keys as texts of the scenario."""
    of_gear = tuple(gear.key.split("."))
    name = "".join(c if c.isalnum() or c in "-_" else "-" for c in gear.name)
    tables: dict[Path, str] = {}
    inline: dict[Key, Any] = {}
    values: dict[Key, Any] = {}

    def add(key: str, content: str, meaning: Any) -> None:
        path = target.with_name(f"{target.stem}-{name}-{key.replace('_', '-')}.csv")
        tables[path] = _MARK + content
        inline[*of_gear, "modification", key] = meaning
        values[*of_gear, "modification", key] = path.name

    for key, table in (("tooth_errors", keys.tooth_errors), ("tooth_errors_back", keys.tooth_errors_back)):
        if table is not None:
            add(key, _csv(table), table.columns())
    if keys.pitch_errors:
        lines = [f"{1e6 * each:.12g}" for each in keys.pitch_errors]
        add("pitch_errors", "\n".join(["error [um]", *lines]) + "\n", [f"{line} um" for line in lines])
    if keys.eccentricity:
        for key, text in (
            ("eccentricity", f"{1e6 * keys.eccentricity:.12g} um"),
            ("eccentricity_angle", f"{math.degrees(keys.eccentricity_angle):.12g} deg"),
        ):
            values[*of_gear, key] = inline[*of_gear, key] = text
    return tables, inline, values


def _csv(table: ToothErrors) -> str:
    columns = table.columns()
    head = ",".join(f"{name} [{column['unit']}]" for name, column in columns.items())
    rows = zip(*(column["values"] for column in columns.values()), strict=True)
    return "\n".join([head, *(",".join(f"{value:.12g}" for value in row) for row in rows)]) + "\n"
