"""What laws have in common: heat of friction by hand, the range in words."""

import math

import pytest

from tests.support.closures import LIU_NI, POINT, under
from tribodyn.errors import InputError
from tribodyn.numerics.parameter import Parameter
from tribodyn.tribology.contact import local_contact
from tribodyn.tribology.law import FilmLaw, FrictionLaw, JudgedRange, heat_of_friction
from tribodyn.tribology.surface_state import film_and_temperature, fraction_in_range, surface_state

SURFACES = LIU_NI.surfaces._replace(gear_conductivity=37.0, gear_heat_capacity=2.9e6)


def test_heat_of_friction_by_hand():
    """μ |v_s| p with the mean pressure w/2a, into both surfaces by Tian & Kennedy."""
    w, rho, u1, u2, mu = 2.7e5, 7.7e-3, 0.31, 0.67, 0.043
    a = math.sqrt(8 * w * rho / (math.pi * SURFACES.effective_modulus))
    heat = mu * 0.36 * w / (2 * a)
    conducted = sum(
        k * math.sqrt(1 + a * u * c / (2 * k))
        for u, k, c in (
            (u1, SURFACES.pinion_conductivity, SURFACES.pinion_heat_capacity),
            (u2, 37.0, 2.9e6),
        )
    )
    contact = local_contact(w, 1 / rho, 0.49, u1 - u2, u1, u2)
    found = heat_of_friction(contact, None, SURFACES, None, mu)
    assert found == pytest.approx(2 * a * heat / math.sqrt(math.pi) / conducted, rel=1e-12)
    laws = under("coulomb", LIU_NI._replace(surfaces=SURFACES), coefficient=mu)
    assert film_and_temperature(contact, *laws)[1] == pytest.approx(found, rel=1e-14)


def test_film_and_temperature_are_those_of_the_whole_state():
    contact = local_contact(**POINT)
    for friction, film in (("masjedi-khonsari", None), ("xu", "moes"), ("none", "dowson-higginson")):
        laws = under(friction, film=film)
        state = surface_state(contact, laws)
        found = film_and_temperature(contact, *laws)
        assert found == pytest.approx((state.central_film_thickness, state.flash_temperature_rise))


@pytest.mark.parametrize("kind", [FilmLaw, FrictionLaw])
def test_the_range_in_words(kind):
    """The authors' limits first, those by the solved contact last."""
    limits, table = ("a ≤ 1", "b ≤ 2", "c ≤ 3"), "film" if kind is FilmLaw else "friction"
    plain = kind("plain", "", lambda *_: 0.0, limits=limits, range="a to c")
    assert (plain.stated, plain.named_limits, plain.table) == ("a to c", limits, table)
    judged = kind(
        "judged", "", lambda *_: 0.0, limits=limits, judged=JudgedRange((0.7, 1.3), (0.9, 1.0, 1.2), 2)
    )
    assert judged.stated == "by the solved contact: b ≤ 2, c ≤ 3 (0.7 to 1.3 times it)"
    assert judged.named_limits == ("a ≤ 1", "b ≤ 2 (judged)", "c ≤ 3 (judged)")
    off = kind(
        "off", "", lambda *_: 0.0, limits=limits, range="all", judged=JudgedRange((0.5, 2), (0.25, 1, 14.3))
    )
    assert off.stated == "all; no range by the solved contact: 0.25 to 14 times it"
    assert off.named_limits == limits
    assert kind("none", "", lambda *_: 0.0).stated == ""


def test_keys_take_their_defaults_and_unknown_ones_are_refused():
    keys = (
        Parameter("first", "number", "one", default=3.0, source="test"),
        Parameter("other", "number", "two"),
    )
    law = FrictionLaw("mine", "", lambda *_: 0.0, keys=keys)
    assert law.made(LIU_NI, {"other": 0.5}) == (3.0, 0.5)
    assert law.with_values(first=4.0, other=2.0).made(LIU_NI, {}) == (4.0, 2.0)
    assert law.with_values(first=4.0).made(LIU_NI, {"first": 5.0, "other": 1.0}) == (5.0, 1.0)
    with pytest.raises(InputError, match=r"friction\.zzzqx.*its keys: first, other"):
        law.made(LIU_NI, {"zzzqx": 1.0, "other": 1.0})
    with pytest.raises(InputError, match=r"friction\.other: missing"):
        law.made(LIU_NI, {})
    with pytest.raises(TypeError, match="no key zzzqx; its keys: first, other"):
        law.with_values(zzzqx=1.0)
    bare = FilmLaw("bare", "", lambda *_: 0.0)
    assert bare.made(LIU_NI, {}) == ()
    with pytest.raises(InputError, match=r"film\.zzzqx.*its keys: none"):
        bare.made(LIU_NI, {"zzzqx": 1.0})
    with pytest.raises(TypeError, match="its keys: none"):
        bare.with_values(zzzqx=1.0)


@pytest.mark.parametrize(
    ("flags", "share"),
    [([], 1.0), ([1.0], 1.0), ([0.0], 0.0), ([1.0, 0.0, 0.0, 1.0, 1.0], 0.6), ([math.nan] * 3, None)],
)
def test_share_of_contacts_inside(flags, share):
    assert fraction_in_range(flags) == (share if share is None else pytest.approx(share))
