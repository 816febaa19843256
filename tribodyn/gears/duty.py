"""The duty of a pair at nominal speed and constant torque, in the engineer's quantities."""

import math
from math import isfinite
from typing import NamedTuple

from tribodyn.gears.case import GearCase
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.path import kinematics
from tribodyn.tribology.closure import MINIMUM_ANGLE
from tribodyn.tribology.contact import hertz_pressure

HERTZ = "Hertz pressure of a pair with the whole load"


class DutyFigures(NamedTuple):
    """Duty of a pair at nominal speed and constant torque, magnitudes; NaN where there is no speed."""

    pinion_torque: float  # N m
    gear_torque: float  # N m
    power: float  # kW
    pinion_speed: float  # rpm
    pitch_line_speed: float  # m/s
    line_load: float  # F_t/b, tangential load on the pitch circle over the common face width, N/mm
    hertz_pressure: float  # of a pair that carries the whole torque, MPa
    place: str  # where that is
    contact_ratio: float


def nominal_duty(case: GearCase, assembly: Assembly) -> DutyFigures:
    """Return the duty of a case."""
    path, width = assembly.path, float(assembly.common_width)
    torque, speed = abs(float(case.operating.gear_torque)), abs(float(case.operating.pinion_speed))
    pinion, gear = float(path.pinion_pitch_radius), float(path.gear_pitch_radius)
    place, roll = "pitch point", 0.0
    if abs(float(path.pressure_angle(0.0))) < MINIMUM_ANGLE:  # radius and load have no limit there
        place, roll = "end of contact", float(assembly.limits[1])
    motion = kinematics(path, roll)
    moduli = [(1.0 - m.poisson_ratio**2) / m.youngs_modulus for m in case.materials]
    load = torque / abs(float(motion.gear_normal_arm)) / width
    pressure = hertz_pressure(load, abs(float(motion.relative_curvature)), 2.0 / sum(moduli))
    pinion_torque = torque * abs(pinion / gear)
    return DutyFigures(
        pinion_torque,
        torque,
        pinion_torque * speed * 1e-3,
        speed * 30.0 / math.pi,
        speed * abs(pinion),
        torque / abs(gear) / width * 1e-3,
        float(pressure) * 1e-6,
        place,
        float(assembly.contact_ratio),
    )


def duty_lines(duty: DutyFigures) -> dict[str, tuple[float, str]]:
    """Quantities of a duty by name: value and unit, those of a drawing. What is not given is left out."""
    lines = {
        "torque of the pinion": (duty.pinion_torque, "N m"),
        "torque of the gear": (duty.gear_torque, "N m"),
        "power": (duty.power, "kW"),
        "speed of the pinion": (duty.pinion_speed, "rpm"),
        "pitch-line speed": (duty.pitch_line_speed, "m/s"),
        "tangential load F_t/b": (duty.line_load, "N/mm"),
        f"{HERTZ}, {duty.place}": (duty.hertz_pressure, "MPa"),
        "contact ratio": (duty.contact_ratio, ""),
    }
    return {name: line for name, line in lines.items() if isfinite(line[0])}
