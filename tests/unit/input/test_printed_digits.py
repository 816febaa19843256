"""Centre distances as they are printed: a pair without backlash is one within the rounding of the digits."""

import math
import tomllib
from pathlib import Path
from typing import Any

import pytest
import tomli_w

import tribodyn
from tribodyn.errors import InputError
from tribodyn.gears.case import ROUNDED
from tribodyn.geometry.families.involute import shift_sensitivity, tight_centre_distance
from tribodyn.input.quantity import shift_rounding
from tribodyn.studies.drive_file import load_drive
from tribodyn.studies.protocol.load import load_scenario


def pair(
    module: float, teeth: tuple[int, int], shifts: tuple[float, float], distance: str | None
) -> dict[str, Any]:
    """A drive file with what the tests do not vary."""
    gears = [
        {"teeth": z, "profile_shift": x, "face_width": "20 mm", "bore_radius": f"{0.15 * module * z} mm"}
        for z, x in zip(teeth, shifts, strict=True)
    ]
    table: dict[str, Any] = {
        "family": "involute",
        "module": f"{module} mm",
        "pressure_angle": "20 deg",
        "mean_roughness": "0.4 um",
        "material": "16MnCr5",
        "pinion": gears[0],
        "gear": gears[1],
    }
    return table | ({"centre_distance": distance} if distance else {})


#: The gears of the FZG rig's type C, and the sun and planet of a published design report (module 21 mm).
FZG = 4.5, (16, 24), (0.1817, 0.1715)
REPORT = 21.0, (18, 36), (0.389, 0.5039)


def without_backlash(module: float, teeth: tuple[int, int], shift: float) -> float:
    """Of a sum of shifts, by bisection of inv α_w = inv α + 2 tan α Σx/Σz, m."""
    alpha, total = math.radians(20.0), sum(teeth)
    target = math.tan(alpha) - alpha + 2 * math.tan(alpha) * shift / total
    low, high = 0.01, 1.2
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if math.tan(middle) - middle < target else (low, middle)
    return 0.5e-3 * module * total * math.cos(alpha) / math.cos(low)


@pytest.mark.parametrize(
    ("shift", "rounding"),
    [(0, 0.0), (0.0, 0.0), (-1.0, 0.0), (0.5, 0.005), (0.17, 0.005), (-0.389, 0.0005), (0.1817, 0.00005)],
)
def test_shifts_are_printed_to_two_decimals_or_more(shift: float, rounding: float):
    assert shift_rounding(shift) == pytest.approx(rounding, rel=1e-12)


@pytest.mark.parametrize(("gears", "distance"), [(FZG, "91.5 mm"), (FZG, "91.5000 mm"), (REPORT, "584 mm")])
def test_a_published_distance_is_that_without_backlash(gears: Any, distance: str):
    module, teeth, shifts = gears
    found = tribodyn.drive(pair(module, teeth, shifts, distance))
    tight = without_backlash(module, teeth, sum(shifts))
    assert found.sheet["centre distance"][0] == pytest.approx(tight, rel=1e-12)
    assert found.sheet["normal backlash"][0] == 0.0
    printed = float(distance.split()[0])
    assert 0.0 < 1e3 * tight - printed < 1e-3
    assert found.sheet["centre distance as printed"][0] == pytest.approx(1e-3 * printed, rel=1e-12)
    assert found.contact_ratio == pytest.approx(
        tribodyn.drive(pair(module, teeth, shifts, None)).contact_ratio, rel=1e-12
    )
    assert 'centre_distance = "' + distance in found.toml


def test_the_rounding_is_that_of_the_distance_and_of_the_shifts():
    """The distance without backlash moves by m sin α/sin α_w with a shift: that of central differences."""
    module, teeth, shifts = FZG
    drive = load_drive(pair(module, teeth, shifts, None)).drive
    step = 1e-4
    ends = [without_backlash(module, teeth, sum(shifts) + sign * step) for sign in (1, -1)]
    slope = (ends[0] - ends[1]) / (2 * step)
    assert float(shift_sensitivity(drive)) == pytest.approx(slope, rel=1e-6)
    thicker = drive._replace(pinion=drive.pinion._replace(thickness_allowance=20e-6))
    moved = [
        float(
            tight_centre_distance(thicker._replace(gear=thicker.gear._replace(profile_shift=shifts[1] + dx)))
        )
        for dx in (step, -step)
    ]
    assert float(shift_sensitivity(thicker)) == pytest.approx((moved[0] - moved[1]) / (2 * step), rel=1e-6)
    sheet = tribodyn.drive(pair(module, teeth, shifts, "91.500 mm")).sheet
    expected = 0.5e-6 + slope * 2 * 0.00005
    assert sheet["rounding of the printed digits"][0] == pytest.approx(expected, rel=1e-6)


def written(millimetres: float) -> str:
    """A distance with four decimals."""
    return f"{millimetres:.4f} mm"


def test_an_overlap_beyond_the_rounding_is_refused_with_the_remedy():
    module, teeth, shifts = FZG
    tight = 1e3 * without_backlash(module, teeth, sum(shifts))
    slope = 1e3 * float(shift_sensitivity(load_drive(pair(module, teeth, shifts, None)).drive))
    allowed = 0.00005 + slope * 2 * 0.00005
    accepted = written(tight - allowed + 1.1e-4)
    assert tribodyn.drive(pair(module, teeth, shifts, accepted)).sheet["normal backlash"][0] == 0.0
    with pytest.raises(
        InputError, match=r"drive.centre_distance = .*the teeth overlap.*use at least 91.5001 mm"
    ):
        tribodyn.drive(pair(module, teeth, shifts, written(tight - allowed - 1.1e-4)))


@pytest.mark.parametrize("coarse", ["91 mm", "9e1 mm", "0.09 m", "3.6 in"])
def test_coarse_digits_excuse_no_more_than_a_twentieth_of_the_module(coarse: str):
    """0.225 mm: the first three are 0.5 and 1.5 mm too close, the last one 0.06 mm."""
    module, teeth, shifts = FZG
    table = pair(module, teeth, shifts, coarse)
    if coarse == "3.6 in":
        assert tribodyn.drive(table).sheet["rounding of the printed digits"][0] == pytest.approx(0.225e-3)
        return
    with pytest.raises(InputError, match="the teeth overlap"):
        tribodyn.drive(table)


@pytest.mark.parametrize("distance", ["91.6 mm", "91.5002 mm", "92 mm"])
def test_a_larger_distance_is_taken_as_it_is_written(distance: str):
    sheet = tribodyn.drive(pair(*FZG, distance)).sheet
    assert sheet["centre distance"][0] == pytest.approx(1e-3 * float(distance.split()[0]), rel=1e-14)
    assert sheet["normal backlash"][0] > 0.0
    assert "centre distance as printed" not in sheet


def test_teeth_without_shift_at_their_own_distance_need_no_rounding():
    sheet = tribodyn.drive(pair(3.0, (18, 36), (0.0, 0.0), "81 mm")).sheet
    assert sheet["centre distance"][0] == pytest.approx(0.081, rel=1e-14)
    assert "centre distance as printed" not in sheet
    with pytest.raises(InputError, match="the teeth overlap"):
        tribodyn.drive(pair(3.0, (18, 36), (0, 0), "80.99 mm"))


@pytest.fixture
def scenario(tmp_path: Path) -> Path:
    """An efficiency study of the pair of the FZG rig."""
    data = tomllib.loads(load_scenario("efficiency-involute-18-36").toml)
    data |= {"drive": pair(*FZG, "91.5 mm")}
    path = tmp_path / "fzg.toml"
    path.write_text(tomli_w.dumps(data))
    return path


def test_a_sweep_says_of_which_cases_it_is(scenario: Path):
    values = ["91.5 mm", "91.45 mm", "91.6 mm"]
    swept = tribodyn.sweep(str(scenario), {"drive.centre_distance": values}, output=scenario.parent / "s.h5")
    messages = [str(message) for message in swept["message"].values]
    assert "the teeth overlap" in messages[1]
    assert [ROUNDED in message for message in messages] == [True, False, False]
