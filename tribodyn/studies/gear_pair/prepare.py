"""From a case to a model ready to integrate: geometry checked, mesh cycle tabulated, numbers assembled."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

import numpy as np

from tribodyn.dynamics import parameters
from tribodyn.dynamics.data import BearingData
from tribodyn.geometry.assembly import Assembly
from tribodyn.mesh.cycle import MeshCycle, Polynomials, polynomials
from tribodyn.mesh.equilibrium import contacts, elastic, settled
from tribodyn.mesh.quasi_static import friction_loss
from tribodyn.numerics.curve import monotone_slopes
from tribodyn.studies.gear_pair.case import Case
from tribodyn.studies.gears.prepare import PreparedGears, assembled, at_tooth_temperature
from tribodyn.train.schedule import Schedule, of_one_mesh
from tribodyn.train.structure import GROUND, Bodies, Layout, Links, Mesh, layout_of
from tribodyn.tribology.closure import Closure, closure_of

#: Gauss-Seidel sweeps from the tabulated inverse: only pairs about to separate need more than one. Each
#: reduces the error by the square of the coupling between two pairs over what each deflects alone.
SWEEPS, SWEEPS_STRONGLY_COUPLED = 4, 8
#: That square, from which two pairs are strongly coupled: 0.02 to 0.08 of usual gears, 0.2 on thin rims.
STRONGLY_COUPLED = 0.1
#: With a load-dependent Hertz contact the inverse is no more than a guess, wrong by about a tenth.
SWEEPS_NONLINEAR = 12


#: Bodies of the train.
PINION, GEAR, MOTOR = 0, 1, 2


@dataclass(frozen=True)
class PreparedPair(PreparedGears[Case]):
    """A case made ready to integrate."""

    model: parameters.Model
    #: (mass kg, inertia kg m²); of pinion and gear alone, without what is attached to them
    masses: tuple[tuple[float, float], tuple[float, float]]
    given: Case  # as it was before: with the oil that enters the mesh


class Tabulated(NamedTuple):
    """What the geometry and elasticity of a case make of it: costly, and the same for every speed."""

    cycle: MeshCycle
    table: Polynomials  # the same as the right-hand side reads it
    schedule: Schedule  # when the set of contacting pairs changes
    #: (mass kg, inertia kg m²); of pinion and gear alone
    masses: tuple[tuple[float, float], tuple[float, float]]
    assembly: Assembly
    #: () -> the cycle of the driving flanks alone, in which a segment begins where friction turns; made at
    #: the first call
    split: Callable[[], MeshCycle]


def prepare(case: Case, tabulated: Tabulated | None = None) -> PreparedPair:
    """Check the geometry, tabulate the mesh cycle and assemble the model.

    `tabulated` is of a case with the same `table_key`; it is made here where it is not given. Raises
    InputError where the teeth cannot be made or cannot run together, or a table does not cover the contact.
    """
    made = tabulated or tables(case)
    cycle, (pinion, gear), assembly = made.cycle, made.masses, made.assembly
    warm, thermal = at_tooth_temperature(case, assembly, _quasi_static_loss(made))
    model = _model(case, made, closure_of(warm), (pinion, gear))
    return PreparedPair(warm, assembly, cycle, thermal, model, (pinion, gear), case)


def _quasi_static_loss(made: Tabulated) -> Callable[[Case], float]:
    """Return what gives the mean loss to tooth friction in slow rotation at the constant torque, W."""

    def lost(case: Case) -> float:
        torque, speed = case.operating.gear_torque, case.operating.pinion_speed
        if torque == 0.0:
            return 0.0
        cycle = made.split()
        seen = contacts(cycle, torque, speed, closure_of(case))
        found = settled(seen, elastic(cycle, torque))
        return speed * float(friction_loss(cycle, found.normal_load, found.friction_coefficient))

    return lost


def tables(case: Case) -> Tabulated:
    """Check the geometry and tabulate the mesh cycle; raises as `prepare` does."""
    from tribodyn.geometry.body import body_masses
    from tribodyn.mesh.by_compliance import mesh_cycle_of

    assembly = assembled(case)
    back, torque = case.mesh.backlash is not None, case.operating.gear_torque
    cycle = mesh_cycle_of(assembly, case.materials, case.mesh, torque, back)
    given = [(body.mass, body.inertia) for body in case.masses]
    pinion, gear = body_masses(assembly, given, [material.density for material in case.materials])

    @cache
    def split() -> MeshCycle:
        turning = Assembly(assembly.family._replace(corner=True), assembly.drive)
        return mesh_cycle_of(turning, case.materials, case.mesh, torque)

    table = polynomials(cycle)
    return Tabulated(cycle, table, of_one_mesh(table.boundary), (pinion, gear), assembly, split)


def _options(case: Case, cycle: MeshCycle, closure: Closure, layout: Layout) -> parameters.Options:
    linear = float(cycle.hertz_coefficient) == 0.0
    return parameters.Options(
        film=closure.film.functions,
        friction=closure.friction.functions,
        layout=layout,
        sliding=parameters.SLIDING_DYNAMIC
        if case.friction.sliding == "dynamic"
        else parameters.SLIDING_KINEMATIC,
        formulation=parameters.ENERGY_CONSISTENT
        if case.mesh.formulation == "energy-consistent"
        else parameters.CLASSICAL,
        drive=parameters.DRIVE_TORQUE if case.operating.source == "torque" else parameters.DRIVE_SPEED,
        hertz=parameters.HERTZ_IN_TABLE if linear else parameters.HERTZ_POWER_LAW,
        sweeps=_sweeps(cycle),
        averaged=int(float(cycle.pitch_point_length) > 0.0),
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


def _model(
    case: Case, made: Tabulated, closure: Closure, masses: tuple[tuple[float, float], tuple[float, float]]
) -> parameters.Model:
    """The train of two bodies on bearings, and a third, of the drive, where a shaft gives way."""
    operating, cycle = case.operating, made.cycle
    shaft = operating.source == "torque" and operating.shaft_stiffness is not None
    (mass_1, inertia_1), (mass_2, inertia_2) = masses
    radius_1, radius_2 = float(cycle.pinion_pitch_radius), float(cycle.gear_pitch_radius)
    equivalent_mass = inertia_1 * inertia_2 / (inertia_1 * radius_2**2 + inertia_2 * radius_1**2)
    motor = [operating.drive_inertia] if shaft else []
    ratio = radius_1 / radius_2
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
    )
    links = [_bearing(bearing, mass) for bearing, mass in zip(case.bearings, (mass_1, mass_2), strict=True)]
    ends = [(PINION, GROUND), (GEAR, GROUND)]
    if shaft:
        links.append(([0.0, 0.0, operating.shaft_stiffness], [0.0, 0.0, operating.shaft_damping]))
        ends.append((MOTOR, PINION))
    layout = layout_of(2, 2 + len(motor), [(PINION, GEAR)], ends, MOTOR if shaft else PINION, GEAR)
    mesh = Mesh(
        table=made.table,
        driver_radius=cycle.pinion_pitch_radius,
        driven_radius=cycle.gear_pitch_radius,
        along_x=1.0,
        along_y=0.0,
        across_x=0.0,
        across_y=1.0,
        damping=2.0 * case.mesh.damping_ratio * float(np.sqrt(equivalent_mass)),
        surfaces=closure.surfaces,
        film=closure.film.parameters,
        friction=closure.friction.parameters,
    )
    return parameters.Model(
        (mesh,),
        bodies,
        Links(*(np.array(values) for values in zip(*links, strict=True))),
        made.schedule,
        operation_of(case, ratio),
        _options(case, cycle, closure, layout),
    )


def _bearing(bearing: BearingData, mass: float) -> tuple[list[float], list[float]]:
    """Stiffness and damping of a shaft and its bearings, per direction."""
    stiffness = [bearing.stiffness_x, bearing.stiffness_y, 0.0]
    ratios = [bearing.damping_ratio_x, bearing.damping_ratio_y, 0.0]
    return stiffness, [2.0 * z * float(np.sqrt(k * mass)) for z, k in zip(ratios, stiffness, strict=True)]


def operation_of(case: Case, ratio: float) -> parameters.Operation:
    """How a case is driven and loaded; `ratio` is that of the gear's speed to the pinion's."""
    operating = case.operating
    times, torques = (np.asarray(values, dtype=float) for values in operating.torque_table or ((), ()))
    harmonics = np.array(operating.torque_harmonics, dtype=float).reshape(-1, 3)
    balance = operating.gear_torque * ratio
    return parameters.Operation(
        nominal_speed=operating.pinion_speed,
        pitch_angle=2.0 * np.pi / case.drive.pinion.teeth,
        drive_torque=balance if operating.pinion_torque is None else operating.pinion_torque,
        speed_regulation=operating.speed_regulation,
        contact_width=case.mesh.contact_width,
        reversal_width=case.friction.reversal_width,
        load_times=times,
        load_torques=torques,
        load_slopes=_monotone_slopes(times, torques),
        load_amplitudes=np.ascontiguousarray(harmonics[:, 0]),
        load_frequencies=np.ascontiguousarray(harmonics[:, 1]),
        load_phases=np.ascontiguousarray(harmonics[:, 2]) + np.pi / 2.0,  # cosines, as a scenario gives them
    )


def _monotone_slopes(times: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Slopes of the C1 curve through the points that never overshoots; flat at both ends."""
    if len(times) < 2:
        return np.zeros_like(times)
    slopes = monotone_slopes(times, values)
    slopes[[0, -1]] = 0.0  # the torque is constant outside the table
    return slopes
