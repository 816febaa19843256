"""Pitting and bending of a pair of gears by ISO 6336-2, -3, -5 and -6: stresses, safeties, life."""

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from tribodyn.cases.assessment_part import Meshing
from tribodyn.gears.case import OiledCase
from tribodyn.gears.rating.iso_names import common_names, flank_names, other_root_names, root_names
from tribodyn.gears.rating.margins import flanks_of
from tribodyn.gears.rating.settings import PEAKS_OVER_MEAN, RatingTable
from tribodyn.gears.rating.standard import LoadFactors, load_factors, path_of
from tribodyn.gears.rating.strength import metals_of
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES, Side, body_of, reference_radius, tip_circle_radius
from tribodyn.geometry.helix import normal_module, normal_pressure_angle
from tribodyn.geometry.root_section import critical_section
from tribodyn.standards import bending, pitting
from tribodyn.standards.fatigue import Bin, StressCurve, damage, life_share, safety
from tribodyn.standards.metals import Metal

#: Where lines of permissible stress end, load cycles.
LAST_CYCLES = 1e10
#: Miner's sum that stands for the infinite one of a stress above the static limit.
MOST_DAMAGE = 1e12


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
    left: float  # share of the life that 1 % more stress leaves


class GearCapacity(NamedTuple):
    """Capacity of one gear."""

    pitting: Failure
    bending: Failure
    factors: dict[str, float]  # by their names, those of this gear


class Capacity(NamedTuple):
    """Capacity of a pair."""

    gears: tuple[GearCapacity, GearCapacity]
    common: dict[str, float]  # factors of both gears by their names
    remarks: tuple[str, ...] = ()  # what lies outside the limits of the standard

    @property
    def shortest(self) -> Failure:
        """The failure with the shortest life of both gears."""
        every = [each for gear in self.gears for each in (gear.pitting, gear.bending)]
        return min(every, key=lambda each: (each.life, each.unlimited))

    @property
    def life(self) -> float:
        """The shortest life of both gears, s."""
        return self.shortest.life

    def by_name(self) -> dict[str, Any]:
        """Everything by the standard's names; what either gear has of its own by ``pinion``, ``gear``."""
        factors: dict[str, Any] = dict(self.common)
        for name in self.gears[0].factors:
            factors[name] = {side: gear.factors[name] for side, gear in zip(SIDES, self.gears, strict=True)}
        return factors


def capacity_of(
    case: OiledCase,
    assembly: Assembly,
    at_duty: LoadFactors,
    bins: Sequence[LoadBin],
    settings: RatingTable,
    meshing: tuple[Meshing, Meshing] = (Meshing(), Meshing()),
) -> Capacity | None:
    """Rate a pair of involutes whose pinion drives; None where the materials' strength is not known.

    `at_duty` are the load factors of the case's own duty, `bins` those of its life, shares 1 in sum. The
    velocity factor and the load factors of each bin are those of its own duty.
    """
    metals = metals_of(case)
    if metals is None:
        return None
    mesh = _mesh(case, assembly, settings)
    shape, influence = pitting.geometry(mesh), pitting.influences(mesh, metals)
    of_duties = [pitting.influences(mesh._replace(pinion_speed=load.pinion_speed), metals) for load in bins]
    roots = [_root(case, assembly, side, settings, turns) for side, turns in zip(SIDES, meshing, strict=True)]
    slender = min(root.face_width for root in roots) / max(root.tooth_height for root in roots)
    face, tangential = bending.face_factor(at_duty.duty.face, slender), pitting.tangential_load(mesh)
    faces = {load.factors.duty.face: bending.face_factor(load.factors.duty.face, slender) for load in bins}
    faces[at_duty.duty.face] = face
    gears, remarks = [], list[str]()
    for number, (metal, root, turns) in enumerate(zip(metals, roots, meshing, strict=True)):
        turned = turns.per_turn / (abs(mesh.path.ratio) if number else 1.0)
        cycles = [settings.life * load.share * load.pinion_speed * turned / (2.0 * math.pi) for load in bins]
        shares = [load.gear_torque / case.operating.gear_torque for load in bins]

        def flank(factors: LoadFactors, share: float = 1.0, number: int = number) -> float:
            return pitting.contact_stress(shape, factors.flank * share)[number]

        nominal = bending.nominal_stress(root, tangential)

        def bent(factors: LoadFactors, share: float = 1.0, nominal: bending.Stress = nominal) -> float:
            along = faces[factors.duty.face] / factors.duty.face
            return bending.root_stress(nominal, factors.flank * along * share)

        remarks += [f"Root of the {SIDES[number]}: {text}." for text in bending.beyond(root, nominal.notch)]
        relative = bending.relative_factors(root, nominal, metal)
        curves = pitting.permissible(metal, influence.of(number)), bending.permissible(metal, relative)
        by_speed = [pitting.permissible(metal, of_duty.of(number)) for of_duty in of_duties]
        own_curves = by_speed, [None] * len(bins)
        needed = settings.safety_pitting, settings.safety_bending
        failed = [
            _failure(
                stress(at_duty),
                [
                    Bin(stress(load.factors, share), n, cycles_of)
                    for load, share, n, cycles_of in zip(bins, shares, cycles, of_bins, strict=True)
                ],
                curve,
                required,
                settings.life,
            )
            for stress, curve, of_bins, required in zip(
                (flank, bent), curves, own_curves, needed, strict=True
            )
        ]
        factors = flank_names(metal, influence, number) | root_names(metal, root, nominal, relative)
        if any(each.internal for each in roots):
            other = _root(case, assembly, SIDES[number], settings, turns, other=True)
            factors |= other_root_names(
                other, bending.nominal_stress(other, tangential), settings.root_by_formula
            )
        gears.append(GearCapacity(failed[0], failed[1], factors | _failures_by_name(metal, failed, needed)))
    common = common_names(mesh, shape, influence) | {"K_Fbeta": face, "K_Falpha": at_duty.transverse}
    return Capacity((gears[0], gears[1]), common, tuple(remarks))


def _mesh(case: OiledCase, assembly: Assembly, settings: RatingTable) -> pitting.PittingMesh:
    sheet, drive, path = case.lubricant.sheet, assembly.drive, path_of(assembly)
    assert sheet is not None, "refused by the rules"
    rz = settings.peak_roughness or PEAKS_OVER_MEAN * case.mean_roughness
    return pitting.PittingMesh(
        path,
        (float(reference_radius(drive, "pinion")), float(reference_radius(drive, "gear"))),
        float(normal_pressure_angle(drive)),
        abs(float(drive.helix_angle)),
        float(assembly.common_width),
        path.pinion_torque(case.operating.gear_torque) * path.sense,
        case.operating.pinion_speed,
        flanks_of(case).reduced_modulus,
        float(sheet.viscosity_40),
        (rz, rz),
        settings.edition,
        _modification(case, settings),
    )


def _modification(case: OiledCase, settings: RatingTable) -> str:
    """How suitable the profile modification is, for f_ZCa: see `pitting.UNMODIFIED_FACTOR`."""
    if settings.adequate_tip_relief:
        return "suitable"
    flanks = case.mesh.modifications
    reliefs = [end.amount for flank in (flanks.pinion, flanks.gear) for end in (flank.tip, flank.root)]
    return "usual" if any(amount > 0.0 for amount in reliefs) else "none"


def _failures_by_name(
    metal: Metal, failures: Sequence[Failure], required: tuple[float, float]
) -> dict[str, float]:
    """Cycles, stresses, safeties and lives of pitting and bending by their names."""
    results = {"N_L": failures[0].cycles}
    lives = pitting.contact_factors(metal.treatment), bending.bending_factors(metal.treatment)
    names = ("Z_NT", "H", "pitting"), ("Y_NT", "F", "bending")
    for failure, life, safe, (of_life, letter, name) in zip(failures, lives, required, names, strict=True):
        allowed = failure.curve.at(failure.cycles)
        results |= {
            of_life: life.at(failure.cycles),
            f"sigma_{letter}": failure.stress,
            f"sigma_{letter}G": allowed,
            f"sigma_{letter}P": allowed / safe,
            f"S_{letter}": failure.safety,
            f"damage_{name}": failure.damage,
            f"life_{name}": failure.life,
        }
    return results


def life_bins(
    case: OiledCase,
    assembly: Assembly,
    at_duty: LoadFactors,
    spectrum: Sequence[tuple[float, float, float]] = (),
    faces: Sequence[float] = (),
) -> list[LoadBin]:
    """Duties of the life: a load spectrum's (share, pinion speed, gear torque), else the case's own duty.

    In a spectrum loads count as they are, K_A = 1 (ISO 6336-6); K_v and K_Hα follow each duty where they are
    not given, and so does K_Hβ, one for each duty in `faces`; without, and where it is given, it is that of
    the case's duty. A duty without load or against the motion does no damage to these flanks.
    """
    if not spectrum:
        return [LoadBin(1.0, case.operating.pinion_speed, case.operating.gear_torque, at_duty)]
    duty = at_duty.duty._replace(application=1.0)
    every = zip(spectrum, faces or [duty.face] * len(spectrum), strict=True)
    return [
        LoadBin(share, speed, torque, load_factors(case, assembly, duty._replace(face=face), (speed, torque)))
        for (share, speed, torque), face in every
        if torque > 0.0
    ]


def safeties(capacity: Capacity | None) -> dict[str, Any]:
    """The smaller S_H, S_F, S_FF of both gears, the shorter life, s; ``life_unlimited``: a lower bound."""
    if capacity is None:
        return {}
    fracture = [gear.factors["S_FF"] for gear in capacity.gears if "S_FF" in gear.factors]
    return {
        "S_H": min(gear.pitting.safety for gear in capacity.gears),
        "S_F": min(gear.bending.safety for gear in capacity.gears),
        **({"S_FF": min(fracture)} if fracture else {}),
    } | as_life(capacity.life, capacity.shortest.unlimited)


def as_life(life: float, unlimited: bool) -> dict[str, Any]:
    """A life, s, as summaries have it."""
    return {"life": life} | ({"life_unlimited": True} if unlimited else {})


def shorter_life(*failures: Mapping[str, Any]) -> dict[str, Any]:
    """The shorter of the lives that summaries have, see `as_life`."""
    lives = [(each["life"], bool(each.get("life_unlimited"))) for each in failures if "life" in each]
    return as_life(*min(lives)) if lives else {}


def required(settings: RatingTable) -> dict[str, float]:
    """What the settings require, by the names of the limits."""
    return {
        "pitting": settings.safety_pitting,
        "bending": settings.safety_bending,
        "life": settings.life,
    }


def _root(
    case: OiledCase,
    assembly: Assembly,
    side: Side,
    settings: RatingTable,
    turns: Meshing,
    other: bool = False,
) -> bending.BendingGear:
    """A root by the settings; `other`: by the other choice of `ring_root`."""
    drive = assembly.drive
    section = critical_section(assembly, side, by_formula=settings.root_by_formula != other)
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
        case.masses[SIDES.index(side)].rim or abs(root - bore),
        internal,
        case.quality.grade,
        settings.root_roughness,
        turns.reversed,
        settings.edition,
    )


def _failure(stress: float, bins: Sequence[Bin], curve: StressCurve, required: float, life: float) -> Failure:
    cycles = sum(one.cycles for one in bins)
    endured, unlimited = life_of(bins, curve, required, life, cycles)
    used = min(damage(bins, curve, required), MOST_DAMAGE)
    return Failure(
        stress,
        tuple(bins),
        curve,
        cycles,
        safety(bins, curve),
        used,
        endured,
        unlimited,
        1.0 if unlimited else used / max(damage(bins, curve, 1.01 * required), used),
    )


def life_of(
    bins: Sequence[Bin], curve: StressCurve, required: float, life: float, cycles: float
) -> tuple[float, bool]:
    """Life at a required safety, s, of bins of a required life with so many meshings, and whether unlimited.

    Where nothing is damaged it is that until `LAST_CYCLES`, at least the required one.
    """
    share = life_share(bins, curve, required)
    if math.isinf(share):
        return life * max(1.0, LAST_CYCLES / cycles), True
    return life * share, False
