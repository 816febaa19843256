"""The solved contact of an oil whose viscosity was measured under pressure: Jacobian, limits, heat, keys."""

import math

import numpy as np
import pytest

import tribodyn as td
from tests.support.closures import LIU_NI
from tribodyn.tribology.contact import BY_FINISH, FINISHES, Asperities, asperities_of, local_contact
from tribodyn.tribology.ehl import reynolds
from tribodyn.tribology.ehl.coupled import solve_coupled
from tribodyn.tribology.ehl.fluid import Fluid, Rheology, hot_log_viscosity, log_viscosity
from tribodyn.tribology.ehl.grid import made
from tribodyn.tribology.ehl.heat import HeatProperties
from tribodyn.tribology.ehl.lookup import TERMS
from tribodyn.tribology.ehl.of_case import contact_of, friction_band
from tribodyn.tribology.ehl.problem import LineContact
from tribodyn.tribology.ehl.table import ContactTable
from tribodyn.tribology.friction.solved import LAW
from tribodyn.tribology.high_pressure import MEASURED
from tribodyn.tribology.oil import OilSheet, lubricant_from
from tribodyn.tribology.pressure_law import LawPart, PressureLaw, asymptotic_coefficient

T_80 = 353.15


def fluid_of(name, viscosity=0.02):
    law = PressureLaw((LawPart(MEASURED[name]),), T_80)
    return Fluid(viscosity, asymptotic_coefficient(law), law=law)


@pytest.mark.parametrize("name", MEASURED)
def test_the_jacobian_is_that_of_differences(rng, name):
    nodes = np.array([-4.0, -2.9, -2.1, -1.6, -1.0, -0.7, -0.4, -0.15, 0.0])
    grid = made(nodes)
    closure = reynolds.FlowCorrection(
        *(rng.uniform(*ends, len(nodes)) for ends in ((-0.5, 0.0), (0.5, 1.0), (-0.1, 0.1)))
    )
    reduced = reynolds.SmoothReduced(0.3, 2e8, fluid_of(name))
    unknowns = np.concatenate([rng.uniform(0.3, 1.2, len(nodes) - 2), [0.4, 0.9, 0.2]])

    def values(given):
        state = reynolds.FilmState(np.concatenate([[0.0], given[:-3], [0.0]]), *given[-3:])
        return reynolds.residual(state, reduced, grid, closure)

    matrix = values(unknowns)[1]
    for column in range(len(unknowns)):
        change = 1e-6 * np.eye(len(unknowns))[column]
        slope = (values(unknowns + change)[0] - values(unknowns - change)[0]) / 2e-6
        np.testing.assert_allclose(matrix[:, column], slope, rtol=1e-5, atol=1e-6 * np.abs(slope).max())


@pytest.mark.parametrize("name", MEASURED)
def test_heat_thins_the_oil_under_pressure_as_the_law_says(name):
    fluid, pressure, rise = fluid_of(name), np.array([0.0, 3e8, 8e8]), np.array([0.0, 15.0, 40.0])
    cold, _ = log_viscosity(pressure, fluid)
    hot, slope = hot_log_viscosity(pressure[:, None], rise, fluid, 0.03)
    np.testing.assert_allclose(hot[:, 0], cold, atol=1e-12)
    assert np.all(np.diff(hot, axis=1) < 0.0)
    # −K_T at ambient pressure, and more under pressure
    assert slope[0, 0] == pytest.approx(-0.03)
    assert np.all(np.diff(slope[:, 0]) < 0.0)
    ahead, behind = (hot_log_viscosity(pressure[:, None], rise + by, fluid, 0.03)[0] for by in (1e-3, -1e-3))
    np.testing.assert_allclose(slope, (ahead - behind) / 2e-3, rtol=1e-5)


@pytest.mark.parametrize("name", MEASURED)
@pytest.mark.parametrize("load", [5e4, 4e5, 1.5e6])
def test_contacts_are_solved(name, load):
    """From 0.4 to 2.3 GPa; films are those of Barus' law with the same α in a few per cent."""
    fluid = fluid_of(name)
    contact = LineContact(load, 10e-3, 2.0, fluid, 226.37e9, 0.4)
    found = solve_coupled(contact, Rheology("limiting"), HeatProperties(0.03))
    assert found.solution.imbalance < 1e-10
    limit = 0.05 + 2e6 * 2.0 * contact.half_width / load
    assert 0.0 < found.friction / load < 1.05 * limit
    cold = solve_coupled(contact._replace(sliding_speed=0.0), Rheology())
    barus = contact._replace(fluid=Fluid(fluid.viscosity, fluid.pressure_viscosity), sliding_speed=0.0)
    film = solve_coupled(barus, Rheology()).solution.central_film_thickness
    assert cold.solution.central_film_thickness == pytest.approx(film, rel=0.08)


def test_friction_of_an_estimated_oil_carries_its_band():
    oil = lubricant_from(OilSheet("pao", 320e-6, 35.6e-6, 859.0), T_80)
    contact = contact_of(LIU_NI._replace(lubricant=oil))
    assert contact.viscosity_limits == (0.0, math.inf, 1.0)
    low, high = friction_band(contact, [(4e5, 2.0, 0.01, 0.5), (4e5, 2.0, 0.01, -0.3)], step=0.2)
    assert low < 0.9
    assert high >= 1.0
    given = contact_of(LIU_NI)
    assert given.viscosity_limits == (1.0, math.inf, 1.0)
    assert friction_band(given, [(4e5, 2.0, 0.01, 0.5)]) == (1.0, 1.0)


def shares(**changed):
    zero = np.zeros(len(TERMS))
    table = ContactTable(*(0.0, 20.0) * 4, zero, zero, zero, 0.05, 2e6, 0.1, 0.0, 0.0, 9.0, **changed)
    contact = local_contact(4e5, 100.0, 2.0, 0.3, 2.1, 1.9)
    found = LAW.in_range(contact, None, LIU_NI.surfaces, table)
    assert len(found) == len(LAW.limits)
    return dict(zip(LAW.limits, found, strict=True))


def test_friction_solved_with_an_estimate_is_never_inside_its_range():
    assert min(shares().values()) >= 1.0
    for changed in ({"measured": 0.0}, {"pressure_limit": 1e9}, {"temperature_share": 0.5}):
        found = shares(**changed)
        assert sum(share < 1.0 for share in found.values()) == 1
    assert shares(measured=0.0)["viscosity measured at high pressure, not estimated"] == 0.0


def test_asperities_by_finish_or_as_given():
    assert asperities_of(None, None, None) == Asperities() == BY_FINISH["ground"][0]
    assert asperities_of("superfinished", None, 0.02) == (0.03, 0.02)
    slopes = [BY_FINISH[finish][0].slope for finish in ("superfinished", "ground", "hobbed")]
    assert sorted(slopes) == slopes
    assert set(BY_FINISH) == set(FINISHES)
    roughness = contact_of(LIU_NI._replace(asperities=Asperities(0.03, 0.02))).roughness
    assert (roughness.density, roughness.slope) == (0.03, 0.02)


GIVEN = {"line_load": 400e3, "radius": 10e-3, "entrainment_speed": 2.0, "effective_modulus": 226.37e9}


def test_a_lubricant_by_name():
    oil = {"lubricant": "squalane", "oil_temperature": T_80, "sliding_speed": 0.5, "rheology": "limiting"}
    found = td.line_contact(**GIVEN | {"line_load": 420e3}, **oil)
    (limit,) = found.limits
    assert "above 1.2 GPa, up to which the viscosity was measured" in limit
    assert td.line_contact(**GIVEN | {"line_load": 380e3}, **oil).limits == ()
    assert found.temperature.max() > 1.0
    best, low, high = (
        td.line_contact(**GIVEN, **oil | {"lubricant": "iso-vg-100-pao"}, viscosity_band=band)
        for band in ("best", "lowest", "highest")
    )
    assert low.friction_coefficient < best.friction_coefficient <= high.friction_coefficient
    assert "estimated" in best.limits[0]


@pytest.mark.parametrize(
    ("given", "key", "rule"),
    [
        ({"lubricant": "squalan", "oil_temperature": T_80}, "lubricant", "no such file"),
        ({"lubricant": "squalane"}, "oil_temperature", "missing"),
        ({"lubricant": "squalane", "oil_temperature": T_80, "viscosity": 0.1}, "viscosity", "contradicts"),
        ({"lubricant": "squalane", "oil_temperature": 80.0}, "operating.oil_temperature", "outside"),
        ({"lubricant": "liu-ni-2022", "oil_temperature": T_80}, "lubricant", "one temperature"),
        (
            {"lubricant": "squalane", "oil_temperature": T_80, "viscosity_band": "lowest"},
            "viscosity_band",
            "there is none",
        ),
        (
            {"lubricant": "squalane", "oil_temperature": T_80, "viscosity_band": "low"},
            "viscosity_band",
            "no such end of a band",
        ),
        (
            {"viscosity": 0.1, "pressure_viscosity": 2e-8, "oil_temperature": T_80},
            "oil_temperature",
            "no effect",
        ),
        ({"viscosity": 0.1}, "pressure_viscosity", "not a finite number"),
    ],
)
def test_what_is_wrong_with_it_is_said(given, key, rule):
    with pytest.raises(td.InputError) as refused:
        td.line_contact(**GIVEN, **given)
    assert refused.value.key == key
    assert rule in refused.value.rule
    assert refused.value.remedy
