"""Speeds at which the teeth excite the modes of a gearbox most: where to look before looking everywhere."""

import math
from collections.abc import Iterator

import numpy as np

from tribodyn.dynamics.modes import linearised, modes
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.quasi_static import quasi_static
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies.motion.case import Gearbox
from tribodyn.studies.motion.frequencies import mesh_frequencies
from tribodyn.studies.motion.heat.settled import prepare_settled

#: Harmonics of the transmission error that are looked at.
HARMONICS = 6
#: Speeds nearer to each other than this share of one are one: the width of a resonance whose damping ratio is
#: 0.05, and how far teeth that part bend it down.
_NEAR = 0.1


def resonance_speeds(case: Gearbox, span: tuple[float, float], most: int) -> list[float]:
    """The speeds of the input, rad/s, within a span, at which it vibrates most by the linearised model.

    Mode j meets harmonic h of mesh m where h ω_m = ω_j, ω_m going with the speed. With the amplitude ε_h of
    the quasi-static transmission error the force in the mesh then swings by ε_h k e_j/(2 ζ_j), where e_j is
    the share of the mode's strain energy that lies in the mesh; damping ratios ζ_j are taken to be alike. The
    strongest first; `most` of them at most, none near another; of one that is near an end of the span,
    beyond it, that end. Raises InputError or SimulationError where the case cannot be prepared.
    """
    prepared = prepare_settled(case)
    box, cycles = prepared.case, [each.cycle for each in prepared.tables]
    mode_set = modes(prepared.model, cycles)
    angular = 2.0 * math.pi * mode_set.frequency
    order = np.arange(1, HARMONICS + 1)
    strength, speed = [], []
    _, without = linearised(prepared.model, [])
    for m, frequency in enumerate(mesh_frequencies(prepared)):
        _, with_mesh = linearised(prepared.model, cycles[: m + 1])
        stored = np.einsum("jc,cd,jd->j", mode_set.shape, with_mesh - without, mode_set.shape)
        with np.errstate(invalid="ignore", divide="ignore"):
            in_mesh = np.clip(stored / angular**2, 0.0, 1.0)
        torque = math.copysign(1.0, float(cycles[m].gear_pitch_radius)) * box.pairs[m].operating.gear_torque
        strength.append(np.nan_to_num(in_mesh[:, None] * error_harmonics(cycles[m], torque)))
        speed.append(box.source.speed * mode_set.frequency[:, None] / (order * frequency))
        without = with_mesh
    strongest = np.argsort(-np.ravel(strength), kind="stable")
    return list(_apart(np.ravel(speed)[strongest], span, most))


def _apart(speeds: Float[Array, " speed"], span: tuple[float, float], most: int) -> Iterator[float]:
    """Those that are not near an earlier one, in a span or at the end of it that is near."""
    chosen: list[float] = []
    for place in map(float, speeds):
        if len(chosen) == most:
            return
        speed = min(max(place, span[0]), span[1])
        near = abs(place - speed) <= _NEAR * speed
        if near and all(abs(speed - other) > _NEAR * other for other in chosen):
            chosen.append(speed)
            yield speed


def error_harmonics(cycle: MeshCycle, gear_torque: float) -> Float[Array, " harmonic"]:
    """Amplitudes of the harmonics 1 to `HARMONICS` of the quasi-static transmission error, m."""
    error = quasi_static(cycle, gear_torque).deflection
    begin, end = cycle.boundary[:-1, None], cycle.boundary[1:, None]
    phase = begin + (end - begin) * np.linspace(0.0, 1.0, error.shape[1])
    wave = np.exp(-2j * np.pi * np.arange(1, HARMONICS + 1)[:, None, None] * phase)
    return 2.0 * np.abs(np.sum(np.trapezoid(wave * error, phase[None], axis=2), axis=1))
