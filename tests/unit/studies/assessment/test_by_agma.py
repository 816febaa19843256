"""The rating by AGMA 2101 beside ISO 6336: an example of a textbook as a scenario, and what is refused.

Shigley's Mechanical Engineering Design, example 14-4: 17 and 52 teeth, diametral pitch 10, face 1.5 in,
Q_v 6, 1800 rpm, 4 hp, 240 and 200 HB, K_m 1.22, 10⁸ cycles; the printed numbers are from memory.
"""

from typing import Any

import pytest

from tribodyn.errors import InputError
from tribodyn.interface.scenario import scenario
from tribodyn.studies.assessment.run import check

PSI = 6894.757
STEEL = {"like": "42CrMo4", "treatment": "through-hardened", "grade": "ML"}
#: Rack and thinner teeth of AGMA 908's tables.
CUT = {"face_width": "38.1 mm", "dedendum": 1.4, "fillet_radius": 0.35, "thickness_allowance": "-61 um"}
PINION = CUT | {"teeth": 17, "material": STEEL | {"hardness": "2.477 GPa"}}
GEAR = CUT | {"teeth": 52, "material": STEEL | {"hardness": "2.0645 GPa"}}
EXAMPLE: dict[str, Any] = {
    "title": "example 14-4",
    "kind": "assessment",
    "drive": {
        "family": "involute",
        "module": "2.54 mm",
        "pressure_angle": "20 deg",
        "mean_roughness": "0.8 um",
        "quality": 11,
        "material": STEEL | {"hardness": "2.477 GPa"},
        "pinion": PINION,
        "gear": GEAR,
    },
    "lubricant": {
        "type": "mineral",
        "viscosity_40": "220 mm**2/s",
        "viscosity_100": "19 mm**2/s",
        "density_15": "890 kg/m**3",
    },
    "operating": {"power": "2982.8 W", "pinion_speed": "1800 rpm", "oil_temperature": "60 degC"},
    "assessment": {"standard": "agma", "face_load_factor": 1.22, "required_life": "925.926 h"},
}


def changed(table: str, **keys: Any) -> dict[str, Any]:
    return EXAMPLE | {table: EXAMPLE[table] | keys}


def rated(data: dict[str, Any]) -> Any:
    return check(scenario(data)).data


def test_the_example_has_the_printed_stresses_and_safeties():
    """K_s of 1.043, R 0.9 and I at the pitch point (0.121) are the book's; its J is read with two digits."""
    found = rated(EXAMPLE)["agma"]
    bending, contact = found["sigma_F"]["pinion"] / PSI, found["sigma_H"] / PSI
    geometry = found["Y_J"]["pinion"]
    assert found["A_v"] == 11.0
    assert found["K_v"] == pytest.approx(1.377, abs=2e-3)
    assert geometry == pytest.approx(0.30, abs=0.01)
    assert bending * geometry == pytest.approx(6417.0 * 0.30 / 1.043, rel=3e-3)
    # Z_E 189.8 for the book's 2300 √psi, 191
    assert contact**2 * found["Z_I"] == pytest.approx(70360.0**2 * 0.121 / 1.043 * 0.9874, rel=5e-3)
    assert found["sigma_Flim"]["pinion"] / PSI == pytest.approx(31350.0, rel=3e-3)
    assert found["sigma_Hlim"]["gear"] / PSI == pytest.approx(322.0 * 200.0 + 29100.0, rel=3e-3)
    assert (found["Y_N"]["pinion"], found["Z_N"]["pinion"]) == pytest.approx((0.977, 0.948), abs=1e-3)
    as_read = found["S_F"]["pinion"] * 0.30 / geometry / 1.043
    assert as_read == pytest.approx(5.62 * 0.85, rel=0.01)


def test_case_hardened_grades_and_given_factors():
    """65 and 225 ksi of grade 2; K_v as it is given; the rating by ISO is what it is alone."""
    hard = {"material": {"like": "18CrNiMo7-6", "treatment": "case-hardened", "grade": "MQ"}}
    made = changed("drive", quality=4, pinion=PINION | hard, gear=GEAR | hard)
    data = rated(made)
    assert data["agma"]["A_v"] == 6.0  # the finest that AGMA 2101 has a formula for
    assert data["agma"]["sigma_Flim"]["gear"] / PSI == pytest.approx(65000.0, rel=5e-3)
    assert data["agma"]["sigma_Hlim"]["gear"] / PSI == pytest.approx(225000.0, rel=5e-3)
    settings = made["assessment"]
    given = rated(made | {"assessment": settings | {"dynamic_factor": 1.3}})["agma"]
    assert given["K_v"] == 1.3
    assert given["S_F"]["gear"] == pytest.approx(data["agma"]["S_F"]["gear"] * data["agma"]["K_v"] / 1.3)
    plain = rated(made | {"assessment": settings | {"standard": "iso"}})
    assert "agma" not in plain
    assert plain["iso"] == data["iso"]


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ({"helix_angle": "5 deg"}, "low contact ratio, 0.42"),
        ({"family": "cycloidal", "pressure_angle": None}, "needs external involutes"),
        (
            {"gear": GEAR | {"material": STEEL | {"treatment": "nitrided"}}},
            "case-hardened or through-hardened",
        ),
    ],
)
def test_what_it_has_no_formulas_for_is_refused(keys: dict[str, Any], said: str):
    with pytest.raises(InputError, match=said) as refused:
        scenario(changed("drive", **keys))
    assert "assessment.standard" in str(refused.value)
