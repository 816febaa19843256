"""Losses of the planetary stages of NREL's 5 MW gearbox in the reports of KISSsoft, mesh by mesh.

P_VZ = P/3 μ_m H_v of every mesh, and three times both of a stage. Friction by ISO/TR 15144-1 with the printed
load factors; the program's loss is by another friction coefficient, whose formula it does not print.
"""

import math
from typing import Any, NamedTuple

from tribodyn.standards import contact_path, loss_factors, micropitting
from tribodyn.tribology.oil import OilSheet
from tribodyn.validation.books import rows_of
from tribodyn.validation.books.pair_path import path_of

BOOK = "planetary-losses-2017"


class StageMesh(NamedTuple):
    """A mesh of a planetary stage of three planets: mm, 1/min against the carrier, kW of all three, µm."""

    module: float
    teeth: tuple[float, float]
    axes: float
    tips: tuple[float, float]  # radii
    width: float
    speed: float  # of the first gear
    power: float
    roughness: float
    factor: float  # K_A K_γ K_v K_Hβ as printed


#: Speeds of carrier and sun by the ratio of the rotor's 12.1 rpm and the generator's side; K_A 1.25, K_γ 1.1.
_FIRST, _SECOND = 12.1 * 56.0 / 19.0, 12.1 * 75.0 / 19.0 * 93.0 / 18.0
#: Power that the meshes of all planets pass, kW: 5000 kW less what the carrier carries over as a whole.
_POWERS = 5000.0 * 56.0 / 75.0, 5000.0 * 93.0 / 111.0
_PLANETS, _OIL = 3, OilSheet("mineral", 220e-6, 19e-6, 890.0)
_K = 1.25 * 1.1
MESHES = {
    "1-sun": StageMesh(
        *(45.0, (19.0, 17.0), 863.0, (489.404, 452.735), 491.0, _FIRST, _POWERS[0], 0.6, _K * 1.01 * 1.15)
    ),
    "1-ring": StageMesh(
        *(45.0, (17.0, -56.0), -863.0, (452.735, -1237.559), 491.0, _FIRST * 19.0 / 17.0, _POWERS[0]),
        *(0.825, _K * 1.05 * 1.15),
    ),
    "2-sun": StageMesh(
        *(21.0, (18.0, 36.0), 584.0, (216.419, 407.8315), 550.0, _SECOND, _POWERS[1], 0.6, _K * 1.02 * 2.06)
    ),
    "2-ring": StageMesh(
        *(21.0, (36.0, -93.0), -584.0, (407.8315, -953.0405), 550.0, _SECOND / 2.0, _POWERS[1]),
        *(0.825, _K * 1.06 * 1.15),
    ),
}


def _values() -> dict[str, Any]:
    values: dict[str, Any] = {}
    viscosity, totals = float(_OIL.viscosity(348.15)), {"1": 0.0, "2": 0.0}
    for name, mesh in MESHES.items():
        path = path_of(mesh.module, mesh.teeth, mesh.axes, mesh.tips, 0.0, mesh.width)
        tips, speed = path.tip_contact_ratios, mesh.speed * math.pi / 30.0
        point = path.length - tips[0] * path.base_pitch
        radius = float(contact_path.equivalent_radius(path, point))
        each = 1e3 * mesh.power / _PLANETS
        line_load = each / speed / path.base_radius[0] / (1e-3 * mesh.width)
        rough = micropitting.roughness_factor(1e-6 * mesh.roughness, radius)
        speeds = float(sum(contact_path.rolling_speeds(path, point, speed)))
        coefficient = micropitting.mean_friction(
            line_load * mesh.factor, speeds, radius, viscosity, rough, 1.0
        )
        factor = loss_factors.hoehn(*tips, path.teeth[0], path.ratio)
        lost = 1e-3 * each * coefficient * factor
        totals[name[0]] += _PLANETS * lost
        values |= {
            f"eps_a-{name}": path.contact_ratio,
            f"XR-{name}": rough,
            f"HV-{name}": factor,
            f"mym-{name}": coefficient,
            f"mum-{name}": coefficient,
            f"PVZ-{name}": lost,
        }
    values |= {f"PV-{stage}": lost for stage, lost in totals.items()}
    return values | {f"eta-{stage}": 1.0 - lost / 5000.0 for stage, lost in totals.items()}


rows = rows_of(BOOK, _values)
