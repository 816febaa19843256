"""CSV tables in every dialect: what is written is read again, or refused; never read as something else."""

from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tribodyn.errors import InputError
from tribodyn.input.csv_files import read_curve

NAMES = ("time", "torque", "speed")
UNITS = ("ms", "N*m", "rad/s")
NUMBERS = st.one_of(
    st.floats(-1e6, 1e6, allow_nan=False).map(lambda value: round(value, 4)),
    st.floats(1e-9, 1e9, allow_nan=False),
    st.integers(-10_000, 10_000).map(float),
)
TABLES = st.integers(1, 3).flatmap(
    lambda columns: st.lists(st.lists(NUMBERS, min_size=columns, max_size=columns), min_size=1, max_size=6)
)
DIALECTS = st.fixed_dictionaries(
    {
        "separator": st.sampled_from(";\t,"),
        "comma": st.booleans(),
        "encoding": st.sampled_from(["utf-8", "utf-8-sig", "utf-16"]),
        "end": st.sampled_from(["\n", "\r\n", "\r"]),
        "quotes": st.booleans(),
        "units_below": st.booleans(),
        "told": st.booleans(),
    }
)
MANY = settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])


def written(table: list[list[float]], dialect: dict) -> bytes:
    """The table as a program of that dialect writes it."""
    separator, count = dialect["separator"], len(table[0])
    comma = dialect["comma"] and separator != ","
    rows = [[repr(value).replace(".", ",") if comma else repr(value) for value in row] for row in table]
    head = [[f"{name} [{unit}]" for name, unit in zip(NAMES[:count], UNITS, strict=False)]]
    if dialect["units_below"]:
        head = [list(NAMES[:count]), list(UNITS[:count])]
    lines = [
        separator.join(f'"{cell}"' if dialect["quotes"] else cell for cell in row) for row in (*head, *rows)
    ]
    if dialect["told"]:
        lines.insert(0, f"sep={separator}")
    text = dialect["end"].join(lines) + dialect["end"]
    return text.encode(dialect["encoding"])


def read_or_refused(path: Path, names: tuple[str, ...]) -> tuple[dict[str, Any] | None, str]:
    try:
        return read_curve(path, "key", names), ""
    except InputError as error:
        return None, str(error)


@MANY
@given(TABLES, DIALECTS)
def test_a_table_is_read_as_it_was_written(tmp_path: Path, table, dialect):
    path = tmp_path / "table.csv"
    path.write_bytes(written(table, dialect))
    names = NAMES[: len(table[0])]
    if len(names) == 1 and not dialect["told"]:
        dialect = dialect | {"separator": ","}  # nothing in the header tells
    found, why = read_or_refused(path, names)
    if found is None:  # decimal commas may be thousands, and under one column separators
        told = "separator of thousands" in why or "a comma in a number" in why
        assert dialect["comma"]
        assert told or (len(names) == 1 and "values under a header of 1" in why)
        return
    assert {name: column["unit"] for name, column in found.items()} == dict(zip(names, UNITS, strict=False))
    for place, name in enumerate(names):
        assert found[name]["values"] == [row[place] for row in table]


@MANY
@given(TABLES, DIALECTS, st.integers(0, 5), st.booleans())
def test_a_row_of_another_length_is_refused(tmp_path: Path, table, dialect, at, longer):
    columns = len(table[0])
    if columns == 1:
        longer = True
    broken = [list(row) for row in table]
    row = broken[at % len(broken)]
    if longer:
        row.append(2.5)
    else:
        row.pop()
    broken.insert(0, [0.5] * columns)  # a number that is no thousand
    path = tmp_path / "table.csv"
    path.write_bytes(written(broken, dialect | {"told": True}))
    with pytest.raises(InputError, match=r"under a header of|separated by"):
        read_curve(path, "key", NAMES[:columns])
