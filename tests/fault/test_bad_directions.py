"""Loads on the back flanks that a study cannot take, named with a remedy."""

import pytest

from tribodyn.errors import InputError
from tribodyn.studies.protocol.load import load_scenario

BACKLASH = {"mesh.backlash": "0.05 mm"}
MISTAKES = {
    "no back flanks": (
        "crc-23-47",
        {"operating.gear_torque": "-5 N*m"},
        r"operating\.gear_torque = -5 N\*m: .*mesh\.backlash",
    ),
    "error of the other flanks": (
        "crc-23-47",
        {
            **BACKLASH,
            "operating.gear_torque": "-5 N*m",
            "mesh.transmission_error.harmonics": [{"order": 1, "amplitude": "2 um"}],
        },
        r"mesh\.transmission_error\.harmonics.*driving flanks.*leave it out",
    ),
    "no load to take the compliance at": (
        "involute-18-36-fem",
        {**BACKLASH, "operating.gear_torque": "0 N*m"},
        r'operating\.gear_torque = 0 N\*m: contradicts compliance = "fem"',
    ),
    "efficiency of nothing": (
        "efficiency-crc-23-47",
        {"operating.gear_torque": "0 N*m"},
        r"operating\.gear_torque = 0 N\*m: must not be zero.*-500",
    ),
    "load contact": (
        "load-contact-18-36",
        {"operating.gear_torque": "-5 N*m"},
        r"operating\.gear_torque.*must be greater than zero",
    ),
}


@pytest.mark.parametrize("mistake", MISTAKES.values(), ids=list(MISTAKES))
def test_what_is_wrong_is_named(mistake):
    name, overrides, said = mistake
    with pytest.raises(InputError, match=said):
        load_scenario(name, overrides)


def test_what_is_right_is_not_refused():
    load_scenario("crc-23-47", {**BACKLASH, "operating.gear_torque": "-5 N*m"})
    load_scenario("involute-18-36-fem", {**BACKLASH, "operating.gear_torque": "-5 N*m"})
    load_scenario("rattle", {"mesh.transmission_error.harmonics": [{"order": 1, "amplitude": "2 um"}]})
