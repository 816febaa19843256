"""The rating by AGMA 2101-D04 beside that of ISO 6336: factors, stresses and safeties of an external pair."""

import math
from collections.abc import Iterator, Sequence
from typing import Any

from tribodyn.errors import InputError
from tribodyn.gears.case import OiledCase
from tribodyn.gears.rating.capacity import Capacity
from tribodyn.gears.rating.standard import LoadFactors
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES, MaterialData, Side, body_of, tip_circle_radius
from tribodyn.geometry.families import family
from tribodyn.geometry.helix import as_written, normal_section
from tribodyn.standards import agma
from tribodyn.standards.metals import VICKERS

#: AGMA's grade by that of ISO 6336-5.
_GRADES = {"ML": 1, "MQ": 2, "ME": 3}
#: HB of a steel over its HV, about.
_BRINELL = 0.95
_KEY = "assessment.standard"


def agma_part(
    case: OiledCase, assembly: Assembly, factors: LoadFactors, capacity: Capacity
) -> dict[str, Any]:
    """Every factor by its name in AGMA 2101; what either gear has of its own by ``pinion``, ``gear``.

    The case has passed `broken_agma`. K_o = K_A K_γ, K_H = K_Hβ, K_B as Y_B of ISO 6336-3 (the formula is
    AGMA's for external gears); A_v is the grade by ISO 1328-1, 6 where it is finer; K_s, Z_R, Z_W, Y_θ are 1,
    reliability is 0.99. F_t is that of the working pitch circles, load cycles are the ISO rating's.
    """
    duty = factors.duty
    assert case.quality is not None, "refused by the rules"
    pair = _pair(assembly)
    radius = pair.centre_distance * pair.teeth[0] / sum(pair.teeth)
    load = case.operating.gear_torque * pair.teeth[0] / pair.teeth[1] / radius
    accuracy = max(float(case.quality.grade), 6.0)
    dynamic = agma.dynamic_factor(accuracy, case.operating.pinion_speed * radius)
    dynamic = dynamic if duty.dynamic is None else duty.dynamic
    common = duty.application * duty.mesh * dynamic * duty.face
    iso, geometry = capacity.by_name(), agma.pitting_geometry_factor(pair)
    contact = agma.contact_stress(load, iso["Z_E"], geometry, 2.0 * radius, pair.face_width, common)
    by_gear = [
        _of_gear(_pair(assembly, side), number, material, iso["N_L"][side], iso["Y_B"][side], load, common)
        for number, (side, material) in enumerate(zip(SIDES, case.materials, strict=True))
    ]
    for gear in by_gear:
        gear["S_H"] = gear["sigma_HP"] / contact
    return {
        "A_v": accuracy,
        "K_v": dynamic,
        "K_A": duty.application,
        "K_gamma": duty.mesh,
        "K_Hbeta": duty.face,
        "Z_E": iso["Z_E"],
        "m_N": agma.load_sharing_ratio(pair),
        "Z_I": geometry,
        "sigma_H": contact,
        **{
            name: {side: gear[name] for side, gear in zip(SIDES, by_gear, strict=True)} for name in by_gear[0]
        },
    }


def _of_gear(
    pair: agma.AgmaPair,
    number: int,
    material: MaterialData,
    cycles: float,
    rim: float,
    load: float,
    common: float,
) -> dict[str, float]:
    """What a gear has of its own; `rim` is K_B."""
    module = pair.normal_module / math.cos(pair.helix_angle)
    geometry = agma.bending_geometry_factor(pair, number)
    stress = agma.bending_stress(load, geometry, module, pair.face_width, common * rim)
    bending, contact = _allowable(material)
    lives = agma.bending_life_factor(cycles), agma.pitting_life_factor(cycles)
    return {
        "N_L": cycles,
        "sigma_Hlim": contact,
        "Z_N": lives[1],
        "sigma_HP": contact * lives[1],
        "sigma_Flim": bending,
        "K_B": rim,
        "Y_J": geometry,
        "Y_N": lives[0],
        "sigma_F": stress,
        "sigma_FP": bending * lives[0],
        "S_F": agma.safety(bending, stress, lives[0]),
    }


def _allowable(material: MaterialData) -> tuple[float, float]:
    grade = _GRADES[material.grade]
    if material.treatment == "case-hardened":
        return agma.case_hardened_stresses(grade)
    return agma.allowable_stresses(_BRINELL * material.hardness / VICKERS, min(grade, 2))


def _pair(assembly: Assembly, cut: Side = "pinion") -> agma.AgmaPair:
    """The teeth as they are cut, with the rack of one gear; its shift holds the thickness allowance."""
    drive, normal = assembly.drive, normal_section(assembly.drive)
    angle, module = float(normal.pressure_angle), float(normal.module)
    bodies = [body_of(normal, side) for side in SIDES]
    thinner = 2.0 * module * math.tan(angle)
    shifts = [float(body.profile_shift) + float(body.thickness_allowance) / thinner for body in bodies]
    tips = [float(tip_circle_radius(drive, side)) for side in SIDES]
    path = assembly.path
    return agma.AgmaPair(
        (float(bodies[0].teeth), float(bodies[1].teeth)),
        module,
        angle,
        abs(float(drive.helix_angle)),
        float(path.pinion_pitch_radius + path.gear_pitch_radius),
        (tips[0], tips[1]),
        float(assembly.common_width),
        (shifts[0], shifts[1]),
        float(body_of(normal, cut).dedendum),
        float(body_of(normal, cut).fillet_radius),
    )


def not_by_agma(case: OiledCase) -> list[InputError]:
    """Why this rating has no formulas for a pair of gears; empty: it rates the pair."""
    teeth = family(case.family)
    drive = as_written(teeth, case.drive)
    gears = drive.pinion, drive.gear
    width = min(float(gear.face_width) for gear in gears)
    others = min(float(gear.teeth) for gear in gears) < 0.0 or not teeth.involute
    helix = abs(float(drive.helix_angle)), float(drive.module), width
    return list(broken_agma(helix, others, case.materials))


def broken_agma(
    helix: tuple[float, float, float], others: bool, materials: Sequence[MaterialData]
) -> Iterator[InputError]:
    """Refuse what this rating has no formulas for; `helix` are |β|, rad, m_n and common face width, m.

    `others`: the pair has an internal gear or other teeth than involutes.
    """
    angle, module, width = helix
    overlap = width * math.sin(angle) / (math.pi * module)
    wanted = "leave standard out: ISO 6336 rates the pair"
    if others:
        rule = "needs external involutes: AGMA 908 has I and J of no others"
        yield InputError(_KEY, '"agma"', rule, wanted)
    if 0.0 < overlap < 1.0:
        rule = f"needs an overlap ratio of 1 or more of helical gears: low contact ratio, {overlap:.2f} here"
        yield InputError(_KEY, '"agma"', rule, f"make the face wider, or {wanted}")
    for material in dict.fromkeys(materials):
        if material.treatment not in ("case-hardened", "through-hardened", "through-hardened-carbon"):
            rule = f"needs case-hardened or through-hardened steel, which {material.name} is not said to be"
            yield InputError(_KEY, '"agma"', rule, f'give its treatment = "case-hardened", or {wanted}')
