"""A record with the looks of a real one: an involute drive under constant torque, in closed form.

Loads are shared by halves, friction is Coulomb's; nothing here is meant to be exact but the kinematics.
"""

from pathlib import Path

import numpy as np

from tests.support.record_samples import gear_pair_writer
from tribodyn.gears.motion.recorded import DOF, SAMPLES

MODULE, TEETH, PRESSURE_ANGLE, SPEED, TORQUE = 3e-3, (23, 47), np.radians(20.0), 10.0, 500.0
PITCH_RADII = tuple(MODULE * teeth / 2 for teeth in TEETH)
TIP_RADII = tuple(radius + MODULE for radius in PITCH_RADII)
PITCH_ANGLE = 2 * np.pi / TEETH[0]


def approach_and_recess() -> tuple[float, float]:
    """Roll angles of first and last contact from the pitch point, rad."""
    lengths = [
        np.sqrt(tip**2 - (pitch * np.cos(PRESSURE_ANGLE)) ** 2) - pitch * np.sin(PRESSURE_ANGLE)
        for tip, pitch in zip(TIP_RADII, PITCH_RADII, strict=True)
    ]
    base = PITCH_RADII[0] * np.cos(PRESSURE_ANGLE)
    return -lengths[1] / base, lengths[0] / base


def outline(teeth: int, upwards: float) -> np.ndarray:
    """Full gear with involute flanks above its base circle and radial ones below.

    A tooth axis lies a quarter pitch beside the line of centres, so that a flank passes through the pitch
    point: left of it above the pinion's axis, right of it below the gear's.
    """
    pitch, tip, root = MODULE * teeth / 2, MODULE * (teeth / 2 + 1), MODULE * (teeth / 2 - 1.25)
    base = pitch * np.cos(PRESSURE_ANGLE)
    involute = np.tan(PRESSURE_ANGLE) - PRESSURE_ANGLE
    radius = np.linspace(max(base, root), tip, 12)
    angle = np.arccos(np.minimum(1.0, base / radius))
    half = np.pi / (2 * teeth) + involute - (np.tan(angle) - angle)
    radius, half = np.concatenate([[root], radius]), np.concatenate([[half[0]], half])
    flank = np.concatenate([-half, half[::-1]])
    polar = np.concatenate([flank + 2 * np.pi * tooth / teeth for tooth in range(teeth)])
    radii = np.tile(np.concatenate([radius, radius[::-1]]), teeth)
    polar = polar + upwards * np.pi / 2 + np.pi / (2 * teeth)
    return np.stack([radii * np.cos(polar), radii * np.sin(polar)], axis=1)


def tabulated(phase: np.ndarray) -> dict[str, np.ndarray]:
    """Quantities of both slots at phases of the mesh, NaN-free."""
    start, end = approach_and_recess()
    roll = start + (phase[:, None] + np.array([1.0, 0.0])) * PITCH_ANGLE
    contact = roll <= end + 1e-12
    roll = np.minimum(roll, end)
    distance = PITCH_RADII[0] * np.cos(PRESSURE_ANGLE) * roll
    sine = np.sin(PRESSURE_ANGLE)
    pinion, gear = distance + PITCH_RADII[0] * sine, PITCH_RADII[1] * sine - distance
    ratio = TEETH[0] / TEETH[1]
    return {
        "contact": contact,
        "signed_distance": distance,
        "equivalent_radius": 1 / (1 / pinion + 1 / gear),
        "pinion_speed": pinion,
        "gear_speed": ratio * gear,
        "pressure_angle": np.full_like(roll, PRESSURE_ANGLE),
        "compliance": 1 / (3.2e8 * (1 - 3.0 * roll**2)),
    }


def mesh_cycle(nodes: int = 33) -> dict:
    """The table over (phase, pair)."""
    start, end = approach_and_recess()
    ratio = (end - start) / PITCH_ANGLE
    boundary = np.array([0.0, ratio - 1, 1.0])
    phase = np.concatenate([np.linspace(*ends, nodes) for ends in ((0.0, ratio - 1), (ratio - 1, 1.0))])
    table = tabulated(phase)
    contact = table.pop("contact").astype(float)
    contact[nodes:, 0] = 0.0
    return {
        "boundary": boundary,
        "phase": phase,
        "side": np.ones(2),
        "in_contact": contact,
        **table,
        "gap": np.zeros((2 * nodes, 2)),
        "coupling": np.zeros((2 * nodes, 2, 2)),
        "hertz_coefficient": 0.0,
        "pinion_pitch_radius": PITCH_RADII[0],
        "gear_pitch_radius": PITCH_RADII[1],
        "pinion_teeth": float(TEETH[0]),
        "face_width": 0.02,
        "contact_ratio": ratio,
        "pitch_point_phase": -start / PITCH_ANGLE,
        "roll_start": start,
        "roll_end": end,
        "pitch_point_length": 0.0,
        "pitch_point_rate": 0.0,
    }


def geometry() -> dict:
    """Outlines of both gears and the straight path of contact."""
    start, end = approach_and_recess()
    distance = PITCH_RADII[0] * np.cos(PRESSURE_ANGLE) * np.linspace(start, end, 20)
    return {
        "pinion_outline": outline(TEETH[0], 1),
        "gear_outline": outline(TEETH[1], -1),
        "path_of_contact": np.stack(
            [distance * np.cos(PRESSURE_ANGLE), distance * np.sin(PRESSURE_ANGLE)], axis=1
        ),
        "pinion_tip_radius": TIP_RADII[0],
        "gear_tip_radius": TIP_RADII[1],
    }


def samples(cycles: int, per_cycle: int, friction: float = 0.05) -> dict[str, np.ndarray]:
    """All datasets over `cycles` mesh cycles."""
    index = np.arange(cycles * per_cycle + 1)
    turned = index / per_cycle
    table = tabulated(turned - index // per_cycle)
    contact = table["contact"]
    time = turned * PITCH_ANGLE / SPEED
    stiffness = np.where(contact, 1 / table["compliance"], 0.0)
    total = TORQUE / (PITCH_RADII[1] * np.cos(PRESSURE_ANGLE))
    ripple = 1 + 0.02 * np.exp(-(turned % 1) * 8)[:, None] * np.cos(60 * turned)[:, None]
    load = total * stiffness / stiffness.sum(axis=1, keepdims=True) * ripple
    deflection = np.where(contact, load / np.where(contact, stiffness, 1.0), np.nan)
    sliding = SPEED * (table["pinion_speed"] - table["gear_speed"])
    entrainment = SPEED * (table["pinion_speed"] + table["gear_speed"]) / 2
    coefficient = friction * np.tanh(np.abs(sliding) / 0.01)
    force = coefficient * load * np.sign(sliding)
    film = 1.2e-7 * (entrainment / 0.12) ** 0.7 * (7000 / np.maximum(load, 500)) ** 0.135
    radius = table["equivalent_radius"]
    pressure = np.sqrt(np.maximum(load, 0) / 0.02 * 2.26e11 / (2 * np.pi * radius))
    power_out = TORQUE * SPEED * TEETH[0] / TEETH[1]
    loss = np.abs(force * sliding).sum(axis=1)
    values = {
        "time": time,
        "pinion_angle": SPEED * time,
        "transmission_error_normal": deflection,
        "transmission_error_rotational": np.nanmean(deflection, axis=1) / np.cos(PRESSURE_ANGLE),
        "normal_load": load,
        "friction_force": force,
        "friction_coefficient": coefficient,
        "asperity_load_ratio": np.full_like(load, 0.1),
        "film_parameter": film / 2e-7,
        "central_film_thickness": film,
        "equivalent_radius": radius,
        "hertz_pressure": pressure,
        "flash_temperature_rise": 400 * coefficient * np.abs(sliding),
        "entrainment_speed": entrainment,
        "sliding_speed": sliding,
        "pressure_angle": table["pressure_angle"],
        "mesh_stiffness": stiffness,
        "power_in": power_out + loss,
        "power_out": np.full_like(time, power_out),
        "power_friction": loss,
        "efficiency": 1 - loss / (power_out + loss),
    }
    over_pairs = [name for name, variable in SAMPLES.items() if variable.dims == ("time", "pair")]
    for name in over_pairs:
        if SAMPLES[name].flags:
            values[name] = np.where(contact, 1, -1)
        else:
            values[name] = np.where(contact, values[name], np.nan)
    for name, variable in SAMPLES.items():
        shape = (time.size, len(DOF)) if "dof" in variable.dims else (time.size,)
        values.setdefault(name, np.zeros(shape))
    return values


SUMMARY = {
    "contact_ratio": 1.6677,
    "mesh_frequency": 36.606,
    "stiffness_single_pair_at_pitch_point": 3.2e8,
    "transmission_error_mean": 2.2e-5,
    "transmission_error_peak_to_peak": 1.2e-5,
    "transmission_error_normal_mean": 2.1e-5,
    "transmission_error_normal_peak_to_peak": 1.1e-5,
    "normal_load_max": 7850.0,
    "dynamic_factor": 1.02,
    "film_min": 0.9e-7,
    "film_parameter_min": 0.45,
    "hertz_pressure_max": 1.4e9,
    "flash_temperature_max": 12.0,
    "friction_coefficient_mean": 0.045,
    "friction_force_mean": np.array([150.0, 310.0]),
    "efficiency": 0.9868,
    "energy_residual": 3.0e-8,
    "solver": "dopri5",
    "solver_reason": "not stiff: step limited by accuracy",
    "steps": 4200,
    "rhs_evaluations": 26000,
    "wall_time": 0.012,
    "closure_in_range_fraction": 0.93,
    "spectrum_frequencies": np.array([36.606, 73.21]),
    "spectrum_amplitudes": np.array([4e-6, 2e-6]),
}


def write(path: Path, cycles: int = 4, per_cycle: int = 200, friction: float = 0.05) -> Path:
    """Write the record and return its path."""
    values = samples(cycles, per_cycle, friction)
    with gear_pair_writer(
        path,
        values["time"].size,
        table=mesh_cycle(),
        outlines=geometry(),
        scenario_toml='title = "Involute drive, 23/47 teeth, module 3 mm"\n',
        sha256="0" * 64,
    ) as record:
        record.write(0, values)
        return record.finish(SUMMARY)
