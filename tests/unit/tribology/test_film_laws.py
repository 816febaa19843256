"""Film laws of line contacts: printed powers, asymptotes from Reynolds' equation, other formulas."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from tests.support.closures import LIU_NI, POINT, known, under
from tests.support.line_contacts import by_moes
from tribodyn.tribology.ehl.fluid import Fluid
from tribodyn.tribology.ehl.problem import LineContact
from tribodyn.tribology.ehl.rough import Roughness
from tribodyn.tribology.ehl.steady import solve_steady
from tribodyn.tribology.film import FILM_LAWS, dowson_higginson, masjedi_khonsari
from tribodyn.tribology.film.moes import log_of_sum, log_survey
from tribodyn.tribology.film.numbers import roughening

SURFACES = LIU_NI.surfaces
SMOOTH = LIU_NI._replace(surfaces=SURFACES._replace(roughness=1e-16))


def film(law, line_load=4e5, curvature=100.0, speed=0.5, given=SMOOTH):
    """Film thickness, m."""
    return known(under("none", given, film=law), line_load, curvature, speed, 0.0, speed, speed)[2]


def groups(line_load, curvature, speed):
    modulus = SURFACES.effective_modulus
    return (
        line_load * curvature / modulus,
        SURFACES.inlet_viscosity * speed * curvature / modulus,
        SURFACES.pressure_viscosity * modulus,
    )


@pytest.mark.parametrize("law", [masjedi_khonsari.LAW, masjedi_khonsari.AS_PRINTED, dowson_higginson.LAW])
def test_films_in_plain_powers(law):
    """Both laws' groups and powers at contacts that no two of them share."""
    for load, curvature, speed in ((1.3e5, 71.0, 0.9), (7e5, 190.0, 0.13)):
        W, U, G = groups(load, curvature, speed)
        S, V = SURFACES.roughness * curvature, SURFACES.hardness / SURFACES.effective_modulus
        if law is dowson_higginson.LAW:
            expected = 2.65 * U**0.7 * G**0.54 * W**-0.13 / curvature
            expected *= (1 + 1.25 * (SURFACES.roughness / expected) ** 2) ** 0.2
        else:
            expected = 2.691 * W**-0.135 * U**0.705 * G**0.556 / curvature
            expected *= 1 + 0.2 * S**1.222 * V**0.223 * W**-0.229 * U**-0.748 * G**-0.842
        assert film(law.name, load, curvature, speed, LIU_NI) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("share", [0.15, 0.5, 1.0, 3.0])
def test_roughness_raises_a_film_as_it_does_the_solved_one(share):
    """Mean gap on the line of centres over the film of smooth flanks, isothermal, at σ = h/share."""
    smooth = LineContact(4e5, 0.01, 0.5, Fluid(0.05, 2e-8, 0.6), 2.26e11)
    central = solve_steady(smooth).central_film_thickness
    rough = solve_steady(smooth._replace(roughness=Roughness(central / share)))
    gap = np.interp(0.0, rough.place, rough.mean_gap)
    raised = float(roughening(math.log(central), math.log(central / share)))
    assert raised * central / gap == pytest.approx(1.0, abs=0.06)


@pytest.mark.parametrize("load", [0.04, 1.7, 30.0, 900.0])
@pytest.mark.parametrize("material", [0.3, 4.0, 17.0])
def test_moes_in_plain_powers(load, material):
    """Both pairs of asymptotes joined by powers 7/3 and −7/2, and these by s."""
    rigid, elastic = (3.0 / load, 1.287 * material ** (2 / 3)), (2.621 * load**-0.2, 1.311 * load**-0.125)
    s = (7 + 8 * math.exp(-2 * elastic[0] / rigid[0])) / 5
    thin = (rigid[0] ** (7 / 3) + elastic[0] ** (7 / 3)) ** (3 / 7)
    thick = (rigid[1] ** -3.5 + (elastic[1] * material**0.75) ** -3.5) ** (-2 / 7)
    found = math.exp(log_survey(math.log(load), math.log(material)))
    assert found == pytest.approx((thin**s + thick**s) ** (1 / s), rel=1e-12)
    assert log_of_sum(1.3, -0.4) == pytest.approx(math.log(math.exp(1.3) + math.exp(-0.4)), rel=1e-14)
    assert log_of_sum(-900.0, 900.0) == 900.0


def rigid_cylinder():
    """Reynolds' equation under a rigid cylinder, p = p' = 0 at the outlet, x = √(2 ρ h_0) ξ.

    Returns the outlet's ξ_m, where all fluid goes through h_0 (1 + ξ_m²), the maximum of the reduced pressure
    and the load, of dP/dξ = (ξ² − ξ_m²)/(1 + ξ²)³.
    """

    def pressure(to, outlet):
        return quad(lambda xi: (xi * xi - outlet * outlet) / (1 + xi * xi) ** 3, -np.inf, to)[0]

    outlet = brentq(lambda end: pressure(end, end), 0.1, 1.0)
    # the load ∫ P dξ by parts
    load = -quad(lambda xi: xi * (xi * xi - outlet * outlet) / (1 + xi * xi) ** 3, -np.inf, outlet)[0]
    return outlet, pressure(-outlet, outlet), load


def test_moes_tends_to_the_rigid_asymptotes():
    """Martin's and Blok's films at the pressure's maximum, from Reynolds' equation."""
    outlet, highest, load = rigid_cylinder()
    assert 12 * load == pytest.approx(2.4485, rel=1e-3)  # Martin (1916): w h_0/(η u_Σ ρ)
    film_over_h0 = 1 + outlet * outlet
    light = -12.0
    isoviscous = math.exp(log_survey(light, -12.0) + light)
    assert isoviscous == pytest.approx(12 * load * film_over_h0, rel=2e-3)
    # q_max = 1/α: (h_0/ρ)^3/2 = 6 √2 P_max U_Σ G
    blok = (6 * math.sqrt(2) * highest) ** (2 / 3) * film_over_h0
    thick = 40.0
    piezoviscous = math.exp(log_survey(1.0, thick) - 2 / 3 * thick)
    assert piezoviscous == pytest.approx(blok, rel=1e-3)
    assert blok == pytest.approx(1.287, rel=1e-3)


def test_moes_tends_to_the_elastic_asymptotes():
    heavy = 14.0
    assert math.exp(log_survey(heavy, -20.0) + heavy / 5) == pytest.approx(2.621, rel=1e-3)
    elastic = log_survey(heavy, 4.0) + heavy / 8 - 3.0
    assert math.exp(elastic) == pytest.approx(1.311, rel=1e-2)


def test_moes_is_smooth_and_orders_its_regimes():
    """The film falls with the load at any L, and grows with L at any load."""
    M, L = np.meshgrid(np.linspace(-5, 12, 200), np.linspace(-5, 4, 100), indexing="ij")
    film = log_survey(M, L)
    assert np.all(np.diff(film, axis=0) < 0)
    assert np.all(np.diff(film, axis=1) >= -1e-15)
    assert np.max(np.abs(np.diff(film, 2, axis=0))) < 0.02


@pytest.mark.parametrize("line_load", [1e5, 4e5])
@pytest.mark.parametrize("speed", [0.2, 0.6])
def test_the_formulas_meet_where_all_hold(line_load, speed):
    """Heavily loaded steel in oil: Moes against Grubin (1949) and Dowson & Toyoda (1979), central films.

    The minimum is about three quarters of it; formulas of central films scatter by a fifth.
    """
    central = film("moes", line_load, 100.0, speed)
    W, U, G = groups(line_load, 100.0, speed)
    grubin = 1.95 * (G * U) ** (8 / 11) * W ** (-1 / 11) / 100.0
    toyoda = 3.06 * U**0.69 * G**0.56 * W**-0.10 / 100.0
    assert central == pytest.approx(grubin, rel=0.1)
    assert central == pytest.approx(toyoda, rel=0.1)
    assert 0.65 < film("dowson-higginson", line_load, 100.0, speed) / central < 0.85


# "solved" is made of a mesh: tests/unit/tribology/ehl/test_table.py
@pytest.mark.parametrize("law", [law for law in FILM_LAWS if law != "solved"])
def test_nothing_overflows_at_the_ends(law):
    with np.errstate(all="raise", under="ignore"):
        for load in (0.0, 1e-3, 1e9):
            for curvature in (1e-3, 1e9):
                for speed in (0.0, 1e3):
                    assert np.isfinite(film(law, load, curvature, speed))


def test_smooth_laws_leave_no_load_to_asperities():
    for law in ("moes", "dowson-higginson"):
        state = known(under("masjedi-khonsari", film=law), **POINT)
        assert state.asperity_load_ratio == 0.0
        limit = LIU_NI.lubricant.limiting_shear_coefficient
        assert state.friction_coefficient == pytest.approx(limit, rel=1e-6)  # no f_c in it, slid far enough


def test_ranges_are_flagged_or_said_to_be_missing():
    inside = known(under("none", film="dowson-higginson"), 2e5, 100.0, 0.05, 0.0, 0.05, 0.05)
    W, U, _ = groups(2e5, 100.0, 0.05)
    assert (3e-5 < W < 3e-4, 1e-13 < U < 1e-11) == (True, True)
    assert SURFACES.pressure_viscosity * SURFACES.effective_modulus > 5000  # just beyond the fitted G
    assert inside.closure_in_range == 0.0
    thinner = LIU_NI._replace(surfaces=SURFACES._replace(pressure_viscosity=2e-8))
    laws = under("none", thinner, film="dowson-higginson")
    assert known(laws, 2e5, 100.0, 0.05, 0.0, 0.05, 0.05).closure_in_range == 1.0
    assert known(laws, 2e3, 100.0, 0.05, 0.0, 0.05, 0.05).closure_in_range == 0.0


@pytest.mark.parametrize("pressure", [0.3e9, 0.5e9, 0.75e9])
@pytest.mark.parametrize("load", [2.0, 12.0, 90.0, 300.0])
@pytest.mark.parametrize("material", [1.0, 5.0, 15.0])
def test_moes_within_its_range(pressure, load, material):
    """The solved contact of an oil by Roelands and Dowson & Higginson: within 25 % in the stated range."""
    contact = by_moes(load, material, pressure, 0.6, compressible=True)
    given = contact.line_load, 1.0 / contact.radius, contact.entrainment_speed
    oil = LIU_NI._replace(
        surfaces=SURFACES._replace(
            effective_modulus=contact.effective_modulus,
            inlet_viscosity=contact.fluid.viscosity,
            pressure_viscosity=contact.fluid.pressure_viscosity,
            roughness=1e-16,
        )
    )
    state = known(under("none", oil, film="moes"), *given, 0.0, given[2], given[2])
    solved = solve_steady(contact).central_film_thickness
    assert 0.95 < state.central_film_thickness / solved < 1.25
    edges = np.isin([pressure, load, material], [0.75e9, 2.0, 1.0, 15.0])
    assert state.closure_in_range == 1.0 or np.any(edges)


def test_moes_beyond_its_range():
    laws = under("none", film="moes")
    assert known(laws, 1.5e5, 100.0, 0.15, 0.0, 0.15, 0.15).closure_in_range == 1.0
    assert known(laws, 8e5, 100.0, 0.15, 0.0, 0.15, 0.15).closure_in_range == 0.0
