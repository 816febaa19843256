"""Loads along the face and root stresses of the gears of Jia et al., from the sliced load contact model.

As in the paper's finite elements: 134 N·m on the pinion, no friction, steps of about a degree, relief on the
pinion only, y1 = y2. The misalignment is taken in the plane of action.
"""

import math
from functools import cache
from typing import Literal, NamedTuple

import numpy as np

from tribodyn.compliance.sharing.load_sharing import LoadedFlanks, flexibility
from tribodyn.compliance.sharing.loaded_contact import LoadedContact, roll_through
from tribodyn.compliance.sharing.slices import PairFlexibility
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.families import family
from tribodyn.geometry.flanks.modification import FlankModification, LeadRelief, Misalignment, Modifications
from tribodyn.studies.gear_pair.case import Case
from tribodyn.studies.protocol.load import load_scenario

Name = Literal["involute", "parabolic"]

PINION_TORQUE = 134.0  # N m
ARC_MINUTE = math.radians(1.0 / 60.0)
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


def case_of(name: Name) -> Case:
    """Return the case of one of the paper's two drives."""
    case = load_scenario(f"jia-{name}-17-29")
    assert isinstance(case, Case)
    return case


@cache
def elastic(name: Name) -> PairFlexibility:
    """Finite elements of a drive, for loads that vary along the face."""
    case = case_of(name)
    return flexibility(assemble(family(case.family), case.drive), case.materials, lead=True)


@cache
def rolled(name: Name, state: FaceState = FaceState()) -> LoadedContact:
    """One mesh cycle of a drive in slow rotation."""
    flexible = elastic(name)
    teeth = flexible.assembly.drive
    relief = state.relief * 1e-6
    modifications = Modifications(
        pinion=FlankModification(lead=LeadRelief(relief, relief, state.unmodified * 1e-3)),
        misalignment=Misalignment(in_plane=state.misalignment * ARC_MINUTE),
    )
    torque = PINION_TORQUE * teeth.gear.teeth / teeth.pinion.teeth
    return roll_through(LoadedFlanks(flexible, modifications, SLICES, state.coupled), torque, POSITIONS)


class Maximum(NamedTuple):
    """Maximum value of a mesh cycle, and where: pinion angle (°) and place along the face (mm)."""

    value: float
    roll: float
    place: float


def maximum_line_load(name: Name, state: FaceState = FaceState()) -> Maximum:
    """Maximum line load over mesh cycle and face, N/m."""
    run = rolled(name, state)
    return _maximum(run, run.line_load)


def maximum_pressure(name: Name, state: FaceState = FaceState(), away: float = 0.0) -> Maximum:
    """Maximum Hertz pressure, Pa; of pairs at least `away` degrees from the pitch point."""
    run = rolled(name, state)
    far = np.abs(np.degrees(run.roll)) >= away
    return _maximum(run, run.pressure * far[..., None])


def maximum_root_stress(name: Name, tension: bool) -> tuple[float, float]:
    """Maximum root stress of pinion and gear over mesh cycle and face, Pa, as an amount."""
    run = rolled(name)
    stress = run.root_tension if tension else -run.root_compression
    pinion, gear = np.nanmax(stress, axis=(1, 2, 3))
    return float(pinion), float(gear)


def _maximum(run: LoadedContact, values: np.ndarray) -> Maximum:
    position, pair, part = np.unravel_index(int(np.argmax(values)), values.shape)
    return Maximum(
        float(values[position, pair, part]),
        float(np.degrees(run.roll[position, pair])),
        1e3 * float(run.slice_position[part]),
    )


class Passage(NamedTuple):
    """What one pair of teeth goes through, over increasing pinion angle (point,), maximum over the face."""

    roll: np.ndarray  # pinion angle from the pitch point, rad
    line_load: np.ndarray  # N/m
    pressure: np.ndarray  # maximum Hertz pressure, Pa
    #: compression, tension: maximum root stress of both gears, Pa, as amounts
    compression: np.ndarray
    tension: np.ndarray


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


def face_load(name: Name, state: FaceState = FaceState()) -> tuple[np.ndarray, np.ndarray]:
    """Line load (N/m) along the face (m from its middle) of the pair that is nearest to the pitch point."""
    run = rolled(name, state)
    position, pair = np.unravel_index(int(np.argmin(np.abs(run.roll))), run.roll.shape)
    return run.slice_position, run.line_load[position, pair]
