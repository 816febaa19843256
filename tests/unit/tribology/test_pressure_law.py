"""Laws of viscosity over pressure: closed forms, differences, a second method, what they must not do."""

import math
from typing import NamedTuple

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import fsolve

from tribodyn.tribology.high_pressure import MEASURED
from tribodyn.tribology.pressure_law import (
    DoolittleTait,
    LawPart,
    PressureLaw,
    asymptotic_coefficient,
    with_coefficient,
)

NAMES = list(MEASURED)


def law_of(name, temperature=353.15, factor=1.0):
    return PressureLaw((LawPart(MEASURED[name], factor),), temperature)


class Barus(NamedTuple):
    """ln η = α p, which no oil follows."""

    alpha: float

    def exponent(self, pressure, temperature):
        zero = np.zeros_like(pressure + temperature)
        return self.alpha * pressure + zero, self.alpha + zero, zero


@pytest.mark.parametrize("alpha", [5e-9, 2e-8, 5e-8])
def test_the_asymptotic_coefficient_of_an_exponential_is_its_own(alpha):
    law = PressureLaw((LawPart(Barus(alpha)),), 300.0)
    assert asymptotic_coefficient(law) == pytest.approx(alpha, rel=1e-4 if alpha < 1e-8 else 1e-9)
    assert with_coefficient(Barus(alpha), 300.0, 1.7e-8).pressure_factor == pytest.approx(
        1.7e-8 / alpha, rel=1e-4
    )


@pytest.mark.parametrize("name", NAMES)
def test_the_asymptotic_coefficient_is_the_inverse_of_the_isoviscous_pressure(name):
    """Held to an adaptive quadrature; a law over scaled pressures has it scaled."""
    law = law_of(name)
    thinned = lambda p: math.exp(-float(law.rise(np.array([p]), 353.15)[0][0]))  # noqa: E731
    whole = quad(thinned, 0.0, 3e9, points=[1e7, 1e8, 5e8], limit=200)[0]
    found = asymptotic_coefficient(law)
    assert found == pytest.approx(1.0 / whole, rel=1e-6)
    part = with_coefficient(MEASURED[name], 353.15, 1.3e-8)
    assert asymptotic_coefficient(PressureLaw((part,), 353.15)) == pytest.approx(1.3e-8, rel=1e-4)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("temperature", [253.15, 293.15, 353.15, 413.15])
def test_derivatives_are_those_of_differences(name, temperature):
    """Below and beyond the glass transition."""
    law, pressure = law_of(name, temperature), np.array([1e6, 3e8, 7e8, 1.1e9, 1.9e9])
    _, by_pressure, by_heat = law.rise(pressure, temperature)
    step = 1e3
    ahead, behind = (law.rise(pressure + way * step, temperature)[0] for way in (1.0, -1.0))
    np.testing.assert_allclose(by_pressure, (ahead - behind) / (2 * step), rtol=1e-4)
    warm, cold = (law.rise(pressure, temperature + way * 1e-3)[0] for way in (1.0, -1.0))
    np.testing.assert_allclose(by_heat, (warm - cold) / 2e-3, rtol=1e-4, atol=1e-6)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("temperature", [263.15, 313.15, 373.15, 453.15])
def test_viscosity_rises_with_pressure_and_falls_with_temperature(name, temperature):
    pressure = np.linspace(0.0, 3e9, 1501)
    rise, slope, by_heat = law_of(name, temperature).rise(pressure, temperature)
    assert rise[0] == 0.0
    assert np.all(np.diff(rise) > 0.0)
    assert np.all(slope > 0.0)
    if 293.15 <= temperature <= 373.15:  # where they were measured
        assert np.all(by_heat[1:] < 0.0)


def test_squalane_by_density_scaling():
    """η a function of T V^γ, γ = 4.2 (Harris 2009): fixed by three viscosities at ambient pressure alone."""
    tait = MEASURED["squalane"]
    assert isinstance(tait, DoolittleTait)

    def volume(pressure, temperature):
        modulus = tait.bulk_modulus * math.exp(-tait.bulk_modulus_decay * temperature)
        stiffer = 1.0 + tait.bulk_modulus_slope
        grown = 1.0 + tait.expansion * (temperature - tait.reference_temperature)
        return grown * (1.0 - math.log1p(stiffer * pressure / modulus) / stiffer)

    scaled = lambda p, t: t / tait.reference_temperature * volume(p, t) ** 4.2  # noqa: E731
    known = {293.15: 35.8e-3, 313.15: 15.5e-3, 373.15: 3.16e-3}
    equations = lambda x: [  # noqa: E731
        x[0] + x[1] * x[2] / (scaled(0.0, t) - x[2]) - math.log(eta) for t, eta in known.items()
    ]
    _, strength, least = fsolve(equations, [-8.4, 15.0, 0.22])
    for temperature in (313.15, 353.15, 373.15):
        for pressure in (2e8, 6e8, 1e9):
            ambient, dense = scaled(0.0, temperature) - least, scaled(pressure, temperature) - least
            expected = strength * least * (1.0 / dense - 1.0 / ambient)
            found = float(law_of("squalane", temperature).rise(np.array([pressure]), temperature)[0][0])
            assert found == pytest.approx(expected, rel=0.16)


def test_shell_t9_by_its_other_published_correlation():
    """Vogel's form over T/T_R (V/V_R)^g (Björling et al. 2013), from memory as the other: within 10 %."""
    for temperature, pressure in ((313.15, 2e8), (313.15, 4e8), (313.15, 6e8), (353.15, 6e8)):

        def scaled(p, t=temperature):
            modulus = 9.234e9 * math.exp(-6.09e-3 * t)
            dense = 1.0 - math.log1p(11.545 * p / modulus) / 11.545
            return t / 298.0 * ((1.0 + 7.734e-4 * (t - 298.0)) * dense) ** 5.0348

        by = lambda p: 12.898 * 0.26844 / (scaled(p) - 0.26844)  # noqa: E731
        found = float(law_of("shell-t9", temperature).rise(np.array([pressure]), temperature)[0][0])
        assert found == pytest.approx(by(pressure) - by(0.0), rel=0.1)


def test_a_softened_law_rises_as_at_a_lower_pressure():
    law = law_of("hvi-650")
    half, whole = law.softened(0.5), np.array([8e8])
    assert half.rise(whole, 353.15)[0] == pytest.approx(law.rise(0.5 * whole, 353.15)[0])
    assert half.rise(whole, 353.15)[1] == pytest.approx(0.5 * law.rise(0.5 * whole, 353.15)[1])
