"""The drive file of a fitted path: quantities with their units, and keys whose place others take."""

from contextlib import nullcontext
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.geometry.families.spline import FEWEST, MOST
from tribodyn.studies.gears import spline_drive
from tribodyn.studies.gears.spline_drive import as_spline


def body(shift: float, allowance: float) -> Any:
    return SimpleNamespace(
        profile_shift=shift, addendum=1.05, dedendum=1.2, fillet_radius=0.3, thickness_allowance=allowance
    )


@pytest.fixture
def model(monkeypatch: pytest.MonkeyPatch) -> Any:
    shape = SimpleNamespace(
        angles=np.radians([20.0, 21.5, 25.0]), knots=np.array([-0.004, 0.0, 0.0055]), corner=np.radians(1.25)
    )
    drive = SimpleNamespace(module=0.00325, shape=shape, pinion=body(0.125, 0.0), gear=body(-0.25, -4e-5))
    fitted = SimpleNamespace(drive=drive, family="spline family")
    monkeypatch.setattr(spline_drive, "check", lambda family, of: (family, of))
    monkeypatch.setattr(spline_drive, "family", lambda name: f"{name} family")
    monkeypatch.setattr(spline_drive, "fit_spline", lambda assembly, values: fitted)
    monkeypatch.setattr(spline_drive, "flank_deviation", lambda assembly, other: 1.25e-6)
    side = {"teeth": 23, "tip_radius": "30 mm", "face_width": "20 mm", "profile_shift": 0.9}
    table = {
        "title": "Pair",
        "source": "paper",
        "family": "crc",
        "module": "3 mm",
        "pressure_angle": "22 deg",
        "centre_distance": "105 mm",
        "pinion": side,
        "gear": side | {"teeth": 47},
    }
    return SimpleNamespace(
        table=table, family="crc", drive="drive", origins=SimpleNamespace(naming=nullcontext)
    )


def test_what_the_file_holds(model: Any):
    found, deviation = as_spline(model, FEWEST)
    assert deviation == 1.25e-6
    assert (found["family"], found["module"], found["title"]) == (
        "spline",
        "3.25 mm",
        "Pair, as a free-form path",
    )
    assert "flanks within 1.2 um" in found["source"]
    assert not {"pressure_angle", "centre_distance"} & found.keys()
    assert found["shape"] == {
        "angles": ["20 deg", "21.5 deg", "25 deg"], "knots": ["-4 mm", "0 mm", "5.5 mm"], "corner": "1.25 deg"
    }  # fmt: skip
    assert found["pinion"] == {
        "teeth": 23, "face_width": "20 mm", "profile_shift": 0.125,
        "addendum": 1.05, "dedendum": 1.2, "fillet_radius": 0.3,
    }  # fmt: skip
    assert found["gear"]["thickness_allowance"] == "-40 um"
    assert (found["gear"]["profile_shift"], found["gear"]["teeth"]) == (-0.25, 47)
    assert model.table["pinion"]["profile_shift"] == 0.9


@pytest.mark.parametrize(
    ("values", "made"), [(FEWEST - 1, False), (FEWEST, True), (MOST, True), (MOST + 1, False)]
)
def test_a_path_has_few_values_and_not_too_few(model: Any, values: int, made: bool):
    if made:
        assert as_spline(model, values).table["family"] == "spline"
        return
    with pytest.raises(InputError, match=f"{FEWEST} to {MOST} values"):
        as_spline(model, values, "values")
