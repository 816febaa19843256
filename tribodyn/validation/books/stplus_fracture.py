"""Tooth flank fracture of the FZG gears in the listing of STplus: ISO/TS 6336-4:2019 at seven points."""

from typing import Any

import numpy as np

from tribodyn.gears.rating.fracture import middle_thickness
from tribodyn.gears.rating.standard import Standard
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES
from tribodyn.standards import contact_path, micropitting
from tribodyn.standards.case_hardening import flank_fracture
from tribodyn.standards.case_hardening.flank_fracture import USUAL_CASE_DEPTH, HardenedCase
from tribodyn.standards.metals import VICKERS

#: Hardness as printed, the usual case depth, which is the printed one; depths over b_H: the listing's are
#: eleventh parts.
_CASE = HardenedCase(750.0 * VICKERS, 380.0 * VICKERS, USUAL_CASE_DEPTH * 4.5e-3)
_DEPTHS = np.arange(1, 30) / 11.0
_MODULUS = 210e9 / (1.0 - 0.09)


def fracture(assembly: Assembly, standard: Standard, line_load: float) -> dict[str, Any]:
    """Pressures, radii and exposures of the whole load, N/m, with its load factors."""
    path = standard.path
    places = contact_path.point_distances(path)
    radii = contact_path.equivalent_radius(path, places)
    pressure = micropitting.hertz_pressure(
        line_load * contact_path.load_share(path, places, 5.0), radii, _MODULUS
    )
    factors = [flank_fracture.material_factor(middle_thickness(assembly, standard, side)) for side in SIDES]
    values: dict[str, Any] = {"K_material": factors, "Eht": 1e3 * _CASE.case_depth}
    for number, (p, rho) in enumerate(zip(pressure, radii, strict=True), 1):
        width = 4.0 * float(rho * p) / _MODULUS
        worst = flank_fracture.greatest_exposure(_CASE, float(p), width, factors[0], width * _DEPTHS)
        values |= {
            f"p_H_{number}": 1e-6 * float(p),
            f"rho_{number}": 1e3 * float(rho),
            f"b_H_{number}": 1e3 * width,
            f"A_FF_{number}": worst.exposure,
            f"y_{number}": 1e3 * worst.depth,
        }
    return values | {"A_FF_max": max(values[f"A_FF_{number}"] for number in range(1, 8))}
