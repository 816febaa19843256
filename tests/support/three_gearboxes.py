"""A pair, a reducer of two stages and a planetary set, and where tables of a feature differ between them."""

from typing import Any

from tests.support.planet_sets import planet_set
from tests.support.train_scenarios import REDUCER
from tribodyn.sensing.data import KINDS

SPRINGS = {"stiffness_x": "1e9 N/m", "stiffness_y": "1e9 N/m", "damping_ratio": 0.05}
MESH = {"compliance": "constant", "stiffness": "3e8 N/m", "damping_ratio": 0.05}
SPALL = {"depth": "20 um", "length": "1 mm", "height": 0.5, "width": "10 mm"}
PINION = {"teeth": 25, "face_width": "30 mm", "bore_radius": "15 mm"}
NETWORK = {"pinion_oil": "60 W/K", "gear_oil": "90 W/K", "oil_flow": "4 l/min"}
INVOLUTE: dict[str, Any] = {
    "title": "Involutes",
    "source": "example",
    "family": "involute",
    "module": "3 mm",
    "pressure_angle": "20 deg",
    "mean_roughness": "0.4 um",
    "material": "18CrNiMo7-6",
    "pinion": PINION,
    "gear": {"teeth": 51, "face_width": "30 mm", "bore_radius": "30 mm"},
}

#: What the gearboxes of the table below have alike.
ALIKE: dict[str, Any] = {
    "lubricant": {"like": "iso-vg-220-mineral", "fzg_micropitting_stage": 9},
    "mesh": MESH,
    "friction": {"law": "niemann"},
    "solver": {"cycles": 4},
    "output": {"samples_per_cycle": 80},
}
GEAR_BEARINGS = {"default": SPRINGS}
#: A pair, a reducer of two stages, a planetary set: their scenarios.
GEARBOXES: dict[str, dict[str, Any]] = {
    "pair": {
        "title": "A pair",
        "kind": "gear-pair",
        "drive": INVOLUTE | {"quality": 6},
        "bearings": "rigid-1e9",
        "operating": {"pinion_speed": "1480 rpm", "gear_torque": "150 N*m", "oil_temperature": "70 degC"},
        **ALIKE,
    },
    "reducer": REDUCER | {"quality": 6, "bearings": GEAR_BEARINGS} | ALIKE,
    "planetary": planet_set() | {"quality": 6, "bearings": GEAR_BEARINGS} | ALIKE,
}
#: N m.
GEARBOX_LOADS = {"pair": 150.0, "reducer": 1800.0, "planetary": 600.0}
#: What of a feature's tables differs: a body that bearings hold, its gear, a mesh, the name of the load.
PLACES = {
    "pair": ("gear", "gear", None, "gear_torque"),
    "reducer": ("middle", "wheel-1", "pinion-1-wheel-1", "output_torque"),
    "planetary": ("carrier", "planet-1", "set-sun-1", "output_torque"),
}


def heard(gearbox: str) -> list[dict[str, Any]]:
    """A sensor of every kind but sound, which needs a housing by matrices; of rings where there is one."""
    body, _, mesh, _ = PLACES[gearbox]
    at = {
        "housing": "top",
        "torque": "output",
        "transmission-error": mesh,
        "ring": "set" if gearbox == "planetary" else None,
    }
    kinds = [kind for kind in KINDS if kind != "sound" and (kind != "ring" or gearbox == "planetary")]
    return [
        {"name": kind, "kind": kind, "rate": "20 kHz"}
        | ({"at": place} if (place := at.get(kind, body)) else {})
        for kind in kinds
    ]
