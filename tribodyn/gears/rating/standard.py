"""Load capacity of a pair of gears by the standards: method B, with a face load factor from elsewhere."""

import math
from typing import Any, NamedTuple

import numpy as np

from tribodyn.compliance.iso6336 import ReferenceStiffness, blank_factor
from tribodyn.gears.by_standard import rated
from tribodyn.gears.case import OiledCase
from tribodyn.gears.rating.margins import Strength, flanks_of, oil_of
from tribodyn.gears.rating.settings import RatingTable
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.body import body_masses
from tribodyn.geometry.drive import SIDES, body_of, reference_radius, tip_radius
from tribodyn.geometry.helix import base_helix_angle, normal_module, normal_pressure_angle, overlap_ratio
from tribodyn.standards import micropitting, scuffing
from tribodyn.standards.contact_path import (
    POINTS,
    ContactPath,
    equivalent_radius,
    flash_share,
    loss_factor,
    point_distances,
    rolling_speeds,
)
from tribodyn.standards.load_factors import DynamicFactor, transverse_factor_b
from tribodyn.standards.micropitting import Films, Flanks, Load, Oil
from tribodyn.tribology.oil import ZERO_CELSIUS

#: Places along the path over which the flash temperature is looked at.
_PLACES = 201


class RatedDuty(NamedTuple):
    """What the standards need to know beside the gears, the oil, speed and torque."""

    oil_temperature: float  # of the oil that enters, K
    #: application, mesh, face: K_A; K_γ of one of several meshes in parallel; K_Hβ
    application: float = 1.0
    mesh: float = 1.0
    face: float = 1.0
    #: dynamic, transverse, blank: K_v, K_Hα and C_R where they are given; None: by method B, solid discs
    dynamic: float | None = None
    transverse: float | None = None
    blank: float | None = None
    lubrication: str = "dip"  # one of `micropitting.LUBRICATION_FACTORS`
    adequate_tip_relief: bool = False
    #: tip_relief, run_in: C_a that is credited for scuffing, m; whether flanks are run in there
    tip_relief: float = 0.0
    run_in: bool = True


def rated_duty(settings: RatingTable, oil_temperature: float, *, face: float, mesh: float = 1.0) -> RatedDuty:
    """What settings say of the duty; `face` and `mesh` are K_Hβ and K_γ where these do not give them."""
    given_face, given_mesh = settings.face_load_factor, settings.mesh_load_factor
    return RatedDuty(
        oil_temperature,
        settings.application_factor,
        mesh if given_mesh is None else given_mesh,
        face if given_face is None else given_face,
        settings.dynamic_factor,
        settings.transverse_load_factor,
        settings.gear_blank_factor,
        settings.lubrication,
        settings.adequate_tip_relief,
        settings.tip_relief or 0.0,
        settings.run_in,
    )


class LoadFactors(NamedTuple):
    """Load factors of ISO 6336-1 that a rating counts with, and what method B gives."""

    duty: RatedDuty
    dynamic: DynamicFactor  # by method B
    stiffness: ReferenceStiffness  # c', c_γα, c_γβ, Pa
    transverse_b: float  # K_Hα by method B
    line_load: float  # F_t K_A K_γ/b at the reference circle, N/m

    @property
    def dynamic_factor(self) -> float:
        """K_v: given, or by method B."""
        return self.dynamic.factor if self.duty.dynamic is None else self.duty.dynamic

    @property
    def transverse(self) -> float:
        """K_Hα: given, or by method B."""
        return self.transverse_b if self.duty.transverse is None else self.duty.transverse

    @property
    def flank(self) -> float:
        """K_A K_γ K_v K_Hβ K_Hα."""
        duty = self.duty
        return duty.application * duty.mesh * self.dynamic_factor * duty.face * self.transverse


class Standard(NamedTuple):
    """Results by the standards."""

    path: ContactPath
    films: Films  # of method B at the `POINTS`
    factors: LoadFactors
    losses: float  # H_v
    #: flash_bulk, flash_contact: θ_M and θ_Bmax of ISO/TS 6336-20, K
    flash_bulk: float
    flash_contact: float
    integral: scuffing.IntegralTemperature | None  # ISO/TS 6336-21; None of a ring and its planet


def load_factors(
    case: OiledCase, assembly: Assembly, duty: RatedDuty, operating: tuple[float, float] | None = None
) -> LoadFactors:
    """Load factors of a pair of involutes with a tolerance class, whose pinion drives.

    `operating` are (pinion speed rad/s, gear torque N m) of another duty than the case's.
    """
    assert case.quality is not None, "refused by the rules"
    path = path_of(assembly)
    bodies = body_masses(
        assembly,
        [(body.mass, body.inertia) for body in case.masses],
        [material.density for material in case.materials],
    )
    by = rated(
        assembly,
        case.materials,
        bodies,
        case.quality,
        operating or (case.operating.pinion_speed, case.operating.gear_torque),
        duty.application * duty.mesh,
        duty.blank or _blank(case, assembly),
    )
    dynamic = by.dynamic.factor if duty.dynamic is None else duty.dynamic
    transverse = transverse_factor_b(
        (path.contact_ratio, path.overlap_ratio),
        by.stiffness.mesh,
        by.base_pitch_deviation,
        by.line_load * dynamic * duty.face,
    )
    return LoadFactors(duty, by.dynamic, by.stiffness, transverse, by.line_load)


def _blank(case: OiledCase, assembly: Assembly) -> float:
    """C_R of both bodies as drawn, their mean; 1 of solid discs."""
    module = float(normal_module(assembly.drive))
    factors = [
        1.0
        if body.web is None or body.rim is None
        else blank_factor(body.web / float(body_of(assembly.drive, side).face_width), body.rim / module)
        for side, body in zip(SIDES, case.masses, strict=True)
    ]
    return sum(factors) / len(factors)


def standard_of(case: OiledCase, assembly: Assembly, duty: RatedDuty) -> Standard:
    """Evaluate the standards for a pair of involutes with a tolerance class, whose pinion drives."""
    path, factors = path_of(assembly), load_factors(case, assembly, duty)
    loaded = Load(
        path.pinion_torque(case.operating.gear_torque),
        case.operating.pinion_speed,
        float(assembly.common_width),
        duty.oil_temperature,
        duty.application * duty.mesh,
        factors.dynamic_factor,
        factors.transverse,
        duty.face,
        duty.lubrication,
        micropitting.tip_relief_factor(path.tip_contact_ratios, duty.adequate_tip_relief),
    )
    flanks, oil = flanks_of(case), oil_of(case.lubricant)
    films = micropitting.method_b(path, flanks, loaded, oil)
    bulk, contact = _flash(case, path, loaded, factors, flanks, oil)
    integral = _integral(case, path, loaded, factors, flanks, oil) if path.ratio > 0.0 else None
    return Standard(path, films, factors, loss_factor(path), bulk, contact, integral)


def _integral(
    case: OiledCase, path: ContactPath, loaded: Load, factors: LoadFactors, flanks: Flanks, oil: Oil
) -> scuffing.IntegralTemperature:
    """Integral temperature of ISO/TS 6336-21 of two external gears."""
    drive, duty = case.drive, factors.duty
    stiffness = factors.stiffness.single_pair, factors.stiffness.mesh
    effective = scuffing.effective_tip_relief(factors.line_load, stiffness, helical=drive.helix_angle != 0.0)
    credited = 1.0 if duty.adequate_tip_relief else duty.tip_relief / effective
    mesh = scuffing.ScuffingMesh(
        factors.line_load * factors.dynamic_factor * duty.face * factors.transverse,
        loaded.pinion_speed * float(reference_radius(drive, "pinion")),
        float(oil.viscosity(loaded.oil_temperature)),
        loaded.oil_temperature,
        case.mean_roughness,
        flanks.reduced_modulus,
        sum(flanks.thermal_contact) / 2.0,
        float(normal_pressure_angle(drive)),
        abs(float(drive.helix_angle)),
        lubricant=oil.lubricant_factor,
        lubrication=micropitting.LUBRICATION_FACTORS[loaded.lubrication],
        tip_relief=scuffing.tip_relief_factor(path.tip_contact_ratios, credited),
        run_in=float(duty.run_in),
    )
    return scuffing.integral_temperature(path, mesh)


def _flash(
    case: OiledCase, path: ContactPath, load: Load, factors: LoadFactors, flanks: Flanks, oil: Oil
) -> tuple[float, float]:
    """Bulk and maximum contact temperature of ISO/TS 6336-20, K."""
    distance = np.linspace(0.0, path.length, _PLACES)
    radius, speeds = equivalent_radius(path, distance), rolling_speeds(path, distance, load.pinion_speed)
    line_load = load.factor * load.pinion_torque / path.base_radius[0] / load.face_width
    pitch_point = float(point_distances(path)[POINTS.index("C")])
    friction = scuffing.flash_friction(
        load.factor * load.pinion_torque / float(reference_radius(case.drive, "pinion")) / load.face_width,
        float(sum(rolling_speeds(path, pitch_point, load.pinion_speed))),
        float(equivalent_radius(path, pitch_point)),
        scuffing.lubricant_factor(oil.lubricant_factor, float(oil.viscosity(load.oil_temperature))),
        flanks.mean_roughness,
    )
    normal = line_load * flash_share(path, distance, flanks.quality)
    width = np.sqrt(8.0 * normal * radius / (np.pi * flanks.reduced_modulus))
    rise = scuffing.flash_rise(friction, normal, width, speeds, flanks.thermal_contact)
    applied = load.application * load.pinion_torque / path.base_radius[0] / load.face_width
    effective, duty = applied / factors.stiffness.mesh, factors.duty  # C_eff
    missing = 0.0 if duty.adequate_tip_relief else max(effective - duty.tip_relief, 0.0)
    rise *= scuffing.flash_approach(pitch_point - distance, path.length, missing)
    supply = micropitting.LUBRICATION_FACTORS[load.lubrication]
    bulk = scuffing.bulk_temperature(load.oil_temperature, float(np.mean(rise)), supply)
    return bulk, bulk + float(np.max(rise))


def path_of(assembly: Assembly) -> ContactPath:
    """The path of contact of an involute drive as the standards have it."""
    drive, path = assembly.drive, assembly.path
    angle = float(path.pressure_angle(0.0))
    cosine = math.cos(angle)
    return ContactPath(
        (float(drive.pinion.teeth), float(drive.gear.teeth)),
        (float(path.pinion_pitch_radius) * cosine, float(path.gear_pitch_radius) * cosine),
        (float(tip_radius(drive, "pinion")), float(tip_radius(drive, "gear"))),
        angle,
        abs(float(base_helix_angle(drive))),
        float(overlap_ratio(assembly)),
    )


def iso_part(case: OiledCase, by_iso: Standard) -> dict[str, Any]:
    """What a program reads of it; temperatures in °C, everything else in SI units."""
    films, count = by_iso.films, len(POINTS)
    torque = by_iso.path.pinion_torque(case.operating.gear_torque)
    power = torque * case.operating.pinion_speed * by_iso.path.sense
    return {
        "theta_M": by_point(np.full(count, films.bulk_temperature - ZERO_CELSIUS), max),
        "mu_m": by_point(np.full(count, films.friction_coefficient), max),
        "h_Y": by_point(films.film_thickness, min),
        "lambda_GF": by_point(films.specific_film, min),
        "c_prime": by_iso.factors.stiffness.single_pair,
        "c_gamma_alpha": by_iso.factors.stiffness.mesh,
        **factors_by_name(by_iso.factors),
        "H_v": by_iso.losses,
        "loss": power * films.friction_coefficient * by_iso.losses,
    }


def factors_by_name(factors: LoadFactors) -> dict[str, float]:
    """Load factors that a rating counts with, by their names."""
    duty = factors.duty
    return {
        "K_A": duty.application,
        "K_gamma": duty.mesh,
        "K_v": factors.dynamic_factor,
        "K_Hbeta": duty.face,
        "K_Halpha": factors.transverse,
        "C_R": factors.stiffness.blank,
    }


def by_point(values: Any, worst: Any) -> dict[str, float]:
    """Values at the `POINTS` by name, and the worst of them."""
    named = {name: float(value) for name, value in zip(POINTS, values, strict=True)}
    return {"worst": float(worst(named.values())), **named}


def margins_by_standard(by_iso: Standard, strength: Strength, oil_temperature: float) -> dict[str, float]:
    """Temperatures in °C and safeties by the standards, of what the oil has load stages for."""
    margins = {
        "theta_M_flash": by_iso.flash_bulk - ZERO_CELSIUS,
        "theta_B": by_iso.flash_contact - ZERO_CELSIUS,
    }
    if by_iso.integral is not None:
        margins["theta_int"] = by_iso.integral.integral - ZERO_CELSIUS
    if strength.scuffing is not None and strength.scuffing_integral is not None:
        margins["theta_S"] = strength.scuffing - ZERO_CELSIUS
        margins["theta_intS"] = strength.scuffing_integral - ZERO_CELSIUS
        margins["S_B"] = scuffing.flash_safety(strength.scuffing, by_iso.flash_contact, oil_temperature)
        if by_iso.integral is not None:
            margins["S_intS"] = scuffing.integral_safety(strength.scuffing_integral, by_iso.integral.integral)
    if strength.specific_film is not None:
        worst = float(np.min(by_iso.films.specific_film))
        margins |= {"lambda_GFP": strength.specific_film, "S_lambda": worst / strength.specific_film}
    return margins
