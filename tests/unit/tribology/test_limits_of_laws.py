"""Limits of every law as its text says them, with the numbers that they bound by hand."""

import math
import re
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from tests.support.closures import LIU_NI, VECIANA, under
from tribodyn.tribology.closure import closure
from tribodyn.tribology.contact import NominalConditions, local_contact
from tribodyn.tribology.ehl.lookup import LIMITS, in_table
from tribodyn.tribology.film import FILM_LAWS, dowson_higginson, masjedi_khonsari, moes
from tribodyn.tribology.friction import FRICTION_LAWS, benedict_kelley, coulomb, xu
from tribodyn.tribology.friction import coulomb as frictionless
from tribodyn.tribology.friction import masjedi_khonsari as mixed
from tribodyn.tribology.friction.iso_14179_1 import LAW as ISO
from tribodyn.tribology.friction.niemann import LAW as NIEMANN
from tribodyn.tribology.friction.niemann import SCHLENK
from tribodyn.tribology.surface_state import range_shares, surface_state

PAGE = Path(__file__).parents[3] / "docs" / "ehl.md"
UNLIKE = LIU_NI._replace(
    surfaces=LIU_NI.surfaces._replace(gear_conductivity=37.0, gear_heat_capacity=2.9e6, roughness=4e-7)
)
#: Line load, curvature, entrainment, sliding.
CONTACTS = ((1.1e5, 137.0, 0.83, -0.27), (1.3e6, 71.0, 4.6, 3.9), (8e3, 310.0, 0.11, 0.0007))
UNITS = {"GPa": 1e9, "µm": 1e-6, "%": 0.01}


def by_hand(given, w, curvature, u, v):
    """What limits of local laws bound, by their names."""
    c, oil = given.surfaces, given.lubricant
    E = c.effective_modulus
    W, U, G = w * curvature / E, c.inlet_viscosity * u * curvature / E, c.pressure_viscosity * E
    S, V = c.roughness * curvature, c.hardness / E
    share = 5e-5 * W**-0.408 * U**-0.088 * G**0.103
    share *= math.log1p(4470 * S**6.015 * V**1.168 * W**0.485 * U**-3.741 * G**-2.898)
    share = min(share, 1.0)
    rough = 1 + 0.2 * S**1.222 * V**0.223 * W**-0.229 * U**-0.748 * G**-0.842
    film = 2.691 * W**-0.135 * U**0.705 * G**0.556 / curvature * rough
    half = math.sqrt(8 * w / (math.pi * E * curvature))
    mean = w / (2 * half)
    heat = abs(v) * mean * (oil.asperity_friction * share + oil.limiting_shear_coefficient * (1 - share))
    flow = sum(
        k * math.sqrt(1 + half * abs(speed) * capacity / (2 * k))
        for speed, k, capacity in (
            (u + v / 2, c.pinion_conductivity, c.pinion_heat_capacity),
            (u - v / 2, c.gear_conductivity, c.gear_heat_capacity),
        )
    )
    warm = 2 * half * heat / math.sqrt(math.pi) / flow
    index = oil.viscosity_pressure_index
    thicker = (math.log(c.inlet_viscosity) + 9.67) * ((1 + 5.1e-9 * mean * (1 - share)) ** index - 1)
    stress = c.inlet_viscosity * math.exp(thicker - oil.temperature_viscosity * warm) * abs(v) / film
    slid = max(abs(v), 0.02 * u)
    return {
        "W": W,
        "U": U,
        "G": G,
        "σ/ρ": S,
        "V": V,
        "M": W / math.sqrt(2 * U),
        "L": G * (2 * U) ** 0.25,
        "p_H": 4 / math.pi * mean,
        "η0 u²": c.inlet_viscosity * u * u,
        "roughness factor of the film": rough,
        "asperities": share,
        "Newtonian stress": stress / (oil.limiting_shear_coefficient * mean),
        "slide-to-roll ratio": abs(v) / u,
        "roughness": c.roughness,
        "Ra": c.mean_roughness,
        "sliding": abs(v) / (2 * u),
        # N/mm, mPa s, m/s
        "29700 w/(η |v_s| V_Σ²)": 29700 * 1e-3 * w / (1e3 * c.inlet_viscosity * slid * (2 * u) ** 2),
    }


def share_allowed(limit, numbers):
    """Actual over the least, or the most over actual, by the text of a limit."""
    found = re.fullmatch(r"(.+?) ([≥≤]) ([\d.e-]+) ?(\S*).*", limit)
    assert found is not None, limit
    value, bound = numbers[found[1]], float(found[3]) * UNITS.get(found[4], 1.0)
    return value / bound if found[2] == "≥" else bound / value


FILMS = [dowson_higginson.LAW, masjedi_khonsari.LAW, masjedi_khonsari.AS_PRINTED, moes.LAW]
FRICTIONS = [
    mixed.LAW,
    mixed.MEAN_PRESSURE,
    mixed.AS_PRINTED,
    mixed.VECIANA,
    mixed.VECIANA_PEAK,
    xu.LAW,
    benedict_kelley.LAW,
]


@pytest.mark.parametrize("law", [*FILMS, *FRICTIONS], ids=lambda law: f"{law.table}-{law.name}")
@pytest.mark.parametrize("given", [UNLIKE, VECIANA], ids=["liu-ni", "veciana"])
def test_limits_are_those_that_the_law_names(law, given):
    is_film = law.table == "film"
    film, friction = (law, FRICTION_LAWS["none"]) if is_film else (FILM_LAWS["masjedi-khonsari"], law)
    laws = closure(given, film, friction)
    for contact in CONTACTS:
        load, curvature, u, v = contact
        seen = local_contact(load, curvature, u, v, u + v / 2, u - v / 2)
        shares = range_shares(seen, laws)[0 if is_film else 1]
        numbers = by_hand(given, *contact)
        if numbers["asperities"] == 1.0 and law is not mixed.MEAN_PRESSURE:
            numbers["Newtonian stress"] = 0.0  # no fluid is left to shear
        expected = [share_allowed(limit, numbers) for limit in law.limits]
        within = [5e-3 if limit.startswith("Ra") else 1e-9 for limit in law.limits]
        assert len(shares) == len(expected)
        for limit, found, wanted, tolerance in zip(law.limits, shares, expected, within, strict=True):
            assert found == pytest.approx(wanted, rel=tolerance), limit
        state = surface_state(seen, laws)
        inside = state.closure_in_range if is_film else state.friction_in_range
        assert inside == float(min(shares) >= 1.0)


@pytest.mark.parametrize("law", [ISO, NIEMANN, SCHLENK], ids=lambda law: law.name)
@pytest.mark.parametrize("speed", [0.9, 7.0, 41.0])
@pytest.mark.parametrize("torque", [40.0, 900.0])
def test_limits_of_mean_coefficients(law, speed, torque):
    """Pitch line speed in m/s, load intensity F_t (u + 1)/(b d_1 u) in N/mm²; the smallest share counts."""
    r1, r2, width = 0.031, 0.083, 0.019
    mesh = NominalConditions(
        torque / r1, r1, r2, math.radians(22.0), speed / r1, width, 0.031, 861.0, 6e-7, 0.05
    )
    given = LIU_NI._replace(nominal=lambda: mesh)
    found = float(law.made(given, {}).in_range)
    intensity = torque / r1 * (r2 / r1 + 1) / (width * 2 * r1 * r2 / r1) / 1e6
    if law is ISO:
        wanted = min(speed / 2, 25 / speed, intensity / 1.4, 14 / intensity)
    else:
        wanted = 50 / speed
    assert found == pytest.approx(wanted)
    # the whole mesh has it, whatever the contact
    laws = closure(given, FILM_LAWS["moes"], law)
    rolling, other = (range_shares(local_contact(4e5, 90.0, 1.0, v, 1.2, 0.8), laws)[1] for v in (0.0, 0.7))
    assert rolling == other == pytest.approx(wanted)


def test_limits_of_a_table_are_its_ends():
    """Load 2e5 … 9e5 N/m, entrainment 0.3 … 0.7 m/s."""
    table = SimpleNamespace(
        line_load=0.5 * math.log(2e5 * 9e5),
        line_load_half=0.5 * math.log(9e5 / 2e5),
        entrainment=0.5 * math.log(0.3 * 0.7),
        entrainment_half=0.5 * math.log(0.7 / 0.3),
    )
    shares = in_table(local_contact(3e5, 77.0, 0.6, 0.1, 0.65, 0.55), None, table)
    assert len(LIMITS) == 4
    assert shares == pytest.approx((3e5 / 2e5, 9e5 / 3e5, 0.6 / 0.3, 0.7 / 0.6))


def test_laws_without_a_range_say_nothing():
    laws = under("coulomb", coefficient=0.07)
    for sliding in (-0.3, 0.0, 0.1):
        seen = local_contact(3e5, 77.0, 0.6, sliding, 0.65, 0.55)
        assert coulomb.LAW.function(seen, None, None, laws.friction.parameters) == 0.07
        assert frictionless.NONE.function(seen, None, None, frictionless.NO_FRICTION) == 0.0
    assert coulomb.LAW.stated == ""
    shares = range_shares(local_contact(3e5, 77.0, 0.6, 0.1, 0.65, 0.55), laws)[1]
    assert np.all(np.isnan(shares))


def test_ratios_to_the_solved_contact_are_those_of_the_page():
    """Of the table that `tools/law_ranges.py` writes: what is right, and the ratio at 5, 50 and 95 %."""
    rows = re.findall(
        r"^\| (film|friction) `([\w-]+)` \| [^|]+ \| ([\d.]+) … ([\d.]+) \| ([^|]+) \| [^|]+ "
        r"\| ([^|]+) \| ([^|]+) \|",
        PAGE.read_text(encoding="utf-8"),
        re.MULTILINE,
    )
    assert len(rows) == 14
    for table, name, low, high, limits, ratio, outside in rows:
        law = (FILM_LAWS if table == "film" else FRICTION_LAWS)[name]
        assert law.judged is not None
        assert law.judged.right == (float(low), float(high))
        assert list(law.judged.ratio) == [float(part) for part in ratio.split(",")], name
        assert ", ".join(f"{value:.3g}" for value in law.judged.outside or ()) == outside.strip("– "), name
        named = [] if limits == "none found" else limits.split(", ")
        assert list(law.limits[len(law.limits) - law.judged.limits :]) == named
        own = law.limits[: len(law.limits) - law.judged.limits]
        assert law.named_limits == (*own, *(f"{limit} (judged)" for limit in named))
