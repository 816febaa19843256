"""Tables of gear measuring machines, CSV: traces point by point, and pitch tooth by tooth.

The first column of each name is the usual one. A file of traces has a row for each point; one of pitch a row
for each tooth, or for each tooth and flank.
"""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from tribodyn.errors import InputError, quoted
from tribodyn.exchange.format import ExchangeFormat
from tribodyn.exchange.measured_gear import (
    DIAMETER,
    FLANKS,
    HELIX,
    LARGEST,
    LEFT,
    PROFILE,
    RIGHT,
    ROLL_ANGLE,
    ROLL_LENGTH,
    FlankTrace,
    MeasuredGear,
    index_of_single,
)
from tribodyn.input import units
from tribodyn.input.csv_files import read_words
from tribodyn.numerics.shapes import Array, Float

_TOOTH = ("tooth", "tooth_number", "tooth_no", "zahn", "zahn_nr")
_FLANK = ("flank", "side", "flanke", "seite")
_TRACE = ("trace", "kind", "type", "measurement", "messung")
_DEVIATION = ("deviation", "abweichung")
_POSITION = ("position", "place")
_PLACES = {
    ROLL_LENGTH: ("roll_length", "wälzweg", "waelzweg"),
    ROLL_ANGLE: ("roll_angle", "wälzwinkel", "waelzwinkel"),
    DIAMETER: ("diameter", "durchmesser"),
    "face": ("face_position", "face", "z"),
}
_SIDES = {
    **dict.fromkeys(("left", "l", "links"), LEFT),
    **dict.fromkeys(("right", "r", "rechts"), RIGHT),
}
_KINDS = {
    **dict.fromkeys(("profile", "profil", "involute"), PROFILE),
    **dict.fromkeys(("helix", "lead", "flankenlinie"), HELIX),
}
#: Of pitch; the size of the letter counts.
_INDEX, _SINGLE, _RADIAL = ("F_p", "Fp", "F_pi"), ("f_p", "fp", "f_pi"), ("F_r", "Fr", "r")
_EXAMPLE = "tooth,flank,trace,position [mm],deviation [um], or tooth,flank,F_p [um]"


class _Columns:
    """The columns of a file."""

    def __init__(self, path: Path) -> None:
        self.file = str(path)
        self.columns = read_words(path, "file", {*_FLANK, *_TRACE}, _EXAMPLE)
        self.rows = len(next(iter(self.columns.values()))["values"])
        self.used: set[str] = set()

    def bad(self, rule: str, remedy: str) -> InputError:
        """What is wrong with the file."""
        return InputError("file", None, rule, remedy, self.file)

    def named(self, names: Sequence[str], cased: bool = False) -> str | None:
        """The column that has one of these names; `cased`: the size of its letters counts."""
        found = [name for name in self.columns if (name if cased else name.lower()) in names]
        if len(found) > 1:
            raise self.bad(f"the columns {' and '.join(found)} say the same", "leave one of them out")
        self.used |= set(found)
        return found[0] if found else None

    def numbers(self, name: str, kind: units.Kind) -> Float[Array, " row"]:
        """A column in SI units."""
        column = self.columns[name]
        if not column["unit"]:
            remedy = f'write "{name} [{kind.example.split(" ")[1]}]"'
            raise self.bad(f"the column {quoted(name)} has no unit", remedy)
        unit = units.to_si_at(f"{self.file}: {name}", f"1 {column['unit']}", kind)
        values = np.array(column["values"])
        if not np.all(np.abs(values) < LARGEST / unit):
            rule = f"the column {quoted(name)} has a value that no gear has"
            raise self.bad(rule, "correct it, or leave its row out")
        return unit * values

    def words(self, name: str, known: dict[str, str]) -> list[str]:
        """A column of words as they are known here."""
        unknown = next((word for word in self.columns[name]["values"] if word not in known), None)
        if unknown is not None:
            raise self.bad(f"{quoted(unknown)} in the column {quoted(name)}", f"one of {', '.join(known)}")
        return [known[word] for word in self.columns[name]["values"]]

    def teeth(self) -> list[int]:
        """Number of the tooth of every row."""
        name = self.named(_TOOTH)
        if name is None:
            raise self.bad("no column says the tooth", f"begin the file with {_EXAMPLE}")
        values = self.columns[name]["values"]
        wrong = next((value for value in values if not (1 <= value < 1e6 and value == int(value))), None)
        if wrong is not None:
            raise self.bad(f"tooth {wrong:g}", "number the teeth from 1")
        return [round(value) for value in values]

    def remarks(self) -> tuple[str, ...]:
        """Columns that nothing was made of."""
        rest = [name for name in self.columns if name not in self.used]
        return (f"not used: the columns {', '.join(rest)}",) if rest else ()


def read(path: Path) -> MeasuredGear:
    """The measurement in a file; InputError where something in it is not understood."""
    table = _Columns(path)
    if table.rows == 0:
        raise table.bad("it has no rows", f"begin it with {_EXAMPLE}")
    if (deviation := table.named(_DEVIATION)) is not None:
        traces = tuple(_traces(table, deviation))
        return MeasuredGear(traces=traces, remarks=table.remarks())
    return _pitch(table)


def _traces(table: _Columns, deviation: str) -> Iterator[FlankTrace]:
    teeth, flanks, deviations = table.teeth(), _flanks(table), table.numbers(deviation, units.DEVIATION)
    trace, position = table.named(_TRACE), table.named(_POSITION)
    places = {over: name for over, names in _PLACES.items() if (name := table.named(names)) is not None}
    if trace is not None:
        kinds = table.words(trace, _KINDS)
    elif position is None and len(places) == 1:
        kinds = [HELIX if "face" in places else PROFILE] * table.rows
    else:
        raise table.bad("nothing says which rows are of a profile, which of a helix", 'add a column "trace"')
    points: dict[tuple[str, int, str, float | None], list[int]] = {}
    beside = table.numbers(places["face"], units.LENGTH) if "face" in places and PROFILE in kinds else None
    for row in range(table.rows):
        at = float(beside[row]) if beside is not None and kinds[row] == PROFILE else None
        points.setdefault((kinds[row], teeth[row], flanks[row], at), []).append(row)
    columns = {kind: _place(table, kind, position, places) for kind in set(kinds)}
    for (kind, tooth, flank, at), rows in points.items():
        over, place = columns[kind]
        own, what = place[rows], f"{kind} of tooth {tooth}, {flank} flank"
        if len(rows) < 3:
            raise table.bad(f"the {what} has {len(rows)} points", "give it three at least")
        if not (np.all(np.diff(own) > 0.0) or np.all(np.diff(own) < 0.0)):
            raise table.bad(f"the {what} goes forth and back", "write points from one end to the other")
        yield FlankTrace(kind, tooth, flank, own, deviations[rows], at, None, over)


def _place(
    table: _Columns, kind: str, position: str | None, places: dict[str, str]
) -> tuple[str, Float[Array, " row"]]:
    """What the places of a kind of trace are, and the places."""
    if kind == HELIX:
        name = places.get("face", position)
        if name is None:
            raise table.bad("no column says where points of a helix are", 'add "face_position [mm]"')
        return ROLL_LENGTH, table.numbers(name, units.LENGTH)
    over = next((each for each in (ROLL_LENGTH, ROLL_ANGLE, DIAMETER) if each in places), None)
    if over is None:
        if position is None:
            raise table.bad("no column says where points of a profile are", 'add "roll_length [mm]"')
        angle = table.columns[position]["unit"] in ("deg", "°", "rad")
        over, name = ROLL_ANGLE if angle else ROLL_LENGTH, position
    else:
        name = places[over]
    return over, table.numbers(name, units.ANGLE_KIND if over == ROLL_ANGLE else units.LENGTH)


def _flanks(table: _Columns) -> list[str]:
    name = table.named(_FLANK)
    if name is None:
        raise table.bad("no column says the flank", 'add a column "flank" with left and right')
    return table.words(name, _SIDES)


def _pitch(table: _Columns) -> MeasuredGear:
    teeth = table.teeth()
    columns = list(_pitch_columns(table, teeth))
    if not columns:
        raise table.bad("neither traces nor pitch deviations", f"begin it with {_EXAMPLE}")
    index: dict[str, Float[Array, " tooth"]] = {}
    radial = None
    for flank, names, rows, values in columns:
        ordered = _in_order(table, [teeth[row] for row in rows], values)
        if names is _RADIAL:
            radial = ordered if radial is None else radial
        elif names is _INDEX:
            index[flank] = ordered
        else:
            index.setdefault(flank, index_of_single(ordered))
    return MeasuredGear(pitch=index, radial=radial, remarks=table.remarks())


def _pitch_columns(
    table: _Columns, teeth: Sequence[int]
) -> Iterator[tuple[str, tuple[str, ...], list[int], Float[Array, " row"]]]:
    """Flank, what it is, rows and deviations of every column of pitch; index deviations first."""
    by_rows: dict[str, list[int]] = {"": list(range(len(teeth)))}
    name = table.named(_FLANK)
    if name is not None:
        of = table.words(name, _SIDES)
        by_rows = {flank: [row for row, one in enumerate(of) if one == flank] for flank in FLANKS}
    for names in (_INDEX, _SINGLE, _RADIAL):
        if (column := table.named(names, cased=True)) is not None:
            if name is None and names is not _RADIAL:
                remedy = f'add a column "flank", or name it "{column}_left"'
                raise table.bad(f"the flank of the column {quoted(column)} is not said", remedy)
            values = table.numbers(column, units.DEVIATION)
            for flank, rows in by_rows.items():
                if rows:
                    yield flank, names, rows, values[rows]
        for flank in FLANKS if names is not _RADIAL and name is None else ():
            beside = [f"{each}_{flank}" for each in names]
            if (column := table.named(beside, cased=True)) is not None:
                yield flank, names, by_rows[""], table.numbers(column, units.DEVIATION)


def _in_order(table: _Columns, teeth: Sequence[int], values: Float[Array, " row"]) -> Float[Array, " tooth"]:
    if sorted(teeth) != list(range(1, len(teeth) + 1)):
        missing = sorted(set(range(1, max(teeth) + 1)) - set(teeth))
        rule = f"tooth {missing[0]} is missing" if missing else "a tooth stands twice"
        raise table.bad(rule, "give every tooth one row for each flank")
    ordered: Any = np.empty(len(teeth))
    ordered[np.array(teeth) - 1] = values
    return ordered


FORMAT = ExchangeFormat(
    "gear-csv",
    "measured gears as tables: profile, helix and pitch deviations of every tooth and flank",
    (".csv", ".txt"),
    measure=read,
)
