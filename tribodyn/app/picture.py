"""What the page draws of gears: outlines, contacts with their loads, the gearbox in its true positions."""

from collections.abc import Mapping
from typing import Any

import numpy as np

#: Digits of coordinates that go to the browser, mm; of whole gearboxes.
_DIGITS, _COARSE = 3, 2
#: Outer radius of a ring that is drawn, over its root radius.
_RIM = 1.07
#: Positions of the contacts over one pitch.
_FRAMES = 60
#: Distance from the pitch point within which the path has the direction of the force, mm.
_NEAR = 1e-3
#: Half the width that is seen at first, over the largest distance of the path from the pitch point.
_VIEW = 1.75
Result = Mapping[str, Any]


def plain(values: Any, digits: int = 5) -> list[Any]:
    """Numbers as lists, with digits of the largest one; null for what is no finite number."""
    array = np.asarray(values, dtype=float)
    largest = float(np.max(np.abs(array), where=np.isfinite(array), initial=0.0))
    places = digits - 1 - int(np.floor(np.log10(largest))) if largest else 0
    return _with_gaps(np.round(array, places))


def _with_gaps(array: np.ndarray) -> list[Any]:
    finite = np.isfinite(array)
    if finite.all():
        return array.tolist()
    kept = array.astype(object)
    kept[~finite] = None
    return kept.tolist()


def _flat(points: Any, digits: int = _DIGITS) -> list[Any]:
    """Coordinates one after the other, rounded; null where there are none."""
    return _with_gaps(np.round(np.asarray(points, dtype=float), digits).ravel())


def pair_picture(geometry: Result, static: Result | None = None) -> dict[str, Any]:
    """Outlines about their own axes, their places, the path and the contacts over one pitch, mm.

    The quasi-static result gives the contacts their loads. `said` is which state of the gears this is.
    """
    gears = geometry["gears"]
    path, pitch = np.asarray(geometry["path"]), abs(float(geometry["pitch"]))
    bodies = [
        {
            "name": gear["name"],
            "role": "ring" if gear["internal"] else ("pinion", "gear")[number],
            **_toothed(gear),
            "outside": _RIM * gear["root_radius"] if gear["internal"] else 0.0,
            "bore": 0.0 if gear["internal"] else gear["bore_radius"],
            "centre": [round(float(one), _DIGITS) for one in gear["centre"]],
            "turn": float(gear["turn"]),
        }
        for number, gear in enumerate(gears)
    ]
    ends = [
        (float(gear["centre"][1]), float(body["outside"] or gear["tip_radius"]))
        for gear, body in zip(gears, bodies, strict=True)
    ]
    high, low = max(y + radius for y, radius in ends), min(y - radius for y, radius in ends)
    return {
        "bodies": bodies,
        "path": _flat(path),
        "pitch": pitch,
        "radius": abs(float(gears[0]["pitch_radius"])),
        "reach": float(_VIEW * np.nanmax(np.abs(path))),
        "extent": float(0.75 * (high - low)),
        "middle": float((high + low) / 2.0),
        "contacts": _contacts(geometry, static),
        "said": " ".join(geometry.get("remarks", ())),
    }


def _contacts(geometry: Result, static: Result | None) -> list[list[dict[str, Any]]]:
    """Contacts over one pitch, evenly from roll 0 on: place, direction of the force on the gear, load."""
    loaded = static is not None and "load" in static
    source: Result = static if loaded and static is not None else geometry
    rolls, places = np.asarray(source["roll" if loaded else "rolls"]), np.asarray(source["contact"])
    loads = np.asarray(source["load"]) if loaded else None
    frames = []
    order = np.argsort((rolls / float(geometry["pitch"])) % 1.0, kind="stable")
    for k in order[:: max(1, len(order) // _FRAMES)]:
        frame = []
        for pair, (x, y) in enumerate(places[k]):
            if not (np.isfinite(x) and np.isfinite(y)):
                continue
            across, along = _normal(x, y, geometry)
            frame.append(
                {
                    "x": round(float(x), _DIGITS),
                    "y": round(float(y), _DIGITS),
                    "nx": round(across, 5),
                    "ny": round(along, 5),
                    "load": None if loads is None else round(float(loads[k, pair]), 1),
                }
            )
        frames.append(frame)
    return frames


def _normal(x: float, y: float, geometry: Result) -> tuple[float, float]:
    """Direction of the force on the gear at a contact: through the pitch point, towards positive x."""
    path = np.asarray(geometry["path"])
    if np.hypot(x, y) < _NEAR:  # there the path itself has it
        nearest = int(np.argmin(np.hypot(*path.T)))
        x, y = path[min(nearest + 1, len(path) - 1)] - path[max(nearest - 1, 0)]
    length = float(np.hypot(x, y)) * (1.0 if x >= 0.0 else -1.0)
    return float(x) / length, float(y) / length


def _toothed(gear: Result, digits: int = _DIGITS) -> dict[str, Any]:
    """The outline of a gear's first tooth, and how often it is turned about the axis by how much."""
    outline, teeth = np.asarray(gear["outline"], dtype=float), int(gear["teeth"])
    count = (len(outline) - 1) // teeth
    (x, y), (other_x, other_y) = outline[0], outline[count]
    sense = 1.0 if x * other_y - y * other_x > 0.0 else -1.0
    return {"tooth": _flat(outline[:count], digits), "teeth": teeth, "pitch": sense * 2.0 * np.pi / teeth}


def gearbox_picture(train: Result) -> dict[str, Any]:
    """Gears with their teeth at their true places, mm; meshes where their gears meet."""
    gears = {gear["name"]: gear for gear in train["gears"]}
    reaches = {name: np.hypot(*np.asarray(gear["outline"], float).T) for name, gear in gears.items()}
    bodies = [
        {
            "name": name,
            **_toothed(gear, _COARSE),
            "angle": float(np.degrees(gear["angle"])),
            "x": float(gear["centre"][0]),
            "y": float(gear["centre"][1]),
            # of a ring its outside, of other gears their bore
            "radius": float(gear["radius"]),
            "reach": max(float(gear["radius"]), float(reaches[name].max())),
            "internal": bool(gear["internal"]),
            "plane": int(gear["plane"]),
        }
        for name, gear in gears.items()
    ]
    bodies.sort(key=lambda body: (not body["internal"], -body["reach"]))
    meshes = []
    for mesh in train["meshes"]:
        ends = [mesh["driver"], mesh["driven"]]
        small, large = sorted(ends, key=lambda name: (gears[name]["internal"], reaches[name].max()))
        at, other = (np.asarray(gears[name]["centre"], dtype=float) for name in (small, large))
        away = other - at
        distance = float(np.hypot(*away)) or 1.0
        pitch = float(reaches[small].min() + reaches[small].max()) / 2.0
        place = at + away / distance * pitch * (-1.0 if gears[large]["internal"] else 1.0)
        meshes.append({"name": mesh["name"], "x": float(place[0]), "y": float(place[1]), "bodies": ends})
    return {"bodies": bodies, "meshes": meshes}
