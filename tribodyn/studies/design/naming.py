"""Names of free keys, tolerances and duties, and nested tables as dotted keys."""

from collections.abc import Mapping, Sequence
from typing import Any


def naming_key(keys: str | Sequence[str]) -> str:
    """The key that names a free key: of several its parts that all of them have."""
    if isinstance(keys, str):
        return keys
    shared = set(keys[0].split(".")).intersection(*(key.split(".") for key in keys[1:]))
    return ".".join(part for part in keys[0].split(".") if part in shared) or keys[0]


def apart(keys: Sequence[str]) -> list[str]:
    """Shortest names for keys: their last parts, of such length that all differ; gears are always named."""
    for length in range(1, 12):
        ends = [key.split(".")[-length:] for key in keys]
        gears = [next((one for one in key.split(".") if one in ("pinion", "gear")), "") for key in keys]
        names = [
            "_".join(([gear] if gear and gear not in end else []) + end)
            for gear, end in zip(gears, ends, strict=True)
        ]
        if len(set(names)) == len(names):
            return names
    return [key.replace(".", "_") for key in keys]


def flat(table: Mapping[str, Any], above: str = "") -> dict[str, Any]:
    """Nested tables as dotted keys."""
    keys: dict[str, Any] = {}
    for name, value in table.items():
        key = f"{above}{name}"
        keys |= flat(value, f"{key}.") if isinstance(value, Mapping) else {key: value}
    return keys


def duty_names(design: Mapping[str, Any]) -> list[str]:
    """A name for each duty: the values of the keys in which duties differ."""
    sets = [flat(one.get("set", {})) for one in design.get("duty", ())]
    keys = list(dict.fromkeys(key for one in sets for key in one))
    different = [key for key in keys if len({str(one.get(key)) for one in sets}) > 1]
    return ["\n".join(str(one.get(key, "")) for key in different) for one in sets]
