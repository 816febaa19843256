"""Tolerances of a search: the same samples for every candidate, about what the candidate has."""

from typing import Any

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.families import family
from tribodyn.studies.design.candidates.candidates import BEYOND, cases_of, chosen
from tribodyn.studies.design.candidates.evaluation import evaluate, loaded_case
from tribodyn.studies.design.scenario import loaded_search

PITCH = "drive.pinion.modification.pitch_errors"
PROFILE, DISTANCE = "drive.gear.modification.profile_error", "drive.centre_distance"
FREE = [{"key": "drive.pinion.profile_shift", "from": 0.0, "to": 0.2}]
EFFICIENCY = "efficiency-involute-18-36"
FEM = {"mesh.compliance": "fem"}


def search(*tolerances: dict[str, Any], overrides: Any = FEM) -> Any:
    given = {"free": FREE, "minimise": "loss", "tolerance": list(tolerances), "robust": {"samples": 4}}
    return loaded_search(EFFICIENCY, given, overrides).case


def test_an_error_along_the_profile_covers_the_path_and_stays_within_its_bounds():
    case = search({"key": PROFILE, "plus_minus": "3 um"})
    known = [overrides[PROFILE]["error"] for overrides in cases_of(case, chosen(case, [0.3]))]
    for share in (0.0, 1.0):
        cases = cases_of(case, chosen(case, [share]))
        curves = [overrides[PROFILE] for overrides in cases]
        assert [curve["error"] for curve in curves] == known  # for every candidate the same
        errors = np.array([curve["error"]["values"] for curve in curves])
        assert np.abs(errors).max() <= 3.0
        assert np.ptp(errors, axis=0).min() > 0.0
        loaded = loaded_case(case.base, cases[0]).case
        start, end = assemble(family(loaded.family), loaded.drive).roll_limits
        roll = curves[0]["roll_angle"]["values"]
        assert roll[0] == pytest.approx(start - BEYOND * (end - start))
        assert roll[-1] == pytest.approx(end + BEYOND * (end - start))


def test_an_error_is_added_to_the_profile_that_stands():
    given = {
        "roll_angle": {"unit": "deg", "values": [-60.0, 0.0, 60.0]},
        "error": {"unit": "um", "values": [0.0, 10.0, 0.0]},
    }
    case = search({"key": PROFILE, "plus_minus": "0.001 mm"}, overrides=FEM | {PROFILE: given})
    (first, *_) = cases_of(case, chosen(case, [0.0]))
    curve = first[PROFILE]
    assert curve["error"]["unit"] == "mm"
    middle = np.interp(0.0, curve["roll_angle"]["values"], curve["error"]["values"])
    assert 0.0 < abs(middle - 0.010) <= 0.001


def test_the_distance_of_the_axes_deviates_about_that_of_nominal_teeth():
    """a = m (z1 + z2)/2 = 81 mm without shift; teeth that are thinner leave room."""
    thin = {f"drive.{side}.thickness_allowance": "-80 um" for side in ("pinion", "gear")}
    case = search({"key": DISTANCE, "plus_minus": "50 um", "distribution": "ends"}, overrides=thin)
    cases = cases_of(case, chosen(case, [0.0]))
    distances = [float(overrides[DISTANCE].split()[0]) * 1e-6 for overrides in cases]
    np.testing.assert_allclose(sorted(distances), [0.08095] * 2 + [0.08105] * 2, rtol=1e-9)
    rows: list[Any] = evaluate(case.scenarios, cases)
    order = np.argsort(distances)  # the further apart, the shorter the contact
    assert rows[order[0]]["contact_ratio"] > rows[order[-1]]["contact_ratio"] + 0.01


def test_one_tolerance_alone_leaves_the_others_as_they_stand():
    torque = "operating.gear_torque"
    case = search({"key": PROFILE, "plus_minus": "3 um"}, {"key": torque, "plus_minus": "20 N*m"})
    (alone,) = cases_of(case, chosen(case, [0.0]), alone=(1, 1.0))
    assert torque in alone
    assert PROFILE not in alone
    (other,) = cases_of(case, chosen(case, [0.0]), alone=(0, 1.0))
    assert torque not in other
    assert PROFILE in other


def test_every_tooth_deviates_by_itself_within_its_bounds():
    given = {"free": FREE, "minimise": "peak_to_peak", "robust": {"samples": 2}}
    given["tolerance"] = [{"key": PITCH, "plus_minus": "3 um"}]
    short = {"output.positions_per_cycle": 8, "mesh.slices": 3}
    case = loaded_search("load-contact-18-36", given, short).case
    cases = cases_of(case, chosen(case, [0.3]))
    errors = np.array([[float(error.split()[0]) for error in overrides[PITCH]] for overrides in cases])
    assert errors.shape == (2, 18)
    assert np.abs(errors).max() <= 3.0
    assert np.ptp(errors, axis=0).min() > 0.0
    rows: list[Any] = evaluate(case.scenarios, cases)
    assert rows[0]["contact_ratio"] == rows[1]["contact_ratio"]
    assert rows[0]["face_load_factor"] > 0.0


@pytest.mark.parametrize("key", [PROFILE, PITCH])
def test_a_curve_deviates_by_a_length(key: str):
    with pytest.raises(InputError, match="not a length"):
        search({"key": key, "plus_minus": "3 N"})
