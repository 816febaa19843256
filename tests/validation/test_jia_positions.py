"""Claims of Jia et al. about where stresses are largest, on passages whose maxima are known."""

import numpy as np
import pytest

from tribodyn.validation.papers.jia import Passage, positions

ROLL = np.linspace(-0.4, 0.5, 91)


def peaked(**places: float) -> Passage:
    """A passage with contact from −0.35 to 0.4 rad and stresses that peak at places of the way to 0.4."""
    at = {"line_load": 0.0, "compression": 0.0, "tension": 0.0} | places
    inside = (ROLL > -0.355) & (ROLL < 0.405)
    curves = {name: np.where(inside, 2.0 - np.abs(ROLL - 0.4 * place), 0.0) for name, place in at.items()}
    return Passage(ROLL, pressure=0.0 * ROLL, **curves)


def test_places_are_shares_of_the_way_to_the_last_contact():
    assert peaked(tension=0.9).place("tension") == pytest.approx(0.9, abs=0.02)
    assert peaked(line_load=-0.5).place("line_load") == pytest.approx(-0.5, abs=0.02)


@pytest.mark.parametrize("compression", [0.9, 0.5])
@pytest.mark.parametrize("contact", [0.1, -0.4])
def test_claims_hold_where_the_maxima_are(compression: float, contact: float):
    parabolic = peaked(compression=compression, tension=0.1)
    found = positions(peaked(line_load=contact), parabolic, [parabolic._replace(), peaked(compression=0.95)])
    held = {key.removeprefix("jia/claim-"): holds for key, (holds, _) in found.items()}
    assert held == {
        "involute-largest-near-the-middle": contact == 0.1,
        "contact-largest-near-the-pitch-circle": True,
        "compression-largest-before-the-exit": compression == 0.9,
        "tension-largest-before-the-exit": False,
    }
