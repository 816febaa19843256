"""The table of the first page: each safety of each gear, green or red against what is required."""

import re

import tribodyn as td
from tribodyn.studies.assessment.pages.limit_table import holds

SUMMARY = {
    "limits": {
        "pitting": {"value": 0.9, "limit": 1.0, "kept": False, "p5": 0.8, "p95": 1.2, "exceed": 3},
        "bending": {"value": 1.6, "limit": 1.4, "kept": True, "p5": 1.5, "p95": 1.7, "exceed": 0},
        "life": {"value": 3.6e6, "limit": 7.2e7, "kept": False},
        "scuffing_flash": {"value": 1.7, "limit": 1.5, "kept": True},
    },
    "iso": {
        "S_H": {"pinion": 1.1, "gear": 1.2},
        "S_F": {"pinion": 1.6, "gear": 1.9},
        "life_pitting": {"pinion": 3.6e8, "gear": 7.2e8},
        "life_bending": {"pinion": 3.6e9, "gear": 7.2e9},
        "damage_pitting": {"pinion": 0.0, "gear": 0.2},
        "damage_bending": {"pinion": 0.0, "gear": 0.0},
    },
    "simulated": {
        "S_H": {"pinion": 0.9, "gear": 1.05},
        "life_pitting": {"pinion": 3.6e6, "gear": 7.2e8},
        "damage_pitting": {"pinion": 20.0, "gear": 0.1},
    },
    "margins": {"iso": {"S_B": 1.7}, "simulated": {"S_B": 2.5}},
}


def cells(page: str) -> dict[str, list[tuple[str, str]]]:
    """Mark and text of the cells of every row, by its first."""
    rows = re.findall(r"<tr>(<td.*?)</tr>", page)
    found = [re.findall(r'<td class="(\w*)" colspan="\d">(.*?)</td>', row) for row in rows]
    return {row[0][1]: row[1:] for row in found}


def test_every_gear_is_judged_by_itself_and_what_nobody_knows_is_a_dash():
    found = cells(holds(SUMMARY))
    assert found["Pitting S_H"] == [
        *[("good", "1.10"), ("good", "1.20"), ("bad", "0.90"), ("good", "1.05")],
        *[("bad", "0.80 to 1.20"), ("", "≥ 1.00")],
    ]
    assert found["Tooth bending S_F"][2:4] == [("", "–"), ("", "–")]
    assert found["Tooth bending S_F"][4] == ("good", "1.50 to 1.70")
    assert found["Scuffing S_B, flash temperature"] == [
        ("good", "1.70"),
        ("good", "2.50"),
        ("", ""),
        ("", "≥ 1.50"),
    ]
    assert "Micropitting S_λ" not in found


def test_a_life_is_the_shorter_of_both_and_a_bound_where_nothing_is_damaged():
    found = cells(holds(SUMMARY))["Life, h"]
    assert found[:4] == [("good", "≥ 100,000"), ("good", "200,000"), ("bad", "1,000"), ("good", "200,000")]
    # the end of a line of permissible stress for breakage comes before the life until pitting
    iso = SUMMARY["iso"] | {
        "life_pitting": {"pinion": 3.6e9, "gear": 3.6e8},
        "damage_pitting": {"pinion": 0.1},
    }
    iso["life_bending"] = {"pinion": 7.2e8, "gear": 7.2e8}
    life = {"value": 7.2e8, "limit": 7.2e7, "kept": True, "p5": 3.6e8, "p95": 7.2e8, "unlimited": True}
    found = cells(holds(SUMMARY | {"iso": iso, "limits": {"life": life}}))["Life, h"]
    assert found[:2] == [("good", "≥ 200,000"), ("good", "100,000")]
    assert found[4] == ("good", "100,000 to ≥ 200,000")


def test_check_has_the_factors_without_a_simulation():
    found = td.check("assessment-helical-24-95", {"assessment.face_load_factor": 1.2})["iso"]
    assert found["K_Hbeta"] == 1.2
    assert found["S_H"]["pinion"] > 1.0
    assert set(found["Y_F"]) == {"pinion", "gear"}
