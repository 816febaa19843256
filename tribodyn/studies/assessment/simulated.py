"""The simulation's own values under the standards' names."""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from tribodyn.geometry.assembly import Assembly
from tribodyn.studies.assessment.case import AssessmentCase
from tribodyn.studies.assessment.local import LocalValues
from tribodyn.studies.assessment.standard import ZERO_CELSIUS, by_point

#: Figure of the simulation -> its name by the standards.
_NAMES = {
    "dynamic_factor": "K_v",
    "transverse_load_factor": "K_Halpha",
    "face_load_factor": "K_Hbeta",
}


def simulated_part(
    case: AssessmentCase,
    assembly: Assembly,
    local: LocalValues,
    figures: Mapping[str, Any],
    spread: Mapping[str, Mapping[str, float]],
) -> dict[str, Any]:
    """What stands beside `standard.iso_part`, by the same names; worst values are those of all places.

    c' and c_γα are along the line of action per face width: of one pair at the pitch point, and the mean of
    all pairs. H_v is loss over power and mean friction coefficient. ``spread`` has the scatter over the
    samples of deviations.
    """
    films, count = local.films, len(local.points)
    width = float(assembly.common_width)
    angle = float(assembly.path.pressure_angle(0.0))
    power = (
        case.operating.gear_torque
        * float(case.drive.pinion.teeth / case.drive.gear.teeth)
        * case.operating.pinion_speed
    )
    loss, friction = float(figures["power_friction_mean"]), float(figures["friction_coefficient_mean"])
    bulk = films.bulk_temperature - ZERO_CELSIUS
    film = by_point(local.at_points(films.film_thickness), min)
    specific = by_point(local.at_points(films.specific_film), min)
    scattered = {_NAMES.get(name, name): one for name, one in spread.items()}
    transverse = figures.get("transverse_load_factor")
    return {
        "theta_M": by_point(np.full(count, bulk), max),
        "mu_m": by_point(np.full(count, friction), max),
        "h_Y": film | {"worst": float(np.nanmin(films.film_thickness))},
        "lambda_GF": specific | {"worst": float(np.nanmin(films.specific_film))},
        "c_prime": figures["stiffness_single_pair_at_pitch_point"] / width,
        "c_gamma_alpha": figures["mesh_stiffness_mean"] / width / math.cos(angle) ** 2,
        "K_v": figures["dynamic_factor"],
        "H_v": loss / (power * friction) if friction > 0.0 else float("nan"),
        "loss": loss,
        "K_Hbeta": figures["face_load_factor"],
        **({"K_Halpha": transverse} if transverse is not None else {}),
        **({"spread": scattered} if scattered else {}),
        "theta_B": by_point(local.at_points(bulk + films.flash_rise), max)
        | {"worst": float(bulk + np.nanmax(films.flash_rise))},
    }
