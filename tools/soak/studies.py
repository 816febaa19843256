"""Random scenarios of the studies beside a gear pair's dynamics."""

import math
from typing import Any

from tools.soak.draw import Draw, quantity
from tools.soak.drives import size_of
from tools.soak.duties import MOST_SLOW_STEPS, laws, lubricant, scale_of, torque

#: Oils by their data sheets, thin and thick.
OILS = ("75w90", "atf", "iso-vg-32-mineral", "iso-vg-100-pao", "iso-vg-220-mineral", "iso-vg-460-pao")


def efficiency(draw: Draw, drive: dict[str, Any]) -> dict[str, Any]:
    """Return the scenario of an efficiency study."""
    speed = draw.decades(0.01, 3000.0)
    mesh: dict[str, Any] = {"load_sharing": draw.choice(("elastic", "uniform", "single-pair"))}
    if draw.chance(0.1):
        mesh["compliance"] = "fem"
    elif draw.chance(0.3):
        mesh["hertz"] = "load-dependent"
    return {
        "title": "A random efficiency study",
        "kind": "efficiency",
        "drive": drive,
        "lubricant": lubricant(draw),
        "operating": {
            "pinion_speed": quantity(speed, "rad/s"),
            "gear_torque": quantity(draw.choice((1, 1, -1)) * torque(draw, scale_of(drive, speed)), "N*m"),
        },
        "mesh": mesh,
        **laws(draw),
        "output": {"samples_per_cycle": draw.choice((16, 100))},
    }


def load_contact(draw: Draw, drive: dict[str, Any]) -> dict[str, Any]:
    """Return the scenario of a load contact study."""
    module, *_, width = size_of(drive)
    load = torque(draw, scale_of(drive, 1.0))
    for name in ("pinion", "gear"):
        if draw.chance(0.5):
            drive = {
                **drive,
                name: {
                    **drive[name],
                    "modification": _modification(draw, drive[name]["teeth"], module, width),
                },
            }
    mesh: dict[str, Any] = {"slices": draw.choice((1, 3, 7, 15)), "slice_coupling": draw.chance(0.8)}
    if draw.chance(0.3):
        mesh["friction_coefficient"] = draw.between(0.0, 0.2)
    if mesh["slices"] > 1 and draw.chance(0.5):
        angles = (quantity(draw.between(-3.0, 3.0), "arcmin") for _ in range(2))
        mesh["misalignment"] = dict(zip(("in_plane", "out_of_plane"), angles, strict=True))
    operating: dict[str, Any] = {"gear_torque": quantity(load, "N*m")}
    if draw.chance(0.2):
        operating["gear_torques"] = [quantity(share * load, "N*m") for share in (0.2, 1.5)]
    return {
        "title": "A random load contact study",
        "kind": "load-contact",
        "drive": drive,
        "operating": operating,
        "mesh": mesh,
        "output": {"positions_per_cycle": draw.choice((8, 20)), "cycles": draw.choice((1, 1, 2))},
    }


def wear(draw: Draw, drive: dict[str, Any]) -> dict[str, Any]:
    """Return the scenario of a wear study: flanks worn by a few micrometres, on few positions."""
    found, speed = load_contact(draw, drive), draw.decades(0.1, 300.0)
    gears = [found["drive"][name] for name in ("pinion", "gear")]
    each = math.lcm(*(int(gear["teeth"]) for gear in gears)) <= 200 and draw.chance(0.5)
    if not each:
        for gear in gears:
            gear.get("modification", {}).pop("pitch_errors", None)
    oiled, coefficient = draw.chance(0.7), draw.decades(1e-19, 1e-16)
    law = draw.choice(("priest-taylor", "archard-asperities", "archard", "energy") if oiled else ("archard",))
    own = {"energy_coefficient" if law == "energy" else "coefficient": quantity(coefficient, "m**2/N")}
    load = abs(float(found["operating"]["gear_torque"].split()[0]))
    module, *_, width = size_of(drive)
    line_load = load / (0.5 * module * int(gears[1]["teeth"]) * width)
    depth = draw.decades(1e-9, 3e-6)
    operating: dict[str, Any] = {
        "gear_torque": found["operating"]["gear_torque"],
        "pinion_speed": quantity(speed, "rad/s"),
    }
    friction: dict[str, Any] = {"friction": {"law": "coulomb", "coefficient": draw.between(0.01, 0.1)}}
    if oiled:
        friction = laws(draw) if law != "energy" else friction
    return {
        "title": "A random wear study",
        "kind": "wear",
        "drive": found["drive"],
        **({"lubricant": lubricant(draw)} if oiled else {}),
        "operating": operating,
        "wear": {
            "law": law,
            **own,
            "revolutions": max(1.0, depth / coefficient / line_load),
            "teeth": "each" if each else "alike",
        },
        "mesh": {key: value for key, value in found["mesh"].items() if key != "friction_coefficient"},
        **friction,
        "output": {"positions_per_cycle": draw.choice((12, 30))},
    }


def solved_contact(draw: Draw, drive: dict[str, Any]) -> dict[str, Any]:
    """Return the scenario of a study of the solved contact, at few positions on a coarse grid."""
    speed = draw.decades(0.1, 1000.0)
    return {
        "title": "A random study of the solved contact",
        "kind": "ehl",
        "drive": drive,
        "lubricant": lubricant(draw),
        "operating": {
            "pinion_speed": quantity(speed, "rad/s"),
            "gear_torque": quantity(torque(draw, scale_of(drive, speed)), "N*m"),
        },
        "mesh": {"compliance": draw.choice(("energy", "fem"), (9, 1))},
        "contact": {"step": 0.25, "transient": draw.chance(0.2)},
        "output": {"positions": 4},
    }


def assessment(draw: Draw, drive: dict[str, Any]) -> dict[str, Any]:
    """Return the scenario of an assessment with as little beyond the duty as there may be."""
    speed = draw.decades(3.0, 500.0)
    laws = ["masjedi-khonsari", "xu"] if draw.chance(0.3) else ["masjedi-khonsari"]
    return {
        "title": "A random assessment",
        "kind": "assessment",
        "drive": {**drive, "quality": draw.whole(3, 10)},
        "lubricant": draw.choice(OILS),
        "bearings": draw.choice(("rigid-1e9", "medium-4e8", "soft-1e8")),
        "operating": {
            "pinion_speed": quantity(speed, "rad/s"),
            "gear_torque": quantity(torque(draw, scale_of(drive, speed)), "N*m"),
            "oil_temperature": quantity(draw.between(20.0, 120.0), "degC"),
        },
        "mesh": {
            "misalignment": {"in_plane": quantity(draw.choice((0.0, draw.between(-0.5, 0.5))), "arcmin")}
        },
        "assessment": {
            "application_factor": draw.between(1.0, 2.0),
            "lubrication": draw.choice(("dip", "spray", "submerged")),
            "torque_shares": [0.5, 1.0],
            "speed_range": [0.5, 1.5],
            "speeds": 8,
            "samples": draw.choice((0, 2)),
            "friction_laws": laws,
        },
    }


def _modification(draw: Draw, teeth: int, module: float, width: float) -> dict[str, Any]:
    table: dict[str, Any] = {}
    for end in ("tip", "root"):
        if draw.chance(0.4):
            table[f"{end}_relief"] = quantity(draw.decades(1.0, 60.0), "um")
            table[f"{end}_relief_length"] = quantity(1e3 * module * draw.between(0.2, 1.5), "mm")
            table[f"{end}_relief_shape"] = draw.choice(("linear", "parabolic"))
    if draw.chance(0.3):
        table["crowning"] = quantity(draw.decades(0.5, 30.0), "um")
    elif draw.chance(0.3):
        table["lead_relief_start"] = quantity(draw.decades(0.5, 30.0), "um")
        table["lead_unmodified"] = quantity(1e3 * width * draw.between(0.0, 0.7), "mm")
    if draw.chance(0.2):
        table["pitch_errors"] = [quantity(draw.between(-5.0, 5.0), "um") for _ in range(teeth)]
    return table


def steady(scenario: dict[str, Any]) -> dict[str, Any]:
    """Return the duty of a gear pair without what a steady state cannot have: loads over time."""
    operating = {
        key: value
        for key, value in scenario["operating"].items()
        if key not in ("gear_torque_harmonics", "gear_torque_table")
    }
    solver = {**scenario["solver"], "rtol": 1e-6}
    return marched({**scenario, "operating": operating, "solver": solver})


def marched(scenario: dict[str, Any]) -> dict[str, Any]:
    """Return the duty of a gear pair as a sweep runs it: by native methods, with few samples."""
    solver = {**scenario["solver"], "method": "auto", "cycles": 8, "max_steps": MOST_SLOW_STEPS}
    return {**scenario, "solver": solver, "output": {"samples_per_cycle": 16}}
