"""The simulation beside the standards: values by their names along the path of contact, margins, limits.

Film and temperature are by method A of ISO/TS 6336-22, from the simulation's loads.
"""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import SimulationError
from tribodyn.gears.rating.capacity import Capacity, safeties, shorter_life
from tribodyn.gears.rating.limits import judged, with_unlimited, worst
from tribodyn.gears.rating.margins import Strength, bulk_of, flanks_of, oil_of, strength_of
from tribodyn.gears.rating.standard import (
    ZERO_CELSIUS,
    Standard,
    by_point,
    factors_by_name,
    margins_by_standard,
)
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.helix import curvature_share, pitch_slope, speed_share
from tribodyn.geometry.path import kinematics
from tribodyn.numerics.shapes import Array, Float
from tribodyn.standards import micropitting, scuffing
from tribodyn.standards.micropitting import Films
from tribodyn.studies.assessment.case import RatedPair
from tribodyn.studies.assessment.settings import AssessmentTable

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
    case: RatedPair, assembly: Assembly, along: Mapping[str, Any], quantities: Mapping[str, Any]
) -> LocalValues:
    """Evaluate method A; SimulationError where no place has a Hertz contact.

    `along` has ``roll_angle``, ``hertz_pressure`` (maximum over the face) and ``normal_load`` of one pair.
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
    across = abs(pitch_slope(assembly)), assembly.path, motion.signed_distance  # the line of contact
    speed = case.operating.pinion_speed * speed_share(*across)
    speeds = motion.pinion_speed * speed, motion.gear_speed * speed
    curvature = motion.relative_curvature * curvature_share(*across)
    raised = pressure * np.sqrt(load_factor(settings, quantities))
    # no Hertz contact where its half width √(8 w ρ/(π E_r)) is not small beside its radius, none without load
    flanks = flanks_of(case)
    line_load = load / float(assembly.common_width)
    narrow = 8.0 * line_load * curvature / (np.pi * flanks.reduced_modulus) < _WIDEST**2
    hertzian = (raised > 0.0) & narrow
    if not np.any(hertzian):
        raise SimulationError(
            f"the contact is nowhere narrower than {_WIDEST:g} of its radius: the load is far beyond what "
            "the teeth carry; reduce operating.gear_torque, or use larger teeth or a stiffer material"
        )
    films = micropitting.at_places(
        np.where(hertzian, raised, np.nan),
        1.0 / curvature,
        speeds,
        quantities["friction_coefficient_mean"],
        bulk_of(assembly, quantities, case.oil_temperature, case.settings.lubrication),
        flanks,
        oil_of(case.lubricant),
    )
    sliding = np.abs(speeds[0] - speeds[1])
    return LocalValues(roll, load, 1.0 / curvature, sliding, films, points)


def load_factor(settings: AssessmentTable, quantities: Mapping[str, Any]) -> float:
    """Factor by which the loads of slow rotation grow: K_A K_γ K_v, and K_Hβ where it is given.

    K_v is the simulation's where none is given; the pressures of slow rotation are maxima over the face and
    contain the simulation's K_Hβ, which a given one replaces.
    """
    dynamic = settings.dynamic_factor or max(quantities["dynamic_factor"], 1.0)
    face_load_factor = settings.face_load_factor
    face = 1.0 if face_load_factor is None else face_load_factor / quantities["face_load_factor"]
    return settings.application_factor * (settings.mesh_load_factor or 1.0) * dynamic * face


def largest_stresses(
    case: RatedPair, local: LocalValues, quantities: Mapping[str, Any]
) -> tuple[float, float]:
    """Largest pressure between B and D and tension in the roots, slow rotation times `load_factor`, Pa."""
    root = max(quantities["pinion_root_tension_max"], quantities["gear_root_tension_max"])
    raised, inner = load_factor(case.settings, quantities), sorted(local.points[[2, 4]])
    rated = (local.roll_angle >= inner[0]) & (local.roll_angle <= inner[1])
    pressed = local.films.pressure[rated]
    pressures = pressed if np.any(np.isfinite(pressed)) else local.films.pressure
    return float(np.nanmax(pressures)), raised * float(root)


def simulated_part(
    case: RatedPair,
    assembly: Assembly,
    local: LocalValues,
    quantities: Mapping[str, Any],
) -> dict[str, Any]:
    """What stands beside `standard.iso_part`, by the same names; worst values are those of all places.

    c' and c_γα are along the line of action per face width: of one pair at the pitch point, and the mean of
    all pairs. H_v is loss over power and mean friction coefficient.
    """
    films, count = local.films, len(local.points)
    width = float(assembly.common_width)
    angle = float(assembly.path.pressure_angle(0.0))
    power = (
        case.operating.gear_torque
        * abs(float(case.drive.pinion.teeth / case.drive.gear.teeth))
        * case.operating.pinion_speed
    )
    loss, friction = float(quantities["power_friction_mean"]), float(quantities["friction_coefficient_mean"])
    bulk = films.bulk_temperature - ZERO_CELSIUS
    film = by_point(local.at_points(films.film_thickness), min)
    specific = by_point(local.at_points(films.specific_film), min)
    transverse = quantities.get("transverse_load_factor")
    return {
        "theta_M": by_point(np.full(count, bulk), max),
        "mu_m": by_point(np.full(count, friction), max),
        "h_Y": film | {"worst": float(np.nanmin(films.film_thickness))},
        "lambda_GF": specific | {"worst": float(np.nanmin(films.specific_film))},
        "c_prime": quantities["stiffness_single_pair_at_pitch_point"] / width,
        "c_gamma_alpha": quantities["mesh_stiffness_mean"] / width / math.cos(angle) ** 2,
        "K_v": quantities["dynamic_factor"],
        "H_v": loss / (power * friction) if friction > 0.0 else float("nan"),
        "loss": loss,
        "K_Hbeta": quantities["face_load_factor"],
        **({"K_Halpha": transverse} if transverse is not None else {}),
        "theta_B": by_point(local.at_points(bulk + films.flash_rise), max)
        | {"worst": float(bulk + np.nanmax(films.flash_rise))},
    }


def strength_of_case(case: RatedPair) -> Strength:
    """What its oil stands."""
    structure = case.settings.structure_factor
    return strength_of(case.lubricant, case.oil_temperature, structure, case.materials)


def margins_and_limits(
    case: RatedPair,
    standard: Standard | None,
    capacity: Capacity | None,
    further: Mapping[str, Any],
    local: LocalValues,
    quantities: Mapping[str, Any],
) -> dict[str, Any]:
    """Return ``margins`` by ``iso`` and ``simulated``, ``load_factors`` and ``limits``; temperatures in °C.

    The worse of both safeties is compared with a limit; `further` are the simulation's against pitting and
    bending, and its life. One whose load stage the oil lacks is left out.
    """
    by_standard = (
        margins_by_standard(standard, strength_of_case(case), case.oil_temperature) if standard else {}
    )
    rated = safeties(capacity)
    simulated = scuffing_and_micropitting(case, local) | dict(further)
    values = {
        "scuffing_flash": worst(by_standard.get("S_B"), simulated.get("S_B")),
        "scuffing_integral": by_standard.get("S_intS", math.nan),
        "micropitting": worst(by_standard.get("S_lambda"), simulated.get("S_lambda")),
        "pitting": worst(rated.get("S_H"), simulated.get("S_H")),
        "bending": worst(rated.get("S_F"), simulated.get("S_F")),
        "flank_fracture": rated.get("S_FF", math.nan),
        "life": worst(rated.get("life"), simulated.get("life")),
        "dynamic_factor": quantities["dynamic_factor"],
        "hertz_pressure": float(np.nanmax(local.films.pressure)),
        "root_tension": max(quantities["pinion_root_tension_max"], quantities["gear_root_tension_max"]),
        "loaded_error": quantities["loaded_transmission_error_peak_to_peak"],
    }
    factors: dict[str, Any] = {"K_A": case.settings.application_factor}
    factors["K_Hbeta"] = case.settings.face_load_factor or quantities["face_load_factor"]
    if standard:
        iso_factors = standard.factors
        computed = {
            "K_v": iso_factors.dynamic.factor,
            "K_Hbeta": quantities["face_load_factor"],
            "K_Halpha": iso_factors.transverse_b,
        }
        factors |= {
            **factors_by_name(iso_factors),
            "computed": computed,
            "N": iso_factors.dynamic.resonance_ratio,
            "resonance_speed": iso_factors.dynamic.resonance_speed,
            "range": iso_factors.dynamic.range,
            "c_gamma_beta": iso_factors.stiffness.mesh_face,
        }
    margins = {"simulated": simulated} | ({"iso": by_standard | rated} if by_standard else {})
    limits = with_unlimited(judged(case.limits, values), shorter_life(rated, simulated))
    return {"margins": margins, "load_factors": factors, "limits": limits}


def scuffing_and_micropitting(case: RatedPair, local: LocalValues) -> dict[str, float]:
    """Contact temperature, °C, and safeties of the simulation, of what the oil has load stages for."""
    strength = strength_of_case(case)
    films = local.films
    contact = films.bulk_temperature + float(np.nanmax(films.flash_rise))
    margins = {"theta_B": contact - ZERO_CELSIUS}
    if strength.scuffing is not None:
        margins["S_B"] = scuffing.flash_safety(strength.scuffing, contact, case.oil_temperature)
    if strength.specific_film is not None:
        margins["S_lambda"] = float(np.nanmin(films.specific_film)) / strength.specific_film
    return margins
