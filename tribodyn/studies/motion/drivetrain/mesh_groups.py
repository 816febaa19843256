"""Meshes of a planetary set that differ by their planet alone: which they are, and their names together."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from tribodyn.post import verdict
from tribodyn.studies.motion.case import Gearbox
from tribodyn.train.planetary import CARRIER, PLANETS

#: In the summary of a mesh: the name that it shares with those of the set's other planets.
ALIKE = "alike"
#: Share of the largest power, and of the largest load, of a mesh below which one idles.
IDLES = 0.01


def alike_of(case: Gearbox) -> tuple[str, ...]:
    """What every mesh shares with those of the other planets, set and member; "" of a mesh outside sets."""
    groups = [""] * len(case.meshes)
    for gearset in case.sets:
        of_body = {body: member for member, body in gearset.members.items() if member != CARRIER}
        for m, mesh in enumerate(case.meshes):
            if mesh.carrier == gearset.members[CARRIER]:
                body = mesh.driver if mesh.driver in of_body else mesh.driven
                groups[m] = f"{gearset.name}-{of_body.get(body, PLANETS)}"
    return tuple(groups)


def groups_of(meshes: Mapping[str, Mapping[str, Any]]) -> list[list[str]]:
    """Names of the meshes of a summary, those of all planets with one member in a list of their own."""
    groups: dict[str, list[str]] = {}
    for name, mesh in meshes.items():
        groups.setdefault(f"set {mesh[ALIKE]}" if mesh.get(ALIKE) else f"mesh {name}", []).append(name)
    return list(groups.values())


def idle_meshes(meshes: Mapping[Any, Mapping[str, Any]]) -> list[Any]:
    """Those of a summary that carry next to nothing: gears that turn along, whose K_v is of no load."""
    found = {name: verdict.numbers(mesh) for name, mesh in meshes.items()}
    power = {name: abs(each.get("power_in_mean", 0.0)) for name, each in found.items()}
    load = {
        name: abs(each.get("normal_load_max", 0.0)) / max(abs(each.get("dynamic_factor", 0.0)), 1.0)
        for name, each in found.items()
    }
    most = [IDLES * max(each.values(), default=0.0) for each in (power, load)]
    return [name for name in meshes if power[name] < most[0] and load[name] < most[1]]


def together(names: Iterable[str]) -> str:
    """Names in one, those that differ by the number at their end once: "set-sun-1 (and 2, 3), second"."""
    numbers: dict[str, list[str]] = {}
    for name in dict.fromkeys(names):
        head, line, number = name.rpartition("-")
        alone = not (line and number.isdigit())
        numbers.setdefault(name if alone else f"{head}-", []).append("" if alone else number)
    return ", ".join(
        f"{head}{first} (and {', '.join(others)})" if others else f"{head}{first}"
        for head, (first, *others) in numbers.items()
    )


def between(cells: Sequence[str], values: Sequence[Any]) -> str:
    """Written values of several meshes in one cell: the smallest to the largest, or what is the same once."""
    different = dict(zip(cells, values, strict=True))
    if len(different) < 2:
        return next(iter(different), "")
    if not all(isinstance(value, (int, float)) for value in values):
        return together(cells)
    ordered = sorted(different, key=lambda cell: different[cell])
    return f"{ordered[0]} … {ordered[-1]}"
