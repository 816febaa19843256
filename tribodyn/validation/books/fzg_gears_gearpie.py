"""FZG gears in the reports of GEARpie: loss factors, mean friction and the loss under load.

The program takes the radius of curvature of its friction in the transverse section, and sums the loss factor
over a thousand places of the plane of action. Beside its losses stand those of an efficiency study.
"""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from tribodyn.standards import contact_path, loss_factors
from tribodyn.standards.mesh_loss import friction
from tribodyn.validation.books import rows_of
from tribodyn.validation.books.printed_pair import PrintedPair, own_loss

BOOK = "fzg-gears-gearpie"
#: Places along ε_α + ε_β over which the program sums.
_PLACES = 1000
_AXES = 91.5


class GearTest(NamedTuple):
    """A pair and its duty: N m, 1/min, mPa s, 1/GPa, °C."""

    pair: PrintedPair
    torque: float
    speed: float
    viscosity: float
    pressure_viscosity: float
    oil: str
    temperature: float


#: Oils of the program: type and X_L; m and n of lg lg(ν + 0.7) = m − n lg T in mm²/s; kg/m³ at 15 °C.
OILS = {
    "M32": ("mineral", 0.846, 9.5259, 3.7449, 902.0),
    "M150": ("mineral", 0.846, 9.0379, 3.4861, 902.0),
    "P320": ("pao", 0.65, 7.3514, 2.7865, 859.0),
}
_C14 = PrintedPair(4.5, (16.0, 24.0), (0.1817, 0.1715), _AXES, (41.318, 59.272), 14.0, 0.355)
_H501 = PrintedPair(3.5, (20.0, 30.0), (0.1809, 0.0891), _AXES, (40.336, 58.132), 23.0, 0.6, 15.0)
_H701 = PrintedPair(2.5, (28.0, 42.0), (0.2290, 0.1489), _AXES, (39.276, 57.193), 17.0, 0.6, 15.0)
_H951 = PrintedPair(1.75, (38.0, 57.0), (1.6915, 2.0003), _AXES, (38.115, 55.867), 21.2418, 0.6, 15.0)
#: Of the C40 the torque of its printed power, 40 623.2 W; 215.5 N m is printed.
TESTS = {
    "C14": GearTest(_C14, 200.0, 1500.0, 13.28, 20.47, "M32", 60.0),
    "C40": GearTest(_C14._replace(width=40.0), 215.513, 1800.0, 49.85, 20.36, "P320", 80.0),
    "H501": GearTest(_H501, 100.0, 1000.0, 32.67, 50.23, "M150", 70.0),
    "H701": GearTest(_H701, 200.0, 1500.0, 49.85, 20.36, "P320", 80.0),
    "H951": GearTest(_H951, 200.0, 1000.0, 32.67, 50.23, "M150", 70.0),
}


def _values() -> dict[str, Any]:
    values: dict[str, Any] = {}
    for name, test in TESTS.items():
        path = test.pair.path()
        tips, base_helix = path.tip_contact_ratios, path.base_helix_angle
        shape = path.teeth[0], path.ratio, base_helix
        speed = test.speed * math.pi / 30.0
        force = test.torque / path.base_radius[0] / math.cos(base_helix)
        length = 1e-3 * test.pair.width
        length *= loss_factors.least_line_length(path.contact_ratio, path.overlap_ratio, base_helix)
        point = path.length - tips[0] * path.base_pitch
        radius = float(contact_path.equivalent_radius(path, point)) * math.cos(base_helix)
        speeds = float(sum(contact_path.rolling_speeds(path, point, speed)))
        oil = 1e-3 * test.viscosity, 1e-9 * test.pressure_viscosity
        rough, lubricant = 1e-6 * test.pair.roughness, OILS[test.oil][1]
        schlenk = friction.schlenk(force / length, speeds, radius, oil[0], rough, lubricant)
        local = _summed(path, 1e-3 * test.pair.width)
        values |= {
            f"eps_alpha-{name}": path.contact_ratio,
            f"eps_beta-{name}": path.overlap_ratio,
            f"F_bn-{name}": force,
            f"H_VL-{name}": local,
            f"H_V-{name}": loss_factors.hoehn(*tips, *shape),
            f"mu_Schlenk-{name}": schlenk,
            f"mu_Fernandes-{name}": friction.fernandes(force, length, speeds, radius, *oil, rough, lubricant),
            f"P_VZP-{name}": test.torque * speed * local * schlenk,
        }
    return values


def _summed(path: contact_path.ContactPath, width: float) -> float:
    """Wimmer's loss factor of rigid teeth by the trapezoidal rule, over those places that lie before E.

    Of as many places across the face width as have the same distance. Both rules leave out what lies between
    the last place and the end; `loss_factors.of_rigid_lines` is the sum of infinitely many places.
    """
    ratio, overlap = path.contact_ratio, path.overlap_ratio
    pitch, helix = path.base_pitch, path.base_helix_angle
    along = np.linspace(0.0, ratio + overlap, _PLACES)
    along = along[along < ratio]
    across = np.linspace(0.0, 1.0, int(width * _PLACES / (ratio * pitch)))
    ends = along[:, None] + across * overlap + np.arange(-4.0, 5.0)[:, None, None]
    if overlap:
        parts = np.minimum(ends, ratio) - np.maximum(ends - overlap, 0.0)
        lines = np.maximum(parts, 0.0).sum(axis=0) * pitch / math.sin(helix)
    else:
        lines = ((ends >= 0.0) & (ends < ratio)).sum(axis=0) * width
    sliding = np.abs(along * pitch - path.length + path.tip_contact_ratios[0] * pitch)
    sliding *= (1.0 + 1.0 / path.ratio) / path.base_radius[0] / math.cos(helix) ** 2
    share = np.trapezoid(1.0 / lines, across * width, axis=1)
    return float(np.trapezoid(share * sliding, along * pitch)) / pitch


def _lubricant(oil: str) -> dict[str, str]:
    kind, _, order, slope, density = OILS[oil]
    known = {"type": kind, "density_15": f"{density} kg/m**3"}
    for name, kelvin in (("viscosity_40", 313.15), ("viscosity_100", 373.15)):
        known[name] = f"{10.0**10.0 ** (order - slope * math.log10(kelvin)) - 0.7} mm**2/s"
    return known


def _own(progress: Callable[[float], None]) -> dict[str, str]:
    said = {}
    for done, (name, test) in enumerate(TESTS.items(), start=1):
        found = test.pair.study(_lubricant(test.oil), test.temperature, test.torque, test.speed)
        said[f"P_VZP-{name}"] = own_loss(found, "W")
        progress(done / len(TESTS))
    return said


rows = rows_of(BOOK, _values, _own)
