"""A gearbox in slow rotation without friction: stiffness, transmission error, backlash over the loads."""

import math
from typing import Any

import numpy as np

from tribodyn.cases.loss_part import Statics
from tribodyn.dynamics.modes import linearised
from tribodyn.gears.mesh_loss import LEAST_TORQUE
from tribodyn.gears.tabulated import Tabulated
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.quasi_static import normal_arms, quasi_static
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.losses.gearbox import GearboxLoss
from tribodyn.train.structure import turn_of

#: Harmonics of a mesh cycle that are told, and phases that they are of.
HARMONICS, PHASES = 8, 256


def statics_of(prepared: PreparedGearbox, gearbox: GearboxLoss, loads: Any) -> Statics:
    """Statics at loads that are multiples of the scenario's own; tables are those of the latter."""
    case, loads = gearbox.case, np.atleast_1d(np.asarray(loads, dtype=float))
    torques = gearbox.flow.load[:, None] * loads
    seen = [
        _of_mesh(tabulated, torque, mesh.pair.operating.gear_torque)
        for tabulated, torque, mesh in zip(prepared.tables, torques, case.meshes, strict=True)
    ]
    stiffness, error = (np.stack([of[k] for of in seen], axis=1) for k in range(2))
    entry = np.asarray(prepared.phases.meshes, dtype=float)[:, None] * np.arange(1, HARMONICS + 1)
    reflected = _at_output(prepared, gearbox)
    teeth = np.array([abs(case.gears[mesh.gears[0]].teeth) for mesh in case.meshes])
    return Statics(
        np.real(stiffness[:, :, 0]),
        np.abs(stiffness[:, :, 1:]),
        np.real(error[:, :, 0]),
        np.abs(error[:, :, 1:]),
        np.angle(error[:, :, 1:] * np.exp(2j * math.pi * entry)),
        teeth * gearbox.turning,
        reflected,
        np.array([_stiffness(prepared, max(abs(load), LEAST_TORQUE)) for load in loads]),
        float(_backlash(gearbox) @ reflected),
    )


def _of_mesh(tabulated: Tabulated, torque: Float[Array, " point"], nominal: float) -> tuple[Any, Any]:
    """Complex amplitudes (point, 1 + harmonic) of stiffness and error along the pitch circles."""
    cycle = tabulated.cycle
    least = LEAST_TORQUE * (abs(nominal) or 1.0)
    force = cycle.gear_sense * np.maximum(np.abs(torque), least)
    state = quasi_static(cycle, force[:, None, None])
    return _amplitudes(cycle, state.mesh_stiffness), _amplitudes(cycle, state.deflection)


def _amplitudes(cycle: MeshCycle, values: Float[Array, "point segment node"]) -> Any:
    """Mean and complex amplitudes of harmonics over a mesh cycle of values at its nodes."""
    phase = (np.arange(PHASES) + 0.5) / PHASES
    boundary, nodes = np.asarray(cycle.boundary), values.shape[-1]
    segment = np.clip(np.searchsorted(boundary, phase, side="right") - 1, 0, len(boundary) - 2)
    place = (phase - boundary[segment]) / np.diff(boundary)[segment] * (nodes - 1)
    cell = np.minimum(place.astype(int), nodes - 2)
    share = place - cell
    over = (1.0 - share) * values[:, segment, cell] + share * values[:, segment, cell + 1]
    found = np.fft.rfft(over, axis=-1)[:, : HARMONICS + 1] / PHASES
    found *= np.exp(-1j * math.pi * np.arange(HARMONICS + 1) / PHASES)  # the first phase is half a step in
    return np.where(np.arange(HARMONICS + 1) > 0, 2.0, 1.0) * found


def _stiffness(prepared: PreparedGearbox, load: float) -> float:
    """Stiffness at the output with the source held, N m/rad, about this load: of all that gives way."""
    model, layout = prepared.model, prepared.model.layout
    scaled = model._replace(bodies=model.bodies._replace(load=load * np.asarray(model.bodies.load)))
    _, matrix = linearised(scaled, [each.cycle for each in prepared.tables])
    held = turn_of(prepared.order.index(prepared.case.source.body), layout)
    free = np.array([place for place in range(layout.half) if place != held])
    push = np.zeros(layout.half)
    output = turn_of(layout.output, layout)
    push[output] = 1.0
    scale = np.sqrt(np.maximum(np.diag(matrix)[free], 1e-300))
    balanced = matrix[np.ix_(free, free)] / np.outer(scale, scale)
    moved = np.linalg.lstsq(balanced, push[free] / scale)[0] / scale
    return float(1.0 / moved[np.searchsorted(free, output)])


def _at_output(prepared: PreparedGearbox, gearbox: GearboxLoss) -> Float[Array, " mesh"]:
    """Angle of the output, rad, per m along the pitch circles of each mesh with the source held.

    By virtual work: it is what the mesh bears of the output's torque. 0 without loads.
    """
    output = prepared.order[prepared.model.layout.output]
    torque = gearbox.output_power / abs(gearbox.speeds[output])
    radii = np.array(
        [float(each.cycle.gear_sense * each.cycle.gear_pitch_radius) for each in prepared.tables]
    )
    return np.abs(gearbox.flow.load / torque) / radii if torque else 0.0 * radii


def _backlash(gearbox: GearboxLoss) -> Float[Array, " mesh"]:
    """Backlash along the pitch circles, m; 0 where none is given."""
    play = []
    for mesh, tabulated in zip(gearbox.case.meshes, gearbox.tabulated, strict=True):
        arms = normal_arms(tabulated.cycle)
        normal = math.cos(float(tabulated.assembly.path.pressure_angle(0.0))) * float(
            np.mean(arms / np.cos(tabulated.cycle.pressure_angle))
        )
        play.append((mesh.pair.mesh.backlash or 0.0) / normal)
    return np.array(play)
