"""A mate's tip that would touch the fillet: the tool's rounding that leaves enough of the flank is named."""

import math
import re

import pytest

import tribodyn as td

#: Helical pair of large shifts (FZG, 38/57): the tool's rounding, 0.38, takes flank that the tips need.
PAIR = {
    "title": "A pair whose tips reach the fillets",
    "source": "own",
    "family": "involute",
    "module": "1.75 mm",
    "pressure_angle": "20 deg",
    "helix_angle": "15 deg",
    "centre_distance": "91.5 mm",
    "material": "18CrNiMo7-6",
    "mean_roughness": "0.3 um",
    "pinion": {"teeth": 38, "profile_shift": 1.6915, "tip_diameter": "76.23 mm"},
    "gear": {"teeth": 57, "profile_shift": 2.0003, "tip_diameter": "111.734 mm"},
}
BODY = {"face_width": "21.2418 mm", "dedendum": 1.25, "fillet_radius": 0.38, "bore_radius": "15 mm"}


def largest_rounding(z: int, other: int, shift: float, tip_diameter: float) -> float:
    """Rounding at which the flank that a rack of dedendum 1.25 cuts begins where the mate's tip touches.

    Lengths over the module, along the line of contact from the point where it touches the base circle.
    """
    normal, cos_helix = math.radians(20.0), math.cos(math.radians(15.0))
    transverse = math.atan(math.tan(normal) / cos_helix)
    radius = z / (2.0 * cos_helix)
    base, mate = (teeth / (2.0 * cos_helix) * math.cos(transverse) for teeth in (z, other))
    distance = 91.5 / 1.75
    touches = math.sqrt(distance**2 - (base + mate) ** 2) - math.sqrt((tip_diameter / 3.5) ** 2 - mate**2)
    depth = shift - (touches - radius * math.sin(transverse)) * math.sin(transverse)
    return (1.25 - depth) / (1.0 - math.sin(normal))


def test_the_rounding_that_is_named_lets_the_pair_run():
    given = {"pinion": dict(PAIR["pinion"]), "gear": dict(PAIR["gear"])}
    limits = {
        "pinion": largest_rounding(38, 57, 1.6915, 111.734),
        "gear": largest_rounding(57, 38, 2.0003, 76.23),
    }
    for side, limit in limits.items():
        with pytest.raises(td.InputError) as error:
            td.drive(PAIR | {name: BODY | body for name, body in given.items()})
        named = re.search(rf"or drive\.{side}\.fillet_radius of at most ([\d.]+)", str(error.value))
        assert named, error.value
        # the corner of the tip has to pass the fillet too, which asks for slightly less
        assert 0.95 * limit < float(named[1]) <= limit
        given[side]["fillet_radius"] = float(named[1])
    assert td.drive(PAIR | {name: BODY | body for name, body in given.items()}).contact_ratio > 0.5
