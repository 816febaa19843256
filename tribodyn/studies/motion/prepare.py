"""From a gearbox to a model ready to integrate: pairs tabulated, numbers of the train assembled."""

from collections.abc import Sequence

import numpy as np

from tribodyn.dynamics import parameters
from tribodyn.errors import InputError
from tribodyn.gears.bearings_in_time import bearings_in_time
from tribodyn.gears.case import LubricatedCase
from tribodyn.gears.drawn_system import coupled_by
from tribodyn.gears.model import gear_mesh, helix_sign, motor_curve, options_of, varying_load, with_own_teeth
from tribodyn.gears.tabulated import Tabulated, tables
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.twist import static_twist
from tribodyn.studies.motion.assembly import (
    BodyInertia,
    PreparedGearbox,
    body_inertias,
    clutches_of,
    engagements,
    in_space_of,
    link_damping,
    loads_in_own_sense,
    refuse_in_time,
    start_slip_of,
    table_numbers,
    varying_of,
)
from tribodyn.studies.motion.case import HOUSING, Gearbox
from tribodyn.studies.motion.heat.thermal_iteration import at_tooth_temperatures
from tribodyn.studies.motion.planetary.carriers import carrier_coordinates, carriers_of
from tribodyn.studies.motion.planetary.frames import carried_of, frames_of, pins_of, reference_pitch
from tribodyn.studies.motion.planetary.in_space import pins_in_space, tilts_in_frames
from tribodyn.studies.motion.planetary.rims import pushing_rims, rim_coordinates, rims_of, with_rims
from tribodyn.studies.motion.train.operating_point import settled
from tribodyn.train.layout import TrainLayout, layout_of
from tribodyn.train.links.chain import chain_of
from tribodyn.train.phases import Phases, entering_teeth, nominal_phases
from tribodyn.train.planetary import CARRIER
from tribodyn.train.positions import frame_of
from tribodyn.train.schedule import schedule_of
from tribodyn.train.structure import (
    GROUND,
    IN_SPACE,
    TURN,
    Bodies,
    Links,
)
from tribodyn.tribology.closure import closure_of

#: Cycles over which the numbers of teeth that differ are laid out for a run by time: until they meet again.
MOST_CYCLES = 10**6


def tabulated(case: Gearbox) -> tuple[Tabulated, ...]:
    """The tables of every mesh; equal meshes share one. Raises what `gears.tabulated.tables` raises."""
    table_of: dict[int, Tabulated] = {}
    numbers = table_numbers(case)
    for number, mesh in zip(numbers, case.meshes, strict=True):
        if number not in table_of:
            table_of[number] = tables(mesh.pair)
    return tuple(table_of[number] for number in numbers)


def prepare(case: Gearbox, tables: tuple[Tabulated, ...] | None = None) -> PreparedGearbox:
    """Make a case ready, drawn shafts about where they stand under the loads of their meshes.

    `tables` are equal tables, if known. Raises as `assemble`.
    """
    if case.in_time:
        refuse_in_time(case)
    prepared = assemble(case, tables)
    return prepared if case.system is None else settled(prepared, assemble)


def assemble(
    case: Gearbox, tables: tuple[Tabulated, ...] | None = None, twist: Float[Array, " mesh"] | None = None
) -> PreparedGearbox:
    """Check the geometry, tabulate the meshes, assemble the model.

    `tables` are equal tables, `twist` that of a case whose shafts turn alike, if known. Raises InputError
    where teeth cannot be made or run together, or a table does not cover the contact.
    """
    tables = tables or tabulated(case)
    inertias = body_inertias(case, [each.assembly for each in tables])
    warm, thermal = zip(*at_tooth_temperatures(case, tables), strict=True)
    entries = [float(each.cycle.roll_start) for each in tables]
    engaged = engagements(case, [each.assembly for each in tables], entries)
    phases = nominal_phases(case.toothed_shafts, engaged)
    order = _order(case)
    model = _model(case, tables, warm, inertias, phases, order)
    further = static_twist(model, [mesh.rate for mesh in case.meshes]) if twist is None else twist
    model = with_own_teeth(
        _under_load(model, case, further),
        entering_teeth(case.toothed_shafts, engaged, phases, further.tolist()),
        [(case.gears[one].teeth, case.gears[two].teeth) for one, two in (mesh.gears for mesh in case.meshes)],
        MOST_CYCLES if case.in_time else case.solver.cycles,
    )
    return PreparedGearbox(case, model, tables, tuple(warm), tuple(thermal), phases, order, inertias, further)


def _held(case: Gearbox, body: int) -> bool:
    """Whether bearings hold a body, which then moves in the plane; another one only turns."""
    springs = any(body in link.ends and min(link.stiffness[:2]) > 0.0 for link in case.links)
    on_shaft = case.system is not None and body in case.system.bodies
    return springs or on_shaft or case.bodies[body].floating


def _order(case: Gearbox) -> tuple[int, ...]:
    """Bodies of the case as the model has them: those that bearings hold first, the reference before all."""
    numbers = range(len(case.bodies))
    held = [body for body in numbers if _held(case, body)]
    if held and 0 not in held:
        rule = "the body that drives the reference mesh has no bearing, but others have"
        raise InputError(case.bodies[0].key, case.bodies[0].name, rule, "give it a bearing, or none to any")
    # those that move in space before those that only move in the plane
    held.sort(key=lambda body: not _moves_in_space(case, body))
    return (*held, *(body for body in numbers if body not in held))


def structure_of(case: Gearbox) -> tuple[list[str], int, int]:
    """Names of the model's bodies, and how many of the first ones move in the plane and in space."""
    order = _order(case)
    names = [case.bodies[body].name for body in order]
    planar = [body for body in order if _held(case, body)]
    spatial = sum(_moves_in_space(case, body) for body in planar)
    return [*names, *(["motor"] if _has_motor(case) else [])], len(planar), spatial


def _has_motor(case: Gearbox) -> bool:
    """Whether a motor is a body of its own, behind a shaft that gives way."""
    return case.source.kind == "torque" and case.source.shaft_stiffness is not None


def _moves_in_space(case: Gearbox, body: int) -> bool:
    """Whether a body that bearings hold moves in space: where anything tilts, all but those of spur sets.

    The reference, which comes before all, even then.
    """
    in_plane = any(body in gearset.bodies for gearset in case.sets if not gearset.in_space)
    return case.tilts and (body == 0 or not in_plane)


def _model(
    case: Gearbox,
    tables: Sequence[Tabulated],
    pairs: Sequence[LubricatedCase],
    inertias: Sequence[BodyInertia],
    phases: Phases,
    order: Sequence[int],
) -> parameters.Model:
    source, new = case.source, {body: number for number, body in enumerate(order)}
    closures = [closure_of(pair) for pair in pairs]
    layout = _layout(case, new)
    motor = [source.body] if layout.bodies > len(order) else []
    mass = np.array([inertias[body].mass for body in order[: layout.planar]])
    bodies = Bodies(
        mass=mass,
        inertia=np.array([*(inertias[body].inertia for body in order), *(source.inertia for _ in motor)]),
        ratio=np.array([float(case.bodies[body].ratio) for body in (*order, *motor)]),
        load=np.zeros(layout.bodies),
        load_damping=np.zeros(layout.bodies),
        tilting=np.array([inertias[body].tilting for body in order[: layout.spatial]]),
        **frames_of(case, order[: layout.planar], mass),
    )
    for load in loads_in_own_sense(case):
        bodies.load[new[load.body]] += load.torque
        bodies.load_damping[new[load.body]] += load.damping
    stiffness = [link.stiffness for link in case.links]
    damping = [link_damping(link, inertias) for link in case.links]
    laws = [(link.key, link.law, dict(link.values)) for link in case.links]
    chain, of_links = chain_of(laws, [link.stiffness[TURN] for link in case.links])
    if motor:
        stiffness.append((0.0, 0.0, source.shaft_stiffness or 0.0))
        damping.append((0.0, 0.0, source.shaft_damping))
    meshes = []
    # meshes are damped as by their gears and shafts alone, like those of a pair
    polar = [each.inertia - body.attached for each, body in zip(inertias, case.bodies, strict=True)]
    for mesh, each, pair, closure in zip(case.meshes, tables, pairs, closures, strict=True):
        ends = polar[mesh.driver], polar[mesh.driven]
        sense = case.bodies[mesh.driver].sense * int(each.cycle.pinion_sense)
        frame = frame_of(mesh.azimuth, sense)
        hand = helix_sign(pair.drive, clockwise=case.bodies[mesh.driver].sense < 0)
        one, two = (case.gears[gear].axial_position for gear in mesh.gears)
        plain = gear_mesh(pair, each, closure, ends, frame, hand, (one, two))
        meshes.append(plain._replace(**carried_of(case, mesh, plain)))
    drive = parameters.DRIVE_TORQUE if source.kind == "torque" else parameters.DRIVE_SPEED
    parts = [
        *pins_in_space(case, layout, new, damping, inertias),
        *tilts_in_frames(case, order, layout, bodies),
        *rims_of(case, tables, layout),
        *carriers_of(case, layout, new, damping, inertias, rim_coordinates(case)),
    ]
    layout, couplings = coupled_by(case.system, parts, layout, bodies, new, not drive)
    forces, in_time = bearings_in_time(case.system, layout, new)
    varying = varying_of(case)
    first, cycles = case.meshes[0].pair, [each.cycle for each in tables]
    return parameters.Model(
        pushing_rims(case, tables, meshes),
        bodies,
        Links(
            np.array(stiffness).reshape(-1, 3),
            np.array(damping).reshape(-1, 3),
            of_links,
            *_in_space(case, damping, inertias, layout),
            *pins_of(case, layout),
            couplings,
            in_time,
        ),
        schedule_of(
            [np.asarray(each.table.boundary) for each in tables],
            [mesh.rate for mesh in case.meshes],
            [float(phase) for phase in phases.meshes],
            case.laid_out,
        ),
        parameters.Operation(
            nominal_speed=source.speed / float(case.bodies[source.body].ratio),
            pitch_angle=reference_pitch(case),
            drive_torque=source.torque if source.curve is None else 0.0,
            speed_regulation=source.speed_regulation,
            contact_width=first.mesh.contact_width,
            reversal_width=first.friction.reversal_width,
            **varying_load(varying.table, varying.harmonics),
            clutches=clutches_of(case.clutches),
            start_slip=start_slip_of(case) / float(case.bodies[source.body].ratio),
            **motor_curve(source.curve),
        ),
        options_of(first, cycles, closures[0], layout, drive)._replace(
            links=chain,
            bearings=forces,
            variable=parameters.BY_TIME if case.in_time else parameters.BY_ROTATION,
        ),
    )


def _in_space(
    case: Gearbox,
    damping: Sequence[tuple[float, float, float]],
    inertias: Sequence[BodyInertia],
    layout: TrainLayout,
) -> tuple[Float[Array, "link 5 5"], Float[Array, "link 5 5"]]:
    """Matrices of the links between bodies that move in space; of a motor's shaft nothing."""
    stiffness = np.zeros((layout.links if layout.spatial else 0, IN_SPACE, IN_SPACE))
    losses = stiffness.copy()
    for number, link in enumerate(case.links if layout.spatial else ()):
        body = link.ends[0]
        if link.lever:
            continue  # `planetary.in_space`
        of_sets = [planet for gearset in case.sets if body in gearset.bodies for planet in gearset.planets]
        faces = [case.gears[gear].face_width for one in (body, *of_sets) for gear in case.bodies[one].gears]
        width = max(faces, default=0.0)
        stiffness[number], losses[number] = in_space_of(link, damping[number], inertias, width)
    return stiffness, losses


def _under_load(model: parameters.Model, case: Gearbox, further: Float[Array, " mesh"]) -> parameters.Model:
    """The model with its meshes where the load at the start brings them, so many cycles `further`."""
    if not np.any(further):
        return model
    schedule = schedule_of(
        [np.asarray(mesh.table.boundary) for mesh in model.meshes],
        [mesh.rate for mesh in case.meshes],
        ((model.schedule.offset[0] + further) % 1.0).tolist(),
        case.laid_out,
    )
    return model._replace(schedule=schedule)


def _layout(case: Gearbox, new: dict[int, int]) -> TrainLayout:
    ends = [(new[link.ends[0]], new.get(link.ends[1], GROUND)) for link in case.links]
    source = new[case.source.body]
    count, planar = len(new), sum(_held(case, body) for body in new)
    shaft = _has_motor(case)
    if shaft:
        ends.append((count, source))
    meshes = [(new[mesh.driver], new[mesh.driven]) for mesh in case.meshes]
    layout = layout_of(
        planar,
        count + shaft,
        meshes,
        ends,
        count if shaft else source,
        new[varying_of(case).body],
        spatial=sum(_held(case, body) and _moves_in_space(case, body) for body in new),
        pins=[number for number, link in enumerate(case.links) if link.lever],
        holding={number: link.holds for number, link in enumerate(case.links) if link.holds},
        frames=int(bool(case.sets)),
        clutches=[(new[one.ends[0]], new.get(one.ends[1], GROUND)) for one in case.clutches],
        carriers=[new.get(mesh.carrier, GROUND) for mesh in case.meshes],
        modes=coordinates_of_no_body(case),
    )
    return with_rims(case, layout)


def coordinates_of_no_body(case: Gearbox) -> int:
    """Number of those of shafts and housing, of rims and of carriers, behind the bodies'."""
    of_shafts = case.system.reduced.modes if case.system is not None else 0
    return of_shafts + rim_coordinates(case) + sum(carrier_coordinates(gearset) for gearset in case.sets)


def geometry_of(prepared: PreparedGearbox) -> dict[str, np.ndarray]:
    """Where bodies, gears and meshes stand, as `record.TRAIN_GEOMETRY` says."""
    case, order = prepared.case, prepared.order
    numbers = {body: number for number, body in enumerate(order)}
    of_body = {body: numbers[gearset.members[CARRIER]] for gearset in case.sets for body in gearset.bodies}
    carriers = [of_body.get(body, HOUSING) for body in order] + [HOUSING] * (
        len(prepared.bodies) - len(order)
    )
    centres = np.array([body.centre for body in prepared.bodies])
    # gears of a pair are as far apart as its path of contact says
    centres[np.isnan(centres)] = prepared.cycle.pinion_pitch_radius + prepared.cycle.gear_pitch_radius
    turning = [body.sense * float(body.ratio) for body in prepared.bodies] + [0.0]  # the last: the housing
    return {
        "centre": centres,
        "sense": np.array([body.sense for body in prepared.bodies]),
        "carrier": np.array(carriers),
        "carried": np.array([turning[body] for body in carriers]),
        "gear_body": np.array([numbers[gear.body] for gear in case.gears]),
        "plane": np.array([gear.plane for gear in case.gears]),
        "tooth_direction": np.array(prepared.phases.teeth),
        "driver_gear": np.array([mesh.gears[0] for mesh in case.meshes]),
        "driven_gear": np.array([mesh.gears[1] for mesh in case.meshes]),
        "phase": np.array(prepared.phases.meshes),
        "azimuth": np.array([mesh.azimuth for mesh in case.meshes]),
    }
