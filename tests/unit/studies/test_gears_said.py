"""What is said of gears: stiffness per face width and as a whole, in engineers' units."""

import math
from typing import Any

import pytest

from tribodyn.gears.check import sheet_and_stiffness, sheet_tables, with_unit
from tribodyn.geometry.assembly import Assembly, assemble
from tribodyn.geometry.drive import Drive, GearBody, MaterialData
from tribodyn.geometry.families import crc, involute

STEEL = MaterialData("steel", 206e9, 0.3, 7830.0, 46.0, 470.0, 6e9)
LOAD, STIFFNESS = 2600.0, 5.2e8


def pair(family: Any) -> Assembly:
    bodies = [GearBody(z, 0.0, 1.0, 1.25, 0.25, width, 0.01) for z, width in ((25.0, 0.04), (60.0, 0.0325))]
    return assemble(family, Drive(3e-3, math.radians(20.0), *bodies))


@pytest.mark.parametrize("load", [2600.0, 9000.0])
def test_stiffness_by_simulation_and_by_the_standard(load: float):
    """c' of ISO 6336-1, (5.25): 1/q' of 25 and 60 teeth, 0.8 of it measured, less below 100 N/mm."""
    found = sheet_and_stiffness(
        pair(involute.FAMILY), (STEEL, STEEL), "energy method", (load, STIFFNESS), remark="of steel"
    )
    by, width = found.data["stiffness"]["by"], 0.0325
    assert by["energy method"] == {
        "per_width": pytest.approx(STIFFNESS / width),
        "stiffness": pytest.approx(STIFFNESS),
    }
    line = load * math.cos(math.radians(20.0)) / width * 1e-3
    theory = 1.0 / (0.04723 + 0.15551 / 25.0 + 0.25791 / 60.0)
    reduced = min((line / 100.0) ** 0.25, 1.0)
    single = 0.8 * 0.975 * theory * reduced
    ours, measured = by["ISO 6336-1 c', factors below"], by["ISO 6336-1 c'_th, theory"]
    assert ours["per_width"] == pytest.approx(1e9 * single, rel=1e-9)
    assert ours["stiffness"] == pytest.approx(1e9 * single * width, rel=1e-9)
    assert measured["per_width"] == pytest.approx(1e9 * theory, rel=1e-9)
    assert found.data["stiffness"]["line_load"] == pytest.approx(load / width)
    said = {table.title.partition(",")[0]: {row[0]: row[1:] for row in table.rows} for table in found.tables}
    shown = said["Stiffness of a single pair at the pitch point"]
    assert shown["energy method"] == ("16.00", "520")
    assert shown["ISO 6336-1 c', factors below"][0] == f"{single:.2f}"
    rows = said["Reference stiffness by ISO 6336-1"]
    assert rows["c'_th, one pair, theory for steel"][0] == f"{theory:.2f}"
    assert rows["c', one pair"][0] == f"{single:.2f}"
    assert (rows["C_M, correction from measurements"][0], rows["C_B, rack"][0]) == ("0.8", "0.975")
    assert rows[f"reduction at F_t/b = {line:.0f} N/mm"][0] == f"{reduced:.4g}"
    ratio = float(pair(involute.FAMILY).contact_ratio)
    mesh = single * (0.75 * ratio + 0.25)
    assert rows["c_γα, mean of the mesh"][0] == f"{mesh:.2f}"
    assert rows["c_γβ, for the face load factor"][0] == f"{0.85 * mesh:.2f}"
    of_load, of_standard = found.remarks
    assert of_load == "of steel"
    assert ("reduced below 100 N/mm" in of_standard) == (reduced < 1.0)
    assert any(f"at {load / width * 1e-3:.0f} N/mm" in table.title for table in found.tables)


def test_other_teeth_have_no_reference():
    found = sheet_and_stiffness(pair(crc.FAMILY), (STEEL, STEEL), "energy method", (LOAD, STIFFNESS))
    assert list(found.data["stiffness"]["by"]) == ["energy method"]
    assert "iso_6336_1" not in found.data["stiffness"]
    assert found.remarks == []


def test_sheets_of_two_gears_side_by_side():
    """What one gear alone has leaves the other's cell empty."""
    sheet = {
        "centre distance": (127.5, "mm"),
        "pinion": {"teeth": (25, ""), "tip": (40.5, "mm")},
        "gear": {"teeth": (60, ""), "bore": (10.123456789, "mm")},
    }
    of_pair, gears = sheet_tables(sheet)
    assert of_pair.rows == [("centre distance", "127.5 mm")]
    assert gears.columns == ("quantity", "pinion", "gear")
    assert gears.rows == [("teeth", "25", "60"), ("tip", "40.5 mm", ""), ("bore", "", "10.1235 mm")]
    assert with_unit(1.5, "") == "1.5"
    assert with_unit("yes", "") == "yes"
