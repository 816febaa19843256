"""Gears that this version does not model, or that a kind of study has not, by what asks for them."""

import re
from typing import Any

from tribodyn.errors import InputError

INTERNAL, STAGES, HELIX, PLANETS = "internal gears", "several stages", "a helix", "planetary gears"
#: What is asked for -> the keys and names that ask for it, and what to do about it.
_OUTSIDE = {
    "double helical gears": (r"herringbone|double_?heli", "describe one half of it, with helix_angle"),
    HELIX: (
        r"helix|helical|^beta(_|$)",
        'write helix_angle = "20 deg" in [drive] of a gear pair, and hand = "left" of a left-hand pinion',
    ),
    INTERNAL: (
        r"^internal(_(gears?|teeth|mesh))?$|annulus|^ring(_|$)",
        "write internal = true in [drive.gear], and all numbers of teeth and lengths without sign",
    ),
    PLANETS: (
        r"planet|epicyclic|^(sun|carrier)s?(_|$)",
        'write a [[stage]] of type = "planetary" in a scenario of the kind for trains (tribodyn list kinds)',
    ),
    STAGES: (
        r"multi_?stage|^((n|number_of)_)?(stage|shaft|gearbox|gear_?train|train|idler|gears|mesh(es)?|"
        r"((pinion|gear|wheel)_?\d+))(e?s)?(_?\d+)?$",
        "write [gear.NAME] and [[stage]] in a scenario of the kind for trains (tribodyn list kinds), "
        "or describe one stage as [drive.pinion] and [drive.gear]",
    ),
    "bevel, worm and hypoid gears": (r"bevel|worm|hypoid|(cone|shaft|spiral)_angle", "omit it"),
}
#: What to do about a helix in a scenario that has several stages.
_STAGED_HELIX = (
    'write helix_angle = "20 deg" in its [[stage]], and hand = "left" in [gear.NAME] of a left-hand gear'
)


def outside(error: InputError, *names: str, remedy: str = "", but: tuple[str, ...] = ()) -> InputError | None:
    """What to say in place of an unknown key or name that asks for other gears; None where it does not.

    `names` are the key's last part, or the name, and others that may ask for them; `but` is what the scenario
    may ask for.
    """
    plain = [re.sub(r"[\s-]+", "_", name.strip().lower()) for name in names]
    for what, (pattern, _) in _OUTSIDE.items():
        if what not in but and any(re.search(pattern, name) for name in plain):
            helix = _STAGED_HELIX if STAGES in but else _OUTSIDE[HELIX][1]
            return refusal(error, what, helix if what == HELIX else remedy)
    return None


def refusal(error: InputError, what: str, remedy: str = "") -> InputError:
    """What to say, in place of an error, of a value that asks for gears which its kind of study has not."""
    if what == STAGES:
        rule = f"{STAGES} are of another kind of study"
        return InputError(error.key, error.value, rule, _OUTSIDE[STAGES][1], error.file)
    if what == HELIX:
        rule = "the key of a helix is helix_angle, of both gears together"
        return InputError(error.key, error.value, rule, remedy, error.file)
    if what == INTERNAL:
        rule = "the key of an internal gear is internal, of the gear that it is"
        parts = error.key.split(".")
        named = len(parts) > 2 and parts[-3] == "gear"  # of a train
        remedy = _OUTSIDE[INTERNAL][1]
        if named:
            remedy = remedy.replace("[drive.gear]", f"[{'.'.join(parts[:-1])}]")
        return InputError(error.key, error.value, rule, remedy, error.file)
    if what == PLANETS:
        rule = f"{PLANETS} are a stage of a train"
        return InputError(error.key, error.value, rule, _OUTSIDE[PLANETS][1], error.file)
    rule = f"{what} are not modelled: this version computes spur and helical gears"
    return InputError(error.key, error.value, rule, remedy or _OUTSIDE[what][1], error.file)


def names_gears(name: str, value: Any) -> bool:
    """Whether an unknown key is a table of a train: [gear.NAME], [[body]] or [[link]]."""
    if name == "gear":
        return (
            isinstance(value, dict) and bool(value) and all(isinstance(one, dict) for one in value.values())
        )
    return name in ("body", "link") and isinstance(value, list)
