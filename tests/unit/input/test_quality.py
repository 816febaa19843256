"""Tolerances, and samples of deviations within them, in every study that takes them."""

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.studies.protocol.load import load

GEARS = {"drive.quality": 6, "mesh.deviation_sample": 4}


def case(name, **changes):
    return load(name, GEARS | {key.replace("__", "."): value for key, value in changes.items()}).case.pair


def test_load_contact_has_teeth_that_differ():
    flanks = case("load-contact-18-36").mesh.modifications
    again = case("load-contact-18-36").mesh.modifications
    assert (len(flanks.pinion.pitch_error), len(flanks.gear.pitch_error)) == (18, 36)
    assert flanks.pinion.pitch_error == again.pinion.pitch_error
    assert (
        flanks.pinion.pitch_error
        != case("load-contact-18-36", mesh__deviation_sample=5).mesh.modifications.pinion.pitch_error
    )
    assert flanks.pinion.profile_error is not None
    assert flanks.misalignment.in_plane != 0.0
    alone = case("load-contact-18-36", mesh__slices=1).mesh.modifications
    assert alone.misalignment.in_plane == 0.0


def test_a_coarser_class_deviates_more_by_the_root_of_two():
    """The same sample of the class two above is twice as large, whatever the study."""
    for name, curve in (
        ("involute-23-47", lambda case: case.mesh.error_table[1]),
        ("load-contact-18-36", lambda case: case.mesh.modifications.pinion.profile_error[1]),
        ("load-contact-18-36", lambda case: np.array(case.mesh.modifications.gear.pitch_error)),
    ):
        fine, coarse = (curve(case(name, drive__quality=grade)) for grade in (5, 7))
        assert coarse == pytest.approx(2 * fine, rel=1e-9, abs=1e-15)


def test_dynamics_take_profile_and_base_pitch():
    assert load("involute-23-47").case.pair.mesh.error_table is None
    at, error = case("involute-23-47").mesh.error_table
    assert 0 < np.ptp(error) < 60e-6
    assert at[0] < 0 < at[-1]
    fem = case("involute-18-36-fem").mesh
    assert fem.error_table is None
    assert fem.modifications.pinion.profile_error is not None
    assert fem.modifications.pinion.pitch_error == ()
    assert case("efficiency-involute-18-36").mesh.error_table is not None


def test_own_errors_are_added():
    given = {
        "error": {"unit": "um", "values": [3.0, 3.0]},
        "roll_angle": {"unit": "deg", "values": [-40, 40]},
    }
    alone = case("involute-23-47").mesh.error_table
    both = case("involute-23-47", mesh__transmission_error={"table": given}).mesh.error_table
    assert np.interp(alone[0], *both) == pytest.approx(alone[1] + 3e-6, abs=1e-12)


def test_misalignment_of_the_helix_tolerances():
    """√(f_Hβ1² + f_Hβ2²) over the common face, of class 6."""
    reference = case("load-contact-18-36", mesh__misalignment__from_quality=1.0, mesh__slices=None or 21)
    other = case("load-contact-18-36", mesh__misalignment__from_quality=2.0, mesh__slices=21)
    table = load("load-contact-18-36", GEARS).case.drive
    d = [1e3 * table.module * body.teeth for body in (table.pinion, table.gear)]
    b = [1e3 * body.face_width for body in (table.pinion, table.gear)]
    slopes = [np.sqrt(2) * (0.05 * d[i] ** 0.5 + 0.35 * b[i] ** 0.5 + 4) for i in (0, 1)]
    expected = np.hypot(*slopes) * 1e-3 / min(b)
    assert (
        other.mesh.modifications.misalignment.in_plane - reference.mesh.modifications.misalignment.in_plane
        == pytest.approx(expected)
    )


def test_the_edition_of_1995():
    """d 36 and 72 mm of module 2, class 6, in ranges 20 to 50, 50 to 125 and 0.5 to 2: f_pt by hand, µm."""
    found = case("load-contact-18-36", drive__module="2 mm", drive__quality_edition=1995).quality
    d, m = (50 * 125) ** 0.5, (0.5 * 2) ** 0.5
    assert found.single_pitch == pytest.approx(2**0.5 * (0.3 * (m + 0.4 * d**0.5) + 4) * 1e-6)
    assert found.edition == 1995
    with pytest.raises(InputError, match="1995 do not cover the gear: face width 1200 mm"):
        case("load-contact-18-36", drive__gear__face_width="1.2 m", drive__quality_edition=1995)


def test_what_is_refused():
    with pytest.raises(InputError, match="the back flanks carry"):
        case("involute-23-47", mesh__backlash="50 um", operating__gear_torque="-100 N*m")
    with pytest.raises(InputError, match="they have no quality"):
        load("involute-23-47", {"mesh.deviation_sample": 1})
    with pytest.raises(InputError, match=r"drive.gear.quality = 6.*face width"):
        load("involute-23-47", {"drive.gear.quality": 6, "drive.gear.face_width": "3 mm"})
    with pytest.raises(InputError, match="quality"):
        load("involute-23-47", {"drive.quality": 12})
