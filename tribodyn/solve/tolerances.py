"""Error control: a relative tolerance, and absolute ones from the scale of every state."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tribodyn.dynamics.mesh_motion import motion_of
from tribodyn.dynamics.parameters import DRIVE_SPEED, Model, OutputDrive
from tribodyn.mesh.cycle import CHANNELS
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.initial import static_deflection
from tribodyn.train.flow import flow
from tribodyn.train.layout import TrainLayout, displacements, works
from tribodyn.train.structure import (
    TURN,
    GearMesh,
    rolling_ratio,
    shift_of,
    turn_of,
)

_COMPLIANCE = CHANNELS.index("compliance")
_COSINE, _SINE, _GAP = CHANNELS.index("cosine"), CHANNELS.index("sine"), CHANNELS.index("gap")
#: Smallest deflection that tolerances are scaled by, m.
MINIMUM_DEFLECTION = 1e-9
#: Scale of the works over the energy transmitted in a mesh cycle: errors of steps add up over the cycle. With
#: stiff bearings it costs no step.
SHARE_OF_WORKS = 1.0 / 30.0

#: Frequency of a shaft beside the output over the lowest of a mesh, and its damping ratio.
SHARE_OF_MESH, DAMPING_RATIO = 0.1, 0.7


class StepTolerances(NamedTuple):
    """Relative tolerance, absolute ones for every state, and the steps that a mesh cycle may take."""

    rtol: float
    atol: Float[Array, " state"]
    max_steps: int


class TableScales(NamedTuple):
    """What tolerances take from a mesh's table alone."""

    stiffness: float  # of one pair, from its mean compliance over the mesh cycle, N/m
    per_torque: float  # deflection per torque on the driven body, m/(N m)
    gap_slope: float  # largest slope of the gaps over the driver's rotation, m/rad


def table_scales(mesh: GearMesh) -> TableScales:
    """The scales of a mesh's table."""
    table = mesh.table
    channel, boundary = np.asarray(table.channel), np.asarray(table.boundary)
    widths = np.diff(boundary) * float(table.pitch_angle) / channel.shape[1]
    steepest = np.max(np.abs(channel[..., _GAP, 1]), axis=1) * np.asarray(table.in_contact)
    return TableScales(
        np.shape(table.face_position)[0] / float(np.mean(channel[..., _COMPLIANCE, 0])),
        static_deflection(mesh, 1.0),
        float(np.max(np.max(steepest, axis=-1) / widths)),
    )


def _inertial_mass(model: Model, m: int) -> float:
    """Mass that the inertias of a mesh's bodies have along its pitch tangent, kg."""
    layout, mesh, inertia = model.layout, model.meshes[m], model.bodies.inertia
    first, second = float(mesh.driver_radius), float(mesh.driven_radius)
    return 1.0 / (first**2 / float(inertia[layout.driver[m]]) + second**2 / float(inertia[layout.driven[m]]))


def _transmitted(model: Model, m: int, deflection: float, stiffness: float) -> float:
    """Energy that a mesh with a deflection transmits in one reference cycle, J."""
    turned = float(rolling_ratio(m, model)) * float(model.operation.pitch_angle)
    return stiffness * deflection * float(model.meshes[m].driver_radius) * turned


def scales_from(
    model: Model,
    tables: Sequence[TableScales],
    deflection: Float[Array, " mesh"],
    energy: Sequence[float],
) -> Float[Array, " state"]:
    """Sizes of all states, from every mesh's deflection, m, and the energy that works are measured by, J.

    Displacements of a body scale with the least deflection of its meshes, velocities with the deflection
    times the mesh's natural frequency, works with a share of an energy. A body without meshes has the scales
    of the one that it is linked to, which may have its own so; on pins, by the lever.
    """
    layout = model.layout
    frequency = [np.sqrt(t.stiffness / _inertial_mass(model, m)) for m, t in enumerate(tables)]
    none = np.full(layout.bodies, np.inf)
    shift, shift_rate, turn, turn_rate = none.copy(), none.copy(), none.copy(), none.copy()
    for m, mesh in enumerate(model.meshes):
        deflected = float(deflection[m])
        ends = ((layout.driver[m], mesh.driver_radius), (layout.driven[m], mesh.driven_radius))
        for body, radius in ends:
            velocity = deflected * frequency[m]
            shift[body], shift_rate[body] = (min(shift[body], deflected), min(shift_rate[body], velocity))
            turn[body] = min(turn[body], deflected / abs(float(radius)))
            turn_rate[body] = min(turn_rate[body], velocity / abs(float(radius)))
    of_body = shift, shift_rate, turn, turn_rate
    # one after the other: a flywheel hangs on its carrier, and that on pins
    waiting = [k for k in range(layout.links + layout.clutches) if min(_ends(k, layout)) >= 0]
    while waiting:
        unscaled = [k for k in waiting if not _scaled_by_link(k, model, of_body)]
        if len(unscaled) == len(waiting):
            break
        waiting = unscaled
    scale = np.empty(layout.states)
    half = layout.half
    for body in range(layout.bodies):
        i = turn_of(body, layout)
        scale[i], scale[half + i] = turn[body], turn_rate[body]
        if body < layout.planar:
            place = shift_of(body)
            scale[place : place + 2], scale[half + place : half + place + 2] = shift[body], shift_rate[body]
        if body < layout.spatial:
            place = layout.tilts + 3 * body
            scale[place], scale[half + place] = shift[body], shift_rate[body]
            scale[place + 1 : place + 3] = turn[body]
            scale[half + place + 1 : half + place + 3] = turn_rate[body]
    first = half - layout.modes  # of no body: as the finest of those that move in the plane
    scale[first:half], scale[half + first : 2 * half] = np.min(shift), np.min(shift_rate)
    scale[layout.lag] = turn[0] / float(model.operation.nominal_speed)
    scale[works(layout)] = SHARE_OF_WORKS * np.max(energy)
    return scale


def _ends(k: int, layout: TrainLayout) -> tuple[int, int]:
    """Bodies at the ends of a link, or of a clutch by its number behind those of the links."""
    if k < layout.links:
        return layout.first[k], layout.second[k]
    return layout.clutch_first[k - layout.links], layout.clutch_second[k - layout.links]


def _scaled_by_link(k: int, model: Model, of_body: Sequence[Float[Array, " body"]]) -> bool:
    """Whether a link or clutch has, of a body with scales, given any to another, which had none.

    `of_body` are the scales of displacements, rotations and the rates of both, changed in place.
    """
    layout = model.layout
    shift, shift_rate, turn, turn_rate = of_body
    ends, on_pin = _ends(k, layout), k < layout.links and layout.pins[k]
    if k < layout.links and not (on_pin or model.links.stiffness[k][TURN] > 0.0):
        return False
    for end, (body, other) in enumerate((ends, ends[::-1])):
        if np.isinf(turn[body]) and np.isfinite(turn[other]):
            shift[body], shift_rate[body] = shift[other], shift_rate[other]
            turn[body], turn_rate[body] = turn[other], turn_rate[other]
            if on_pin:
                lever = float(np.linalg.norm(np.asarray(model.links.lever)[k, end]))
                turn[body], turn_rate[body] = shift[other] / lever, shift_rate[other] / lever
            return True
    return False


def state_scales(model: Model, state: Float[Array, " state"]) -> Float[Array, " state"]:
    """Sizes of all states by the deflections that the meshes have in a state or would have under the load."""
    tables = [table_scales(mesh) for mesh in model.meshes]
    deflection = np.maximum(_loaded(model, state, tables), _least(model))
    energy = [_transmitted(model, m, deflection[m], table.stiffness) for m, table in enumerate(tables)]
    return scales_from(model, tables, deflection, energy)


def output_shaft(model: Model) -> OutputDrive:
    """A shaft that carries the output along at a speed of its own, softer than the meshes and well damped.

    With all that turns it vibrates at a tenth of the lowest frequency of a mesh between its two bodies.
    """
    layout, bodies = model.layout, model.bodies
    squared = min(
        table_scales(mesh).stiffness / _inertial_mass(model, m) for m, mesh in enumerate(model.meshes)
    )
    turned = np.asarray(bodies.ratio) / float(bodies.ratio[layout.output])
    inertia = float(np.asarray(bodies.inertia) @ turned**2)
    stiffness = inertia * SHARE_OF_MESH**2 * squared
    return OutputDrive(stiffness, 2.0 * DAMPING_RATIO * float(np.sqrt(stiffness * inertia)))


def _least(model: Model) -> float:
    """Smallest deflection that tolerances are scaled by, at least the width over which contact sets in; m."""
    return max(float(model.operation.contact_width), MINIMUM_DEFLECTION)


def _loaded(model: Model, state: Float[Array, " state"], tables: list[TableScales]) -> Float[Array, " mesh"]:
    """Deflections that the meshes have in a state or would have under their load, without the bearings; m.

    The load is the largest that constant part, harmonics and table can add up to.
    """
    operation, layout = model.operation, model.layout
    varying = float(np.sum(np.abs(operation.load_amplitudes)))
    varying += float(np.max(np.abs(operation.load_torques), initial=0.0))
    constant = float(model.bodies.load[layout.output])
    still = model._replace(options=model.options._replace(drive=DRIVE_SPEED))
    torque = np.abs(flow(still, varying if constant >= 0.0 else -varying).on_driven)
    deflection = np.empty(len(model.meshes))
    for m, mesh in enumerate(model.meshes):
        table, motion = mesh.table, motion_of(m, state, model)
        segment = int(np.asarray(model.schedule.segment)[0, m])
        there = np.asarray(table.in_contact)[segment] > 0
        pairs, side = np.asarray(table.channel)[segment, 0, there, :, 0], np.asarray(table.side)[there]
        pressed = side * motion.towards * pairs[:, _COSINE] + motion.across * pairs[:, _SINE] - pairs[:, _GAP]
        deflection[m] = max(float(np.max(pressed)), tables[m].per_torque * torque[m])
    return deflection


def _energy(model: Model, m: int, loaded: float, table: TableScales) -> float:
    """Energy that works are measured by, J.

    That transmitted in one reference cycle; where there is no load, the kinetic energy that the gaps give,
    and at least the strain energy over the width in which contact sets in.
    """
    speed = float(rolling_ratio(m, model)) * float(model.operation.nominal_speed)
    moved = _inertial_mass(model, m) * (table.gap_slope * speed) ** 2
    strain = table.stiffness * _least(model) ** 2
    return max(_transmitted(model, m, loaded, table.stiffness), moved, strain)


def tolerances_from(
    model: Model, state: Float[Array, " state"], rtol: float, max_steps: int
) -> StepTolerances:
    """Tolerances scaled by the deflections that the meshes have in `state` or would have under the load."""
    return StepTolerances(rtol, tolerances_of_many([model], state[None], rtol)[0], max_steps)


def tolerances_of_many(
    models: Sequence[Model], states: Float[Array, "case state"], rtol: float
) -> Float[Array, "case state"]:
    """Absolute tolerances of many cases; what depends on a table alone is computed once per table."""
    by_table: dict[int, TableScales] = {}
    tolerances = np.empty(states.shape)
    for case, model in enumerate(models):
        for mesh in model.meshes:
            if id(mesh.table) not in by_table:
                by_table[id(mesh.table)] = table_scales(mesh)
        tables = [by_table[id(mesh.table)] for mesh in model.meshes]
        loaded = _loaded(model, states[case], tables)
        energy = [_energy(model, m, loaded[m], table) for m, table in enumerate(tables)]
        tolerances[case] = rtol * scales_from(model, tables, np.maximum(loaded, _least(model)), energy)
        # no relative part, see `step_control.relative_factor`: in its place that of the deflection
        tolerances[case, displacements(model.layout)] *= 2.0
    return tolerances
