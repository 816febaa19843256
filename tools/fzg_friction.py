"""Mean friction of FZG type C gears by solved contacts, beside regressions made on measurements.

python -m tools.fzg_friction --into docs/ehl.md

Schlenk's and Fernandes' regressions (`tribodyn.standards.mesh_loss.friction`) as the open program GEARpie has
them, with its X_L: 0.846 mineral, 0.65 PAO and ester. The gears: 16/24 teeth, module 4.5 mm, centre distance
91.5 mm, tips of 82.64 and 118.54 mm, Ra 0.4 and 0.31 µm. Two pairs share the load by half.
"""

import math
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np

from tools.marked_block import generate, table
from tribodyn.standards.mesh_loss.friction import fernandes, schlenk
from tribodyn.tribology.closure import without_nominal_conditions
from tribodyn.tribology.contact import Asperities, Surfaces
from tribodyn.tribology.ehl.coupled import solve_coupled
from tribodyn.tribology.ehl.of_case import Contact, contact_of
from tribodyn.tribology.ehl.problem import LineContact
from tribodyn.tribology.law import LawInput
from tribodyn.tribology.oil import LubricantData, OilSheet, lubricant_from

TEETH, MODULE, DISTANCE, TIPS = (16, 24), 4.5e-3, 91.5e-3, (41.318e-3, 59.272e-3)
BASE = tuple(count * MODULE * math.cos(math.radians(20.0)) / 2 for count in TEETH)
ANGLE = math.acos(sum(BASE) / DISTANCE)
MEAN_ROUGHNESS = 0.355e-6
PLACES = 8


class Test(NamedTuple):
    """A duty of the gears with an oil."""

    name: str
    oil: OilSheet
    temperature: float  # K
    torque: float  # on the pinion, N m
    speed: float  # of the pinion, rpm
    width: float  # m
    schlenk_factor: float


#: Mineral: the naphthenic VG 100 of Arana et al. where it has 13.28 mPa s, and its limiting stress.
MINERAL = OilSheet("mineral", 97.9e-6, 8.61e-6, 900.0, {"limiting_shear_coefficient": 0.053})
PAO = OilSheet("pao", 320e-6, 35.6e-6, 859.0)
ESTER = OilSheet("ester", 320e-6, 35.6e-6, 915.0)
TESTS = {
    "mineral": Test("mineral VG 100, b 14 mm", MINERAL, 353.513, 200.0, 1500.0, 14e-3, 0.846),
    "pao": Test("PAO VG 320, b 40 mm", PAO, 353.15, 302.0, 1800.0, 40e-3, 0.65),
    "pao-slow": Test("the same", PAO, 353.15, 302.0, 600.0, 40e-3, 0.65),
    "pao-light": Test("the same", PAO, 353.15, 183.4, 1800.0, 40e-3, 0.65),
    "ester": Test("ester VG 320, b 40 mm", ESTER, 353.15, 302.0, 1800.0, 40e-3, 0.65),
    "ester-slow": Test("the same", ESTER, 353.15, 302.0, 600.0, 40e-3, 0.65),
}


def oil_of(test: Test) -> LubricantData:
    """Return the test's oil at its temperature."""
    return lubricant_from(test.oil, test.temperature)


def regressions(test: Test) -> tuple[float, float]:
    """Schlenk's and Fernandes' mean friction coefficient."""
    oil, force = oil_of(test), test.torque / BASE[0]
    pitch = BASE[0] / math.cos(ANGLE) * test.speed * 2 * math.pi / 60
    speed = 2 * pitch * math.sin(ANGLE)
    ratio = TEETH[1] / TEETH[0]
    radius = DISTANCE * math.sin(ANGLE) * ratio / (1 + ratio) ** 2
    oil_factor, viscosity = test.schlenk_factor, oil.inlet_viscosity
    return (
        schlenk(force / test.width, speed, radius, viscosity, MEAN_ROUGHNESS, oil_factor),
        fernandes(
            *(force, test.width, speed, radius, viscosity, oil.pressure_viscosity),
            *(MEAN_ROUGHNESS, oil_factor),
        ),
    )


def contact_for(test: Test, oil: LubricantData, asperities: Asperities = Asperities()) -> Contact:
    """Return what the test's contacts have in common."""
    surfaces = Surfaces(
        effective_modulus=226.37e9,
        hardness=7e9,
        roughness=math.sqrt(math.pi) * MEAN_ROUGHNESS,
        mean_roughness=MEAN_ROUGHNESS,
        inlet_viscosity=oil.inlet_viscosity,
        pressure_viscosity=oil.pressure_viscosity,
        pinion_conductivity=46.0,
        gear_conductivity=46.0,
        pinion_heat_capacity=3.6e6,
        gear_heat_capacity=3.6e6,
    )
    steel: tuple[None, None] = (None, None)  # read by no solved contact
    return contact_of(
        LawInput(surfaces, oil, steel, without_nominal_conditions, asperities=asperities)  # pyright: ignore
    )


def mean_friction(
    test: Test, contact: Contact, places: int = PLACES, *, smooth: bool = False, heat: bool = True
) -> tuple[float, float]:
    """Loss of the solved contacts along the path over that of μ = 1; share of it that asperities make."""
    whole, pitch = DISTANCE * math.sin(ANGLE), 2 * math.pi * BASE[0] / TEETH[0]
    start = whole - math.sqrt(TIPS[1] ** 2 - BASE[1] ** 2)
    end = math.sqrt(TIPS[0] ** 2 - BASE[0] ** 2)
    speed, load = test.speed * 2 * math.pi / 60, test.torque / BASE[0] / test.width
    lost = sliding = rubbed = 0.0
    for place in np.linspace(start + 0.2e-3, end - 0.2e-3, places):
        share = 1.0 if end - pitch < place < start + pitch else 0.5
        pinion, gear = speed * place, speed * TEETH[0] / TEETH[1] * (whole - place)
        problem = LineContact(
            share * load,
            place * (whole - place) / whole,
            (pinion + gear) / 2,
            contact.fluid,
            contact.effective_modulus,
            pinion - gear,
            None if smooth else contact.roughness,
        )
        solved = solve_coupled(problem, contact.rheology, contact.thermal if heat else None)
        weight = share * abs(pinion - gear)
        lost += weight * abs(solved.friction) / problem.line_load
        rubbed += weight * contact.roughness.friction * solved.solution.asperity_load_ratio
        sliding += weight
    return lost / sliding, rubbed / lost


def _row(test: Test) -> list[str]:
    contact = contact_for(test, oil_of(test))
    best, rubbed = mean_friction(test, contact)
    low, high = (mean_friction(test, contact.under(law))[0] for law in contact.band)
    schlenk, fernandes = regressions(test)
    return [
        test.name,
        f"{test.torque:g} N·m, {test.speed:g} rpm",
        f"{1e3 * float(oil_of(test).inlet_viscosity):.3g}",
        f"{schlenk:.4f}, {fernandes:.4f}",
        f"{best:.4f} ({min(low, best):.4f} to {max(high, best):.4f})",
        f"{100 * (best / schlenk - 1):+.0f}, {100 * (best / fernandes - 1):+.0f} %",
        f"{100 * rubbed:.0f} %",
    ]


def compared(_: object) -> str:
    """Return the table of all tests."""
    head = (
        *("oil", "pinion", "η, mPa·s", "Schlenk, Fernandes", "solved (band)"),
        *("departure", "by asperities"),
    )
    return table(head, [_row(test) for test in TESTS.values()], "llrlllr")


def parts(test: Test) -> dict[str, float]:
    """Mean friction with one term of the solved contact changed at a time."""
    oil = oil_of(test)
    contact = contact_for(test, oil)
    sheet = test.oil
    roelands = lubricant_from(
        OilSheet(
            sheet.type, sheet.viscosity_40, sheet.viscosity_100, sheet.density_15, sheet.given, roelands=True
        ),
        test.temperature,
    )
    limits = {"mineral": (0.047, 0.053), "pao": (0.030, 0.040), "ester": (0.030, 0.045)}[sheet.type]
    of: Callable[..., float] = lambda *given, **how: mean_friction(test, *given, **how)[0]  # noqa: E731
    stress = [
        contact._replace(rheology=contact.rheology._replace(limiting_coefficient=limit)) for limit in limits
    ]
    return {
        "as it is": of(contact),
        "viscosity by Roelands from α": of(contact_for(test, roelands)),
        f"limiting stress {limits[0]:g} p": of(stress[0]),
        f"limiting stress {limits[1]:g} p": of(stress[1]),
        "without asperities": of(contact, smooth=True),
        "isothermal": of(contact, heat=False),
    }


def taken_apart(_: object) -> str:
    """Return the table of the terms, of one duty of each oil."""
    found = {kind: parts(TESTS[kind]) for kind in ("mineral", "pao")}
    cells: dict[str, list[str]] = {}
    for place, kind in enumerate(found):
        for name, value in found[kind].items():
            cells.setdefault(name, ["–"] * len(found))[place] = f"{value:.4f}"
    return table(("term", *found), [[name, *row] for name, row in cells.items()], "lrr")


if __name__ == "__main__":
    generate(__doc__, fzg=partial(compared), fzg_terms=partial(taken_apart))
