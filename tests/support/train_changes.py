"""Changes of the reducer's scenario: keys put in and left out, a bare model in place of its gears."""

from collections.abc import Callable
from typing import Any

Change = Callable[[dict[str, Any]], None]


def put(key: str, value: Any) -> Change:
    """Put a value at a dotted key; lists grow by one."""

    def change(data: dict[str, Any]) -> None:
        *above, last = key.split(".")
        place: Any = data
        for part in above:
            place = place[int(part)] if part.isdecimal() else place.setdefault(part, {})
        if last == "+":
            place.append(value)
        else:
            place[int(last) if last.isdecimal() else last] = value

    return change


def drop(key: str) -> Change:
    def change(data: dict[str, Any]) -> None:
        *above, last = key.split(".")
        place: Any = data
        for part in above:
            place = place[int(part)] if part.isdecimal() else place[part]
        del place[last]

    return change


BARE_MESH = {
    "bodies": ["a", "b"],
    "teeth": [20, 40],
    "module": "4 mm",
    "pressure_angle": "20 deg",
    "face_width": "20 mm",
    "stiffness": "2e8 N/m",
    "damping_ratio": 0.05,
}


def bare(**mesh: Any) -> Change:
    """Two bodies and one mesh in the place of gears and stages."""

    def change(data: dict[str, Any]) -> None:
        for name in ("gear", "stage", "shaft"):
            del data[name]
        data["body"] = [{"name": name, "mass": "2 kg", "inertia": "1e-3 kg*m**2"} for name in "ab"]
        data["mesh"] = [{name: value for name, value in (BARE_MESH | mesh).items() if value is not None}]
        data["operating"] |= {"input": "a", "output": "b"}

    return change
