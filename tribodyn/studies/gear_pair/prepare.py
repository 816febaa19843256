"""From a case to a model ready to integrate: geometry checked, mesh cycle tabulated, numbers assembled."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

import numpy as np

from tribodyn.dynamics import parameters
from tribodyn.geometry.assembly import Assembly
from tribodyn.mesh.cycle import MeshCycle, Polynomials, polynomials
from tribodyn.mesh.equilibrium import contacts, elastic, settled
from tribodyn.mesh.quasi_static import friction_loss
from tribodyn.numerics.curve import monotone_slopes
from tribodyn.studies.gear_pair.case import Case
from tribodyn.studies.gears.prepare import PreparedGears, assembled, at_tooth_temperature
from tribodyn.tribology.closure import Closure, closure_of

#: Gauss-Seidel sweeps from the tabulated inverse: only pairs about to separate need more than one. Each
#: reduces the error by the square of the coupling between two pairs over what each deflects alone.
SWEEPS, SWEEPS_STRONGLY_COUPLED = 4, 8
#: That square, from which two pairs are strongly coupled: 0.02 to 0.08 of usual gears, 0.2 on thin rims.
STRONGLY_COUPLED = 0.1
#: With a load-dependent Hertz contact the inverse is no more than a guess, wrong by about a tenth.
SWEEPS_NONLINEAR = 12


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
    cycle, table, (pinion, gear), assembly, _ = made = tabulated or tables(case)
    warm, thermal = at_tooth_temperature(case, assembly, _quasi_static_loss(made))
    surfaces, film, friction = closure = closure_of(warm)
    mechanics, options = _mechanics(case, pinion, gear, cycle), _options(case, cycle, closure)
    model = parameters.Model(table, mechanics, surfaces, film.parameters, friction.parameters, options)
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

    return Tabulated(cycle, polynomials(cycle), (pinion, gear), assembly, split)


def _options(case: Case, cycle: MeshCycle, closure: Closure) -> parameters.Options:
    drive = parameters.DRIVE_SPEED
    if case.operating.source == "torque":
        drive = parameters.DRIVE_TORQUE if case.operating.shaft_stiffness is None else parameters.DRIVE_SHAFT
    linear = float(cycle.hertz_coefficient) == 0.0
    return parameters.Options(
        film=closure.film.functions,
        friction=closure.friction.functions,
        sliding=parameters.SLIDING_DYNAMIC
        if case.friction.sliding == "dynamic"
        else parameters.SLIDING_KINEMATIC,
        formulation=parameters.ENERGY_CONSISTENT
        if case.mesh.formulation == "energy-consistent"
        else parameters.CLASSICAL,
        drive=drive,
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


def _mechanics(
    case: Case, pinion: tuple[float, float], gear: tuple[float, float], cycle: MeshCycle
) -> parameters.Mechanics:
    operating, bearings = case.operating, case.bearings
    pinion_radius, gear_radius = float(cycle.pinion_pitch_radius), float(cycle.gear_pitch_radius)
    equivalent_mass = pinion[1] * gear[1] / (pinion[1] * gear_radius**2 + gear[1] * pinion_radius**2)

    def damping(ratio: float, stiffness: float, mass: float) -> float:
        return 2.0 * ratio * float(np.sqrt(stiffness * mass))

    rigid = 0.0 if operating.shaft_stiffness is not None else operating.drive_inertia
    balance = operating.gear_torque * pinion_radius / gear_radius
    times, torques = (np.asarray(values, dtype=float) for values in operating.torque_table or ((), ()))
    harmonics = np.array(operating.torque_harmonics, dtype=float).reshape(-1, 3)
    return parameters.Mechanics(
        pinion_mass=pinion[0],
        gear_mass=gear[0],
        pinion_inertia=pinion[1] + rigid,
        gear_inertia=gear[1] + operating.load_inertia,
        pinion_stiffness_x=bearings[0].stiffness_x,
        pinion_stiffness_y=bearings[0].stiffness_y,
        gear_stiffness_x=bearings[1].stiffness_x,
        gear_stiffness_y=bearings[1].stiffness_y,
        pinion_damping_x=damping(bearings[0].damping_ratio_x, bearings[0].stiffness_x, pinion[0]),
        pinion_damping_y=damping(bearings[0].damping_ratio_y, bearings[0].stiffness_y, pinion[0]),
        gear_damping_x=damping(bearings[1].damping_ratio_x, bearings[1].stiffness_x, gear[0]),
        gear_damping_y=damping(bearings[1].damping_ratio_y, bearings[1].stiffness_y, gear[0]),
        mesh_damping=2.0 * case.mesh.damping_ratio * float(np.sqrt(equivalent_mass)),
        contact_width=case.mesh.contact_width,
        reversal_width=case.friction.reversal_width,
        nominal_speed=operating.pinion_speed,
        drive_torque=balance if operating.pinion_torque is None else operating.pinion_torque,
        speed_regulation=operating.speed_regulation,
        drive_inertia=operating.drive_inertia,
        shaft_stiffness=operating.shaft_stiffness or 0.0,
        shaft_damping=operating.shaft_damping,
        load_torque=operating.gear_torque,
        load_damping=operating.load_damping,
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
