"""A pair's way through the mesh: its loads, speeds and radii, quasi-static, and its contact solved there."""

import math
from typing import NamedTuple

import numpy as np

from tribodyn.errors import InputError, SimulationError
from tribodyn.gears.prepare import PreparedGears, assembled
from tribodyn.geometry.helix import curvature_share, line_stretch, speed_share
from tribodyn.geometry.path import kinematics
from tribodyn.mesh.by_compliance import mesh_cycle_of
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.quasi_static import quasi_static
from tribodyn.numerics.shapes import Array
from tribodyn.studies.ehl.scenario import BEGIN, END, PLACES, EhlCase
from tribodyn.tribology.closure import surfaces_of, untried_closure_of, with_laws, without_nominal_conditions
from tribodyn.tribology.contact import hertz_half_width
from tribodyn.tribology.ehl.coupled import CoupledSolution, solve_coupled
from tribodyn.tribology.ehl.of_case import Contact, contact_of
from tribodyn.tribology.ehl.problem import LEAST_LOAD, LineContact, Solution
from tribodyn.tribology.law import LawInput
from tribodyn.tribology.surface_state import ContactFriction, contact_friction

#: Positions at which the friction is solved that enters the loads.
FRICTION_POSITIONS = 8
#: Loads over the highest at which a pair is taken as out of contact.
_UNLOADED = 1e-6
#: By how much of the whole way the ends of given loads may miss those of the contact.
_SAME_WAY = 0.02
#: Nodes over half the width over which a jump of the load is spread.
_SPREAD = 32


PreparedEhl = PreparedGears[EhlCase]


class PairWay(NamedTuple):
    """The pair at its positions: arrays (K,), SI; the rolling speeds are those of both flanks.

    Of helical teeth it is the section in the middle of the face: radius and speeds across the line of
    contact, line load per length of that line, and the load of a face that carries it throughout.
    `table` holds roll angles and line loads between which the loads are linear.
    """

    roll: Array
    normal_load: Array
    line_load: Array
    radius: Array
    speeds: tuple[Array, Array]
    table: tuple[Array, Array]

    @property
    def sliding(self) -> Array:
        """Sliding speed, m/s, of the pinion's flank over the gear's."""
        return self.speeds[0] - self.speeds[1]


def prepare(case: EhlCase) -> PreparedEhl:
    """Check the geometry and tabulate the mesh; raises InputError where teeth cannot be made or run."""
    assembly = assembled(case)
    cycle = mesh_cycle_of(assembly, case.materials, case.mesh, case.operating.gear_torque)
    return PreparedGears(case, assembly, cycle, None)


def way(study: PreparedEhl) -> PairWay:
    """Return the pair at positions evenly spaced in roll angle, in the middle of equal parts of its contact.

    Loads are given ones, or follow from the compliances of the pairs, the torque and the friction of the
    contact as it is solved at a few positions. With squeeze a jump of the load, where another pair comes or
    goes, is spread over `jump_width`.
    """
    friction = None
    if study.case.loads is None:
        free = _way(study, FRICTION_POSITIONS, None)
        coefficient = np.abs(friction_along(study, free))
        solved = np.isfinite(coefficient)
        friction = (free.roll[solved], coefficient[solved]) if np.any(solved) else None
    return _way(study, study.case.positions, friction)


def _way(study: PreparedEhl, positions: int, friction: tuple[Array, Array] | None) -> PairWay:
    """As `way`, with friction coefficients at roll angles, or without friction."""
    case, cycle = study.case, study.cycle
    start, end = roll_limits(study)
    roll = start + (np.arange(positions) + 0.5) / positions * (end - start)
    path = study.assembly.path
    motion = kinematics(path, path.signed_distance(roll))
    speed = case.operating.pinion_speed
    slope, distance = float(cycle.pitch_slope), motion.signed_distance
    # across the line of contact, which helical teeth have inclined
    radius = 1.0 / np.asarray(motion.relative_curvature * curvature_share(slope, path, distance))
    speed = speed * np.asarray(speed_share(slope, path, distance))
    speeds = (speed * np.asarray(motion.pinion_speed), speed * np.asarray(motion.gear_speed))
    if case.loads is not None:
        nodes, loads = given_loads(case.loads, (start, end))
        stretch = np.asarray(line_stretch(slope, path, path.signed_distance(np.clip(nodes, start, end))))
        loads = loads / (float(cycle.face_width) * stretch)
    elif cycle.slices > 1:
        at = int(np.argmin(np.abs(np.asarray(cycle.face_position) - case.face_position)))
        nodes, loads = section_line_loads(cycle, at, case.operating.gear_torque, friction, (start, end))
    else:
        nodes, loads = quasi_static_loads(cycle, case.operating.gear_torque, friction)
        loads = loads / float(cycle.face_width)
    if case.transient:
        nodes, loads = _spread(nodes, loads, jump_width(study, float(np.max(loads)), radius, speeds))
    line_load = np.interp(roll, nodes, loads)
    width = float(cycle.face_width) * np.asarray(line_stretch(slope, path, distance))
    return PairWay(roll, line_load * width, line_load, radius, speeds, (nodes, loads))


def quasi_static_loads(
    cycle: MeshCycle, gear_torque: float, friction: tuple[Array, Array] | None
) -> tuple[Array, Array]:
    """Roll angles of the table's nodes, and the load of the pair that is there; in order of the angle.

    Nodes on both sides of a boundary share an angle and keep the order of time. `friction`: roll angles and
    friction coefficients there; None: frictionless.
    """
    pairs, roll = cycle.front_pairs, _front_rolls(cycle)
    load = _slot_loads(cycle, gear_torque, roll, friction)[:, :, :pairs]
    touching = np.broadcast_to(np.asarray(cycle.in_contact)[:, None, :pairs] > 0, load.shape)
    # a pair passes through the phases as the youngest, then once more as the one before
    roll, load, touching = (np.moveaxis(values, 2, 0)[::-1] for values in (roll, load, touching))
    return roll[touching], load[touching]


def _front_rolls(cycle: MeshCycle) -> Array:
    """Roll angles (segment, node, pair) of the pairs on the driving flanks, rad."""
    age = np.asarray(cycle.phase)[:, :, None] + np.arange(cycle.front_pairs - 1.0, -1.0, -1.0)
    return float(cycle.roll_start) + float(cycle.pitch_angle) * age


def _slot_loads(
    cycle: MeshCycle, gear_torque: float, roll: Array, friction: tuple[Array, Array] | None
) -> Array:
    """Loads of all slots, the first of which are at these roll angles, with the friction there."""
    signed = None
    if friction is not None:
        # the pinion slides ahead of the gear behind the pitch point, which the pair passes at roll angle zero
        signed = np.zeros(np.shape(cycle.compliance))
        signed[:, :, : roll.shape[2]] = np.sign(roll) * np.interp(roll, *friction)
    return np.asarray(quasi_static(cycle, gear_torque, signed).normal_load)


def roll_limits(study: PreparedEhl) -> tuple[float, float]:
    """Roll angles, rad, between which the pair is followed: of helical teeth in a section of the face."""
    cycle = study.cycle
    start, end = study.assembly.roll_limits if cycle.slices > 1 else (cycle.roll_start, cycle.roll_end)
    return float(start), float(end)


def section_line_loads(
    cycle: MeshCycle,
    at: int,
    gear_torque: float,
    friction: tuple[Array, Array] | None,
    limits: tuple[float, float],
) -> tuple[Array, Array]:
    """Roll angles, rad, and loads per length of contact line, N/m, of one slice of a pair, by its number.

    Other arguments as `quasi_static_loads`; the limits are those of `roll_limits`.
    """
    pairs, count = cycle.front_pairs, cycle.slices
    late = cycle.face_position * float(cycle.pitch_slope) / float(cycle.pinion_pitch_radius)
    turned = _front_rolls(cycle)
    roll = (turned[..., None] - late).reshape(*turned.shape[:2], -1)
    load = _slot_loads(cycle, gear_torque, roll, friction)
    share = np.broadcast_to(cycle.share, load.shape)
    stretched = np.broadcast_to(cycle.line_load_friction, load.shape)
    line_load = load * stretched / (float(cycle.slice_width) * np.where(share > 0.0, share, 1.0))
    ours = np.arange(pairs) * count + at
    # where half of it touches, as the study of losses has it; further out the nearest value stands
    whole = np.flatnonzero(share[..., ours] >= 0.5)
    roll, line_load = roll[..., ours].ravel()[whole], line_load[..., ours].ravel()[whole]
    order = np.argsort(roll)
    return np.array([limits[0], *roll[order], limits[1]]), np.pad(line_load[order], 1, mode="edge")


def given_loads(loads: tuple[Array, Array], limits: tuple[float, float]) -> tuple[Array, Array]:
    """Return given loads, those below 0 as 0; InputError for another way of contact, or none above 0."""
    (roll, load), (start, end) = loads, limits
    if max(abs(roll[0] - start), abs(roll[-1] - end)) > _SAME_WAY * (end - start):
        stated, touching = (f"{a:.4g} … {b:.4g}°" for a, b in np.degrees([(roll[0], roll[-1]), (start, end)]))
        rule = f"for roll angles {stated}, where a pair touches at {touching}"
        remedy = "give loads of this drive over its whole contact, from the pitch point"
        raise InputError("contact.loads", None, rule, remedy)
    if not np.any(load > 0.0):
        rule = "nowhere above 0: there is no contact to solve"
        raise InputError("contact.loads", None, rule, "give loads that press")
    return roll, np.maximum(load, 0.0)


def jump_width(study: PreparedEhl, line_load: float, radius: Array, speeds: tuple[Array, Array]) -> float:
    """Roll angle in which the oil is drawn through half a contact, b/u, at the highest load; rad.

    Where the load rises much faster, the contact widens faster than the oil can follow.
    """
    modulus = float(surfaces_of(study.case).effective_modulus)
    width = hertz_half_width(line_load, 1.0 / np.median(radius), modulus)
    entrainment = np.median(0.5 * np.abs(speeds[0] + speeds[1]))
    return float(width / entrainment) * study.case.operating.pinion_speed


def _spread(nodes: Array, loads: Array, width: float) -> tuple[Array, Array]:
    """Loads averaged twice over half the width: once differentiable; on equally spaced nodes."""
    count = int(np.ceil((nodes[-1] - nodes[0]) / width * 2 * _SPREAD)) + 1
    fine = np.linspace(nodes[0], nodes[-1], count)
    kernel = np.convolve(np.full(_SPREAD, 1.0 / _SPREAD), np.full(_SPREAD, 1.0 / _SPREAD))
    reach = _SPREAD - 1
    padded = np.pad(np.interp(fine, nodes, loads), reach, mode="edge")
    return fine, np.convolve(padded, kernel, mode="valid")


def friction_along(study: PreparedEhl, over: PairWay) -> Array:
    """Friction coefficient of the solved contact, of the sign of the sliding; NaN where there is none."""
    seen = seen_by(study, over)
    coefficient = np.full(len(over.roll), np.nan)
    for at in map(int, np.flatnonzero(loaded(over))):
        solved = solved_at(study, over, seen, at)
        if solved is not None:
            coefficient[at] = solved.friction / float(over.line_load[at])
    return coefficient


def seen_by(
    study: PreparedEhl, over: PairWay, film: str | None = None, friction: str = "none"
) -> ContactFriction:
    """What a film law (None: that which goes with the friction law) and a friction law make of the way."""
    cycle, speed = study.cycle, study.case.operating.pinion_speed
    return contact_friction(
        untried_closure_of(with_laws(study.case, film, friction)),
        np.maximum(over.line_load, 1e-9),
        over.radius,
        *over.speeds,
        float(cycle.pitch_point_length),
        speed * float(cycle.pitch_point_rate),
    )


def solved_at(
    study: PreparedEhl,
    over: PairWay,
    seen: ContactFriction,
    at: int,
    slide_to_roll: float | None = None,
    smooth: bool = False,
) -> CoupledSolution | None:
    """Solve the contact at a position, mixed and with heat, or of `smooth` surfaces.

    None: next to no load, or no solution was found.
    """
    contact = contact_for(study.case)
    line_load, radius, speed = (float(x[at]) for x in (over.line_load, seen.radius, seen.entrainment))
    sliding = float(over.sliding[at]) if slide_to_roll is None else float(slide_to_roll * speed)
    of_pair, rough = (contact.fluid, contact.effective_modulus), None if smooth else contact.roughness
    problem = LineContact(line_load, radius, speed, *of_pair, sliding, rough)
    if problem.moes_load < LEAST_LOAD:
        return None
    try:
        return solve_coupled(problem, contact.rheology, contact.thermal, step=study.case.step)
    except SimulationError:
        return None


def loaded_places(study: PreparedEhl, over: PairWay, most: int) -> list[tuple[float, float, float, float]]:
    """Line load, entrainment, radius and sliding speed at positions that carry load, so many at most."""
    seen, at = seen_by(study, over), np.flatnonzero(loaded(over))
    at = at[:: max(1, -(-len(at) // most))]
    columns = over.line_load, seen.entrainment, seen.radius, over.sliding
    load, speed, radius, sliding = (np.broadcast_to(x, over.roll.shape)[at].tolist() for x in columns)
    return list(zip(load, speed, radius, sliding, strict=True))


def profiles(coupled: CoupledSolution) -> dict[str, Array]:
    """Pressure, film, temperature and shear at the places of a record."""
    solution = coupled.solution
    return pressure_and_film(solution) | {
        "temperature_rise": over_places(solution, coupled.temperature, 0.0),
        "shear_stress": over_places(solution, coupled.shear.stress, 0.0),
    }


def pressure_and_film(solution: Solution) -> dict[str, Array]:
    """Pressure and film at the places of a record."""
    return {
        "pressure": over_places(solution, solution.pressure, 0.0),
        "film_thickness": over_places(solution, solution.mean_gap, math.nan),
    }


def over_places(solution: Solution, values: Array, outside: float) -> Array:
    """Values at the nodes as values at the places of a record."""
    at = solution.place / solution.problem.half_width
    return np.interp(np.linspace(BEGIN, END, PLACES), at, values, left=outside, right=outside)


def contact_for(case: EhlCase) -> Contact:
    """What all contacts of a case have in common: oil, surfaces, rheology and heat."""
    law_input = LawInput(surfaces_of(case), case.lubricant, case.materials, without_nominal_conditions)
    return contact_of(law_input._replace(asperities=case.asperities))


def loaded(over: PairWay) -> Array:
    """Where the pair carries load."""
    return over.normal_load > _UNLOADED * np.max(over.normal_load)
