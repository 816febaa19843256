"""Pitting and bending of a pair of gears by ISO 6336-2, -3, -5 and -6: stresses, safeties, life."""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES, Side, body_of, reference_radius, tip_circle_radius
from tribodyn.geometry.helix import normal_module, normal_pressure_angle
from tribodyn.geometry.root_section import critical_section
from tribodyn.standards import bending, pitting
from tribodyn.standards.fatigue import Bin, StressCurve, damage, life_share, safety
from tribodyn.standards.metals import Metal
from tribodyn.studies.gears.case import OiledCase
from tribodyn.studies.gears.rated.margins import flanks_of
from tribodyn.studies.gears.rated.settings import PEAKS_OVER_MEAN, RatingTable
from tribodyn.studies.gears.rated.standard import LoadFactors, load_factors, path_of
from tribodyn.studies.gears.rated.strength import metals_of
from tribodyn.studies.protocol.part import Meshing

#: Where lines of permissible stress end, load cycles.
LAST_CYCLES = 1e10


class LoadBin(NamedTuple):
    """One duty of the life: share of the time, speed and torque, load factors."""

    share: float
    pinion_speed: float  # rad/s
    gear_torque: float  # N m
    factors: LoadFactors


class Failure(NamedTuple):
    """One way to fail of one gear, and what the required life asks."""

    stress: float  # at the duty, Pa
    bins: tuple[Bin, ...]  # of the required life
    curve: StressCurve  # permissible stress σ_G over load cycles
    cycles: float  # N_L of the required life
    safety: float  # S, over all bins
    damage: float  # Miner's sum at the required safety
    life: float  # at the required safety, s; where it has no end, see `unlimited`
    unlimited: bool  # below the end of the line of permissible stress: `life` is a lower bound


class GearCapacity(NamedTuple):
    """Capacity of one gear."""

    pitting: Failure
    bending: Failure
    factors: dict[str, float]  # by their names, those of this gear


class Capacity(NamedTuple):
    """Capacity of a pair."""

    gears: tuple[GearCapacity, GearCapacity]
    common: dict[str, float]  # factors of both gears by their names

    @property
    def life(self) -> float:
        """The shortest life of both gears, s."""
        return min(each.life for gear in self.gears for each in (gear.pitting, gear.bending))

    def by_name(self) -> dict[str, Any]:
        """Everything by the standard's names; what either gear has of its own by ``pinion``, ``gear``."""
        found: dict[str, Any] = dict(self.common)
        for name in self.gears[0].factors:
            found[name] = {side: gear.factors[name] for side, gear in zip(SIDES, self.gears, strict=True)}
        return found


def capacity_of(
    case: OiledCase,
    assembly: Assembly,
    at_duty: LoadFactors,
    bins: Sequence[LoadBin],
    settings: RatingTable,
    meshing: tuple[Meshing, Meshing] = (Meshing(), Meshing()),
) -> Capacity | None:
    """Rate a pair of involutes whose pinion drives; None where the materials' strength is not known.

    `at_duty` are the load factors of the case's own duty, `bins` those of its life, shares 1 in sum.
    """
    metals = metals_of(case)
    if metals is None:
        return None
    sheet = case.lubricant.sheet
    assert sheet is not None, "refused by the rules"
    rz = settings.peak_roughness or PEAKS_OVER_MEAN * case.mean_roughness
    drive, path = assembly.drive, path_of(assembly)
    own = case.operating.pinion_speed, case.operating.gear_torque

    def mesh_at(speed: float, torque: float) -> pitting.PittingMesh:
        return pitting.PittingMesh(
            path,
            (float(reference_radius(drive, "pinion")), float(reference_radius(drive, "gear"))),
            float(normal_pressure_angle(drive)),
            abs(float(drive.helix_angle)),
            float(assembly.common_width),
            path.pinion_torque(torque) * path.sense,
            speed,
            flanks_of(case).reduced_modulus,
            float(sheet.viscosity_40),
            (rz, rz),
        )

    mesh = mesh_at(*own)
    shape = pitting.geometry(mesh)
    influence = pitting.influences(mesh, metals)
    roots = tuple(
        _root(case, assembly, side, settings, turns) for side, turns in zip(SIDES, meshing, strict=True)
    )
    height = max(root.tooth_height for root in roots)
    slender = min(root.face_width for root in roots) / height
    face = bending.face_factor(at_duty.duty.face, slender, 1.0)
    tangential = pitting.tangential_load(mesh)
    gears = []
    for number, (metal, root, turns) in enumerate(zip(metals, roots, meshing, strict=True)):
        nominal = bending.nominal_stress(root, tangential)
        relative = bending.relative_factors(root, nominal, metal)
        ratio = 1.0 if number == 0 else 1.0 / abs(path.ratio)
        flank_bins, root_bins = [], []
        for load in bins:
            cycles = settings.life * load.share * load.pinion_speed / (2.0 * math.pi)
            cycles *= ratio * turns.per_turn
            share = load.gear_torque / own[1]
            flank = pitting.contact_stress(shape, load.factors.flank * share)[number]
            flank_bins.append(Bin(flank, cycles))
            stress = bending.root_stress(nominal, _root_factor(load.factors, face) * share)
            root_bins.append(Bin(stress, cycles))
        flank_curve = pitting.permissible(metal, influence.of(number))
        root_curve = bending.permissible(metal, relative)
        flank = _failure(
            pitting.contact_stress(shape, at_duty.flank)[number],
            flank_bins,
            flank_curve,
            settings.safety_pitting,
            settings.life,
        )
        bent = _failure(
            bending.root_stress(nominal, _root_factor(at_duty, face)),
            root_bins,
            root_curve,
            settings.safety_bending,
            settings.life,
        )
        factors = _flank_names(metal, influence, number, flank, settings)
        factors |= _root_names(metal, root, nominal, relative, bent, settings)
        gears.append(GearCapacity(flank, bent, factors))
    common = {
        "F_t": tangential,
        "Z_H": shape.zone,
        "Z_E": shape.elasticity,
        "Z_epsilon": shape.contact_ratio,
        "Z_beta": shape.helix,
        "Z_B": shape.single_pair[0],
        "Z_D": shape.single_pair[1],
        "Z_X": influence.size,
        "sigma_H0": shape.nominal,
        "K_Fbeta": face,
        "K_Falpha": at_duty.transverse,
        "Y_ST": bending.STRESS_CORRECTION_TEST,
    }
    return Capacity((gears[0], gears[1]), common)


def life_bins(
    case: OiledCase,
    assembly: Assembly,
    at_duty: LoadFactors,
    spectrum: Sequence[tuple[float, float, float]] = (),
) -> list[LoadBin]:
    """Duties of the life: a load spectrum's (share, pinion speed, gear torque), else the case's own duty.

    In a spectrum loads count as they are, K_A = 1 (ISO 6336-6); K_v and K_Hα follow each duty where they are
    not given, K_Hβ is that of the case's duty. A duty without load or against the motion does no damage to
    these flanks.
    """
    if not spectrum:
        return [LoadBin(1.0, case.operating.pinion_speed, case.operating.gear_torque, at_duty)]
    duty = at_duty.duty._replace(application=1.0)
    return [
        LoadBin(share, speed, torque, load_factors(case, assembly, duty, (speed, torque)))
        for share, speed, torque in spectrum
        if torque > 0.0
    ]


def safeties(capacity: Capacity | None) -> dict[str, float]:
    """The smaller S_H and S_F of both gears, and the shorter life, s."""
    if capacity is None:
        return {}
    return {
        "S_H": min(gear.pitting.safety for gear in capacity.gears),
        "S_F": min(gear.bending.safety for gear in capacity.gears),
        "life": capacity.life,
    }


def required(settings: RatingTable) -> dict[str, float]:
    """What the settings require, by the names of the limits."""
    return {
        "pitting": settings.safety_pitting,
        "bending": settings.safety_bending,
        "life": settings.life,
    }


def _root_factor(factors: LoadFactors, face: float) -> float:
    """K_A K_γ K_v K_Fβ K_Fα."""
    return factors.flank / factors.duty.face * face


def _root(
    case: OiledCase, assembly: Assembly, side: Side, settings: RatingTable, turns: Meshing
) -> bending.BendingGear:
    drive, section = assembly.drive, critical_section(assembly, side)
    body, tooth = body_of(drive, side), assembly.tooth(side)
    root, tip = abs(float(tooth.root_radius)), abs(float(tip_circle_radius(drive, side)))
    internal, bore = float(body.teeth) < 0.0, abs(float(body.bore_radius))
    module = float(normal_module(drive))
    assert case.quality is not None, "refused by the rules"
    return bending.BendingGear(
        bending.RootSection(section.arm, section.thickness, section.notch_radius, section.load_angle),
        module,
        float(normal_pressure_angle(drive)),
        abs(float(drive.helix_angle)),
        float(path_of(assembly).overlap_ratio),
        section.virtual_contact_ratio,
        min(float(body.face_width), float(assembly.common_width) + 2.0 * module),
        abs(tip - root),
        bore - root if internal else root - bore,
        internal,
        case.quality.grade,
        settings.root_roughness,
        turns.reversed,
    )


def _failure(stress: float, bins: Sequence[Bin], curve: StressCurve, required: float, life: float) -> Failure:
    cycles = sum(one.cycles for one in bins)
    share = life_share(bins, curve, required)
    unlimited = math.isinf(share)
    found = life * max(1.0, LAST_CYCLES / cycles) if unlimited else life * share
    return Failure(
        stress,
        tuple(bins),
        curve,
        cycles,
        safety(bins, curve),
        min(damage(bins, curve, required), 1e12),
        found,
        unlimited,
    )


def _flank_names(
    metal: Metal, influence: pitting.Influences, gear: int, flank: Failure, settings: RatingTable
) -> dict[str, float]:
    allowed = flank.curve.at(flank.cycles)
    return {
        "N_L": flank.cycles,
        "sigma_Hlim": metal.contact_limit,
        "Z_L": influence.lubricant[gear],
        "Z_v": influence.speed[gear],
        "Z_R": influence.roughness[gear],
        "Z_W": influence.hardening[gear],
        "Z_NT": pitting.contact_factors(metal.treatment).at(flank.cycles),
        "sigma_H": flank.stress,
        "sigma_HG": allowed,
        "sigma_HP": allowed / settings.safety_pitting,
        "S_H": flank.safety,
        "damage_pitting": flank.damage,
        "life_pitting": flank.life,
    }


def _root_names(
    metal: Metal,
    root: bending.BendingGear,
    nominal: bending.Stress,
    relative: bending.Relative,
    bent: Failure,
    settings: RatingTable,
) -> dict[str, float]:
    allowed = bent.curve.at(bent.cycles)
    return {
        "sigma_Flim": metal.bending_limit,
        "h_F": root.section.arm,
        "s_Fn": root.section.thickness,
        "rho_F": root.section.notch_radius,
        "Y_F": nominal.form,
        "Y_S": nominal.correction,
        "Y_beta": nominal.helix,
        "Y_B": nominal.rim,
        "Y_DT": nominal.deep,
        "Y_delta_relT": relative.notch,
        "Y_R_relT": relative.surface,
        "Y_X": relative.size,
        "Y_M": relative.alternating,
        "Y_NT": bending.bending_factors(metal.treatment).at(bent.cycles),
        "sigma_F0": nominal.nominal,
        "sigma_F": bent.stress,
        "sigma_FG": allowed,
        "sigma_FP": allowed / settings.safety_bending,
        "S_F": bent.safety,
        "damage_bending": bent.damage,
        "life_bending": bent.life,
    }
