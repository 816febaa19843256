"""Scenarios of epicyclic sets beyond sun, planets and ring."""

from typing import Any

from tests.support.planet_sets import planet_set

#: Teeth of sun, planet, second planet, ring: at one distance with one module.
STEPPED = (24, 36, 21, 81)
MESHED = (24, 18, 20, 84)
#: And of the second sun, which meshes with the second planets: the ratios of a four-speed automatic gearbox.
RAVIGNEAUX = (30, 18, 18, 72, 36)


def stepped_set(
    teeth: tuple[int, int, int, int] = STEPPED,
    planets: int = 3,
    held: str = "ring",
    ends: tuple[str, str] = ("sun", "carrier"),
    **changes: Any,
) -> dict[str, Any]:
    """A scenario; `changes` are of the stage, or of other tables by their names."""
    return _set("stepped", teeth, planets, held, ends, changes)


def meshed_set(
    teeth: tuple[int, int, int, int] = MESHED,
    planets: int = 3,
    held: str = "ring",
    ends: tuple[str, str] = ("sun", "carrier"),
    **changes: Any,
) -> dict[str, Any]:
    """The same of planets that mesh with each other."""
    return _set("meshed", teeth, planets, held, ends, changes)


def ravigneaux_set(
    held: str = "second_sun",
    ends: tuple[str, str] = ("sun", "ring"),
    teeth: tuple[int, int, int, int, int] = RAVIGNEAUX,
    planets: int = 3,
    **changes: Any,
) -> dict[str, Any]:
    """The same of a Ravigneaux set, whose second sun is called large."""
    gear = {"large": {"teeth": teeth[4], "bore_diameter": "60 mm", "face_width": "30 mm"}}
    return _set("ravigneaux", teeth[:4], planets, held, ends, {"second_sun": "large", "gear": gear} | changes)


def _set(
    kind: str,
    teeth: tuple[int, ...],
    planets: int,
    held: str,
    ends: tuple[str, str],
    changes: dict[str, Any],
) -> dict[str, Any]:
    sun, planet, second, ring = teeth
    size = {"bore_diameter": "10 mm", "face_width": "30 mm"}
    gear = {name: {"teeth": z} | size for name, z in (("sun", sun), ("planet", planet), ("step", second))}
    gear |= changes.pop("gear", {})
    own = {"type": kind, "second_planet": "step", "gear": gear}
    return planet_set((sun, planet, ring), planets, held, ends, **own | changes)
