"""Names in older records, which called the deflection along a normal `transmission_error`."""

import re
from collections.abc import Collection, Mapping
from typing import Any

#: Dataset (time, pair) of the deflection along a pair's normal, its older name, and one beside both.
NORMAL, OLDER, BESIDE = "transmission_error_normal", "transmission_error", "transmission_error_rotational"
_SPEEDS = {f"contact_loss_{end}": f"contact_loss_speed_{end}" for end in ("from", "to")}
_OF_A_MESH = re.compile(r"(back_)?transmission_error_(rotational_)?(mean|peak_to_peak|max|min)")


def today(name: Any, names: Collection[str]) -> Any:
    """Name of today of a dataset among the names of a file; others as they are."""
    return NORMAL if name == OLDER and BESIDE in names else name


def stored(name: Any, names: Collection[str]) -> Any:
    """Name among those of a file of a dataset that is asked for by its older name or by that of today."""
    name = today(name, names)
    return OLDER if name == NORMAL and name not in names else name


def of_older(summary: Mapping[str, Any], names: Collection[str]) -> dict[str, Any]:
    """The summary of a record whose file has these names, under the names of today."""
    if OLDER in names and BESIDE in names:
        return _without_normal(summary)
    if "dynamic_factor_max_speed" in summary:  # speeds at which contact is lost, elsewhere frequencies
        return {_SPEEDS.get(name, name): value for name, value in summary.items()}
    return dict(summary)


def _without_normal(summary: Mapping[str, Any]) -> dict[str, Any]:
    def name_of(name: str) -> str:
        found = _OF_A_MESH.fullmatch(name)
        if not found:
            return name
        return f"{found[1] or ''}transmission_error_{'' if found[2] else 'normal_'}{found[3]}"

    return {
        name_of(name): _without_normal(value) if isinstance(value, Mapping) else value
        for name, value in summary.items()
    }
