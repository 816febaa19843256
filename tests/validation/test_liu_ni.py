"""Liu & Ni (2022): rows of the published table, from runs of the shipped scenarios."""

import re

import pytest


@pytest.fixture(scope="module")
def rows(validated):
    return validated("liu-ni-2022")


def test_no_row_fails_and_no_load_stands_in_for_another(rows):
    assert [row.id for row in rows.values() if row.verdict == "fail"] == []
    loads = [rows[f"liu-ni/load-stcp-{model}"] for model in ("6dof", "mbd", "fem")]
    assert [row.verdict for row in loads] == ["pass", "reported", "reported"]
    assert loads[1].computed is None
    # whatever the teeth are made of: the torque over the arm, 500 N·m/(r_g cos α)
    assert loads[2].computed == pytest.approx(7694.0, rel=1e-3)


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
    assert len(claims) == 17
    assert all(row.note for row in claims)
    assert {row.id.removeprefix("liu-ni/claim-") for row in claims if row.verdict != "pass"} == {
        "dte-of-the-crc-drive-above-the-involute-s-lower",
        "sliding-friction-force-of-the-crc-drive-smaller",
        "load-above-the-fe-s",
    }


@pytest.mark.parametrize(
    ("claim", "figures"),
    [
        # of a separate evaluation of the records: films in nm, friction coefficients, mean efficiencies
        ("film-of-the-crc-drive-thicker-in-double-contact", [383, 330]),
        ("efficiency-of-the-crc-drive-higher", [0.9884, 0.9869]),
        ("contact-ratio-below-the-fe-s", [1.5233, 1.7405]),
    ],
)
def test_courses_have_their_figures(rows, claim, figures):
    note = rows[f"liu-ni/claim-{claim}"].note
    found = [float(text) for text in re.findall(r"\d+\.?\d*", note)]
    assert all(any(one == pytest.approx(value, rel=1e-3) for one in found) for value in figures), note


def test_the_transmission_error_is_that_along_the_normal(rows):
    """Figures of another evaluation of (6) from records, 0.01 µm; the rotational one is another claim."""
    above = rows["liu-ni/claim-dte-of-the-crc-drive-above-the-involute-s-lower"]
    figures = [float(text) for text in re.findall(r"\d+\.\d\d", above.note)]
    assert figures[:4] == pytest.approx([21.40, 21.46, 22.00, 22.32], abs=0.011)
    assert [other.computed for other in above.otherwise] == [True, True]
    raised = rows["liu-ni/claim-friction-raises-maximum-and-minimum-of-the-dte"]
    figures = [float(text) for text in re.findall(r"\d+\.\d\d", raised.note)]
    assert figures == pytest.approx([29.60, 31.55, 15.47, 15.86, 30.88, 32.60, 16.29, 16.55], abs=0.011)


def test_what_depends_on_a_choice_says_so(rows):
    standings = {key.partition("/")[2]: row.standing for key, row in rows.items()}
    others = {key for key, standing in standings.items() if standing == "under another choice"}
    assert others == {
        "friction-pair1-crc",
        "friction-pair1-involute",
        "claim-dte-of-the-crc-drive-above-the-involute-s-lower",
        "claim-sliding-friction-force-of-the-crc-drive-smaller",
    }
    assert {key for key, row in rows.items() if row.hangs_on_choice} == {
        "liu-ni/claim-friction-coefficient-of-the-crc-drive-below-the",
        "liu-ni/claim-friction-coefficient-of-the-crc-drive-constant",
    }
    friction = rows["liu-ni/friction-pair1-involute"]
    dynamic, mean_pressure = friction.otherwise
    assert dynamic.choice == "dynamic sliding, the default"
    # docs/validation.md#sensitivities: another tool's run with dynamic sliding
    assert dynamic.computed == pytest.approx(450.0, abs=1.0)
    # another evaluation, of (20) with the whole mean pressure on the recorded loads and motion: -2.4 %
    assert mean_pressure.difference == pytest.approx(-0.024, abs=1e-3)
    assert rows["liu-ni/contact-ratio-crc"].otherwise == ()  # does not depend on it
