"""A pair's way through the mesh: its loads, speeds and radii, quasi-static, and its contact solved there."""

import math
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import InputError, SimulationError
from tribodyn.geometry.path import kinematics
from tribodyn.numerics.shapes import Array
from tribodyn.studies.ehl.case import BEGIN, END, PLACES, EhlCase
from tribodyn.studies.ehl.loads import given_loads, quasi_static_loads
from tribodyn.studies.gears.prepare import PreparedGears, assembled
from tribodyn.tribology.closure import surfaces_of, untried_closure_of
from tribodyn.tribology.contact import hertz_half_width
from tribodyn.tribology.ehl.coupled import CoupledSolution, solve_coupled
from tribodyn.tribology.ehl.problem import LEAST_LOAD, LineContact, Solution
from tribodyn.tribology.ehl.table import Contact, contact_of
from tribodyn.tribology.film import FILM_LAWS
from tribodyn.tribology.friction import FRICTION_LAWS
from tribodyn.tribology.law import FilmData, FrictionData, LawInput
from tribodyn.tribology.surface_state import ContactFriction, contact_friction

#: Positions at which the friction is solved that enters the loads.
FRICTION_POSITIONS = 8
#: Loads over the highest at which a pair is taken as out of contact.
_UNLOADED = 1e-6
#: Nodes over half the width over which a jump of the load is spread.
_SPREAD = 32


PreparedEhl = PreparedGears[EhlCase]


class PairWay(NamedTuple):
    """The pair at its positions: arrays (K,), SI; the rolling speeds are those of both flanks.

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
    from tribodyn.mesh.by_compliance import mesh_cycle_of

    assembly = assembled(case)
    cycle = mesh_cycle_of(assembly, case.materials, case.mesh, case.operating.gear_torque)
    return PreparedGears(case, assembly, cycle, None)


def way(study: PreparedEhl) -> PairWay:
    """Return the pair at positions evenly spaced in roll angle, in the middle of equal parts of its contact.

    Loads are given ones, or follow from the compliances of the pairs, the torque and the friction of the
    contact as it is solved at a few positions. With squeeze a jump of the load, where another pair comes or
    goes, is spread over `jump_width`.
    """
    if study.case.loads is not None:
        return _way(study, study.case.positions, None)
    free = _way(study, FRICTION_POSITIONS, None)
    friction = np.abs(friction_along(study, free))
    known = np.isfinite(friction)
    if not np.any(known):
        return _way(study, study.case.positions, None)
    return _way(study, study.case.positions, (free.roll[known], friction[known]))


def _way(study: PreparedEhl, positions: int, friction: tuple[Array, Array] | None) -> PairWay:
    """As `way`, with friction coefficients at roll angles, or without friction."""
    case, cycle = study.case, study.cycle
    start, end = float(cycle.roll_start), float(cycle.roll_end)
    roll = start + (np.arange(positions) + 0.5) / positions * (end - start)
    path = study.assembly.path
    motion = kinematics(path, path.signed_distance(roll))
    speed = case.operating.pinion_speed
    radius = 1.0 / np.asarray(motion.relative_curvature)
    speeds = (speed * np.asarray(motion.pinion_speed), speed * np.asarray(motion.gear_speed))
    if case.loads is None:
        nodes, loads = quasi_static_loads(cycle, case.operating.gear_torque, friction)
    else:
        nodes, loads = given_loads(case.loads, cycle)
    loads = loads / float(cycle.face_width)
    if case.transient:
        nodes, loads = _spread(nodes, loads, jump_width(study, float(np.max(loads)), radius, speeds))
    line_load = np.interp(roll, nodes, loads)
    return PairWay(roll, line_load * float(cycle.face_width), line_load, radius, speeds, (nodes, loads))


def jump_width(study: PreparedEhl, line_load: float, radius: Array, speeds: tuple[Array, Array]) -> float:
    """Roll angle in which the oil is drawn through half a contact, b/u, at the highest load; rad.

    Where the load rises much faster, the contact widens faster than the oil can follow.
    """
    modulus = float(surfaces_of(study.case).effective_modulus)
    width = hertz_half_width(line_load, 1.0 / np.median(radius), modulus)
    drawn = np.median(0.5 * np.abs(speeds[0] + speeds[1]))
    return float(width / drawn) * study.case.operating.pinion_speed


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
    seen, contact = seen_by(study, over, None, "none"), contact_for(study.case)
    found = np.full(len(over.roll), np.nan)
    for at in np.flatnonzero(loaded(over)):
        solved = solved_at(contact, over, seen, at, study.case.step)
        if solved is not None:
            found[at] = solved.friction / float(over.line_load[at])
    return found


def given_of(case: EhlCase) -> LawInput:
    """What laws and solution are made from."""

    def none() -> Any:
        raise InputError("film.law", '"solved"', "is not compared with itself", "use another law")

    return LawInput(surfaces_of(case), case.lubricant, case.materials, none, none)


def seen_by(study: PreparedEhl, over: PairWay, film: str | None, friction: str) -> ContactFriction:
    """What a film law (None: that which goes with the friction law) and a friction law make of the way."""
    case = replace(study.case, film=FilmData(film), friction=FrictionData(friction))
    cycle, speed = study.cycle, study.case.operating.pinion_speed
    return contact_friction(
        untried_closure_of(case),
        np.maximum(over.line_load, 1e-9),
        over.radius,
        *over.speeds,
        float(cycle.pitch_point_length),
        speed * float(cycle.pitch_point_rate),
    )


def by_laws(study: PreparedEhl, over: PairWay) -> dict[str, dict[str, Array]]:
    """Film by every film law and friction by every friction law that needs no values of its own.

    The solved law is left out: it is tabulated from the contacts that are solved here.
    """
    films, frictions = {}, {}
    for name in FILM_LAWS:
        if name != "solved":
            films[name] = np.asarray(seen_by(study, over, name, "none").surface.central_film_thickness)
    for name in FRICTION_LAWS:
        if name in ("solved", "none"):
            continue
        try:
            seen = seen_by(study, over, None, name)
        except InputError:  # it wants a value of its own
            continue
        frictions[name] = np.abs(np.asarray(seen.surface.friction_coefficient)) + 0.0 * over.roll
    return {"film": films, "friction": frictions}


def meant_by(study: PreparedEhl, over: PairWay, law: str) -> str:
    """Which dataset of the solved contact a film law stands for.

    Its central or its minimum film; and that between smooth surfaces, where the law knows no roughness.
    """
    smooth = replace(study, case=replace(study.case, roughness=1e-3 * study.case.roughness))
    rough, flat = (
        seen_by(prepared, over, law, "none").surface.central_film_thickness for prepared in (study, smooth)
    )
    kind = "smooth" if np.array_equal(np.asarray(rough), np.asarray(flat)) else "thickness"
    return f"{FILM_LAWS[law].thickness}_film_{kind}"


def solved_at(
    contact: Contact,
    over: PairWay,
    seen: ContactFriction,
    at: Any,
    step: float,
    slide_to_roll: float | None = None,
    smooth: bool = False,
) -> CoupledSolution | None:
    """Solve the contact at a position, mixed and with heat, or of `smooth` surfaces.

    None: next to no load, or no solution was found.
    """
    line_load, radius, speed = (float(x[at]) for x in (over.line_load, seen.radius, seen.entrainment))
    sliding = float(over.sliding[at]) if slide_to_roll is None else float(slide_to_roll * speed)
    roughness = None if smooth else contact.roughness
    problem = LineContact(
        line_load, radius, speed, contact.fluid, contact.effective_modulus, sliding, roughness
    )
    if problem.moes_load < LEAST_LOAD:
        return None
    try:
        return solve_coupled(problem, contact.rheology, contact.thermal, step=step)
    except SimulationError:
        return None


def profiles(found: CoupledSolution) -> dict[str, Array]:
    """Pressure, film, temperature and shear at the places of a record."""
    solution = found.solution
    return pressure_and_film(solution) | {
        "temperature_rise": over_places(solution, found.temperature, 0.0),
        "shear_stress": over_places(solution, found.shear.stress, 0.0),
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
    return contact_of(given_of(case))


def loaded(over: PairWay) -> Array:
    """Where the pair carries load."""
    return over.normal_load > _UNLOADED * np.max(over.normal_load)
