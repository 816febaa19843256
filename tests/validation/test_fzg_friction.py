"""FZG type C gears, 200 N m on the pinion at 1500 rpm, mineral oil of 13.28 mPa s: mean friction as measured.

Regressions made on measurements: Schlenk 0.0449, Fernandes 0.0494. The limiting shear stress, 0.053 of the
pressure, is that of twin discs (Arana, Larrañaga & Ulacia 2019); 16 1/GPa for the oil is an assumption.
"""

import math

import numpy as np
import pytest

import tribodyn as td


def mean_friction(places: int) -> float:
    """Loss of the solved contacts along the path over that of μ = 1, two pairs sharing the load by half."""
    teeth, module, distance = (16, 24), 4.5e-3, 91.5e-3
    base = [count * module * math.cos(math.radians(20.0)) / 2 for count in teeth]
    angle = math.acos(sum(base) / distance)
    whole, pitch = distance * math.sin(angle), 2 * math.pi * base[0] / teeth[0]
    start = whole - math.sqrt(59.272e-3**2 - base[1] ** 2)
    end = math.sqrt(41.318e-3**2 - base[0] ** 2)
    speed, load = 1500 * 2 * math.pi / 60, 200.0 / base[0] / 14e-3
    lost = sliding = 0.0
    for place in np.linspace(start + 0.2e-3, end - 0.2e-3, places):
        share = 1.0 if end - pitch < place < start + pitch else 0.5
        pinion_speed, gear_speed = speed * place, speed * teeth[0] / teeth[1] * (whole - place)
        contact = td.line_contact(
            line_load=share * load,
            radius=place * (whole - place) / whole,
            entrainment_speed=(pinion_speed + gear_speed) / 2,
            sliding_speed=pinion_speed - gear_speed,
            viscosity=13.28e-3,
            pressure_viscosity=1.6e-8,
            effective_modulus=226.37e9,
            rheology="limiting",
            limiting_coefficient=0.053,
            temperature_viscosity=0.035,
        )
        lost += share * abs(contact.friction_coefficient * (pinion_speed - gear_speed))
        sliding += share * abs(pinion_speed - gear_speed)
    return lost / sliding


def test_mean_friction():
    found = mean_friction(8)
    assert found == pytest.approx(0.0449, rel=0.25)
    assert found == pytest.approx(0.0494, rel=0.25)
