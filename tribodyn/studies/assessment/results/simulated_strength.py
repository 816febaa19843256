"""Pitting and bending of the simulation beside the standard's: stresses, safeties, lives.

Hertz pressure where the standard rates a flank, and root stress by finite elements, under the loads of the
steady state at the duty; what is endured is the standard's.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.compliance.sharing.face_root_stress import ToothStress, tooth_stress
from tribodyn.compliance.sharing.load_sharing import LoadedFlanks, flexibility
from tribodyn.gears.rating.capacity import (
    MOST_DAMAGE,
    Capacity,
    Failure,
    as_life,
    life_of,
    shorter_life,
)
from tribodyn.gears.rating.strength import metals_of
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES
from tribodyn.numerics.shapes import Array, Float
from tribodyn.standards.bending import mean_stress_influence, pulsating_stress
from tribodyn.standards.fatigue import Bin, damage
from tribodyn.standards.rainflow import rainflow_repeated
from tribodyn.studies.assessment.case import RatedPair
from tribodyn.studies.assessment.results.rated_flank import (
    NominalLoad,
    RatedFlank,
    nominal_load,
    rated_flanks,
)
from tribodyn.studies.assessment.settings import AssessmentTable


class LoadedTeeth(NamedTuple):
    """Stresses of the teeth in slow rotation and in motion, without K_A, K_γ and other given factors."""

    slow: ToothStress
    moving: ToothStress
    #: pair_share: share of all pairs' load that one carries in slow rotation where the root stress of pinion
    #: and gear is largest
    pair_share: tuple[float, float]
    #: flank_slow, flank_moving: pressure where the standard rates the flanks of pinion and gear
    flank_slow: tuple[RatedFlank, RatedFlank]
    flank_moving: tuple[RatedFlank, RatedFlank]
    nominal: NominalLoad
    #: roll angle of the pinion from the pitch point, rad, at which the place with the largest pressure in
    #: motion touches, and whether it is beyond the path of contact: a tip's corner
    peak_roll: float
    in_corner: bool


def loaded_teeth(
    case: RatedPair, assembly: Assembly, along: Mapping[str, Any], motion: Mapping[str, Any]
) -> LoadedTeeth | None:
    """Stresses from the loads of a pair `along` its path and in `motion`, see `Findings`.

    In motion loads lie on the faces as in slow rotation, see `_in_motion`. None where there are none.
    """
    if not motion:
        return None
    flexible = flexibility(assembly, case.materials, lead=True, held=case.mesh.held)
    slices = along["line_load"].shape[1]
    flanks = LoadedFlanks(flexible, case.mesh.modifications, slices, case.mesh.slice_coupling)
    roll, helical = along["roll_angle"], float(case.drive.helix_angle) != 0.0
    length = flanks.contacts(roll[:, None]).length[:, 0] * flexible.width / slices
    slice_load = along["line_load"] * length
    # the places of one pair's way are those of all pairs at the positions of a mesh cycle
    positions = round(float(assembly.pitch_angle) / (roll[1] - roll[0]))

    def in_cycle(values: np.ndarray) -> np.ndarray:
        return np.moveaxis(values.reshape(-1, positions, *values.shape[1:])[::-1], 0, 1)

    loads = in_cycle(slice_load)
    slow = tooth_stress(flanks, in_cycle(roll), loads[None])
    moved = _in_motion(motion, roll, slice_load, helical)
    moving = tooth_stress(flanks, motion["roll_angle"], moved)
    shares = [_share(loads, peak.at) for peak in slow.root_peak]
    carried = np.sum(loads, axis=2) / np.sum(loads, axis=(1, 2))[:, None]
    if helical:
        touching = np.sum(in_cycle(length * (slice_load > 0.0)), axis=2)
        carried = carried * flexible.width / np.where(touching > 0.0, touching, np.inf)
    nominal = nominal_load(assembly)
    rolls = _slice_rolls(flanks, motion["roll_angle"])
    start, end = assembly.roll_limits
    peak = float(rolls[moving.pressure_peak.at[1:]])
    return LoadedTeeth(
        slow,
        moving,
        (shares[0], shares[1]),
        rated_flanks(_slice_rolls(flanks, in_cycle(roll)), slow.pressure, nominal, carried),
        rated_flanks(rolls, moving.pressure, nominal),
        nominal,
        peak,
        not start <= peak <= end,
    )


def _slice_rolls(
    flanks: LoadedFlanks, roll: Float[Array, "position pair"]
) -> Float[Array, "position pair slice"]:
    """Angles at which slices touch, of spur pairs all the same."""
    rolls = flanks.rolls(roll)
    return rolls if rolls.ndim == 3 else np.repeat(rolls[..., None], flanks.slices, axis=-1)


def _share(loads: Float[Array, "position pair slice"], at: tuple[int, int, int, int]) -> float:
    return float(np.sum(loads[at[1], at[2]]) / np.sum(loads[at[1]]))


def _in_motion(
    motion: Mapping[str, Any],
    roll: Float[Array, " place"],
    slice_load: Float[Array, "place slice"],
    helical: bool,
) -> Float[Array, "cycle position pair slice"]:
    """Loads of slices in motion, N, from those of a pair in slow rotation over its roll angle.

    Spur pairs have their own loads of the motion, each spread as in slow rotation; where a pair carries none
    there, as in the nearest place. Of helical pairs all loads of an instant are raised alike: where slices
    come and go one by one, a pair's load of a model that differs a little would lie on the last of them.
    """
    wanted, total = motion["roll_angle"], motion["normal_load"][..., None]
    if helical:
        shape = _at_roll(wanted, roll, slice_load, outside=0.0)
        return shape * np.sum(total, axis=2, keepdims=True) / np.sum(shape, axis=(1, 2), keepdims=True)
    loaded = np.sum(slice_load, axis=1) > 0.0
    shape = _at_roll(wanted, roll[loaded], slice_load[loaded])
    return total * shape / np.sum(shape, axis=-1, keepdims=True)


def _at_roll(
    wanted: Float[Array, "position pair"],
    roll: Float[Array, " place"],
    values: Float[Array, "place slice"],
    outside: float | None = None,
) -> Float[Array, "position pair slice"]:
    columns = [np.interp(wanted, roll, column, outside, outside) for column in values.T]
    return np.stack(columns, axis=-1)


class GivenFactors(NamedTuple):
    """Factors of load that a case gives, over those that the simulation has itself."""

    application: float  # K_A K_γ
    dynamic: float  # K_v over the simulation's
    face: float  # K_Hβ over the simulation's

    @property
    def load(self) -> float:
        """By which all loads grow."""
        return self.application * self.dynamic * self.face


def given_factors(settings: AssessmentTable, quantities: Mapping[str, Any]) -> GivenFactors:
    """What stands beside the simulation's own factors, or replaces them; see also `margins.load_factor`."""
    simulated, face = max(quantities["dynamic_factor"], 1.0), quantities["face_load_factor"]
    return GivenFactors(
        settings.application_factor * (settings.mesh_load_factor or 1.0),
        (settings.dynamic_factor or simulated) / simulated,
        (settings.face_load_factor or face) / face,
    )


class SimulatedFailure(NamedTuple):
    """One way to fail of one gear, as `capacity.Failure`; safety and life are None without a material's."""

    stress: float  # Pa
    safety: float | None = None
    life: float | None = None  # s
    damage: float | None = None  # Miner's sum at the required safety; 0: without end, `life` is a lower bound
    #: the same under stresses so many times as large
    times: Callable[[float], "SimulatedFailure"] | None = None


class SimulatedStrength(NamedTuple):
    """What the simulation says of pitting and bending, of pinion and gear."""

    pitting: tuple[SimulatedFailure, SimulatedFailure]
    bending: tuple[SimulatedFailure, SimulatedFailure]

    def by_name(self) -> dict[str, dict[str, float]]:
        """By the standard's names, of each gear."""
        by_key: dict[str, dict[str, float]] = {}
        for letter, name, both in (("H", "pitting", self.pitting), ("F", "bending", self.bending)):
            values = {f"sigma_{letter}": "stress", f"S_{letter}": "safety"}
            values |= {f"life_{name}": "life", f"damage_{name}": "damage"}
            for key, field in values.items():
                of_gears = {side: getattr(one, field) for side, one in zip(SIDES, both, strict=True)}
                by_key |= {key: of_gears} if None not in of_gears.values() else {}
        return by_key

    def times(self, flank: float, root: float) -> "SimulatedStrength":
        """The same under stresses so many times as large."""
        scaled = [
            [one.times(factor) if one.times else one._replace(stress=factor * one.stress) for one in both]
            for factor, both in ((flank, self.pitting), (root, self.bending))
        ]
        return SimulatedStrength((scaled[0][0], scaled[0][1]), (scaled[1][0], scaled[1][1]))

    def safeties(self) -> dict[str, Any]:
        """The smaller safeties of both gears and the shortest life, as `capacity.safeties`."""
        named = self.by_name()
        smallest = {name: min(named[name].values()) for name in ("S_H", "S_F") if name in named}
        every = [one for both in self for one in both if one.life is not None]
        return smallest | shorter_life(*(as_life(one.life or 0.0, one.damage == 0.0) for one in every))


def strength_beside(
    case: RatedPair, teeth: LoadedTeeth, capacity: Capacity | None, quantities: Mapping[str, Any]
) -> SimulatedStrength:
    """Safeties and lives of stresses of the simulation, by the stresses that the standard permits.

    Under a load spectrum the stresses follow the duties as the standard's do. A flank's place is pressed once
    in a meshing; at the root cycles are counted by rain-flow.
    """
    settings, metals = case.settings, metals_of(case)
    prescribed = given_factors(settings, quantities)
    pressed = float(np.sqrt(prescribed.load)) * teeth.nominal.credit
    pitting, bending = [], []
    for gear, peak in enumerate(teeth.moving.root_peak):
        rated_at = teeth.flank_moving[gear]
        flank = [Bin(pressed * float(p), 1.0) for p in rated_at.pressure]
        of_flank = SimulatedFailure(pressed * rated_at.largest)
        of_root = SimulatedFailure(prescribed.load * peak.value)
        if capacity is not None and metals is not None:
            rated = capacity.gears[gear]
            influence = mean_stress_influence(metals[gear], rated.factors["Y_S"])
            root = root_bins(prescribed.load * teeth.moving.root[gear], influence)
            required = settings.safety_pitting, settings.safety_bending
            life = settings.life
            of_flank = _rated(of_flank, flank, len(flank), rated.pitting, required[0], life)
            of_root = _rated(of_root, root, len(teeth.moving.root[gear]), rated.bending, required[1], life)
        pitting.append(of_flank)
        bending.append(of_root)
    return SimulatedStrength((pitting[0], pitting[1]), (bending[0], bending[1]))


def root_bins(course: Float[Array, "tooth time"], influence: float) -> list[Bin]:
    """Pulsating stresses with the damage of the cycles of some teeth, Pa; between its meshings a tooth rests.

    Compression by a neighbour's load counts as rest: the roots of running test gears have it too, so that
    σ_Flim contains it. `influence` is M of ISO 6336-3, annex B.
    """
    at_rest = np.pad(np.maximum(course, 0.0), ((0, 0), (0, 1)))
    cycles = rainflow_repeated(at_rest.ravel())
    bins = [Bin(pulsating_stress(each.low, each.high, influence), each.share) for each in cycles]
    return [one for one in bins if one.stress > 0.0]


def _rated(
    failure: SimulatedFailure,
    bins: Sequence[Bin],
    meshings: int,
    rated: Failure,
    required: float,
    life: float,
) -> SimulatedFailure:
    """Add safety and life: `bins` are those of so many meshings at the duty, `rated` by the standard."""
    endured = [
        Bin(one.stress * duty.stress / rated.stress, one.cycles / meshings * duty.cycles, duty.curve)
        for duty in rated.bins
        for one in bins
    ]

    def times(factor: float) -> SimulatedFailure:
        stress = factor * failure.stress
        grown = [one._replace(stress=factor * one.stress) for one in endured]
        reached, _ = life_of(grown, rated.curve, required, life, rated.cycles)
        used = min(damage(grown, rated.curve, required), MOST_DAMAGE)
        return SimulatedFailure(stress, rated.safety * rated.stress / stress, reached, used, times)

    return times(1.0)
