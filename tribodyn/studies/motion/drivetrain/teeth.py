"""How the teeth of a train stand to each other: what phases need of every mesh, and whether teeth agree.

A gear that meshes with two others has one shape of tooth, whichever of its mates it is worked out with.
"""

from collections.abc import Sequence

import numpy as np

from tribodyn.errors import InputError, quoted
from tribodyn.geometry.assembly import Assembly, half_angles
from tribodyn.geometry.drive import Drive, Side, body_of, tip_radius
from tribodyn.geometry.families import family
from tribodyn.geometry.path import seen_from
from tribodyn.geometry.tooth import thickness_half_angle
from tribodyn.train.phases import Engagement

#: Difference of half thicknesses by which two shapes of one gear's teeth are the same, m.
SAME_TOOTH = 1e-6
_RADII = 9
#: Signed distances in modules, and the difference in rad by which two paths of contact are the same.
_OVER_MODULE, _SAME_ANGLE = np.linspace(-1.0, 1.0, 9), 1e-8


def engagement(
    key: str, gears: tuple[int, int], azimuth: float, assembly: Assembly, entry: float | None = None
) -> Engagement:
    """What the phase of a mesh needs: its driver is the assembly's pinion.

    `entry` is the pinion's angle (rad from the pitch point) at phase 0 of its mesh cycle, `roll_start` of the
    table; None: the beginning of the path of contact.
    """
    begins = float(assembly.roll_limits[0]) if entry is None else entry
    return Engagement(key, gears, azimuth, half_angles(assembly), begins)


def check_same_teeth(key: str, name: str, seen: Sequence[tuple[Assembly, Side]]) -> None:
    """Raise InputError where a gear's teeth, in each of its meshes, are not the same.

    `seen` are the meshes with what the gear is in them, `key` and `name` the gear's.
    """
    first, side = seen[0]
    for other in seen[1:]:
        both: list[tuple[Assembly, Side]] = [seen[0], other]
        bounds = [
            (float(one.tooth(which).form_radius), float(tip_radius(one.drive, which))) for one, which in both
        ]
        low, high = max(below for below, _ in bounds), min(above for _, above in bounds)
        radii = np.linspace(low, high, _RADII)
        halves = [radii * np.asarray(thickness_half_angle(one.tooth(which), radii)) for one, which in both]
        apart = float(np.max(np.abs(halves[0] - halves[1])))
        apart = max(apart, abs(bounds[0][1] - bounds[1][1]))
        if not apart <= SAME_TOOTH:
            teeth = round(float(body_of(first.drive, side).teeth))
            rule = f"its {teeth} teeth differ by {1e6 * apart:.3g} um between the stages that it belongs to"
            remedy = "give both stages the same family, module, pressure angle and shape"
            raise InputError(key, name, rule, remedy)


def check_planet(key: str, name: str, meshes: Sequence[tuple[Drive, Side]]) -> None:
    """Raise InputError where the meshes with sun and ring need planets of different teeth.

    A planet's tooth has one path of contact with its rack, and with every gear of a family but the involute
    the same. `meshes` are those of one planet, with what it is in them, `key` and `name` the family's.
    """
    teeth = family(name)
    if teeth.involute:
        return
    with np.errstate(invalid="ignore"):
        one, two = (
            seen_from(teeth.working_path(drive), side).pressure_angle(drive.module * _OVER_MODULE)
            for drive, side in meshes
        )
    if not np.all(np.abs(one - two) <= _SAME_ANGLE):
        rule = (
            "the mesh with the sun fixes the planets' teeth, and the ring needs others: "
            "seen from the planet, their paths of contact differ"
        )
        remedy = "use involutes, or paths alike on both sides of P, such as cycloids of equal circles"
        raise InputError(key, quoted(name), rule, remedy)
