"""Parts of a model that are the same for every train of gears: a mesh, what is switched, the varying load."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from tribodyn.dynamics import parameters
from tribodyn.dynamics.data import equivalent_mass, mesh_damping
from tribodyn.gears.case import GearCase, LubricatedCase
from tribodyn.gears.tabulated import Tabulated
from tribodyn.geometry.drive import Drive, Side
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.teeth.damage.gear import DamagedTeeth, damaged_gear
from tribodyn.mesh.teeth.fields import OwnTeeth
from tribodyn.mesh.teeth.lookup import ALIKE, Teeth
from tribodyn.mesh.teeth.table import teeth_of
from tribodyn.numerics.curve import Table, monotone_slopes
from tribodyn.train.layout import TrainLayout
from tribodyn.train.positions import moves_of
from tribodyn.train.schedule import with_teeth
from tribodyn.train.structure import (
    GearMesh,
)
from tribodyn.tribology.closure import Closure, laws_of

#: Gauss-Seidel sweeps from the tabulated inverse: only pairs about to separate need more than one. Each
#: reduces the error by the square of the coupling between two pairs over what each deflects alone.
SWEEPS, SWEEPS_STRONGLY_COUPLED = 4, 8
#: That square, from which two pairs are strongly coupled: 0.02 to 0.08 of usual gears, 0.2 on thin rims.
STRONGLY_COUPLED = 0.1
#: With a load-dependent Hertz contact the inverse is no more than a guess, wrong by about a tenth.
SWEEPS_NONLINEAR = 12

#: Directions (x, y) of a mesh, see `train.structure.Mesh`: along the pitch tangent, across.
Frame = tuple[tuple[float, float], tuple[float, float]]


def gear_mesh(
    case: LubricatedCase,
    made: Tabulated,
    closure: Closure,
    inertias: tuple[float, float],
    frame: Frame,
    hand: float = 1.0,
    places: tuple[float, float] = (0.0, 0.0),
) -> GearMesh:
    """A mesh of two bodies with so much inertia each, kg m²; `hand`, `places` as in `train.structure`."""
    cycle = made.cycle
    radius_1, radius_2 = float(cycle.pinion_pitch_radius), float(cycle.gear_pitch_radius)
    mass = equivalent_mass(inertias, (radius_1, radius_2))
    return GearMesh(
        made.table,
        cycle.pinion_pitch_radius,
        cycle.gear_pitch_radius,
        *frame[0],
        *frame[1],
        damping=mesh_damping(case.mesh.damping_ratio, mass, cycle.slices),
        surfaces=closure.surfaces,
        film=closure.film.parameters,
        friction=closure.friction.parameters,
        teeth=own_teeth(case, made),
        hand=hand,
        driver_sense=float(cycle.pinion_sense),
        driven_sense=float(cycle.gear_sense),
        moves=moves_of(frame, (radius_1, radius_2), places),
    )


def own_teeth(case: GearCase, tabulated: Tabulated) -> Teeth:
    """What single teeth of a case have of their own, as its tabulated mesh looks them up."""
    if not any(case.teeth):
        return ALIKE
    drive, (one, two) = case.drive, case.teeth
    both_gears = _in_mesh(one, "pinion", case, tabulated), _in_mesh(two, "gear", case, tabulated)
    counts = abs(round(float(drive.pinion.teeth))), abs(round(float(drive.gear.teeth)))
    return teeth_of(tabulated.assembly, case.mesh, tabulated.cycle, both_gears, counts)


def _in_mesh(teeth: OwnTeeth, side: Side, case: GearCase, tabulated: Tabulated) -> OwnTeeth:
    """What teeth of one gear have of their own, where damage knows its mesh."""
    if not any(isinstance(each, DamagedTeeth) for each in teeth):
        return teeth
    gear = damaged_gear(tabulated.assembly, case.materials, side, case.mesh.at_load)
    return tuple(each.in_mesh(gear) if isinstance(each, DamagedTeeth) else each for each in teeth)


def with_own_teeth(
    model: parameters.Model, first: Sequence[tuple[int, int]], teeth: Sequence[tuple[int, int]], cycles: int
) -> parameters.Model:
    """The model with the numbers of its teeth over so many cycles, where teeth differ.

    `first` and `teeth` as of `schedule.with_teeth`.
    """
    if not any(len(mesh.teeth.rate) for mesh in model.meshes):
        return model
    options = model.options
    if any(mesh.teeth.driver.channel.shape[3] > 1 for mesh in model.meshes) and options.sweeps > 1:
        options = options._replace(sweeps=SWEEPS_NONLINEAR)  # the tabulated inverse is no more than a guess
    schedule = with_teeth(model.schedule, first, teeth, cycles)
    return model._replace(schedule=schedule, options=options)


def helix_sign(drive: Drive, clockwise: bool = True) -> float:
    """`GearMesh.hand` of a pair whose pinion turns clockwise seen from +z, or not; 1 of spur gears."""
    return 1.0 if (float(drive.helix_angle) >= 0.0) == clockwise else -1.0


def tilting_inertia(mass: float, inertia: float, width: float) -> float:
    """Moment of inertia about a diameter of a gear as wide as its teeth, kg m²: J/2 + m b²/12."""
    return inertia / 2.0 + mass * width**2 / 12.0


def options_of(
    case: LubricatedCase, cycles: Sequence[MeshCycle], closure: Closure, layout: TrainLayout, drive: int
) -> parameters.Options:
    """What a case of a pair switches, the same in all meshes of a train; `closure` has the laws in use."""
    linear = all(float(cycle.hertz_coefficient) == 0.0 for cycle in cycles)
    sliding = case.friction.sliding == "dynamic"
    consistent = case.mesh.formulation == "energy-consistent"
    return parameters.Options(
        film=closure.film.functions,
        friction=closure.friction.functions,
        layout=layout,
        sliding=parameters.SLIDING_DYNAMIC if sliding else parameters.SLIDING_KINEMATIC,
        formulation=parameters.ENERGY_CONSISTENT if consistent else parameters.CLASSICAL,
        drive=drive,
        hertz=parameters.HERTZ_IN_TABLE if linear else parameters.HERTZ_POWER_LAW,
        sweeps=max(_sweeps(cycle) for cycle in cycles),
        reads_film=int(laws_of(case)[1].reads_film),
        averaged=int(any(float(cycle.pitch_point_length) > 0.0 for cycle in cycles)),
    )


def _sweeps(cycle: MeshCycle) -> int:
    coupling, alone = np.asarray(cycle.coupling), np.asarray(cycle.compliance)
    if not np.any(coupling):
        return 1
    if float(cycle.hertz_coefficient) != 0.0:
        return SWEEPS_NONLINEAR
    share = coupling**2 / (alone[..., :, None] * alone[..., None, :])
    both = np.asarray(cycle.in_contact)[:, None, :, None] * np.asarray(cycle.in_contact)[:, None, None, :]
    return SWEEPS_STRONGLY_COUPLED if np.max(both * share) > STRONGLY_COUPLED else SWEEPS


def varying_load(
    table: Table | None, harmonics: Sequence[tuple[float, float, float]]
) -> dict[str, np.ndarray]:
    """Fields of `parameters.Operation`: a torque over time, and cosines (amplitude, frequency, phase)."""
    times, torques = (np.asarray(values, dtype=float) for values in table or ((), ()))
    rows: Any = np.array(harmonics, dtype=float).reshape(-1, 3)
    return {
        "load_times": times,
        "load_torques": torques,
        "load_slopes": resting_slopes(times, torques),
        "load_amplitudes": np.ascontiguousarray(rows[:, 0]),
        "load_frequencies": np.ascontiguousarray(rows[:, 1]),
        "load_phases": np.ascontiguousarray(rows[:, 2]) + np.pi / 2.0,  # cosines, as a scenario gives them
    }


def motor_curve(curve: Table | None) -> dict[str, np.ndarray]:
    """Fields of `parameters.Operation`: a torque of the drive over speed; without one nothing."""
    if curve is None:
        return {}
    speeds, torques = (np.asarray(values, dtype=float) for values in curve)
    slopes = monotone_slopes(speeds, torques)
    return {"motor_speeds": speeds, "motor_torques": torques, "motor_slopes": slopes}


def resting_slopes(times: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Slopes of the C1 curve through the points that never overshoots; flat at both ends."""
    if len(times) < 2:
        return np.zeros_like(times)
    slopes = monotone_slopes(times, values)
    slopes[[0, -1]] = 0.0  # the torque is constant outside the table
    return slopes
