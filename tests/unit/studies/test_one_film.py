"""The same gears, oil and duty have one film law, whatever the study and whether friction reads it."""

from typing import Any

import pytest

from tribodyn.studies.protocol.load import load_data
from tribodyn.tribology.closure import laws_of, with_laws

GEARS = {
    "title": "one film",
    "drive": "diez-ibarbia-18-36",
    "lubricant": "iso-vg-220-mineral",
    "operating": {"pinion_speed": "1500 rpm", "gear_torque": "300 N*m", "oil_temperature": "80 degC"},
}
COULOMB = {"law": "coulomb", "coefficient": 0.05}
MESH = {"compliance": "energy", "damping_ratio": 0.05}
#: What a kind has beside, and where its case keeps the film.
KINDS: dict[str, tuple[dict[str, Any], str]] = {
    "gear-pair": ({"friction": COULOMB, "mesh": MESH, "bearings": "rigid-1e9"}, ""),
    "gear-pair without friction": ({"friction": {"law": "none"}, "mesh": MESH, "bearings": "rigid-1e9"}, ""),
    "efficiency": ({"friction": COULOMB}, ""),
    "load-contact": ({}, "lubricated"),
    "wear": ({"friction": COULOMB, "wear": {"revolutions": 1e6}}, "lubricated"),
}


def film_of(name: str) -> Any:
    own, where = KINDS[name]
    case = load_data({**GEARS, "kind": name.split()[0], **own}, name).case
    return (getattr(case, where) if where else case.pair).film


@pytest.mark.parametrize("name", KINDS)
def test_it_is_that_of_the_plain_pair(name: str):
    film, plain = film_of(name), film_of("gear-pair")
    assert film.law == plain.law
    assert film.ratio == pytest.approx(plain.ratio, rel=0.01)
    # the law is judged by the contact solved at this duty
    assert 0.5 < film.ratio[0] <= film.ratio[1] <= film.ratio[2] < 2.0


def test_wear_by_asperities_keeps_a_law_that_knows_them():
    wear = {"law": "archard-asperities", "revolutions": 1e6}
    case = load_data({**GEARS, "kind": "wear", "friction": COULOMB, "wear": wear}, "asperities").case
    assert case.lubricated.film.law == "masjedi-khonsari"


def test_another_friction_law_brings_the_film_law_that_it_reads():
    case = load_data({**GEARS, "kind": "gear-pair", **KINDS["gear-pair"][0]}, "pair").case.pair
    assert with_laws(case, friction="schlenk").film == case.film
    film, friction = laws_of(with_laws(case, friction="masjedi-khonsari"))
    assert (film.name, friction.name) == ("masjedi-khonsari", "masjedi-khonsari")
