"""Scenarios of epicyclic sets beyond sun, planets and ring."""

from typing import Any

from tests.support.planet_sets import planet_set

#: Teeth of sun, planet, second planet, ring: at one distance with one module.
STEPPED = (24, 36, 21, 81)


def stepped_set(
    teeth: tuple[int, int, int, int] = STEPPED,
    planets: int = 3,
    held: str = "ring",
    ends: tuple[str, str] = ("sun", "carrier"),
    **changes: Any,
) -> dict[str, Any]:
    """A scenario; `changes` are of the stage, or of other tables by their names."""
    sun, planet, step, ring = teeth
    gear = {"step": {"teeth": step, "bore_diameter": "30 mm", "face_width": "30 mm"}}
    kind = {"type": "stepped", "second_planet": "step", "gear": gear}
    return planet_set((sun, planet, ring), planets, held, ends, **kind | changes)
