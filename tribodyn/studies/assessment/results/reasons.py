"""Why the safeties of the simulation and of the standard part: the ratio of both, factor by factor."""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from tribodyn.gears.rating.capacity import Capacity, safeties
from tribodyn.gears.rating.standard import LoadFactors
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES
from tribodyn.quantities.catalogue import QUANTITIES
from tribodyn.studies.assessment.case import RatedPair
from tribodyn.studies.assessment.results.simulated_strength import (
    GivenFactors,
    LoadedTeeth,
    SimulatedStrength,
    given_factors,
    loaded_teeth,
    strength_beside,
)

#: By how much safeties part until the reason is given: 5 % of stress are a factor of 5 in a life.
PARTED = 0.05


class Reason(NamedTuple):
    """One of the factors by which the simulated safety is the standard's."""

    name: str
    factor: float  # above 1: the simulation is milder
    said: str  # the numbers behind it


def bending_reasons(
    gear: int, teeth: LoadedTeeth, prescribed: GivenFactors, capacity: Capacity, factors: LoadFactors
) -> list[Reason]:
    """Factors of simulated over standard S_F; their product is that ratio.

    σ_F by the standard is σ_F0 K_A K_γ K_v K_Fβ K_Fα, the simulation's the largest stress in slow rotation,
    taken apart into what the pair carries of the whole load, how it spreads along the face, and the rest,
    which is what finite elements give for the same load; and what the motion adds.
    """
    rated, common = capacity.gears[gear].factors, capacity.common
    slow, moving = teeth.slow.root_peak[gear], teeth.moving.root_peak[gear]
    share, along_face = teeth.pair_share[gear], slow.along_face * prescribed.face
    dynamic = moving.value / slow.value * prescribed.dynamic
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
    gear: int, teeth: LoadedTeeth, prescribed: GivenFactors, capacity: Capacity, factors: LoadFactors
) -> list[Reason]:
    """Factors of simulated over standard S_H; their product is that ratio. Stresses go with √load.

    Both at the point where the standard rates the flank, see `rated_flank`.
    """
    common, nominal = capacity.common, teeth.nominal
    slow, moving = teeth.flank_slow[gear], teeth.flank_moving[gear]
    along_face = slow.along_face * math.sqrt(prescribed.face)
    dynamic = (moving.largest / slow.largest) ** 2 * prescribed.dynamic
    single, shared = common[("Z_B", "Z_D")[gear]], common["Z_epsilon"]
    even = slow.largest / (math.sqrt(slow.carried) * slow.along_face)
    whole = common["sigma_H0"] * single / shared
    spread, face = factors.transverse, factors.duty.face
    return [
        Reason(
            "load sharing",
            math.sqrt(nominal.carried * spread / slow.carried),
            f"K_Hα {spread:.2f} on {nominal.carried:.2f} of the whole load per face width; simulated "
            f"{slow.carried:.2f}",
        ),
        _dynamic(math.sqrt(factors.dynamic_factor / dynamic), factors, dynamic),
        Reason(
            "face",
            math.sqrt(face) / along_face,
            f"K_Hβ {face:.2f}, simulated {along_face**2:.2f} in the load",
        ),
        Reason(
            "curvature",
            whole / even,
            f"the whole load on one pair gives {1e-6 * whole:.0f} MPa by Z_H Z_E Z_β Z_{'BD'[gear]}, "
            f"{1e-6 * even:.0f} MPa by Hertz at the same point",
        ),
    ]


def _dynamic(factor: float, factors: LoadFactors, simulated: float) -> Reason:
    explanation = f"K_v {factors.dynamic_factor:.2f}, simulated {simulated:.2f} at the maximum"
    return Reason("dynamic factor", factor, explanation)


def reasons(
    teeth: LoadedTeeth,
    strength: SimulatedStrength,
    prescribed: GivenFactors,
    capacity: Capacity,
    factors: LoadFactors,
) -> list[str]:
    """A sentence for every safety in which both part by more than `PARTED`."""
    sentences = []
    for name, mode, taken_apart in _MODES:
        for gear, side in enumerate(SIDES):
            simulated = getattr(strength, mode)[gear].safety
            standard = getattr(capacity.gears[gear], mode).safety
            if simulated is None or abs(math.log(simulated / standard)) <= math.log1p(PARTED):
                continue
            parts = taken_apart(gear, teeth, prescribed, capacity, factors)
            written = "; ".join(f"{part.name} × {part.factor:.2f} ({part.said})" for part in parts)
            sentences.append(
                f"{name} of the {side}: {simulated:.2f} simulated, {standard:.2f} by the standard, "
                f"× {simulated / standard:.2f}, mostly by {_largest(parts).name}. "
                f"{written[0].upper()}{written[1:]}."
            )
    return [*sentences, *_elsewhere(teeth, prescribed, strength)]


_MODES = (("S_H", "pitting", pitting_reasons), ("S_F", "bending", bending_reasons))


def _largest(parts: Sequence[Reason]) -> Reason:
    return max(parts, key=lambda part: abs(math.log(part.factor)))


def _elsewhere(teeth: LoadedTeeth, prescribed: GivenFactors, strength: SimulatedStrength) -> Iterator[str]:
    """The largest pressure in motion where it is not where the standard rates the flanks."""
    largest = teeth.moving.pressure_peak.value * math.sqrt(prescribed.load)
    rated = max(one.stress for one in strength.pitting) / teeth.nominal.credit
    if largest > (1.0 + PARTED) * rated:
        where = "in a tip's corner" if teeth.in_corner else "on the path of contact"
        yield (
            f"The flanks are pressed hardest {where}, {math.degrees(teeth.peak_roll):.1f}° from the pitch "
            f"point, with {1e-6 * largest:.0f} MPa; where the standard rates them, with "
            f"{1e-6 * rated:.0f} MPa. S_H is of the latter: σ_Hlim is the nominal stress of test gears whose "
            "flanks were pressed harder elsewhere, too."
        )


def rests_on(
    teeth: LoadedTeeth,
    strength: SimulatedStrength,
    prescribed: GivenFactors,
    capacity: Capacity,
    factors: LoadFactors,
) -> str:
    """Which figures the verdict rests on, and why the other ones differ."""
    by_simulation, rated = strength.safeties(), safeties(capacity)
    parts = []
    for name, mode, taken_apart in _MODES:
        simulated = [one.safety or math.inf for one in getattr(strength, mode)]
        standard = [getattr(gear, mode).safety for gear in capacity.gears]
        smaller = min(simulated, standard, key=min)
        reasoned = taken_apart(smaller.index(min(smaller)), teeth, prescribed, capacity, factors)
        both = sorted([(min(simulated), _SIMULATED), (min(standard), _STANDARD)])
        values = ", ".join(f"{value:.2f} {by}" for value, by in both)
        parts.append(f"{name} {values} (mostly {_largest(reasoned).name})")
    lives = sorted(
        [(by_simulation["life"], by_simulation, _SIMULATED), (rated["life"], rated, _STANDARD)],
        key=lambda one: one[0],
    )
    quantity, (remaining, unlimited) = (
        QUANTITIES["life"],
        (capacity.shortest.left, "life_unlimited" in lives[0][1]),
    )
    values = ", ".join(f"{quantity.written_of(life)} h {by}" for _, life, by in lives)
    steep = (
        ""
        if unlimited or remaining == 1.0
        else f" (1 % more stress leaves {100.0 * remaining:.0f} % of such a life)"
    )
    parts.append(f"life {values}{steep}")
    return f"The verdict rests on the smaller of standard and simulation: {'; '.join(parts)}."


_SIMULATED, _STANDARD = "simulated", "by the standard"


class Compared(NamedTuple):
    """The simulation beside the standard."""

    strength: SimulatedStrength | None  # None: without loads in motion
    parted: list[str]  # `reasons`
    rests: str  # `rests_on`; "": there is one of both alone


def compared(
    case: RatedPair,
    assembly: Assembly,
    motion: tuple[Mapping[str, Any], Mapping[str, Any]],
    capacity: Capacity | None,
    factors: LoadFactors | None,
    quantities: Mapping[str, Any],
) -> Compared:
    """Compare both; `motion` are arrays along the path, and those of the motion, see `loaded_teeth`."""
    teeth = loaded_teeth(case, assembly, *motion)
    if teeth is None:
        return Compared(None, [], "")
    strength, parted, rests = strength_beside(case, teeth, capacity, quantities), list[str](), ""
    if capacity is not None and factors is not None:
        both = teeth, strength, given_factors(case.settings, quantities), capacity, factors
        parted, rests = reasons(*both), rests_on(*both)
    return Compared(strength, parted, rests)
