"""Path of contact of an involute pair of 20° from its printed data."""

import math

from tribodyn.standards.contact_path import ContactPath, transverse_angle


def path_of(
    module: float,
    teeth: tuple[float, float],
    axes: float,
    tips: tuple[float, float],
    helix: float,
    width: float,
) -> ContactPath:
    """Path of contact from module, axes, tip radii and width in mm, helix in degrees; of a ring negative."""
    beta, normal = math.radians(helix), math.radians(20.0)
    angle = transverse_angle(normal, beta)
    transverse = module / math.cos(beta)
    bases = [count * transverse * math.cos(angle) / 2.0 for count in teeth]
    return ContactPath(
        teeth,
        (bases[0] * 1e-3, bases[1] * 1e-3),
        (tips[0] * 1e-3, tips[1] * 1e-3),
        math.acos(sum(bases) / axes),
        math.asin(math.sin(beta) * math.cos(normal)),
        width * math.tan(beta) / (math.pi * transverse),
    )
