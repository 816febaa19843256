"""The mixed law of Masjedi & Khonsari by its printed formulas, its variants, limits, symmetry."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.support.closures import LIU_NI, MIXED, known, under
from tribodyn.tribology.contact import (
    inlet_heating,
    local_contact,
)
from tribodyn.tribology.film.masjedi_khonsari import asperity_load_ratio
from tribodyn.tribology.friction.masjedi_khonsari import (
    log_roelands_viscosity,
    saturated,
)

LAWS = under(MIXED)


def by_hand(w, rho, u, v, u1, u2, c, factor=4470, limited=True, heat=None, slid=False, peak=1.0):
    """Liu & Ni (18)-(24) written out with powers, 4470 and ρ_s c_p restored.

    Variants: another `factor`; limiting stress of the whole pressure; other `heat` capacities in the Péclet
    numbers, or the sliding speed; `peak` times the pressure in Roelands' law.
    """
    c, oil = c.surfaces, c.lubricant
    heat = heat or (c.pinion_heat_capacity, c.gear_heat_capacity)
    u1, u2 = (v, v) if slid else (u1, u2)
    E = c.effective_modulus
    W, U, G = w / (E * rho), c.inlet_viscosity * u / (E * rho), c.pressure_viscosity * E
    s, V = c.roughness / rho, c.hardness / E
    La = 0.005 * W**-0.408 * U**-0.088 * G**0.103
    La *= math.log(1 + factor * s**6.015 * V**1.168 * W**0.485 * U**-3.741 * G**-2.898)
    lam = min(La / 100, 1.0)
    h = 2.691 * W**-0.135 * U**0.705 * G**0.556 * rho
    h *= 1 + 0.2 * s**1.222 * V**0.223 * W**-0.229 * U**-0.748 * G**-0.842
    a = math.sqrt(8 * w * rho / (math.pi * E))
    p = w / (2 * a)
    ph = p * (1 - lam)
    tau = oil.limiting_shear_coefficient * (ph if limited else p)
    q = abs(v) * p * (oil.asperity_friction * lam + oil.limiting_shear_coefficient * (1 - lam))
    pe = [
        a * abs(uj) * hc / (2 * k)
        for uj, hc, k in ((u1, heat[0], c.pinion_conductivity), (u2, heat[1], c.gear_conductivity))
    ]
    dT = (
        2
        * a
        * q
        / (
            math.sqrt(math.pi)
            * (c.pinion_conductivity * math.sqrt(1 + pe[0]) + c.gear_conductivity * math.sqrt(1 + pe[1]))
        )
    )
    eta = c.inlet_viscosity * math.exp(
        (math.log(c.inlet_viscosity) + 9.67) * (-1 + (1 + 5.1e-9 * peak * ph) ** oil.viscosity_pressure_index)
        - oil.temperature_viscosity * dT
    )
    mu = lam * oil.asperity_friction + 2 * a * tau / w * (1 - math.exp(-eta * abs(v) / (tau * h)))
    return mu, lam, h, dT, math.sqrt(w * E / (2 * math.pi * rho))


STEEL = LIU_NI.materials[0]
UNLIKE = LIU_NI._replace(
    surfaces=LIU_NI.surfaces._replace(gear_conductivity=37.0, gear_heat_capacity=2.9e6, roughness=6e-7),
    materials=(STEEL, replace(STEEL, specific_heat=530.0)),
)


@pytest.mark.parametrize(
    ("law", "variant"),
    [
        ("masjedi-khonsari", {}),
        ("masjedi-khonsari-mean-pressure", {"limited": False}),
        ("masjedi-khonsari-as-printed", {"factor": 447, "heat": (1.0, 1.0)}),
        ("masjedi-khonsari-veciana", {"heat": (880.0 * 460.0, 880.0 * 530.0), "slid": True}),
        ("masjedi-khonsari-veciana-peak", {"heat": (880.0 * 460.0, 880.0 * 530.0), "peak": 4 / math.pi}),
    ],
)
def test_variants_are_what_they_say(law, variant):
    """Pinion and gear of unlike steels, which change places where the sliding turns."""
    for load, rho, u, v in (
        (3.7e4, 7.1e-3, 0.31, -0.05),
        (2.9e5, 9.7e-3, 0.083, 0.021),
        (3e5, 6e-3, 2.6, 1.9),
        (2e4, 8.98e-3, 5.0, 4.5),
        (1.5e6, 8.98e-3, 0.1, 1e-7),
    ):
        found = known(under(law, UNLIKE), load, 1 / rho, u, v, u + v / 2, u - v / 2)
        theirs = by_hand(load, rho, u, v, u + v / 2, u - v / 2, UNLIKE, **variant)
        np.testing.assert_allclose(found[0], abs(theirs[0]), rtol=1e-9)
        np.testing.assert_allclose(found[1:5], theirs[1:5], rtol=1e-9)


def test_the_asperity_load_is_held_at_all_of_it():
    """Over 0.99 … 1.01 a parabola leads from the ratio to one; very rough surfaces overflow nothing."""
    W, U, G, S, V = 2e-4, 3e-11, 4700.0, 4e-5, 0.011
    logs = [math.log(group) for group in (W, U, G, S, V)]
    plain = 5e-5 * W**-0.408 * U**-0.088 * G**0.103
    inner = math.log(S**6.015 * V**1.168 * W**0.485 * U**-3.741 * G**-2.898)
    for ratio in (0.5, 0.985, 0.993, 1.0, 1.006, 1.02, 3.0):
        factor = math.log(math.expm1(ratio / plain)) if ratio / plain < 600 else ratio / plain
        held = ratio if ratio < 0.99 else 1.0 if ratio > 1.01 else ratio - (ratio - 0.99) ** 2 / 0.04
        assert asperity_load_ratio(*logs, factor - inner) == pytest.approx(held, rel=1e-10)


def test_what_an_exponential_film_saturates_to():
    for x in (1e-9, 0.3, 5.0, 37.0, 39.0, 500.0):
        assert saturated(x) == pytest.approx(-math.expm1(-x), rel=1e-15)


def test_dry_limit_is_asperity_friction():
    coefficient, share, *_ = known(LAWS, 3.85e5, 111.0, 1e-6, 1e-7, 1e-6, 1e-6)
    assert share == pytest.approx(1.0)
    assert coefficient == pytest.approx(LIU_NI.lubricant.asperity_friction, rel=1e-3)


def test_friction_is_between_nothing_and_its_limits(rng):
    for _ in range(300):
        u = 10 ** rng.uniform(-3, 1.5)
        v = u * rng.uniform(0, 1)
        mu, share, *_ = known(
            LAWS,
            10 ** rng.uniform(3, 6.3),
            rng.uniform(50, 400),
            u,
            v,
            u + v / 2,
            u - v / 2,
        )
        limit = share * LIU_NI.lubricant.asperity_friction + LIU_NI.lubricant.limiting_shear_coefficient * (
            1 - share
        )
        assert 0.0 <= mu <= limit * (1 + 1e-12)


def test_laws_are_evaluated_above_the_minimum_of_load_and_speed():
    """1 N/m and 1 µm/s."""
    held = local_contact(0.3, 100.0, 2e-7, 0.1, 0.05, -0.05)
    assert (held.line_load, held.entrainment, held.sliding) == (1.0, 1e-6, 0.1)
    moving = local_contact(2.0, 100.0, -3e-6, 0.1, 0.05, -0.05)
    assert (moving.line_load, moving.entrainment) == (2.0, 3e-6)
    assert inlet_heating(moving, LIU_NI.surfaces) == pytest.approx(0.35 * 9e-12)


def test_roelands_by_hand_and_its_clip():
    """η0 exp{(ln η0 + 9.67) [(1 + 5.1e-9 p)^z − 1] − K ΔT}; an exponent beyond ±600 is held."""
    found = log_roelands_viscosity(7e8, 31.0, math.log(0.35), 0.57, 0.045)
    rise = (math.log(0.35) + 9.67) * ((1 + 5.1e-9 * 7e8) ** 0.57 - 1)
    assert found == pytest.approx(math.log(0.35) + rise - 0.045 * 31.0, rel=1e-12)
    assert log_roelands_viscosity(1e14, 0.0, math.log(0.35), 0.57, 0.045) == math.log(0.35) + 600.0
    assert log_roelands_viscosity(0.0, 1e9, math.log(0.35), 0.57, 0.045) == math.log(0.35) - 600.0
