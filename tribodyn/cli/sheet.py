"""The geometry sheet on the terminal."""

from typing import Any

from tribodyn.cli.printing import print_table


def print_sheet(sheet: dict[str, Any]) -> None:
    """Write the sheet of `tribodyn.geometry.sheet` to stdout: a table of the pair, one of the gears."""
    bodies = {name: sheet[name] for name in ("pinion", "gear")}
    pair = {name: value for name, value in sheet.items() if name not in bodies}
    names = list(dict.fromkeys(name for body in bodies.values() for name in body))
    print_table("Pair", ("quantity", "value"), [(name, written(*value)) for name, value in pair.items()])
    print_table(
        "Gears",
        ("quantity", *bodies),
        [
            (name, *(written(*body[name]) if name in body else "" for body in bodies.values()))
            for name in names
        ],
    )


def written(value: Any, unit: str) -> str:
    """Write a value with its unit."""
    number = f"{value:.6g}" if isinstance(value, float) else str(value)
    return f"{number} {unit}".strip()
