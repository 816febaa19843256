"""Why the safeties of the simulation and of the standard part: the ratio of both, factor by factor."""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES
from tribodyn.studies.assessment.beside import (
    GivenFactors,
    LoadedTeeth,
    SimulatedStrength,
    given_factors,
    loaded_teeth,
    strength_beside,
)
from tribodyn.studies.assessment.case import AssessmentCase
from tribodyn.studies.gears.rated.capacity import Capacity
from tribodyn.studies.gears.rated.standard import LoadFactors

#: By how much safeties part until the reason is given.
PARTED = 0.15


class Reason(NamedTuple):
    """One of the factors by which the simulated safety is the standard's."""

    name: str
    factor: float  # above 1: the simulation is milder
    said: str  # the numbers behind it


def bending_reasons(
    gear: int, teeth: LoadedTeeth, given: GivenFactors, capacity: Capacity, factors: LoadFactors
) -> list[Reason]:
    """Factors of simulated over standard S_F; their product is that ratio.

    σ_F by the standard is σ_F0 K_A K_γ K_v K_Fβ K_Fα, the simulation's the largest stress in slow rotation,
    taken apart into what the pair carries of the whole load, how it spreads along the face, and the rest,
    which is what finite elements give for the same load; and what the motion adds.
    """
    rated, common = capacity.gears[gear].factors, capacity.common
    slow, moving = teeth.slow.root_peak[gear], teeth.moving.root_peak[gear]
    share, along_face = teeth.pair_share[gear], slow.along_face * given.face
    dynamic = moving.value / slow.value * given.dynamic
    even = slow.value / (share * slow.along_face)
    shape = math.prod(rated[name] for name in ("Y_F", "Y_S", "Y_beta", "Y_B", "Y_DT"))
    return [
        Reason(
            "load sharing",
            common["K_Falpha"] / share,
            f"K_Fα {common['K_Falpha']:.2f} on the whole load; the pair carries {100.0 * share:.0f} % of it",
        ),
        _dynamic(factors.dynamic_factor / dynamic, factors, dynamic),
        Reason(
            "face",
            common["K_Fbeta"] / along_face,
            f"K_Fβ {common['K_Fbeta']:.2f}, simulated {along_face:.2f}",
        ),
        Reason(
            "root stress by finite elements",
            rated["sigma_F0"] / even,
            f"Y_F Y_S Y_β Y_B Y_DT {shape:.2f}, finite elements {shape * even / rated['sigma_F0']:.2f}",
        ),
    ]


def pitting_reasons(
    gear: int, teeth: LoadedTeeth, given: GivenFactors, capacity: Capacity, factors: LoadFactors
) -> list[Reason]:
    """Factors of simulated over standard S_H; their product is that ratio. Stresses go with √load."""
    common = capacity.common
    slow, moving = teeth.slow.pressure_peak, teeth.moving.pressure_peak
    along_face = slow.along_face * math.sqrt(given.face)
    dynamic = (moving.value / slow.value) ** 2 * given.dynamic
    single, shared = common[("Z_B", "Z_D")[gear]], common["Z_epsilon"]
    even = slow.value / (math.sqrt(teeth.line_share) * slow.along_face)
    nominal = common["sigma_H0"] * single / shared
    spread, face = factors.transverse, factors.duty.face
    where = f"{math.degrees(teeth.pressure_roll):.1f}° from the pitch point"
    if teeth.on_path is not None:
        path = 1e-6 * teeth.on_path * math.sqrt(given.load)
        where += f"; in motion the largest is in corner contact, on the path {path:.0f} MPa"
    return [
        Reason(
            "load sharing",
            shared * math.sqrt(spread / teeth.line_share),
            f"Z_ε² K_Hα {shared**2 * spread:.2f}; {teeth.line_share:.2f} of the whole load per face width "
            "at the pressure's maximum",
        ),
        _dynamic(math.sqrt(factors.dynamic_factor / dynamic), factors, dynamic),
        Reason(
            "face",
            math.sqrt(face) / along_face,
            f"K_Hβ {face:.2f}, simulated {along_face**2:.2f} in the load",
        ),
        Reason(
            "curvature where the pressure is largest",
            nominal / even,
            f"the whole load on one pair gives {1e-6 * nominal:.0f} MPa by Z_H Z_E Z_β Z_{'BD'[gear]}, "
            f"{1e-6 * even:.0f} MPa {where}",
        ),
    ]


def _dynamic(factor: float, factors: LoadFactors, simulated: float) -> Reason:
    said = f"K_v {factors.dynamic_factor:.2f}, simulated {simulated:.2f} at the maximum"
    return Reason("dynamic factor", factor, said)


def reasons(
    teeth: LoadedTeeth,
    strength: SimulatedStrength,
    given: GivenFactors,
    capacity: Capacity,
    factors: LoadFactors,
) -> list[str]:
    """A sentence for every safety in which both part by more than `PARTED`."""
    found = []
    for name, mode, taken_apart in (
        ("S_H", "pitting", pitting_reasons),
        ("S_F", "bending", bending_reasons),
    ):
        for gear, side in enumerate(SIDES):
            simulated = getattr(strength, mode)[gear].safety
            standard = getattr(capacity.gears[gear], mode).safety
            if simulated is None or abs(math.log(simulated / standard)) <= math.log1p(PARTED):
                continue
            parts = taken_apart(gear, teeth, given, capacity, factors)
            largest = max(parts, key=lambda part: abs(math.log(part.factor)))
            written = "; ".join(f"{part.name} × {part.factor:.2f} ({part.said})" for part in parts)
            found.append(
                f"{name} of the {side}: {simulated:.2f} simulated, {standard:.2f} by the standard, "
                f"× {simulated / standard:.2f}, mostly by {largest.name}. {written[0].upper()}{written[1:]}."
            )
    return found


class Compared(NamedTuple):
    """The simulation beside the standard."""

    strength: SimulatedStrength | None  # None: without loads in motion
    parted: list[str]  # `reasons`


def compared(
    case: AssessmentCase,
    assembly: Assembly,
    motion: tuple[Mapping[str, Any], Mapping[str, Any]],
    capacity: Capacity | None,
    factors: LoadFactors | None,
    quantities: Mapping[str, Any],
) -> Compared:
    """Compare both; `motion` are arrays along the path, and those of the motion, see `loaded_teeth`."""
    teeth = loaded_teeth(case, assembly, *motion)
    if teeth is None:
        return Compared(None, [])
    found, parted = strength_beside(case, teeth, capacity, quantities), list[str]()
    if capacity is not None and factors is not None:
        parted = reasons(teeth, found, given_factors(case.settings, quantities), capacity, factors)
    return Compared(found, parted)
