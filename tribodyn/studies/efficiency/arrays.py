"""Datasets of a record of one mesh cycle in slow rotation."""

from typing import Any

import numpy as np

from tribodyn.dynamics.recorded import SAMPLES
from tribodyn.mesh.power_flow import efficiency
from tribodyn.studies.efficiency.along_path import Duty, Engagement
from tribodyn.studies.efficiency.places import Places
from tribodyn.studies.efficiency.quadrature import Array
from tribodyn.studies.efficiency.sampled import Samples


def record_arrays(over: Samples, mesh: Places, state: Engagement, duty: Duty) -> dict[str, Any]:
    """Datasets at the samples; what a quasi-static state has not stays out."""
    cycle = mesh.cycle
    touching = (cycle.in_contact > 0) & (state.normal_load > 0)
    angle = over.turned * cycle.pitch_angle
    ratio = cycle.pinion_pitch_radius / cycle.gear_pitch_radius
    zero = np.zeros_like(angle)

    def contacting(values: Array) -> Array:
        return np.where(touching, values, np.nan)

    gear_angle = ratio * angle - np.nan_to_num(state.deflection) / cycle.gear_pitch_radius
    one = np.ones_like(angle)
    arrays = {
        "time": angle / duty.pinion_speed,
        "pinion_angle": angle,
        "displacement": np.stack([zero, zero, zero, zero, angle, gear_angle], axis=-1),
        "velocity": np.stack(
            [zero, zero, zero, zero, one * duty.pinion_speed, one * duty.pinion_speed * ratio], -1
        ),
        "transmission_error": contacting(
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
    of_pairs = {name for name, one in SAMPLES.items() if one.dims == ("time", "pair")}
    return {name: over.by_pair(values) if name in of_pairs else values for name, values in arrays.items()}
