"""Phases at which teeth mesh on a gear with several mates, and periods of trains, by counting teeth.

Phases are in mesh cycles. That of a mesh is 0 where a pair of teeth touches at the pitch point; `at_entry`
moves it to where a pair enters. Angles on a gear are polar angles about its axis, positive in its own sense
of rotation: of a clockwise gear the negative of the azimuth.
"""

from fractions import Fraction
from itertools import pairwise
from math import gcd, lcm, pi, tan

#: Whether the gear drives in a mesh, with the leading flanks of its teeth, or is driven on the trailing ones.
DRIVES, DRIVEN = 1, -1


def involute(angle: float) -> float:
    """inv α = tan α − α."""
    return tan(angle) - angle


def half_tooth(teeth: int, shift: float, pressure_angle: float, operating: float) -> float:
    """Half the angle of a tooth at an operating pitch circle: (π/2 + 2 x tan α)/z + inv α − inv α_w, rad.

    Teeth cut by a rack of `pressure_angle` with the profile shift x in modules, without backlash.
    """
    return (pi / 2 + 2 * shift * tan(pressure_angle)) / teeth + involute(pressure_angle) - involute(operating)


def idler_phase(teeth: int, towards_driver: float, towards_driven: float, nu_1: float, nu_2: float) -> float:
    """Phase of an idler's second mesh over its first, γ_2 − γ_1 = z (ψ_1 − ψ_3 + ν_1 + ν_2)/2π, in [0, 1).

    Its driver pushes the trailing flank of a tooth, ν_1 behind the tooth's axis; the tooth's leading flank,
    ν_2 ahead, pushes the gear that it drives. `nu` are `half_tooth` at the two operating pitch circles.
    """
    return (teeth * (towards_driver - towards_driven + nu_1 + nu_2) / (2 * pi)) % 1.0


def shared_gear_phase(
    teeth: int,
    angles: tuple[float, float],
    halves: tuple[float, float],
    roles: tuple[int, int],
) -> float:
    """The same of any two meshes of one gear, which drives or is driven in each, in [0, 1).

    A flank that stands σ ν from its tooth's axis is at the pitch point at ψ when the axis is at ψ − σ ν. With
    one role and one operating circle only the angle between the mates counts.
    """
    places = [angle - role * half for angle, half, role in zip(angles, halves, roles, strict=True)]
    return (teeth * (places[0] - places[1]) / (2 * pi)) % 1.0


def rigid_shaft_phase(
    teeth: int,
    angles: tuple[float, float],
    halves: tuple[float, float],
    roles: tuple[int, int],
    offset: float,
) -> float:
    """Phase of the mesh of a shaft's second gear when that of its first is at 0, in [0, 1).

    `teeth` are the second gear's; an axis of its teeth stands `offset` ahead of one of the first gear's,
    which is the tooth that then touches. Another one of them moves the phase by the ratio of the numbers of
    teeth.
    """
    places = [angle - role * half for angle, half, role in zip(angles, halves, roles, strict=True)]
    return (teeth * (places[0] + offset - places[1]) / (2 * pi)) % 1.0


def at_entry(phase: float, pitch_points: tuple[float, float], rate: float = 1.0) -> float:
    """A phase of a second mesh over a first, counted in both from where a pair enters, in [0, 1).

    `pitch_points` are the phases, so counted, at which pairs pass the pitch point; `rate` cycles of the
    second mesh go to one of the first.
    """
    return (phase + pitch_points[1] - rate * pitch_points[0]) % 1.0


def rates(stages: list[tuple[int, int]]) -> list[Fraction]:
    """Mesh cycles of each stage of a reducer in one of the first; teeth of driver and driven per stage."""
    found = [Fraction(1)]
    for (_, driven), (driver, _) in pairwise(stages):
        found.append(found[-1] * Fraction(driver, driven))
    return found


def common_period(of: list[Fraction]) -> int:
    """Mesh cycles of the first mesh after which all are at their phases again."""
    return lcm(*(rate.denominator for rate in of))


def turns_of_shared_shaft(first: int, second: int) -> Fraction:
    """Turns after which two gears on one shaft are at their phases again: 1/gcd(z_2, z_3)."""
    return Fraction(1, gcd(first, second))
