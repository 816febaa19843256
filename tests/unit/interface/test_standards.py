"""`td.standards`: every formula by name, units of arguments, one error for a bad call."""

from inspect import signature

import numpy as np
import pint
import pytest

import tribodyn as td

S = td.standards
#: All functions and input structures, ``part.name``.
NAMES = [
    f"{part}.{name}"
    for part in dir(S)
    for name in getattr(S, part).__all__
    if callable(getattr(getattr(S, part), name))
]


def call(name: str):
    part, _, function = name.partition(".")
    return getattr(getattr(S, part), function)


def test_factors_that_a_design_report_prints():
    """Helical stage of 2017: z 24/95, m_n 14 mm, β 10°, a 861 mm; α_wt = acos(a_0 cos α_t/a)."""
    alpha_t = np.arctan(np.tan(np.radians(20.0)) / np.cos(np.radians(10.0)))
    centres = 0.5 * 0.014 * 119 / np.cos(np.radians(10.0))
    working = np.degrees(np.arccos(centres * np.cos(alpha_t) / 0.861))
    base = np.degrees(np.arcsin(np.sin(np.radians(10.0)) * np.cos(np.radians(20.0))))
    zone = S.pitting.zone_factor("20 deg", "10 deg", f"{working} deg", f"{base} deg")
    assert zone == pytest.approx(2.307, abs=5e-4)
    assert S.pitting.contact_ratio_factor(1.463, 1.421) == pytest.approx(0.827, abs=5e-4)
    assert S.pitting.lubricant_factor("1500 MPa", "220 mm**2/s") == pytest.approx(1.020, abs=5e-4)
    speed = np.pi * 0.34117 * 1165.9 / 60.0
    assert S.pitting.speed_factor("1500 MPa", f"{speed} m/s") == pytest.approx(1.022, abs=5e-4)
    assert S.pitting.helix_factor("10 deg") == pytest.approx(1.008, abs=5e-4)
    assert S.pitting.elasticity_factor("226.37 GPa") == pytest.approx(189.8e3, rel=1e-3)
    assert S.bending.helix_factor("10 deg", 1.421, 2006) == pytest.approx(0.917, abs=5e-4)


def test_a_text_a_quantity_and_a_number_are_the_same():
    unit = pint.UnitRegistry()
    values = [S.allowances.centre_distance_allowance(7, a) for a in ("91.5 mm", 91.5 * unit.mm, 0.0915)]
    assert values == [17.5e-6] * 3  # IT7 of 80 to 120 mm is 35 µm
    hours = [S.rolling_bearings.running_time(9e7, n) / 3600.0 for n in ("1500 rpm", 50.0 * np.pi)]
    assert hours == pytest.approx([1000.0, 1000.0])
    assert S.metals.yield_from_hardness("300 HV") == pytest.approx(720e6)  # 0.75 · 3.2 N/mm² per HV
    steel = S.scuffing.thermal_flash_factor("226.4 GPa", "13795 W*s**0.5/(m**2*K)")
    assert steel == pytest.approx(50.0, rel=5e-3)  # printed in ISO/TR 13989-2 of steel on steel


def test_rainflow_and_miner():
    """The standard's own example; two bins on a line of slope 1/9, one above it."""
    counted = S.rainflow.rainflow([f"{x} MPa" for x in (-2, 1, -3, 5, -1, 3, -4, 4, -2)])
    assert sorted((round(c.range / 1e6), c.share) for c in counted) == [
        *((3, 0.5), (4, 0.5), (4, 1.0), (6, 0.5), (8, 0.5), (8, 0.5), (9, 0.5))
    ]
    curve = S.fatigue.StressCurve((1e5, 1e8), ("2000 MPa", "1000 MPa"))
    middle = S.fatigue.Bin(f"{1000 * 2**0.5} MPa", 0.25 * 10**6.5)
    assert S.fatigue.damage([middle, middle], curve) == pytest.approx(0.5)
    assert S.fatigue.damage([S.fatigue.Bin("2.1 GPa", 1)], curve) == np.inf


def test_arrays_where_a_formula_takes_them():
    pressures = S.micropitting.hertz_pressure(["200 N/mm", "800 N/mm"], "10 mm", "226 GPa")
    assert pressures[1] / pressures[0] == pytest.approx(2.0)


@pytest.mark.parametrize("name", NAMES)
def test_every_function_says_what_it_takes_and_refuses_what_it_does_not(name):
    function = call(name)
    assert function.__doc__.strip()
    assert "Arguments: " in function.__doc__
    taken = [p for p in signature(function).parameters.values() if p.default is p.empty]
    for values in ((object(),) * len(taken), (*[1.0] * len(taken), 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11)):
        if taken:
            keys = {p.name: v for p, v in zip(taken, values, strict=False) if p.kind is p.KEYWORD_ONLY}
            with pytest.raises(td.InputError, match=name):
                function(*values[: len(taken) - len(keys)], *values[len(taken) :], **keys)


@pytest.mark.parametrize(
    ("name", "values", "said"),
    [
        (
            "pitting.contact_ratio_factor",
            (1.4,),
            "missing a required argument: 'overlap'; it takes transverse",
        ),
        ("pitting.contact_ratio_factor", ("1.4 mm", 1), "is no finite number"),
        ("pitting.contact_ratio_factor", (float("nan"), 1), "is no finite number"),
        ("pitting.contact_ratio_factor", (0, 1), "has no result"),
        ("pitting.contact_ratio_factor", (True, 1), "is no finite number"),
        ("pitting.permissible", ("steel", 1), "is no Metal"),
        ("scuffing.lubricant_factor", (1, "12 mm"), '"mm" is not a unit of dynamic viscosity'),
        ("scuffing.lubricant_factor", (1, -1), "no real result"),
        ("metals.contact_factors", ("hard",), 'is none of "normalized"'),
        ("bending.helix_factor", (0.1, 1, 1996), "is none of 2019, 2006"),
        ("rolling_bearings.basic_life", ("needle", 1, 1), "is none of"),
        ("load_factors.reduced_mass", ([1], (1, 2), 1), "has not 2 values"),
        ("allowances.centre_distance_allowance", (7.5, "1 m"), "is no whole number"),
        ("allowances.thickness_allowances", ("zz25", "1 m"), "as in cd25"),
    ],
)
def test_bad_calls(name, values, said):
    with pytest.raises(td.InputError) as raised:
        call(name)(*values)
    assert said in str(raised.value)
    assert "\n" not in str(raised.value)


def test_no_such_part():
    with pytest.raises(AttributeError, match="it has agma, allowances"):
        S.agma9000  # noqa: B018
