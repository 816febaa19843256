"""CSV tables as programs of many countries write them: the one reader of all that a user gives.

The first line names the columns and their units, ``time [s],torque [N*m]``; or names alone, above a line of
units. It decides what separates: semicolons, tabs or commas; so does a line ``sep=;`` before it. Numbers
have a decimal point, between semicolons or tabs also a comma. What could be read in two ways is refused.
"""

import csv
import re
from collections.abc import Collection, Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from tribodyn.errors import InputError, quoted
from tribodyn.input.sources import MOST_CSV, read_text
from tribodyn.input.unit_grammar import decimal_comma

#: Points of a CSV table.
MOST_POINTS = 100_000
#: Separator of a row -> what it is called; the first of them in the header decides.
SEPARATORS = {";": "semicolons", "\t": "tabs", ",": "commas"}
_HEADER = re.compile(r"\s*(?P<name>\w+)\s*\[(?P<unit>[^\]]*)\]\s*$")
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?|[+-]?(nan|inf)", re.ASCII | re.IGNORECASE)
#: A number whose digits go in threes: 1,234 or 12 345 or 1'234'567, maybe with decimals.
_IN_THREES = re.compile(r"[+-]?[1-9]\d{0,2}(?:([ .,'’\u00a0\u202f])\d{3})(?:\1\d{3})*(?P<rest>[.,]\d+)?")
_QUOTED = re.compile(r'"[^"]*"')
_TOLD = re.compile(r"sep=(.?)", re.IGNORECASE)


class _CsvRow(NamedTuple):
    """A line of a file, cut into cells."""

    number: int
    line: str
    cells: list[str]


class _File:
    """A file as messages name it, and what separates its cells."""

    def __init__(self, path: Path, key: str) -> None:
        self.path, self.key, self.separator = path, key, ","

    def bad(self, number: int, rule: str, remedy: str) -> InputError:
        """What is wrong with a line."""
        return InputError(self.key, rule=f"line {number}: {rule}", remedy=remedy, file=str(self.path))

    def row(self, number: int, line: str, width: int = 1) -> _CsvRow:
        """Cut a line into cells; empty ones beyond `width` are left out, as spreadsheets leave them."""
        try:
            cells = next(csv.reader([line], strict=True, delimiter=self.separator))
        except csv.Error as error:
            remedy = f"write plain numbers separated by {SEPARATORS[self.separator]}, each row in one line"
            raise self.bad(number, f"not a row of a table: {error}", remedy) from None
        while len(cells) > width and not cells[-1].strip():
            cells.pop()
        return _CsvRow(number, line, cells)

    def of_width(self, number: int, line: str, width: int) -> _CsvRow:
        """A row with as many cells as the header."""
        row = self.row(number, line, width)
        count = len(row.cells)
        if count == width:
            return row
        other = next((sign for sign in SEPARATORS if sign != self.separator and sign in line), None)
        if count < width and other is not None:
            rule = f"the row is separated by {SEPARATORS[other]}, the header by {SEPARATORS[self.separator]}"
            raise self.bad(number, rule, "separate both by the same")
        values = "1 value" if count == 1 else f"{count} values"
        rule = f"{values} under a header of {width}, separated by {SEPARATORS[self.separator]}"
        remedy = "name each column, or leave it out"
        if count < width:
            remedy = "give each column its value"
        elif self.separator == ",":
            remedy = "write decimal points, 13.5; or separate header and rows by semicolons"
        raise self.bad(number, f"{rule}: {quoted(line.strip())}", remedy)


def read_curve(
    path: Path, key: str, columns: Iterable[str] = (), example: Iterable[str] = ("time", "torque")
) -> dict[str, Any]:
    """Return the columns of a CSV file as the scenario would write them out.

    Lines that begin with # are comments. `columns` are the names that are due, in order; none: all that there
    are, two at least, such as `example`.
    """
    due = list(columns) or list(example)
    example = ",".join(f"{name} [unit]" for name in due)
    file, first, titles, lines = _opened(path, key, example)
    heads = [_HEADER.match(cell) for cell in titles]
    names_there = [head["name"] for head in heads if head]
    header = {head["name"]: (head["unit"], index) for index, head in enumerate(heads) if head}
    if not columns:
        unread = next((cell for cell, head in zip(titles, heads, strict=True) if not head), None)
        if unread is not None or len(header) < max(2, len(heads)):
            rule = (
                "two columns at least, none twice" if unread is None else f"{quoted(unread)} names no column"
            )
            raise file.bad(first, rule, f"begin the file with {example}, … ")
        due = list(header)
    for name in due:
        if name not in header:
            raise file.bad(first, f'no column "{name} [unit]" in the header', f"write {example}")
        if names_there.count(name) > 1:
            raise file.bad(first, f'"{name}" names more than one column', "leave the others out")
    rows = [file.of_width(number, line, len(titles)) for number, line in lines]
    return _values(file, rows, {name: header[name] for name in due})


def read_words(path: Path, key: str, words: Collection[str], example: str) -> dict[str, Any]:
    """Return all columns of a CSV file, some of which have words, in small letters, and no unit.

    `words` are the names of these in small letters; numbers may stand in a column without a unit too.
    """
    file, first, titles, lines = _opened(path, key, example)
    header: dict[str, tuple[str, int]] = {}
    for place, cell in enumerate(titles):
        head = _HEADER.match(cell)
        name, unit = (head["name"], head["unit"].strip()) if head else (cell.strip(), "")
        if not re.fullmatch(r"\w+", name) or name in header:
            rule = f"{quoted(name)} names {'more than one' if name in header else 'no'} column"
            raise file.bad(first, rule, f"begin the file with {example}")
        header[name] = unit, place
    rows = [file.of_width(number, line, len(titles)) for number, line in lines]
    texts = {name: place for name, (_, place) in header.items() if name.lower() in words}
    found = _values(file, rows, {name: head for name, head in header.items() if name not in texts})
    for name, place in texts.items():
        found[name] = {"unit": "", "values": [row.cells[place].strip().lower() for row in rows]}
    return found


def _opened(path: Path, key: str, example: str) -> tuple[_File, int, list[str], list[tuple[int, str]]]:
    """A file, the number of its header's line, titles of columns, and lines of rows."""
    file = _File(path, key)
    lines = [
        (number, line)
        for number, line in enumerate(read_text(path, MOST_CSV, of_spreadsheet=True).split("\n"), start=1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    if lines and (told := _TOLD.fullmatch(lines[0][1].strip("\n"))):
        if told[1] not in SEPARATORS:
            named = ", ".join(SEPARATORS.values())
            raise file.bad(lines[0][0], f"{quoted(told[0])}: no such separator", f"use one of {named}")
        file.separator = told[1]
        lines = lines[1:]
    elif lines:
        plain = _QUOTED.sub("", lines[0][1])
        file.separator = next((sign for sign in SEPARATORS if sign in plain), ",")
    if not lines:
        raise file.bad(1, "the file is empty", f"begin it with {example}")
    if len(lines) > MOST_POINTS + 1:
        raise file.bad(lines[MOST_POINTS + 1][0], f"more than {MOST_POINTS} points", "leave some out")
    titles, count = _titles(file, lines)
    return file, lines[0][0], titles, lines[count:]


def _values(
    file: _File, rows: list[_CsvRow], columns: Mapping[str, tuple[str, int]]
) -> dict[str, dict[str, Any]]:
    """Numbers of columns, given by their unit and place."""
    places = {name: place for name, (_, place) in columns.items()}
    commas = _decimal_commas(file, rows, places)
    return {
        name: {
            "unit": unit,
            "values": [_number(file, row, row.cells[place], name, commas) for row in rows],
        }
        for name, (unit, place) in columns.items()
    }


def _titles(file: _File, lines: list[tuple[int, str]]) -> tuple[list[str], int]:
    """Names of the columns with their units, and of how many lines they are: units may have a line below."""
    names = file.row(*lines[0]).cells
    if len(lines) > 1 and all(re.fullmatch(r"\s*\w+\s*", name) for name in names):
        units = [cell.strip().strip("[]()") for cell in file.row(*lines[1], len(names)).cells]
        numbers = [unit for unit in units if _NUMBER.fullmatch(unit.replace(",", "."))]
        if len(units) == len(names) > len(numbers) and all(unit == "1" for unit in numbers):
            titles = [f"{name.strip()} [{unit}]" for name, unit in zip(names, units, strict=True)]
            return titles, 2
    return names, 1


def _decimal_commas(file: _File, rows: list[_CsvRow], places: Mapping[str, int]) -> bool:
    """Whether numbers have decimal commas; refuses what has commas and points, or may be meant either way."""
    if file.separator == ",":
        return False
    cells = [(row, row.cells[place].strip()) for row in rows for place in places.values()]
    with_comma = [(row, cell) for row, cell in cells if "," in cell]
    if not with_comma:
        return False
    row, cell = with_comma[0]
    point = next(((at, other) for at, other in cells if "." in other), None)
    if point is not None:
        rule = f"{quoted(cell)} has a comma, and {quoted(point[1])} in line {point[0].number} a point"
        remedy = "write decimal points or decimal commas in all rows, and no separators of thousands"
        raise file.bad(row.number, rule, remedy)
    if all(_IN_THREES.fullmatch(cell) for _, cell in with_comma):
        raise file.bad(row.number, *_may_be_thousands(cell))
    return True


def _may_be_thousands(cell: str) -> tuple[str, str]:
    whole = re.sub(r"[^\d+-]", "", cell)
    rule = f"{quoted(cell)} has a separator of thousands, or a decimal one"
    return rule, f"write {whole}, or a decimal point where one is meant"


def _number(file: _File, row: _CsvRow, cell: str, name: str, commas: bool) -> float:
    """The number in a cell."""
    text = cell.strip()
    plain = text.replace(",", ".", 1) if commas else text
    if _NUMBER.fullmatch(plain):
        return float(plain)
    if not commas and (comma := decimal_comma(cell)) is not None:
        raise file.bad(row.number, f"{quoted(text)}: {comma[0]} ({name})", comma[1])
    if _IN_THREES.fullmatch(text):
        raise file.bad(row.number, *_may_be_thousands(text))
    raise file.bad(row.number, f"{quoted(cell)} is not a number ({name})", "write numbers only")
