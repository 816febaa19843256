"""FZG gears in the reports of GEARpie: loss factors, mean friction and the loss under load.

The program takes the radius of curvature of its friction in the transverse section. Beside its losses stand
those of an efficiency study: loads by elastic teeth, and the law nearest to the contact solved at the duty.
"""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

from tribodyn.geometry.drive import SIDES
from tribodyn.standards import contact_path, loss_factors
from tribodyn.standards.mesh_loss import friction
from tribodyn.studies.efficiency.run import quantities_of
from tribodyn.studies.protocol.load import load_data
from tribodyn.validation.books.pair_path import path_of
from tribodyn.validation.published import published
from tribodyn.validation.rows import Row, compare

BOOK = "fzg-gears-gearpie"


class TestGears(NamedTuple):
    """FZG gears on 91.5 mm, their duty and oil: mm, degrees, N m, 1/min, mPa s, 1/GPa, µm, °C."""

    module: float
    teeth: tuple[float, float]
    width: float
    helix: float
    tips: tuple[float, float]  # radii
    torque: float
    speed: float
    viscosity: float
    pressure_viscosity: float
    roughness: float
    oil: str
    temperature: float
    shifts: tuple[float, float]


#: Oils of the program: type and X_L; m and n of lg lg(ν + 0.7) = m − n lg T in mm²/s; kg/m³ at 15 °C.
OILS = {
    "M32": ("mineral", 0.846, 9.5259, 3.7449, 902.0),
    "M150": ("mineral", 0.846, 9.0379, 3.4861, 902.0),
    "P320": ("pao", 0.65, 7.3514, 2.7865, 859.0),
}
_SPUR, _SHIFTS = (4.5, (16.0, 24.0)), (0.1817, 0.1715)
TESTS = {
    "C14": TestGears(
        *(*_SPUR, 14.0, 0.0, (41.318, 59.272), 200.0, 1500.0),
        *(13.28, 20.47, 0.355, "M32", 60.0, _SHIFTS),
    ),
    "C40": TestGears(
        *(*_SPUR, 40.0, 0.0, (41.318, 59.272), 215.5, 1800.0),
        *(49.85, 20.36, 0.355, "P320", 80.0, _SHIFTS),
    ),
    "H501": TestGears(
        *(3.5, (20.0, 30.0), 23.0, 15.0, (40.336, 58.132), 100.0, 1000.0),
        *(32.67, 50.23, 0.6, "M150", 70.0, (0.1809, 0.0891)),
    ),
    "H701": TestGears(
        *(2.5, (28.0, 42.0), 17.0, 15.0, (39.276, 57.193), 200.0, 1500.0),
        *(49.85, 20.36, 0.6, "P320", 80.0, (0.2290, 0.1489)),
    ),
    "H951": TestGears(
        *(1.75, (38.0, 57.0), 21.2418, 15.0, (38.115, 55.867), 200.0, 1000.0),
        *(32.67, 50.23, 0.6, "M150", 70.0, (1.6915, 2.0003)),
    ),
}
_AXES = 91.5


def _values() -> dict[str, Any]:
    values: dict[str, Any] = {}
    for name, gears in TESTS.items():
        path = path_of(gears.module, gears.teeth, _AXES, gears.tips, gears.helix, gears.width)
        tips, base_helix = path.tip_contact_ratios, path.base_helix_angle
        shape = path.teeth[0], path.ratio, base_helix
        speed = gears.speed * math.pi / 30.0
        force = gears.torque / path.base_radius[0] / math.cos(base_helix)
        length = 1e-3 * gears.width
        length *= loss_factors.least_line_length(path.contact_ratio, path.overlap_ratio, base_helix)
        point = path.length - tips[0] * path.base_pitch
        radius = float(contact_path.equivalent_radius(path, point)) * math.cos(base_helix)
        speeds = float(sum(contact_path.rolling_speeds(path, point, speed)))
        oil = 1e-3 * gears.viscosity, 1e-9 * gears.pressure_viscosity
        rough = 1e-6 * gears.roughness
        schlenk = friction.schlenk(force / length, speeds, radius, oil[0], rough, OILS[gears.oil][1])
        local = loss_factors.of_rigid_lines(*tips, path.overlap_ratio, *shape)
        values |= {
            f"eps_alpha-{name}": path.contact_ratio,
            f"eps_beta-{name}": path.overlap_ratio,
            f"F_bn-{name}": force,
            f"H_VL-{name}": local,
            f"H_V-{name}": loss_factors.hoehn(*tips, *shape),
            f"mu_Schlenk-{name}": schlenk,
            f"mu_Fernandes-{name}": friction.fernandes(
                *(force, length, speeds, radius, *oil, rough, OILS[gears.oil][1])
            ),
            f"P_VZP-{name}": gears.torque * speed * local * schlenk,
        }
    return values


def _study(name: str, gears: TestGears) -> dict[str, Any]:
    """Quantities of an efficiency study of a test."""
    kind, _, order, slope, density = OILS[gears.oil]
    at = (10.0**10.0 ** (order - slope * math.log10(kelvin)) - 0.7 for kelvin in (313.15, 373.15))
    viscosity = dict(zip(("viscosity_40", "viscosity_100"), (f"{nu} mm**2/s" for nu in at), strict=True))
    sides = {
        side: {
            "teeth": int(count),
            "face_width": f"{gears.width} mm",
            "bore_radius": "15 mm",
            "profile_shift": shift,
            "tip_diameter": f"{2.0 * tip} mm",
        }
        for side, count, shift, tip in zip(SIDES, gears.teeth, gears.shifts, gears.tips, strict=True)
    }
    scenario = {
        "title": name,
        "kind": "efficiency",
        "drive": {
            "family": "involute",
            "module": f"{gears.module} mm",
            "pressure_angle": "20 deg",
            "helix_angle": f"{gears.helix} deg",
            "centre_distance": f"{_AXES} mm",
            "mean_roughness": f"{gears.roughness} um",
            "material": {"like": "16MnCr5"},
            **sides,
        },
        "lubricant": {"type": kind, "density_15": f"{density} kg/m**3", **viscosity},
        "operating": {
            "gear_torque": f"{gears.torque * gears.teeth[1] / gears.teeth[0]} N*m",
            "pinion_speed": f"{gears.speed} rpm",
            "oil_temperature": f"{gears.temperature} degC",
        },
        "friction": {"law": "auto"},
    }
    return quantities_of(load_data(scenario, name).case)


def rows(folder: Path, progress: Callable[[float], None]) -> list[Row]:
    """Compare every row; that of a loss says what an efficiency study gives."""
    ours, notes = _values(), {}
    for done, (name, gears) in enumerate(TESTS.items(), start=1):
        found = _study(name, gears)
        notes[f"P_VZP-{name}"] = (
            f"with elastic teeth and the law nearest to the solved contact ({found['friction_law']}) "
            f"{found['power_friction_mean']:.3g} W"
        )
        progress(done / len(TESTS))
    keys = {key: key.partition("/")[2] for key in published(BOOK)}
    return [compare(row, ours[keys[key]], notes.get(keys[key], "")) for key, row in published(BOOK).items()]
