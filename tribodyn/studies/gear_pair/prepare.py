"""From a case to a model ready to integrate: geometry checked, mesh cycle tabulated, numbers assembled."""

from dataclasses import dataclass

import numpy as np

from tribodyn.dynamics import parameters
from tribodyn.dynamics.data import BearingData, matrices_in_space
from tribodyn.studies.gear_pair.case import Case
from tribodyn.studies.gears.model import (
    hand_of,
    mesh_of,
    options_of,
    tilting_inertia,
    varying_load,
    with_own_teeth,
)
from tribodyn.studies.gears.prepare import PreparedGears, at_tooth_temperature
from tribodyn.studies.gears.tabulated import Tabulated, quasi_static_loss, tables
from tribodyn.train.structure import GROUND, IN_SPACE, Bodies, Links, layout_of
from tribodyn.tribology.closure import Closure, closure_of

#: Bodies of the train.
PINION, GEAR, MOTOR = 0, 1, 2
#: The gear stands above the pinion, which turns clockwise.
UPRIGHT = (1.0, 0.0), (0.0, 1.0)


@dataclass(frozen=True)
class PreparedPair(PreparedGears[Case]):
    """A case made ready to integrate."""

    model: parameters.Model
    #: (mass kg, inertia kg m²); of pinion and gear alone, without what is attached to them
    masses: tuple[tuple[float, float], tuple[float, float]]
    given: Case  # as it was before: with the oil that enters the mesh


def prepare(case: Case, tabulated: Tabulated | None = None) -> PreparedPair:
    """Check the geometry, tabulate the mesh cycle and assemble the model.

    `tabulated` is of a case with the same `table_key`; it is made here where it is not given. Raises
    InputError where the teeth cannot be made or cannot run together, or a table does not cover the contact.
    """
    made = tabulated or tables(case)
    cycle, (pinion, gear), assembly = made.cycle, made.masses, made.assembly
    warm, thermal = at_tooth_temperature(case, assembly, quasi_static_loss(made))
    model = _model(case, made, closure_of(warm), (pinion, gear))
    counts = round(float(case.drive.pinion.teeth)), round(float(case.drive.gear.teeth))
    model = with_own_teeth(model, [(0, 0)], [counts], case.solver.cycles)
    masses, remark = (pinion, gear), made.slice_remark
    return PreparedPair(warm, assembly, cycle, thermal, model, masses, case, slice_remark=remark)


def _model(
    case: Case, made: Tabulated, closure: Closure, masses: tuple[tuple[float, float], tuple[float, float]]
) -> parameters.Model:
    """The train of two bodies on bearings, and a third, of the drive, where a shaft gives way."""
    operating, cycle = case.operating, made.cycle
    spatial = moves_in_space(case, cycle.slices)
    tilting = np.array([tilting_inertia(*masses[side], _width(case, side)) for side in (PINION, GEAR)])
    shaft = operating.source == "torque" and operating.shaft_stiffness is not None
    (mass_1, inertia_1), (mass_2, inertia_2) = masses
    motor = [operating.drive_inertia] if shaft else []
    ratio = float(cycle.speed_ratio)
    bodies = Bodies(
        mass=np.array([mass_1, mass_2]),
        inertia=np.array(
            [
                inertia_1 + (0.0 if shaft else operating.drive_inertia),
                inertia_2 + operating.load_inertia,
                *motor,
            ]
        ),
        ratio=np.array([1.0, ratio, *(1.0 for _ in motor)]),
        load=np.array([0.0, operating.gear_torque, *(0.0 for _ in motor)]),
        load_damping=np.array([0.0, operating.load_damping, *(0.0 for _ in motor)]),
        tilting=tilting if spatial else np.zeros(0),
    )
    links = [_bearing(bearing, mass) for bearing, mass in zip(case.bearings, (mass_1, mass_2), strict=True)]
    ends = [(PINION, GROUND), (GEAR, GROUND)]
    if shaft:
        links.append(([0.0, 0.0, operating.shaft_stiffness or 0.0], [0.0, 0.0, operating.shaft_damping]))
        ends.append((MOTOR, PINION))
    layout = layout_of(
        2,
        2 + len(motor),
        [(PINION, GEAR)],
        ends,
        MOTOR if shaft else PINION,
        GEAR,
        spatial=2 if spatial else 0,
    )
    drive = parameters.DRIVE_TORQUE if operating.source == "torque" else parameters.DRIVE_SPEED
    return parameters.Model(
        (mesh_of(case, made, closure, (inertia_1, inertia_2), UPRIGHT, hand_of(case.drive)),),
        bodies,
        Links(*(np.array(values) for values in zip(*links, strict=True)), **_in_space(case, bodies, ends)),
        made.schedule,
        operation_of(case, ratio),
        options_of(case, [cycle], closure, layout, drive),
    )


def moves_in_space(case: Case, slices: int) -> bool:
    """Whether the gears move along their axes and tilt: helical ones, and all on a matrix, which couples."""
    return slices > 1 or any(bearing.matrix is not None for bearing in case.bearings)


def _width(case: Case, side: int) -> float:
    return float((case.drive.pinion, case.drive.gear)[side].face_width)


def _in_space(case: Case, bodies: Bodies, ends: list[tuple[int, int]]) -> dict[str, np.ndarray]:
    """Matrices of the bearings of gears that move in space; of a shaft, which only turns, nothing."""
    if not len(bodies.tilting):
        return {}
    found = {name: np.zeros((len(ends), IN_SPACE, IN_SPACE)) for name in ("stiffness", "damping")}
    for side, bearing in enumerate(case.bearings):
        found["stiffness"][side], found["damping"][side] = matrices_in_space(
            bearing, _width(case, side), bodies.mass[side], bodies.tilting[side]
        )
    return {f"{name}_in_space": values for name, values in found.items()}


def _bearing(bearing: BearingData, mass: float) -> tuple[list[float], list[float]]:
    """Stiffness and damping of a shaft and its bearings, per direction."""
    stiffness = [bearing.stiffness_x, bearing.stiffness_y, 0.0]
    ratios = [bearing.damping_ratio_x, bearing.damping_ratio_y, 0.0]
    return stiffness, [2.0 * z * float(np.sqrt(k * mass)) for z, k in zip(ratios, stiffness, strict=True)]


def operation_of(case: Case, ratio: float) -> parameters.Operation:
    """How a case is driven and loaded; `ratio` is that of the gear's speed to the pinion's."""
    operating = case.operating
    balance = operating.gear_torque * ratio
    return parameters.Operation(
        nominal_speed=operating.pinion_speed,
        pitch_angle=2.0 * np.pi / case.drive.pinion.teeth,
        drive_torque=balance if operating.pinion_torque is None else operating.pinion_torque,
        speed_regulation=operating.speed_regulation,
        contact_width=case.mesh.contact_width,
        reversal_width=case.friction.reversal_width,
        **varying_load(operating.torque_table, operating.torque_harmonics),
    )
