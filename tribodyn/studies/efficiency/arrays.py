"""Samples of one mesh cycle in slow rotation, from where a pair enters until the next one does; datasets."""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.dynamics.recorded import SAMPLES
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.power_flow import efficiency
from tribodyn.studies.efficiency.along_path import MeshDuty, PathState
from tribodyn.studies.efficiency.places import Places
from tribodyn.studies.efficiency.quadrature import Array

#: By how much of a pitch the first and the last sample stand off the end of the path.
_INSIDE = 1e-9


class Samples(NamedTuple):
    """Phases of the table in the order in which they are passed."""

    turned: Array  # (K,), rotation since the first sample, in pitches
    #: (K,), phase of the table at each sample. Where the gear drives it falls: contact begins where the
    #: table's ends, in the mirrored world in which the back flanks are driving flanks
    phase: Array
    later: np.ndarray  # (K,); where the table counts the pairs one slot later than the record
    way: float  # +1, or −1 where the gear drives

    def by_pair(self, values: Array) -> Array:
        """Values (K, Q) of the table's slots, as those of the record's: the pair that entered last, last."""
        if self.way > 0.0:
            return values
        return np.where(self.later[:, None], np.roll(values, -1, axis=1), values)[:, ::-1]


def samples(cycle: MeshCycle, count: int, way: float) -> Samples:
    """Return count + 1 samples over one mesh cycle of the driving flanks, or of the back flanks."""
    turned = np.linspace(0.0, 1.0, count + 1)
    if way > 0.0:
        return Samples(turned, turned, np.zeros(count + 1, dtype=bool), way)
    span = float((cycle.roll_end - cycle.roll_start) / cycle.pitch_angle)
    # the pair in the first slot enters where the table lets it leave: just inside the path, and the next one
    # is just outside when the cycle ends
    falling = span - (cycle.front_pairs - 1.0) - turned - _INSIDE * (1.0 - 2.0 * turned)
    later = falling < 0.0
    return Samples(turned, np.where(later, falling + 1.0, falling), later, way)


def record_arrays(over: Samples, mesh: Places, state: PathState, duty: MeshDuty) -> dict[str, Any]:
    """Datasets at the samples; what a quasi-static state has not stays out."""
    cycle = mesh.cycle
    touching = (cycle.in_contact > 0) & (state.normal_load > 0)
    angle = over.turned * cycle.pitch_angle
    ratio = cycle.pinion_pitch_radius / cycle.gear_pitch_radius
    zero = np.zeros_like(angle)

    def contacting(values: Array) -> Array:
        return np.where(touching, values, np.nan)

    gear_angle = ratio * angle - np.nan_to_num(state.deflection) / cycle.gear_pitch_radius
    arrays = {
        "time": angle / duty.pinion_speed,
        "pinion_angle": angle,
        "displacement": np.stack([zero, zero, zero, zero, angle, gear_angle], axis=-1),
        "velocity": np.stack(
            [zero, zero, zero, zero, zero + duty.pinion_speed, zero + duty.pinion_speed * ratio], -1
        ),
        "transmission_error_normal": contacting(
            duty.way * state.deflection[:, None] * np.cos(cycle.pressure_angle[:, 0])
        ),
        "transmission_error_rotational": state.deflection,
        "normal_load": state.normal_load,
        "friction_force": state.friction_force,
        "friction_coefficient": contacting(state.friction_coefficient),
        "asperity_load_ratio": contacting(state.asperity_load_ratio),
        "central_film_thickness": contacting(state.central_film_thickness),
        "film_parameter": contacting(state.central_film_thickness / duty.closure.surfaces.roughness),
        "flash_temperature_rise": contacting(state.flash_temperature_rise),
        "hertz_pressure": contacting(state.hertz_pressure),
        "equivalent_radius": contacting(state.radius),
        "entrainment_speed": contacting(state.entrainment),
        "sliding_speed": contacting(state.sliding),
        "pressure_angle": contacting(cycle.pressure_angle[:, 0]),
        "mesh_stiffness": np.where(touching, 1.0 / cycle.compliance[:, 0], 0.0),
        "closure_in_range": contacting(state.closure_in_range),
        "friction_in_range": contacting(state.friction_in_range),
        "drive_torque": state.pinion_torque,
        "power_in": state.power_in,
        "power_out": state.power_out,
        "power_friction": state.power_friction,
        "power_damping": zero,
        "power_parametric": zero,
        "efficiency": efficiency(state.power_in, state.power_out, state.power_friction),
    }
    of_pairs = {name for name, sample in SAMPLES.items() if sample.dims == ("time", "pair")}
    return {name: over.by_pair(values) if name in of_pairs else values for name, values in arrays.items()}
