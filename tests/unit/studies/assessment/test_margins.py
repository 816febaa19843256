"""Margins by the standard from what is known of a lubricant's strength."""

from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from tribodyn.gears.rating.standard import margins_by_standard

OIL = 353.15
FOUND = cast(
    Any,
    SimpleNamespace(
        flash_bulk=373.15,
        flash_contact=423.15,
        integral=SimpleNamespace(integral=393.15),
        films=SimpleNamespace(specific_film=np.array([0.9, 0.6, 1.2])),
    ),
)


@pytest.mark.parametrize(("flash", "integral"), [(None, None), (573.15, None), (None, 573.15)])
def test_without_both_scuffing_temperatures_there_is_no_safety(flash, integral):
    strength = cast(Any, SimpleNamespace(scuffing=flash, scuffing_integral=integral, specific_film=None))
    assert margins_by_standard(FOUND, strength, OIL) == pytest.approx(
        {"theta_M_flash": 100.0, "theta_B": 150.0, "theta_int": 120.0}
    )


def test_safeties_of_known_strength():
    """ISO/TS 6336-20: S_B = (θ_S − θ_oil)/(θ_B − θ_oil), -21: S_intS = θ_intS/θ_int, in °C."""
    strength = cast(Any, SimpleNamespace(scuffing=573.15, scuffing_integral=633.15, specific_film=0.4))
    found = margins_by_standard(FOUND, strength, OIL)
    assert found["S_B"] == pytest.approx((300.0 - 80.0) / (150.0 - 80.0))
    assert found["S_intS"] == pytest.approx(360.0 / 120.0)
    assert (found["theta_S"], found["theta_intS"]) == pytest.approx((300.0, 360.0))
    assert (found["lambda_GFP"], found["S_lambda"]) == pytest.approx((0.4, 1.5))
