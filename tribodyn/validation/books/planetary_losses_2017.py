"""Losses of the planetary stages of NREL's 5 MW gearbox in the reports of KISSsoft, mesh by mesh.

P_VZ = P/3 μ_m H_v of every mesh, and three times both of a stage. Friction by ISO/TR 15144-1 with the printed
load factors; the program's loss is by another friction coefficient, whose formula it does not print. Beside
them stand the losses of an efficiency study.
"""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

from tribodyn.standards import contact_path, loss_factors, micropitting
from tribodyn.tribology.oil import OilSheet
from tribodyn.validation.books import printed, rows_of
from tribodyn.validation.books.printed_pair import PrintedPair, own_loss

BOOK = "planetary-losses-2017"
_PLANETS, _TEMPERATURE = 3, 75.0
_OIL = OilSheet("mineral", 220e-6, 19e-6, 890.0)
_LUBRICANT = {
    "type": "mineral",
    "viscosity_40": "220 mm**2/s",
    "viscosity_100": "19 mm**2/s",
    "density_15": "890 kg/m**3",
}
#: K_A K_γ.
_K = 1.25 * 1.1


class StageMesh(NamedTuple):
    """A mesh of one of three planets: 1/min of the first gear against the carrier, kW, K_A K_γ K_v K_Hβ."""

    pair: PrintedPair
    speed: float
    power: float
    factor: float


def _mesh(
    pair: PrintedPair, speed: float, carried: tuple[float, float], factors: tuple[float, float]
) -> StageMesh:
    """Of the speed of the sun in its set, and the share of 5000 kW that the teeth pass."""
    share = carried[0] / carried[1]
    return StageMesh(pair, speed, 5000.0 * share / _PLANETS, _K * factors[0] * factors[1])


#: Speeds of the suns against the carriers: rotor 12.1 rpm, ratios 75/19 and 111/18.
_FIRST, _SECOND = 12.1 * 56.0 / 19.0, 12.1 * 75.0 / 19.0 * 93.0 / 18.0
MESHES = {
    "1-sun": _mesh(
        PrintedPair(45.0, (19.0, 17.0), (0.617, 0.8021), 863.0, (489.404, 452.735), 491.0, 0.6),
        *(_FIRST, (56.0, 75.0), (1.01, 1.15)),
    ),
    "1-ring": _mesh(
        PrintedPair(45.0, (17.0, -56.0), (0.8021, -0.5013), -863.0, (452.735, -1237.559), 491.0, 0.825),
        *(_FIRST * 19.0 / 17.0, (56.0, 75.0), (1.05, 1.15)),
    ),
    "2-sun": _mesh(
        PrintedPair(21.0, (18.0, 36.0), (0.389, 0.5039), 584.0, (216.419, 407.8315), 550.0, 0.6),
        *(_SECOND, (93.0, 111.0), (1.02, 2.06)),
    ),
    "2-ring": _mesh(
        PrintedPair(21.0, (36.0, -93.0), (0.5039, 0.1171), -584.0, (407.8315, -953.0405), 550.0, 0.825),
        *(_SECOND / 2.0, (93.0, 111.0), (1.06, 1.15)),
    ),
}


def _values() -> dict[str, Any]:
    values, found = dict[str, Any](), printed(BOOK)
    viscosity, totals = float(_OIL.viscosity(_TEMPERATURE + 273.15)), {"1": 0.0, "2": 0.0}
    for name, mesh in MESHES.items():
        path, speed = mesh.pair.path(), mesh.speed * math.pi / 30.0
        tips = path.tip_contact_ratios
        point = path.length - tips[0] * path.base_pitch
        radius = float(contact_path.equivalent_radius(path, point))
        line_load = 1e3 * mesh.power / speed / path.base_radius[0] / (1e-3 * mesh.pair.width)
        rough = micropitting.roughness_factor(1e-6 * mesh.pair.roughness, radius)
        speeds = float(sum(contact_path.rolling_speeds(path, point, speed)))
        coefficient = micropitting.mean_friction(
            line_load * mesh.factor, speeds, radius, viscosity, rough, 1.0
        )
        factor = loss_factors.hoehn(*tips, path.teeth[0], path.ratio)
        lost = mesh.power * coefficient * factor
        totals[name[0]] += _PLANETS * found[f"PVZ-{name}"]
        values |= {
            f"eps_a-{name}": path.contact_ratio,
            f"XR-{name}": rough,
            f"HV-{name}": factor,
            f"mym-{name}": coefficient,
            f"mum-{name}": coefficient,
            f"PVZ-{name}": lost,
        }
    values |= {f"PV-{stage}": lost for stage, lost in totals.items()}
    return values | {f"eta-{stage}": 1.0 - found[f"PV-{stage}"] / 5000.0 for stage in totals}


def _own(progress: Callable[[float], None]) -> dict[str, str]:
    said = {}
    for done, (name, mesh) in enumerate(MESHES.items(), start=1):
        torque = 1e3 * mesh.power / (mesh.speed * math.pi / 30.0)
        found = mesh.pair.study(_LUBRICANT, _TEMPERATURE, torque, mesh.speed)
        said[f"PVZ-{name}"] = own_loss(found, "kW", 1e-3)
        progress(done / len(MESHES))
    return said


rows = rows_of(BOOK, _values, _own)
