"""Stiffness and dynamic factor of an involute drive by ISO 6336-1, method B."""

import math
from collections.abc import Sequence
from typing import NamedTuple, cast

from tribodyn.compliance.iso6336 import ReferenceStiffness, pair_of, reference_stiffness
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import MaterialData, reference_radius
from tribodyn.geometry.helix import base_helix_angle, overlap_ratio
from tribodyn.standards.flank_tolerances import FlankTolerances
from tribodyn.standards.load_factors import (
    DynamicFactor,
    DynamicMesh,
    FlankRunIn,
    dynamic_factor,
    reduced_mass,
    run_in,
    running_in,
)
from tribodyn.standards.metals import (
    BENDING,
    CONTACT,
    Grade,
    Metal,
    Treatment,
    stress_number,
    yield_from_hardness,
)


def metal_of(material: MaterialData) -> Metal | None:
    """Strength of a material: given, or by ISO 6336-5; None where its heat treatment is not said."""
    if material.treatment is None:
        return None
    treatment, grade = cast(Treatment, material.treatment), cast(Grade, material.grade)
    contact, root = material.contact_stress_limit, material.bending_stress_limit
    if contact is None:
        contact = stress_number(CONTACT[treatment][grade], material.hardness)
    if root is None:
        root = stress_number(BENDING[treatment][grade], material.hardness)
    strength = material.yield_strength or yield_from_hardness(material.hardness)
    return Metal(treatment, contact, root, material.hardness, strength)


class Quality(NamedTuple):
    """Deviations that the standard reckons with, of the gear that has the larger ones."""

    grade: float  # by ISO 1328-1
    #: single_pitch, profile_form: f_pT and f_fαT, m
    single_pitch: float
    profile_form: float
    edition: int = 2013


class Rated(NamedTuple):
    """Results of ISO 6336-1."""

    dynamic: DynamicFactor
    stiffness: ReferenceStiffness
    line_load: float  # F_t K_A/b at the reference circle, N/m
    base_pitch_deviation: float  # see `base_pitch_deviation`


def quality_of(
    grades: Sequence[float | None], tolerances: Sequence[FlankTolerances | None], edition: int = 2013
) -> Quality | None:
    """Return the quality of both gears by an edition of ISO 1328-1; None where one has none."""
    with_quality = [of_gear for of_gear in tolerances if of_gear is not None]
    if len(with_quality) < len(tolerances):
        return None
    return Quality(
        max(float(grade) for grade in grades if grade is not None),
        max(of_gear.single_pitch for of_gear in with_quality),
        max(of_gear.profile_form for of_gear in with_quality),
        edition,
    )


def running_in_of(materials: Sequence[MaterialData], pitch_speed: float) -> tuple[FlankRunIn, FlankRunIn]:
    """Laws of running in of both gears, by treatment and σ_Hlim, at a pitch line speed, m/s."""
    pinion, gear = (metal_of(material) for material in materials)
    laws = [
        running_in(None, 0.0, pitch_speed)
        if metal is None
        else running_in(metal.treatment, metal.contact_limit, pitch_speed)
        for metal in (pinion, gear)
    ]
    return laws[0], laws[1]


def base_pitch_deviation(
    assembly: Assembly, quality: Quality, gears: tuple[FlankRunIn, FlankRunIn]
) -> tuple[float, float]:
    """f_pb and f_pb − y_α, m: new and after running in; f_pb = f_pT cos α.

    α is the transverse pressure angle at the reference circle of involutes; of other families it is that of
    the pitch point.
    """
    path = assembly.path
    base = float(path.pinion_pitch_radius) * math.cos(float(path.pressure_angle(0.0)))
    new = quality.single_pitch * base / float(reference_radius(assembly.drive, "pinion"))
    return new, new - run_in(new, gears)


def rated(
    assembly: Assembly,
    materials: tuple[MaterialData, MaterialData],
    bodies: Sequence[tuple[float, float]],
    quality: Quality,
    duty: tuple[float, float],
    application_factor: float = 1.0,
    blank: float | None = None,
) -> Rated:
    """Rate an involute drive whose pinion drives; no tip relief is credited.

    `bodies` are (mass kg, inertia kg m²) of pinion and gear alone, `duty` is (pinion speed rad/s, gear torque
    N m), `application_factor` K_A K_γ, `blank` C_R, 1 of solid discs.
    """
    drive, path = assembly.drive, assembly.path
    speed, torque = duty
    cosine = math.cos(float(path.pressure_angle(0.0)))
    base = float(path.pinion_pitch_radius) * cosine, float(path.gear_pitch_radius) * cosine
    normal = torque / abs(base[1]) / math.cos(float(base_helix_angle(drive)))
    pair = pair_of(assembly, materials, normal)
    pair = pair._replace(line_load=pair.line_load * application_factor, blank=blank or pair.blank)
    stiffness = reference_stiffness(pair)
    inertias = float(bodies[0][1]), float(bodies[1][1])
    gears = running_in_of(materials, speed * abs(float(reference_radius(drive, "pinion"))))
    pitch, after_running_in = base_pitch_deviation(assembly, quality, gears)
    dynamic = dynamic_factor(
        DynamicMesh(
            abs(float(drive.pinion.teeth)),
            speed,
            reduced_mass(inertias, base, float(assembly.common_width)),
            stiffness.single_pair,
            stiffness.mesh,
            pair.line_load,
            pitch,
            quality.profile_form,
            float(assembly.contact_ratio) + float(overlap_ratio(assembly)),
            0.0,
            max(quality.grade, 6.0),
            gears,
        )
    )
    return Rated(dynamic, stiffness, pair.line_load, after_running_in)
