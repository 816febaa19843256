"""A mesh in slow rotation: transmission error at several torques, stiffness, loads and where they act."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from tribodyn.app.core.shown import harmonics
from tribodyn.gears.case import GearCase
from tribodyn.gears.tabulated import opened, tables
from tribodyn.geometry.assembly import Assembly
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.quasi_static import QuasiStatic, by_pairs, quasi_static

#: Phases over one mesh cycle, and harmonics.
PHASES, HARMONICS = 200, 8
_MICRON, _MILLIMETRE = 1e-6, 1e-3


def slow_rotation(pair: GearCase, assembly: Assembly) -> dict[str, Any]:
    """A pair at its nominal torque: as `at_torques`, and the loads of its pairs and where they act.

    Errors in µm, stiffness in N/µm, loads in N, points in mm, torques of the gear in N m; each over the phase
    of the mesh cycle, a pair's last, the newest first. Nothing of a duty without torque.
    """
    nominal = abs(pair.operating.gear_torque)
    if nominal == 0.0:
        return {}
    cycle = opened(_counted(pair), assembly, False)
    state = _shared(cycle, nominal)
    return _of_nominal(cycle, state) | _of_torques([nominal], [(cycle, state)])


def at_torques(pair: GearCase, assembly: Assembly, shares: Sequence[float]) -> dict[str, Any]:
    """A pair at its nominal torque and at shares of it; nothing of a duty without torque.

    Of helical pairs, whose slices hold each other, and of flanks by finite elements each torque takes a table
    of its own, of other pairs that of the nominal one serves.
    """
    nominal = abs(pair.operating.gear_torque)
    if nominal == 0.0:
        return {}
    pair = _counted(pair)
    cycle = opened(pair, assembly, False)
    torques, states = [nominal], [(cycle, _shared(cycle, nominal))]
    of_torque = bool(pair.drive.helix_angle) or pair.mesh.at_load
    for torque in (share * nominal for share in shares if share != 1.0):
        if of_torque:
            loaded = replace(pair, operating=replace(pair.operating, gear_torque=torque))
            cycle = opened(loaded, assembly, not pair.mesh.at_load)
        torques.append(torque)
        states.append((cycle, _shared(cycle, torque)))
    return _of_torques(torques, states)


def _counted(pair: GearCase) -> GearCase:
    """A pair with as many slices as it takes, where their number is open."""
    if not pair.drive.helix_angle or pair.mesh.at_load or pair.mesh.slices > 1:
        return pair
    return replace(pair, mesh=replace(pair.mesh, slices=tables(pair).cycle.slices))


def _shared(cycle: MeshCycle, torque: float) -> QuasiStatic:
    return quasi_static(cycle, float(cycle.gear_sense) * torque)


def _over_phase(cycle: MeshCycle, values: np.ndarray) -> np.ndarray:
    """Values at the nodes, (S, N), at even phases, the end of the cycle not included."""
    phase = np.linspace(0.0, 1.0, PHASES, endpoint=False)
    return np.interp(phase, np.asarray(cycle.phase).ravel(), np.asarray(values).ravel())


def _of_torques(torques: list[float], states: list[tuple[MeshCycle, QuasiStatic]]) -> dict[str, Any]:
    order = np.argsort(torques)
    error = np.array([_over_phase(cycle, state.deflection) for cycle, state in states])[order] / _MICRON
    stiffness = np.array([_over_phase(cycle, state.mesh_stiffness) for cycle, state in states])[order]
    return {
        "torques": np.array(torques)[order],
        "nominal": int(np.flatnonzero(order == 0)[0]),
        "phase": np.linspace(0.0, 1.0, PHASES, endpoint=False),
        "transmission_error": error,
        "stiffness": stiffness * _MICRON,
        "harmonics": harmonics(error, HARMONICS),
        "peak_to_peak": np.ptp(error, axis=1),
    }


def _of_nominal(cycle: MeshCycle, state: QuasiStatic) -> dict[str, Any]:
    """Loads of the pairs at the nominal torque, the newest pair first, and where they act."""
    slices, fronts = cycle.slices, cycle.front_pairs
    load = by_pairs(np.asarray(state.normal_load), slices)[..., :fronts]
    middle = slice(slices // 2, cycle.front_slots, slices)
    distance, angle = (
        np.asarray(each)[..., middle] for each in (cycle.signed_distance, cycle.pressure_angle)
    )
    loads = np.stack([_over_phase(cycle, load[..., pair]) for pair in reversed(range(fronts))], axis=-1)
    places = [
        np.stack([_over_phase(cycle, values[..., pair]) for pair in reversed(range(fronts))], axis=-1)
        for values in (distance * np.cos(angle), distance * np.sin(angle))
    ]
    total = np.sum(loads, axis=-1, keepdims=True)
    phase = np.linspace(0.0, 1.0, PHASES, endpoint=False)
    touching = (loads > 0.0)[..., None]
    return {
        "phase": phase,
        "roll": float(cycle.roll_start) + phase * 2.0 * np.pi / float(cycle.pinion_teeth),
        "load": loads,
        "share": loads / np.where(total > 0.0, total, 1.0),
        "contact": np.where(touching, np.stack(places, axis=-1) / _MILLIMETRE, np.nan),
    }
