"""Tooth flank fracture of a scenario: the FZG gears of a listing, the page, and what is refused."""

from typing import Any

import pytest

from tribodyn.errors import InputError
from tribodyn.interface.scenario import scenario
from tribodyn.studies.assessment.pages.limit_table import holds_of_mesh
from tribodyn.studies.assessment.run import check
from tribodyn.validation.books.stplus_fzg_c import SCENARIO

HARD = {"hardness": "750 HV", "core_hardness": "380 HV", "case_depth": "0.675 mm"}
#: A_FF at A to E as printed; K_v K_Hβ of the listing is 1.358, here 1.03 · 1.32.
PRINTED = dict(
    zip(("A", "AB", "B", "C", "D", "DE", "E"), (0.408, 0.392, 0.498, 0.438, 0.423, 0.307, 0.254), strict=True)
)


def changed(limits: dict[str, Any] | None = None, **material: Any) -> dict[str, Any]:
    drive = SCENARIO["drive"]
    return SCENARIO | {
        "drive": drive | {"material": drive["material"] | HARD | material},
        "assessment": SCENARIO["assessment"] | {"face_load_factor": 1.32},
        "limits": limits or {},
    }


def test_the_printed_exposures_and_the_radius_out_of_range():
    found = check(scenario(changed()))
    iso = found.data["iso"]
    for point, printed in PRINTED.items():
        assert iso["A_FF"][point] == pytest.approx(printed, rel=0.01), point
    assert iso["A_FF_max"]["gear"] == iso["A_FF"]["worst"]
    assert iso["K_material"]["pinion"] == pytest.approx(1.131, abs=5e-4)
    assert any("3.91 to 8.73 mm, ISO/TS 6336-4 is for 5 to 150 mm" in text for text in found.remarks)
    summary = {"iso": iso, "limits": {"flank_fracture": {"value": 1.62, "limit": 1.2, "kept": True}}}
    assert "Tooth flank fracture" in holds_of_mesh(summary)


def test_beyond_the_pressures_that_are_known_it_is_an_extrapolation():
    within, beyond = (
        check(scenario(changed() | {"operating": SCENARIO["operating"] | {"pinion_torque": torque}})).remarks
        for torque in ("130 N*m", "200 N*m")
    )
    assert not any("extrapolation" in text for text in within)
    assert sum("770 to 1380 N/mm²: an extrapolation" in text for text in beyond) == 1


def test_a_thinner_case_is_more_exposed_and_without_one_nothing_is_rated():
    safeties = [check(scenario(changed(case_depth=f"{mm} mm"))).data["iso"]["S_FF"] for mm in (0.3, 0.675)]
    assert safeties[0]["pinion"] < safeties[1]["pinion"]
    assert "A_FF" not in check(scenario(SCENARIO)).data["iso"]


@pytest.mark.parametrize(
    ("data", "key", "said"),
    [
        (changed(core_hardness="800 HV"), "drive.material.core_hardness", "not below the surface's hardness"),
        (changed(case_depth="4 mm"), "drive.material.case_depth", "deeper than half of a tooth"),
        (changed(treatment="nitrided"), "drive.material.case_depth", "case-hardened teeth"),
        (SCENARIO | {"limits": {"flank_fracture": 1.2}}, "limits.flank_fracture", "0.15 times"),
    ],
)
def test_what_is_refused(data: dict[str, Any], key: str, said: str):
    with pytest.raises(InputError, match=said) as error:
        scenario(data)
    assert error.value.key == key
