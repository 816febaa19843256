"""Tables of values that the package has as CSV files beside its modules."""

import csv
from collections.abc import Iterator
from importlib import resources


def table_rows(package: str | None, name: str) -> Iterator[dict[str, str]]:
    """Go through the rows of a table beside the modules of a package: texts by column."""
    text = resources.files(package or "").joinpath(name).read_text(encoding="utf-8")
    yield from csv.DictReader(text.splitlines())
