"""Jia et al., Mathematics 10(22):4290 (2022): limits of k1 and k2, contact ratios, stresses as ratios.

Loads along the face and root stresses are of the sliced load contact model; as in the paper's finite elements
134 N·m on the pinion, no friction, relief on the pinion only, y1 = y2. The misalignment is taken in the plane
of action.
"""

import math
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path
from typing import Any, Literal, NamedTuple

import numpy as np
from scipy.optimize import brentq

from tribodyn.compliance.sharing.load_sharing import LoadedFlanks, flexibility
from tribodyn.compliance.sharing.loaded_contact import LoadedContact, roll_through
from tribodyn.compliance.sharing.slices import PairFlexibility
from tribodyn.gears.case import LubricatedCase
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.families import family
from tribodyn.geometry.families.parabolic import maximum_coefficient
from tribodyn.geometry.modification import FlankModification, LeadRelief, Misalignment, Modifications
from tribodyn.geometry.path import kinematics
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.tribology.contact import hertz_pressure
from tribodyn.validation.rows import Row, compare_paper

#: Share of the way from the pitch point to the last contact within which a place is near either of them.
NEAR = 0.25


class Passage(NamedTuple):
    """What one pair of teeth goes through, over increasing pinion angle (point,), maximum over the face."""

    roll: np.ndarray  # pinion angle from the pitch point, rad
    line_load: np.ndarray  # N/m
    pressure: np.ndarray  # maximum Hertz pressure, Pa
    #: compression, tension: maximum root stress of both gears, Pa, as amounts
    compression: np.ndarray
    tension: np.ndarray

    def place(self, name: str) -> float:
        """Where a quantity is largest: from the pitch point, 0, to the last contact, 1; < 0 before it."""
        return float(self.roll[int(np.argmax(getattr(self, name)))] / self.roll[self.line_load > 0.0][-1])


def positions(
    involute: Passage, parabolic: Passage, relieved: Sequence[Passage]
) -> dict[str, tuple[bool, str]]:
    """Claims of §4.2.2 and §4.2.3 about unmodified gears and about parabolic ones with relief."""
    stresses = ("line_load", "compression", "tension")
    middle = [involute.place(name) for name in stresses]
    contact = [passage.place("line_load") for passage in relieved]

    def text_of(places: Sequence[float]) -> str:
        return ", ".join(f"{place:+.2f}" for place in places) + " of the way from P to the last contact"

    claims = {
        "jia/claim-involute-largest-near-the-middle": (
            all(abs(place) <= NEAR for place in middle),
            f"line load, compression, tension at {text_of(middle)}",
        ),
        "jia/claim-contact-largest-near-the-pitch-circle": (
            all(abs(place) <= NEAR for place in contact),
            f"line load of the relieved gears at {text_of(contact)}",
        ),
    }
    for name in stresses[1:]:
        places = [one.place(name) for one in (parabolic, *relieved)]
        late = all(place >= 1.0 - NEAR for place in places)
        text = f"unmodified, then relieved at {text_of(places)}"
        claims[f"jia/claim-{name}-largest-before-the-exit"] = late, text
    return claims


Name = Literal["involute", "parabolic"]
DRIVES: tuple[Name, Name] = ("involute", "parabolic")
PINION_TORQUE, ARC_MINUTE = 134.0, math.radians(1.0 / 60.0)  # N m, rad
#: Positions over a mesh cycle of 360/17 degrees, steps of a degree; slices of 0.6 mm. With 51 slices ratios
#: of aligned gears change by less than 0.1 %, those of misaligned ones by less than 1 %.
POSITIONS, SLICES = 21, 41


class FaceState(NamedTuple):
    """Modifications and misalignment of the gears."""

    relief: float = 0.0  # y1 = y2, µm
    unmodified: float = 0.0  # y3, mm
    misalignment: float = 0.0  # arc minutes in the plane of action
    coupled: bool = True  # whether slices hold each other


#: The paper's relief where it looks at misalignment.
CROWNED = FaceState(8.0, 8.0)
STATES = {"unmodified": FaceState(), "crowned": CROWNED}


def case_of(name: Name) -> LubricatedCase:
    """Return the gears of one of the paper's two drives."""
    return load_scenario(f"jia-{name}-17-29").pair


@cache
def elastic(name: Name) -> PairFlexibility:
    """Finite elements of a drive, for loads that vary along the face."""
    case = case_of(name)
    return flexibility(assemble(family(case.family), case.drive), case.materials, lead=True, held=True)


def modified(state: FaceState) -> FlankModification:
    """Return the flanks of the pinion."""
    relief = state.relief * 1e-6
    return FlankModification(lead=LeadRelief(relief, relief, state.unmodified * 1e-3))


@cache
def rolled(name: Name, state: FaceState = FaceState()) -> LoadedContact:
    """One mesh cycle of a drive in slow rotation."""
    flexible = elastic(name)
    teeth = flexible.assembly.drive
    tilt = Misalignment(in_plane=state.misalignment * ARC_MINUTE)
    flanks = Modifications(pinion=modified(state), misalignment=tilt)
    torque = PINION_TORQUE * teeth.gear.teeth / teeth.pinion.teeth
    return roll_through(LoadedFlanks(flexible, flanks, SLICES, state.coupled), torque, POSITIONS)


class Maximum(NamedTuple):
    """Maximum value of a mesh cycle, and where: pinion angle (°) and place along the face (mm)."""

    value: float
    roll: float
    place: float


def maximum(name: Name, state: FaceState = FaceState(), of: str = "line_load", away: float = 0.0) -> Maximum:
    """Maximum over mesh cycle and face: of the "line_load" (N/m) or the Hertz "pressure" (Pa).

    Of pairs at least `away` degrees from the pitch point.
    """
    run = rolled(name, state)
    values = getattr(run, of) * (np.abs(np.degrees(run.roll)) >= away)[..., None]
    position, pair, part = np.unravel_index(int(np.argmax(values)), values.shape)
    place = 1e3 * float(run.slice_position[part])
    return Maximum(float(values[position, pair, part]), float(np.degrees(run.roll[position, pair])), place)


def maximum_root_stress(name: Name, tension: bool, state: FaceState = FaceState()) -> tuple[float, float]:
    """Maximum root stress of pinion and gear over mesh cycle and face, Pa, as an amount."""
    run = rolled(name, state)
    pinion, gear = np.nanmax(run.root_tension if tension else -run.root_compression, axis=(1, 2, 3))
    return float(pinion), float(gear)


def passage(name: Name, state: FaceState = FaceState()) -> Passage:
    """One pair from just before its first to just beyond its last contact."""
    run = rolled(name, state)
    order = np.argsort(run.roll, axis=None)
    loaded = np.flatnonzero(run.normal_load.ravel()[order] > 0.0)
    order = order[max(loaded[0] - 1, 0) : loaded[-1] + 2]
    along_face = (
        run.line_load,
        run.pressure,
        np.nan_to_num(np.max(-run.root_compression, axis=0)),
        np.nan_to_num(np.max(run.root_tension, axis=0)),
    )
    return Passage(run.roll.ravel()[order], *(np.max(part, axis=-1).ravel()[order] for part in along_face))


# Pairs closer to the pitch point, degrees, are left out where pressures of the two families are compared.
_NEAR = 2.0
_PRESSURES = "Hertz pressures"


def rows(folder: Path, progress: Callable[[float], None]) -> list[Row]:
    """All rows of the paper; no run is recorded, so that `folder` stays empty."""
    values = geometry()
    # Tables 4 and 5 over their own value without misalignment, Table 3 over the unmodified
    ratios: dict[str, tuple[Name, FaceState, FaceState, bool]] = {}
    for name in DRIVES:
        for sort, base in STATES.items():
            for minutes in (1, 2, 3):
                state = base._replace(misalignment=float(minutes))
                ratios[f"jia/misaligned-{name}-{sort}-{minutes}"] = name, state, base, minutes == 3
    for unmodified in (0, 8):
        for relief in (4, 8, 12):
            state = FaceState(float(relief), float(unmodified))
            ratios[f"jia/crown-{relief}-{relief}-{unmodified}"] = "parabolic", state, FaceState(), relief == 8
    for done, (key, printed) in enumerate(ratios.items(), start=1):
        values[key] = _ratio(*printed)
        progress(done / len(ratios))
    values |= _families() | tables()
    alternatives: dict[str, dict[str, Any]] = {}
    for key, (_, _, *others) in values.items():
        for choice, value in others:
            alternatives.setdefault(choice, {})[key] = value
    return compare_paper("jia-2022", {key: printed[:2] for key, printed in values.items()}, alternatives)


def tables() -> dict[str, tuple[Any, ...]]:
    """Ratios of Tables 3 to 5 and of the conclusions as lists: bending, and one family over the other."""
    kinds: dict[str, Callable[[Name, FaceState], float]] = {
        "contact": lambda name, state: maximum(name, state).value,
        "compression": lambda name, state: max(maximum_root_stress(name, False, state)),
        "tension": lambda name, state: max(maximum_root_stress(name, True, state)),
    }
    base, relief = FaceState(), [FaceState(y, y3) for y3 in (0.0, 8.0) for y in (4.0, 8.0, 12.0)]
    tilted = {
        sort: [state._replace(misalignment=float(minutes)) for minutes in range(4)]
        for sort, state in STATES.items()
    }
    ratios: dict[str, tuple[Any, ...]] = {}
    lower = True
    for kind, of in kinds.items():
        for sort, states in tilted.items():
            over = [of("parabolic", state) / of("involute", state) for state in states]
            lower = lower and max(over) < 1.0
            # without misalignment the unmodified gears are the rows of Table 2
            ratios[f"jia/families-{kind}-{sort}"] = over[1:] if sort == "unmodified" else over, ""
            for name in DRIVES if kind != "contact" else ():
                over_unmodified = [of(name, state) / of(name, states[0]) for state in states[1:]]
                ratios[f"jia/misaligned-{kind}-{name}-{sort}"] = over_unmodified, ""
        if kind != "contact":
            values = [of("parabolic", state) / of("parabolic", base) for state in relief]
            ratios[f"jia/crown-{kind}-0"], ratios[f"jia/crown-{kind}-8"] = (values[:3], ""), (values[3:], "")
            stresses = [of(name, base) / 1e6 for name in DRIVES]
            ratios[f"jia/stress-{kind}"] = stresses, "involute, parabolic"
    for key, after, before in (
        ("modified-at-3", tilted["crowned"][3], tilted["unmodified"][3]),
        ("relief-4-to-12", relief[2], relief[0]),
        ("straight-0-to-8", relief[4], relief[1]),
    ):
        ratios[f"jia/{key}"] = [of("parabolic", after) / of("parabolic", before) for of in kinds.values()], ""
    pressures = [
        maximum("parabolic", state, of="pressure").value < maximum("involute", state, of="pressure").value
        for states in tilted.values()
        for state in states
    ]
    involute, parabolic = (passage(name) for name in DRIVES)
    ratios |= positions(involute, parabolic, [passage("parabolic", state) for state in relief])
    note = "line loads and root stresses, modified or not, at 0 to 3 arcmin"
    ratios["jia/claim-parabolic-below-involute"] = lower, note, (_PRESSURES, all(pressures))
    return ratios


def geometry() -> dict[str, tuple[Any, ...]]:
    """Rows of limits of the geometry, contact ratios and the pressure at the pitch point: value and note."""
    case = case_of("involute")
    parabolic, involute = (assemble(family(name), case_of(name).drive) for name in ("parabolic", "involute"))
    lowest, highest_k1 = published_limits(parabolic.drive.gear.teeth)
    _, most_k2 = published_limits(parabolic.drive.pinion.teeth)
    actual = [maximum_coefficient(parabolic.drive, half) for half in (1, -1)]
    true = "by the geometry, with the mate's actual tip: below {:.3f}"
    # of one pair at the pitch point under the whole torque
    at = kinematics(involute.path, 0.0)
    line_load = case.operating.gear_torque / float(at.gear_normal_arm) / involute.drive.gear.face_width
    modulus = 2.0 / sum((1 - m.poisson_ratio**2) / m.youngs_modulus for m in case.materials)
    pressure = float(hertz_pressure(line_load, float(at.relative_curvature), modulus))
    ratio = involute.contact_ratio
    # Z_ε of ISO 6336-2 for spur gears, which takes off the part of the load that a second pair carries
    factor = math.sqrt((4.0 - ratio) / 3.0)
    return {
        "jia/k1-max": (highest_k1, true.format(actual[0]), ("actual tip", actual[0])),
        "jia/k2-max": (most_k2, true.format(actual[1]), ("actual tip", actual[1])),
        "jia/k-min": (
            lowest,
            "by the geometry there is no such limit: smaller k only steepens the path",
            ("actual tip, no limit", None),
        ),
        "jia/cr-novel": (parabolic.contact_ratio, ""),
        "jia/cr-involute": (ratio, ""),
        "jia/hertz-pitch": (
            factor * pressure / 1e6,
            f"{pressure / 1e6:.2f} MPa without Z_eps = {factor:.4f}",
            ("without Z_eps", pressure / 1e6),
        ),
    }


def published_limits(teeth: float) -> tuple[float, float]:
    """Minimum and maximum k without undercut by Jia's (42) and (44), from the teeth of the wheel it rolls in.

    sin(π/(2z)) < (1 − 2k)/(2√(k(1 − k))) ≤ (1 − 2k)/(1 − k), the latter two being the sines of the paper's β
    and u_t at the critical point. Its β is read off as sin β = y/O₂M where the geometry gives x/O₂M, so that
    the lower limit (always 1/5) is an artefact; `parabolic.maximum_coefficient` is the actual upper one.
    """
    # with s = sin(π/2z): (1 − 2k)² = 4 s² k (1 − k), a quadratic in k
    sine = math.sin(math.pi / (2 * teeth))

    def between(k: float) -> float:
        return 2 * math.sqrt(k * (1 - k)) - (1 - k)

    lowest: Any = brentq(between, 0.01, 0.5, xtol=1e-12)
    return round(float(lowest), 9), (1 - sine / math.sqrt(1 + sine**2)) / 2


def _ratio(
    name: Name, state: FaceState, base: FaceState, apart: bool
) -> tuple[float, str, tuple[str, float]]:
    """Ratio of the maximum line loads; the note has where, and the ratios of other readings."""
    most = maximum(name, state)
    pressures = maximum(name, state, of="pressure").value / maximum(name, base, of="pressure").value
    note = (
        f"ratio of maximum line loads over mesh cycle and face, {most.value / 1e3:.0f} N/mm at "
        f"{most.roll:+.1f} deg from the pitch point, {most.place:+.0f} mm from the middle; "
        f"of maximum Hertz pressures {pressures:.4f}"
    )
    if apart:
        free = [maximum(name, state_of._replace(coupled=False)).value for state_of in (state, base)]
        note += f"; of line loads on slices that do not hold each other {free[0] / free[1]:.4f}"
    return most.value / maximum(name, base).value, note, (_PRESSURES, pressures)


def _families() -> dict[str, tuple[Any, ...]]:
    """Rows of Table 2: parabolic over involute, neither modified nor misaligned."""
    ours, theirs = (maximum(name).value for name in ("parabolic", "involute"))
    pressure = [maximum(name, of="pressure").value for name in ("parabolic", "involute")]
    away = [maximum(name, of="pressure", away=_NEAR).value for name in ("parabolic", "involute")]
    compared: dict[str, tuple[Any, ...]] = {
        "jia/ratio-contact": (
            ours / theirs,
            f"ratio of maximum line loads, {ours / 1e3:.0f} and {theirs / 1e3:.0f} N/mm. Hertz pressure "
            f"does not fall: {pressure[0] / 1e6:.0f} and {pressure[1] / 1e6:.0f} MPa at most, "
            f"{away[0] / 1e6:.0f} and {away[1] / 1e6:.0f} MPa more than {_NEAR:g} deg from the pitch point, "
            "where the parabolic flanks' radius goes to zero",
            (_PRESSURES, pressure[0] / pressure[1]),
        )
    }
    for key, tension in (("compression", False), ("tension", True)):
        parabolic, involute = (maximum_root_stress(name, tension) for name in ("parabolic", "involute"))
        compared[f"jia/ratio-{key}"] = (
            max(parabolic) / max(involute),
            "maximum root stress of pinion, gear: "
            f"parabolic {parabolic[0] / 1e6:.0f}, {parabolic[1] / 1e6:.0f} MPa, "
            f"involute {involute[0] / 1e6:.0f}, {involute[1] / 1e6:.0f} MPa",
        )
    return compared
