"""The simulation's values under the standards' names; film and temperature along the path of contact.

These are by method A of ISO/TS 6336-22, from the simulation's loads.
"""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import SimulationError
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.path import kinematics
from tribodyn.numerics.shapes import Array, Float
from tribodyn.standards import micropitting
from tribodyn.standards.micropitting import Films
from tribodyn.studies.assessment.case import AssessmentCase
from tribodyn.studies.assessment.standard import ZERO_CELSIUS, by_point, flanks_of, oil_of

#: Half width of a Hertz contact over its radius from which it is none: at the pitch point of a cycloid.
_WIDEST = 0.1


class LocalValues(NamedTuple):
    """Values along the path of contact, and those at the points A to E."""

    #: (places,); rotation of the pinion since the pair met at the pitch point, rad, increasing
    roll_angle: Float[Array, " place"]
    normal_load: Float[Array, " place"]  # (places,); of the pair, slow rotation, N
    #: radius, sliding: (places,); equivalent radius, m, and sliding speed, m/s
    radius: Float[Array, " place"]
    sliding: Float[Array, " place"]
    #: arrays over the places; the pressure with the dynamic and the application factor. NaN where there is no
    #: Hertz contact: without load, or where the radius vanishes.
    films: Films
    points: Float[Array, " point"]  # (7,); roll angles of the points, rad

    def at_points(self, values: Any) -> Float[Array, " point"]:
        """Values (places,) at the points."""
        return np.interp(self.points, self.roll_angle, values)


def point_angles(assembly: Assembly) -> Float[Array, " point"]:
    """Roll angles of A, AB, B, C, D, DE, E: ends, a pitch from them, between, and the pitch point."""
    start, end = map(float, assembly.roll_limits)
    pitch = float(assembly.pitch_angle)
    first, last = end - pitch, start + pitch
    return np.array([start, (start + first) / 2.0, first, 0.0, last, (last + end) / 2.0, end])


def local_of(
    case: AssessmentCase, assembly: Assembly, along: Mapping[str, Any], figures: Mapping[str, Any]
) -> LocalValues:
    """Evaluate method A; SimulationError where no place has a Hertz contact.

    Parameters
    ----------
    along : ``roll_angle``, ``hertz_pressure`` (maximum over the face) and ``normal_load`` of one pair
    figures : ``dynamic_factor``, ``friction_coefficient_mean`` and ``power_friction_mean`` of the simulation
    """
    settings = case.settings
    start, end = map(float, assembly.roll_limits)
    inside = (along["roll_angle"] >= start) & (along["roll_angle"] <= end)
    # the points themselves too, by interpolation: both ends lie between positions inside and beyond
    points = point_angles(assembly)
    roll = np.unique(np.concatenate([points, along["roll_angle"][inside]]))
    load, pressure = (
        np.interp(roll, along["roll_angle"], along[name]) for name in ("normal_load", "hertz_pressure")
    )
    motion = kinematics(assembly.path, assembly.path.signed_distance(roll))
    speeds = (
        motion.pinion_speed * case.operating.pinion_speed,
        motion.gear_speed * case.operating.pinion_speed,
    )
    raised = pressure * np.sqrt(settings.application_factor * max(figures["dynamic_factor"], 1.0))
    # no Hertz contact where its half width √(8 w ρ/(π E_r)) is not small beside its radius, none without load
    flanks = flanks_of(case)
    line_load = load / float(assembly.common_width)
    narrow = 8.0 * line_load * motion.relative_curvature / (np.pi * flanks.reduced_modulus) < _WIDEST**2
    hertzian = (raised > 0.0) & narrow
    if not np.any(hertzian):
        raise SimulationError(
            f"the contact is nowhere narrower than {_WIDEST:g} of its radius: the load is far beyond what "
            "the teeth carry; reduce operating.gear_torque, or use larger teeth or a stiffer material"
        )
    films = micropitting.at_places(
        np.where(hertzian, raised, np.nan),
        1.0 / motion.relative_curvature,
        speeds,
        figures["friction_coefficient_mean"],
        bulk_of(case, assembly, figures),
        flanks,
        oil_of(case),
    )
    sliding = np.abs(speeds[0] - speeds[1])
    return LocalValues(roll, load, 1.0 / motion.relative_curvature, sliding, films, points)


def bulk_of(case: AssessmentCase, assembly: Assembly, figures: Mapping[str, Any]) -> float:
    """Bulk temperature of the simulation, K: its own if it has one, else by its loss as in ISO/TR 15144-1."""
    if figures.get("bulk_temperature") is not None:
        return float(figures["bulk_temperature"])
    path = assembly.path
    centre = float(path.pinion_pitch_radius + path.gear_pitch_radius)
    supply = micropitting.LUBRICATION_FACTORS[case.settings.lubrication]
    loss, width = float(figures["power_friction_mean"]), float(assembly.common_width)
    return case.oil_temperature + micropitting.bulk_rise(loss, 1.0, 1.0, centre, width, supply)


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
