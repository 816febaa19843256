"""Liu & Ni (2022): rows of the published table, from runs of the shipped scenarios."""

import pytest


@pytest.fixture(scope="module")
def rows(validated):
    return validated("liu-ni-2022")


def test_no_row_fails(rows):
    assert [row.id for row in rows.values() if row.verdict == "fail"] == []


#: Check values of physics.md from separate prototypes of the restored equations: 6-DOF, pair 1 / pair 0.
INDEPENDENT = {
    "liu-ni/load-stcp-6dof": (7694.0, 0.003),
    "liu-ni/friction-pair1-crc": (531.0, 0.03),
    "liu-ni/friction-pair0-crc": (192.0, 0.03),
    "liu-ni/friction-pair1-involute": (474.0, 0.03),
    "liu-ni/friction-pair0-involute": (240.0, 0.03),
    "liu-ni/efficiency-crc": (0.9882, 0.0005),
    "liu-ni/efficiency-involute": (0.9867, 0.0005),
}


@pytest.mark.parametrize("key", INDEPENDENT)
def test_numbers_agree_with_an_independent_prototype(rows, key):
    expected, relative = INDEPENDENT[key]
    assert rows[key].computed == pytest.approx(expected, rel=relative)


def test_claims_carry_their_figures(rows):
    claims = [row for row in rows.values() if row.tolerance_kind == "claim"]
    assert len(claims) == 8
    for row in claims:
        assert row.verdict in ("pass", "reported")
        assert row.note


def test_what_holds_under_kinematic_sliding_only_says_so(rows):
    assert [key for key, row in rows.items() if row.hangs_on_choice] == [
        "liu-ni/friction-pair1-involute",
        "liu-ni/claim-friction-coefficient-of-the-crc-drive-below-the",
    ]
    friction = rows["liu-ni/friction-pair1-involute"]
    assert friction.otherwise.choice == "dynamic sliding, the default"
    # docs/validation.md#sensitivities: another tool's run with dynamic sliding
    assert friction.otherwise.computed == pytest.approx(450.0, abs=1.0)
    assert friction.otherwise.verdict == "fail"
    assert rows["liu-ni/contact-ratio-crc"].otherwise is None  # does not depend on it
