"""A pair of gears in slow rotation under load: line loads along the face, pressures, errors, stiffness.

The load contact model (`load_sharing`) at many positions, with flanks as they are modified and axes as they
stand. Phase 0 is where a pair passes the beginning of its path of contact, in the middle of its face,
whatever the load.
"""

import math
from typing import NamedTuple

import numpy as np

from tribodyn.compliance.sharing.face_root_stress import root_stress
from tribodyn.compliance.sharing.flank_gap import (
    check_modifications,
    flank_gap,
    maximum_along_lead,
    pitch_gap,
)
from tribodyn.compliance.sharing.load_sharing import LoadedFlanks, SharedLoad, half_width
from tribodyn.compliance.sharing.section import is_helical
from tribodyn.compliance.sharing.slices import PairFlexibility
from tribodyn.errors import InputError
from tribodyn.geometry.corner_contact import pair_geometry, roll_at_gap
from tribodyn.geometry.helix import roll_shift
from tribodyn.geometry.modification import MINIMUM_SLICES, too_few_slices, vary_along_lead
from tribodyn.numerics.processes.libraries import one_blas_thread
from tribodyn.numerics.shapes import Array, Float, Int


def check_torque(gear_torque: float) -> None:
    """Refuse a torque that presses no flanks together."""
    if gear_torque <= 0:
        rule = "presses no flanks together: the load contact model is taken at this load"
        raise InputError("operating.gear_torque", gear_torque, rule, 'write a torque such as "500 N*m"')


def check_contact(flanks: LoadedFlanks, gear_torque: float) -> None:
    """Refuse loads that drive nothing, modifications that are none, too few slices for them, and too many.

    A slice must be as wide as its contact: the loads of narrower ones are not line loads to each other.

    Raises InputError, which names the key, the rule and a value that obeys it.
    """
    flexible, modifications, slices, _ = flanks
    check_torque(gear_torque)
    check_modifications(flexible.assembly, modifications)
    varies = vary_along_lead(modifications) or is_helical(flexible.assembly)
    if broken := too_few_slices(slices, varies):
        raise broken
    motion = pair_geometry(flexible.assembly, np.zeros(1)).motion
    line_load = np.abs(gear_torque / motion.gear_normal_arm) / flexible.width
    contact = 2.0 * float(half_width(flexible, motion.relative_curvature, line_load)[0])
    if contact > flexible.width:
        raise InputError(
            "operating.gear_torque",
            f"{gear_torque:g} N m",
            f"flattens the contact to {contact * 1e3:.2g} mm, wider than the face",
            "use a smaller load",
        )
    if slices * contact > flexible.width:
        raise InputError(
            "mesh.slices",
            slices,
            f"makes slices narrower than the contact at {gear_torque:g} N m, {contact * 1e3:.2g} mm",
            f"give at most {int(flexible.width / contact)}",
        )


def check_resolved(flanks: LoadedFlanks, shared: SharedLoad, gear_torque: float) -> None:
    """Refuse what leaves the heaviest pair on fewer slices than a distribution along the face needs."""
    slices = shared.slice_load.shape[-1]
    if slices < MINIMUM_SLICES or not vary_along_lead(flanks.modifications):
        return
    heaviest = np.argmax(shared.normal_load, axis=1)[:, None, None]
    touching = np.sum(np.take_along_axis(shared.slice_load, heaviest, axis=1)[:, 0] > 0.0, axis=-1)
    if np.any(touching < MINIMUM_SLICES):
        raise InputError(
            *maximum_along_lead(flanks.flexible.assembly, flanks.modifications),
            f"lifts the flanks off each other: at {gear_torque:g} N m only {int(np.min(touching))} "
            f"of {slices} slices carry the heaviest pair",
            "give less, or more torque; or more mesh.slices, to resolve so narrow a contact",
        )


#: Corners are followed to a gap of this many deflections of a single pair.
REACH = 2.0
# Phases at which the unloaded error is sampled for the reach of the contact.
_PHASES = 60


def at_pitch_point(roll: Float[Array, "position pair"]) -> tuple[int, int]:
    """Position and pair whose contact is nearest to the pitch point, of pinion angles from it."""
    position, pair = np.unravel_index(int(np.argmin(np.abs(roll))), roll.shape)
    return int(position), int(pair)


class LoadedContact(NamedTuple):
    """Slow rotation under load; the pair that entered first in front."""

    phase: Float[Array, " position"]  # mesh cycles since a pair passed the beginning of its path of contact
    roll: Float[Array, "position pair"]  # pinion angle of each pair from the pitch point, rad
    slice_position: Float[Array, " slice"]  # middle of each slice from the middle of the face, m
    deflection: Float[Array, " position"]  # ξ = r_p θ_p − r_g θ_g, m: loaded static transmission error
    #: the same without load: the kinematic error, m; the load's deflection is the difference
    unloaded: Float[Array, " position"]
    normal_load: Float[Array, "position pair"]  # N
    line_load: Float[Array, "position pair slice"]  # per length of the line of contact, N/m
    pressure: Float[Array, "position pair slice"]  # maximum Hertz pressure, Pa
    half_width: Float[Array, "position pair slice"]  # of the contact, m
    #: root_tension, root_compression: maximum stress along the root of each pair's tooth of pinion and gear,
    #: tension positive and compression negative, Pa (`face_root_stress`)
    root_tension: Float[Array, "2 position pair slice"]
    root_compression: Float[Array, "2 position pair slice"]
    #: K_Hβ, maximum over mean line load along the face (ISO 6336-1), of helical pairs along the part of it
    #: that is on the path of contact; NaN where a pair carries nothing
    face_load_factor: Float[Array, "position pair"]
    mesh_stiffness: Float[Array, " position"]  # dF/dξ on the pitch circles, N/m: of what touches, tangent
    contact_ratio: float  # mean number of pairs that carry load

    @property
    def peak_to_peak(self) -> float:
        """Of the loaded static transmission error, m."""
        return float(np.ptp(self.deflection))


@one_blas_thread()
def roll_through(
    flanks: LoadedFlanks,
    gear_torque: float,
    positions: int,
    cycles: int = 1,
    friction_coefficient: float = 0.0,
) -> LoadedContact:
    """Roll a pair of gears slowly through some mesh cycles under a constant torque T_g > 0 (N m).

    Raises InputError if the torque drives nothing, a modification is none (`check_modifications`), or slices
    do not resolve what carries; SimulationError if no state of contact is found.

    Parameters
    ----------
    flanks : with `lead` in their `load_sharing.flexibility`
    positions : equal steps of a mesh cycle
    cycles : more than one where pitch errors make teeth differ
    friction_coefficient : μ, the same for all
    """
    phase, roll, gap, shared = _rolled(flanks, gear_torque, positions, cycles, friction_coefficient)
    flexible, _, slices, coupled = flanks
    seen = flanks.contacts(roll)
    per_width = shared.slice_load * (slices / flexible.width)
    line_load = per_width / seen.length
    half = half_width(flexible, seen.curvature, line_load)
    total = shared.normal_load
    tension, compression = root_stress(flexible, seen, per_width, coupled)
    # of helical pairs the mean is over the part of the face that is on the path of contact
    start, end = flexible.assembly.roll_limits
    rolls = flanks.rolls(roll)
    rolls_alike, on_path = rolls.ndim == 2, (rolls >= start) & (rolls <= end)
    with np.errstate(invalid="ignore", divide="ignore"):
        pressure = np.where(line_load > 0, 2.0 * line_load / (np.pi * half), 0.0)
        spread = slices if rolls_alike else np.sum(on_path | (line_load > 0.0), axis=-1)
        factor = np.max(shared.slice_load, axis=-1) * spread / total
    return LoadedContact(
        phase=phase,
        roll=roll,
        slice_position=flanks.face(),
        deflection=shared.deflection,
        unloaded=np.min((seen.corner_gap + gap) / seen.arm, axis=(1, 2)),
        normal_load=total,
        line_load=line_load,
        pressure=pressure,
        half_width=np.where(line_load > 0, half, 0.0),
        root_tension=tension,
        root_compression=compression,
        face_load_factor=factor,
        mesh_stiffness=shared.stiffness / np.abs(flexible.assembly.path.gear_pitch_radius),
        contact_ratio=mean_pairs(np.max(shared.overlap, axis=-1), positions),
    )


def loaded_error(
    flanks: LoadedFlanks,
    gear_torque: float,
    positions: int,
    cycles: int = 1,
    friction_coefficient: float = 0.0,
) -> Float[Array, " position"]:
    """Loaded static transmission error ξ alone, m; parameters and errors as those of `roll_through`.

    At several torques it makes Harris' map (S. L. Harris, Proc. IMechE 172 (1958) 87).
    """
    return _rolled(flanks, gear_torque, positions, cycles, friction_coefficient)[-1].deflection


def _rolled(
    flanks: LoadedFlanks, gear_torque: float, positions: int, cycles: int, friction_coefficient: float
) -> tuple[
    Float[Array, " position"], Float[Array, "position pair"], Float[Array, "position pair slice"], SharedLoad
]:
    """Phase, roll and gap of the pairs at all positions, and the state of their contact."""
    check_contact(flanks, gear_torque)
    limits = reach(flanks, gear_torque)
    assembly = flanks.flexible.assembly
    pitch = assembly.pitch_angle
    start, _ = assembly.roll_limits
    late = face_shift(flanks)
    ages = _ages((limits[0] - late, limits[1] + late), start, pitch)
    phase = np.arange(positions * cycles) / positions
    cycle = np.arange(positions * cycles) // positions
    roll = start + pitch * ((phase - cycle)[:, None] + ages)
    gap = flanks.gap(pair_geometry(assembly, flanks.rolls(roll)))
    gap = gap + pitch_gap(flanks.modifications, cycle[:, None] - ages)[..., None]
    shared = flanks.share(roll, gear_torque, friction_coefficient, gap)
    check_resolved(flanks, shared, gear_torque)
    return phase, roll, gap, shared


def reach(
    flanks: LoadedFlanks, gear_torque: float, factor: float = REACH, early: float = 0.0
) -> tuple[float, float]:
    """Pinion angles (rad) between which a pair can touch: corners up to a gap of `factor` deflections.

    The deflection is that of a single pair at the pitch point, from first touch. Relief of the tips keeps the
    corners that much further away; a tooth may be `early` by so much against the next (m), beside its pitch
    errors.
    """
    assembly, modifications = flanks.flexible.assembly, flanks.modifications
    at_pitch_point = np.zeros((1, 1))
    gap = flanks.gap(pair_geometry(assembly, flanks.rolls(at_pitch_point)))
    single = flanks.share(at_pitch_point, gear_torque, 0.0, gap)
    arm = np.cos(pair_geometry(assembly, at_pitch_point).motion.pressure_angle[0, 0])
    deflection = float(single.deflection[0] * arm - np.min(gap))

    start, end = assembly.roll_limits
    pitch = assembly.pitch_angle
    roll = start + pitch * np.arange(0.0, (end - start) / pitch, 1.0 / _PHASES)
    nearest = _nearest(flanks, roll)
    whole = np.full(math.ceil(len(roll) / _PHASES) * _PHASES, np.inf)
    whole[: len(roll)] = nearest
    # what the pairs leave open at the worst phase while nothing is loaded, and the errors of single teeth
    open_between = float(np.max(np.min(whole.reshape(-1, _PHASES), axis=0)))
    errors = [
        np.ptp(flank.pitch_error)
        for flank in (modifications.pinion, modifications.gear)
        if len(flank.pitch_error)
    ]
    most = factor * deflection + open_between + float(sum(errors)) + early
    before, beyond = _nearest(flanks, np.array([start, end]))
    return roll_at_gap(assembly, (most - float(before), most - float(beyond)))


def face_shift(flanks: LoadedFlanks) -> float:
    """Pinion angle (rad) by which the outermost slices are late or early, ≥ 0."""
    assembly = flanks.flexible.assembly
    return float(np.max(np.abs(np.asarray(roll_shift(assembly, flanks.face())))))


def _ages(limits: tuple[float, float], start: float, pitch: float) -> Int[Array, " pair"]:
    """Whole pitches since the pairs that can touch began their path, the pair that entered first in front."""
    first, last = math.floor((limits[0] - start) / pitch), math.ceil((limits[1] - start) / pitch) - 1
    return np.arange(last, first - 1, -1)


def _nearest(flanks: LoadedFlanks, roll: Float[Array, "*pair"]) -> Float[Array, "*pair"]:
    """Minimum gap along the face at each angle on the path, m."""
    assembly = flanks.flexible.assembly
    gap = flank_gap(assembly, flanks.modifications, pair_geometry(assembly, roll), flanks.face())
    return np.min(gap, axis=-1)


def mean_pairs(overlap: Float[Array, "position pair"], positions: int) -> float:
    """Mean number of pairs that carry, from overlaps (position, pair) linear in between."""
    history = [overlap[:-1], overlap[1:]]
    # a pair goes on in the slot before its own in the next cycle
    seam = overlap[positions - 1 :: positions, 1:], np.roll(overlap[::positions], -1, axis=0)[:, :-1]
    total = 0.0
    whole = np.arange(len(overlap) - 1) % positions != positions - 1
    for here, there in ((history[0][whole], history[1][whole]), seam):
        touching = (here > 0).astype(float)
        crossing = (here > 0) != (there > 0)
        share = np.where(crossing, here / np.where(crossing, here - there, 1.0), 0.0)
        total += float(np.sum(np.where(crossing, np.where(here > 0, share, 1.0 - share), touching)))
    return total / len(overlap)


def single_pair_stiffness(flexible: PairFlexibility, gear_torque: float) -> float:
    """Load over deflection along the normal of one unmodified pair alone at the pitch point, N/m.

    Of helical teeth as if all their width touched there at once, as c' of ISO 6336-1 is meant.
    """
    alone, flanks = np.zeros((1, 1)), LoadedFlanks(flexible)
    shared = flanks.share(alone, gear_torque)
    arm = flanks.contacts(alone).arm[0, 0, 0]
    return float(shared.normal_load[0, 0] / (shared.deflection[0] * arm))
