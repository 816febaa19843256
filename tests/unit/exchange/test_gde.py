"""GDE files: what they may look like, what is refused, and that nothing is lost on the way out and in.

No file of a measuring machine was at hand: these are the project's own.
"""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tribodyn as td
from tests.support.verbs import complaint, invoke, sets
from tribodyn.exchange.gde.gde_reading import read
from tribodyn.exchange.gde.gde_writing import text_of
from tribodyn.exchange.measured_gear import (
    DIAMETER,
    HELIX,
    LEFT,
    PROFILE,
    RIGHT,
    ROLL_ANGLE,
    FlankTrace,
    MeasuredGear,
    NominalGear,
)
from tribodyn.gears.measured.from_scenario import measured_of
from tribodyn.studies.measured_flanks import import_measured, mounted
from tribodyn.studies.protocol.load import load

HELICAL, SPUR = "helical-23-47", "involute-23-47"


def gde(inside: str, root: str = "gear_data_exchange_format", gear: str = "") -> str:
    return f"<{root}><gear>{gear}<inspection>{inside}</inspection></gear></{root}>"


def profile(points: str, more: str = "<tooth>1</tooth><flank>left</flank>") -> str:
    return f"<profile_measurement>{more}{points}</profile_measurement>"


POINTS = '<roll_length>1 2 3</roll_length><deviation unit="um">0 1 2</deviation>'


def written(tmp_path: Path, text: str | bytes) -> Path:
    path = tmp_path / "gear.gde"
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return path


def same(one: MeasuredGear, two: MeasuredGear) -> None:
    for a, b in zip(one.traces, two.traces, strict=True):
        assert (a.kind, a.tooth, a.flank, a.over) == (b.kind, b.tooth, b.flank, b.over)
        assert (a.at or 0.0) == pytest.approx(b.at or 0.0, rel=1e-11)
        assert (a.evaluated or 0.0) == pytest.approx(b.evaluated or 0.0, rel=1e-11)
        np.testing.assert_allclose(a.place, b.place, rtol=1e-11)
        np.testing.assert_allclose(a.deviation, b.deviation, rtol=1e-11, atol=1e-18)
    assert one.pitch.keys() == two.pitch.keys()
    for flank in one.pitch:
        np.testing.assert_allclose(one.pitch[flank], two.pitch[flank], rtol=1e-11)


def test_what_is_written_is_read_again(tmp_path: Path):
    rng, place = np.random.default_rng(1), np.array([3e-3, 7.1e-3, 13e-3])
    traces = (
        FlankTrace(PROFILE, 1, LEFT, place, rng.normal(size=3) * 1e-6, 5e-3, (4e-3, 12e-3)),
        FlankTrace(HELIX, 7, RIGHT, place, rng.normal(size=3) * 1e-6, 62e-3),
    )
    nominal = NominalGear(9, False, 3e-3, math.radians(20), 0.2, "left", -0.13, 20e-3, 33e-3)
    index = {RIGHT: rng.normal(size=9) * 1e-6}
    gear = MeasuredGear(nominal, traces, index, rng.normal(size=9) * 1e-6, 61e-3, 'p < "1"')
    found = read(written(tmp_path, text_of(gear, "written -- by a test")))
    same(gear, found)
    for said, due in zip(found.nominal, nominal, strict=True):
        assert said == (pytest.approx(due, rel=1e-11) if isinstance(due, float) else due)
    assert (found.name, found.diameter) == (gear.name, pytest.approx(61e-3))
    np.testing.assert_allclose(found.radial, gear.radial, rtol=1e-11)


@pytest.mark.parametrize(
    "text",
    [
        gde(profile(POINTS)),
        gde(profile(POINTS), "g:Gear-Data-Exchange").replace("<g:", "<g:", 1),
        gde(f'<profile_measurement tooth="1" flank="L">{POINTS}</profile_measurement>'),
        gde(
            f"<profiles><Profile-Trace><tooth_number>1</tooth_number><side>links</side>{POINTS}</Profile-Trace></profiles>"
        ),
        gde(profile(POINTS.replace("1 2 3", "1; 2;3").replace('"um"', '"µm"'))),
        gde(profile(POINTS.replace("um", "mm").replace("0 1 2", "0 1e-3 2e-3"))),
        gde(
            profile(
                "".join(
                    f'<point><roll_length>{i + 1}</roll_length><deviation unit="um">{i}</deviation></point>'
                    for i in range(3)
                )
            )
        ),
    ],
    ids=["plain", "prefix and hyphens", "attributes", "words", "separators", "mm", "points"],
)
def test_the_same_profile_in_other_words(text: str, tmp_path: Path):
    (trace,) = read(written(tmp_path, text)).traces
    assert (trace.kind, trace.tooth, trace.flank) == (PROFILE, 1, LEFT)
    assert trace.place == pytest.approx([1e-3, 2e-3, 3e-3])
    assert trace.deviation == pytest.approx([0.0, 1e-6, 2e-6], abs=1e-15)


def test_angles_and_diameters_of_the_involute(tmp_path: Path):
    """L = r_b ξ = √(r² − r_b²)."""
    base, length = 30e-3, np.array([5e-3, 10e-3, 20e-3])
    angles, diameters = np.degrees(length / base), 2e3 * np.hypot(length, base)
    for name, values, over in (("roll_angle", angles, ROLL_ANGLE), ("diameter", diameters, DIAMETER)):
        numbers = " ".join(f"{value:.15g}" for value in values)
        text = gde(profile(f'<{name}>{numbers}</{name}><deviation unit="um">0 1 2</deviation>'))
        (trace,) = read(written(tmp_path, text)).traces
        assert trace.over == over
        assert trace.over_roll_length(base).place == pytest.approx(length)


def test_single_pitch_deviations_are_added_up(tmp_path: Path):
    single = '<single_pitch_deviation unit="um">1 -2 4 -3</single_pitch_deviation>'
    text = gde(f"<pitch><flank>r</flank>{single}</pitch>")
    assert read(written(tmp_path, text)).pitch[RIGHT] == pytest.approx([1e-6, -1e-6, 3e-6, 0.0], abs=1e-15)


BOMB = '<!DOCTYPE x [<!ENTITY a "ha"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">]>'


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "line 1: not XML"),
        ("tooth;deviation", "line 1: not XML"),
        (gde(profile(POINTS))[:-9], "line 1: not XML"),
        (BOMB + gde(profile("&b;")), "declares a document type or entities, which GDE has not"),
        ('<!DOCTYPE x SYSTEM "file:///etc/passwd">' + gde(profile(POINTS)), "declares a document type"),
        ("<model/>", 'its first element is "model": no GDE that is known'),
        ("<gde>" + "<gear>" * 20 + "</gear>" * 20 + "</gde>", "more than 12 elements inside each other"),
        ("<gde/>", "no profile, helix, pitch or runout measurement"),
        (gde("<topography>1</topography>"), "<topography>: no measurement that is known"),
        (gde(profile(POINTS + "<filter>3</filter>")), "<filter>: is not known in <profile_measurement>"),
        (gde(profile(POINTS.replace(' unit="um"', ""))), "<deviation>: its unit is not said"),
        (gde(profile(POINTS.replace("um", "furlong"))), '"furlong" is no unit of length'),
        (gde(profile(POINTS.replace("um", "deg"))), '"deg" is no unit of length'),
        (gde(profile(POINTS.replace("0 1 2", "0 1"))), "3 places and 2 deviations"),
        (gde(profile(POINTS.replace("0 1 2", "0 1 nan"))), '"nan" is no number'),
        (gde(profile(POINTS.replace("0 1 2", "0,5 1 2"))), '"0,5" is no number'),
        (gde(profile(POINTS.replace("0 1 2", "0 1_0 2"))), '"1_0" is no number'),
        (gde(profile(POINTS.replace("1 2 3", "1 3 2"))), "its points go forth and back"),
        (gde(profile(POINTS, "<flank>left</flank>")), "no tooth_number that is a whole number"),
        (gde(profile(POINTS, "<tooth>1</tooth>")), "says no flank"),
        (gde(profile(POINTS, "<tooth>1</tooth><flank>top</flank>")), "says no flank"),
        (gde(profile(POINTS) + profile("<deviation>1</deviation>")), "nothing says where its points are"),
        (gde(profile(POINTS + "<evaluation_end>2</evaluation_end>")), "one end of the evaluation range"),
        ("<gde><gear/><gear/></gde>", "a second gear in the file"),
        (gde(profile(POINTS), gear="<geometry><teeth>9.5</teeth></geometry>"), "9.5 is no whole number"),
        (gde(profile(POINTS), gear="<geometry><hand>up</hand></geometry>"), '"up" is no hand'),
    ],
)
def test_what_is_refused_and_by_which_element(text: str, said: str, tmp_path: Path):
    path = written(tmp_path, text)
    with pytest.raises(td.InputError) as caught:
        read(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


def test_what_is_not_used_is_listed(tmp_path: Path):
    gear = "<identification><order>7</order></identification><geometry><span>3</span></geometry>"
    remarks = read(written(tmp_path, gde(profile(POINTS), gear=gear))).remarks
    assert remarks == ("not used: <identification>", "not used: <span>")


ERRORS = {
    "modification.pitch_errors": [f"{3 * math.sin(i):.4f} um" for i in range(23)],
    "eccentricity": "9 um",
    "eccentricity_angle": "40 deg",
}


def table(seed: int, separable: bool) -> dict[str, Any]:
    """Errors of some teeth, as a profile and a helix or as a whole surface."""
    rng, height, face = np.random.default_rng(seed), np.linspace(0.0, 1.0, 5), np.linspace(-12.0, 12.0, 4)
    teeth = [1.0, 8.0, 9.0]
    rest = 0.0 if separable else rng.normal(size=(3, 5, 4))
    error = 3.0 * rng.normal(size=(3, 5, 1)) + 2.0 * rng.normal(size=(3, 1, 4)) + rest
    grid = np.meshgrid(teeth, height, face, indexing="ij")
    columns = dict(zip(("tooth", "height", "face", "error"), (*grid, error), strict=True))
    units = {"face": "mm", "error": "um"}
    return {
        name: {"unit": units.get(name, "1"), "values": values.ravel().tolist()}
        for name, values in columns.items()
    }


@pytest.mark.parametrize("name", [SPUR, HELICAL])
@pytest.mark.parametrize("separable", [True, False])
@pytest.mark.parametrize("datum", ["start", "end"])
def test_from_a_scenario_and_back_into_it_nothing_is_lost(
    name: str, separable: bool, datum: str, tmp_path: Path
):
    """Material that is missing on both flanks of every tooth, wherever it is looked at."""
    errors = {"tooth_errors": table(1, separable), "tooth_errors_back": table(2, separable)}
    changes = {f"drive.pinion.{key}": value for key, value in ERRORS.items()}
    changes |= {f"drive.pinion.modification.{key}": value for key, value in errors.items()}
    changes["solver.cycles"] = 1081
    path = tmp_path / "pinion.gde"
    gear = mounted(load(name, changes))["pinion"]
    path.write_text(text_of(measured_of(gear, datum), ""), encoding="utf-8")
    target = tmp_path / "back.toml"
    import_measured([(path, read(path))], name, "pinion", datum, target)
    again = mounted(load(target, {"solver.cycles": 1081}))["pinion"]
    height, face = np.linspace(0.0, 1.0, 5), np.array([-12.0, -4.0, 4.0, 12.0]) * 1e-3
    for flank in (0, 1):
        places = gear.flanks[flank].places(height, face)
        for tooth in range(23):
            before, after = (
                sum(own.gap for each in one.own if (own := each.fields(tooth, flank, places)) is not None)
                for one in (gear, again)
            )
            np.testing.assert_allclose(after, before, rtol=0.0, atol=2e-12)


def test_another_gear_is_refused(tmp_path: Path):
    geometry = "<geometry><number_of_teeth>24</number_of_teeth></geometry>"
    path = written(tmp_path, gde(profile(POINTS), gear=geometry))
    said = complaint("import", path, "--into", SPUR, "--gear", "pinion", folder=tmp_path)
    assert "drive.pinion: teeth: 24 in the measurement, 23 in the scenario" in said
    into = "--into", SPUR, "--gear"
    said = complaint("import", path, *into, "pinoin", folder=tmp_path)
    assert 'did you mean "pinion"?' in said
    assert "the gear is not said" in complaint("import", path, "--into", SPUR, folder=tmp_path)
    alike = "--into", "efficiency-involute-18-36", "--gear", "gear"
    assert "takes all teeth" in complaint("import", path, *alike, folder=tmp_path)
    for option in ("--gear", "--datum", "-o"):
        said = complaint("import", path, option, "pinion", folder=tmp_path)
        assert "add --into SCENARIO" in said
    assert "no end of the face" in complaint(
        *("import", path, *into, "gear", "--datum", "up"), folder=tmp_path
    )


def test_what_was_measured_beside_the_gear_or_twice_is_refused(tmp_path: Path):
    into = "--into", SPUR, "--gear"
    far = written(tmp_path, gde(profile(POINTS.replace("1 2 3", "100 200 300"))))
    assert "is beyond contact" in complaint("import", far, *into, "pinion", folder=tmp_path)
    helix = POINTS.replace("roll_length", "face_position").replace("1 2 3", "100 200 300")
    helix = profile(helix).replace("profile_", "helix_")
    beside = written(tmp_path, gde(helix))
    assert "beside a face of 25 mm" in complaint("import", beside, *into, "pinion", folder=tmp_path)
    twice = written(tmp_path, gde(2 * profile(POINTS.replace("1 2 3", "10 20 30"))))
    assert "measured twice" in complaint("import", twice, *into, "pinion", folder=tmp_path)
    short = POINTS.replace("1 2 3", "10 20 30") + "<evaluation_begin>40</evaluation_begin>"
    outside = written(tmp_path, gde(profile(short + "<evaluation_end>50</evaluation_end>")))
    said = complaint("import", outside, folder=tmp_path)
    assert "profile of tooth 1, left flank: has fewer than three points in its evaluation range" in said
    assert [each.name for each in tmp_path.iterdir()] == ["gear.gde"]


def test_the_verb_evaluates_and_writes(tmp_path: Path):
    changes = sets({"drive.pinion.eccentricity": "10 um", "solver.cycles": 1081})
    invoke("export", SPUR, "--to", "gde", "-o", "p.gde", *changes, folder=tmp_path)
    printed = invoke("import", "p.gde", folder=tmp_path)
    assert "runout F_r: 19.9 µm" in printed
    assert "by ISO 1328-1:2013: class" in printed
    invoke("import", "p.gde", "--into", SPUR, "--gear", "pinion", folder=tmp_path)
    made = td.scenario(tmp_path / f"{SPUR}-measured.toml", {"solver.cycles": 1081})
    assert made.pair.teeth[0][0].eccentricity == pytest.approx(10e-6, rel=1e-9)
    again = "import", "p.gde", "--into", SPUR, "--gear", "pinion"
    assert "--force" in complaint(*again, folder=tmp_path)
    data = json.loads(invoke(*again, "--force", "--json", folder=tmp_path))
    assert {each["name"] for each in data["evaluation"]["deviations"]} >= {"runout", "total_pitch"}
    assert data["evaluation"]["class"] == 6
    said = complaint("export", SPUR, "--to", "gde", "-o", "q.gde", folder=tmp_path)
    assert "its teeth have no deviations of their own" in said
