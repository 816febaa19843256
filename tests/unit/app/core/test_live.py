"""What is computed while a scenario is edited, against the command line's own and against second methods."""

import numpy as np
import pytest

from tests.support.verbs import complaints, invoke
from tribodyn.app.core.document import Document
from tribodyn.app.core.live import STAGES, Live, LiveRequest
from tribodyn.input.sources import shipped
from tribodyn.record.reader import Record
from tribodyn.studies.protocol.load import load

#: Quantities of a run that tell of the machine.
OF_THE_MACHINE = {"wall_time"}


@pytest.fixture(scope="module")
def live(tmp_path_factory):
    return Live(tmp_path_factory.mktemp("live"))


def of(document: Document, **more) -> LiveRequest:
    return LiveRequest(document.text, str(document.path), **more)


def edited(name: str, **values) -> Document:
    document = Document.open(name)
    for key, value in values.items():
        document.set(key.replace("__", "."), value)
    return document


def plain(value):
    """Numbers of a summary to be compared, NaN included."""
    if isinstance(value, dict):
        return {name: plain(one) for name, one in value.items() if name not in OF_THE_MACHINE}
    return np.asarray(value).tolist() if isinstance(value, np.ndarray) else value


@pytest.mark.parametrize(
    ("name", "key", "value"),
    [
        ("spur-25-51", "drive.pinion.profile_shift", 0.2),
        ("helical-23-47", "drive.gear.modification.tip_relief", "12 um"),
        ("two-stage-reducer", "gear.pinion-2.profile_shift", 0.1),
    ],
)
def test_what_is_shown_is_what_the_saved_file_gives(live, tmp_path, name, key, value):
    document = Document.open(name)
    document.set(key, value)
    shown = {stage: live.compute(stage, of(document)) for stage in ("motion", "check")}
    saved = document.save(tmp_path / "mine.toml")
    loaded = load(saved)
    result = loaded.study.run(loaded.case, tmp_path / "mine.h5")
    assert shown["motion"]["ok"]
    assert shown["check"]["ok"]
    with Record(result.path) as record:
        np.testing.assert_equal(plain(shown["motion"]["summary"]), plain(record.summary))
    checked = loaded.study.check(loaded.case)
    np.testing.assert_equal(shown["check"]["data"], checked.data)
    assert shown["check"]["warnings"] == list(checked.warnings)
    rows = {row["name"]: row for row in shown["motion"]["rows"]}
    assert rows["efficiency"]["value"] == pytest.approx(100.0 * result.summary["efficiency"], rel=1e-12)


def test_slow_rotation_is_what_a_slow_run_comes_to(live):
    """At 5 rpm without friction, with soft entry, and its bearings give besides."""
    slowly = {"operating__pinion_speed": "5 rpm", "friction__law": "none", "solver__method": "switching"}
    document = edited("involute-18-36-tip-relief", **slowly)
    document.unset("friction.coefficient")
    slow, run = (live.compute(stage, of(document)) for stage in ("static", "motion"))
    error = run["curves"]["transmission_error_rotational"]
    assert slow["peak_to_peak"][0] == pytest.approx(np.ptp(error), rel=2e-3)
    case = load("involute-18-36-tip-relief").case
    angle, base = case.pair.drive.pressure_angle, case.pair.drive.module * 18.0 * np.cos(np.radians(20.0))
    springs = sum(1.0 / bearing.stiffness_x for bearing in case.bearings)
    given = 1e6 * case.pair.operating.gear_torque / base * springs / np.cos(angle)  # at the pitch circles
    assert np.mean(error) == pytest.approx(np.mean(slow["transmission_error"]) + given, rel=2e-3)
    assert slow["harmonics"][0][:4] == pytest.approx(run["harmonics"][:4], rel=2e-3)
    assert np.max(slow["load"]) == pytest.approx(np.nanmax(run["curves"]["normal_load"]), rel=2e-3)


def test_loads_balance_the_torque_and_shares_are_whole(live):
    document = Document.open("spur-25-51")
    slow = live.compute("static", of(document))
    drive = load("spur-25-51").case.pair.drive
    base = drive.module * drive.gear.teeth / 2.0 * np.cos(drive.pressure_angle)
    assert np.sum(slow["load"], axis=1) == pytest.approx(550.0 / base, rel=1e-6)
    assert np.sum(slow["share"], axis=1) == pytest.approx(1.0)


def test_error_grows_with_the_torque_and_the_relief_turns_it(live):
    """With relief of the tips made for the nominal torque the error swings least there."""
    document = edited("involute-18-36-tip-relief")
    torques = live.compute("torques", of(document, torques=(0.25, 1.0, 2.0)))
    assert list(np.argsort(torques["torques"])) == [0, 1, 2]
    assert torques["nominal"] == 1
    assert np.all(np.diff(np.mean(torques["transmission_error"], axis=1)) > 0.0)
    assert torques["peak_to_peak"][1] < torques["peak_to_peak"][2]
    nominal = live.compute("static", of(document))
    assert torques["transmission_error"][1] == pytest.approx(nominal["transmission_error"][0])


@pytest.mark.parametrize("name", ["spur-25-51", "helical-23-47", "ring-36-93", "cycloidal-23-47"])
def test_flanks_touch_where_contacts_are_drawn(live, name):
    """At every third roll angle each contact lies on both outlines, turned as the page turns them."""
    shown = live.compute("geometry", of(Document.open(name)))
    for roll, contacts in list(zip(shown["rolls"], shown["contact"], strict=True))[::20]:
        for x, y in contacts[np.isfinite(contacts[:, 0])]:
            for gear in shown["gears"]:
                angle = gear["turn"] * roll
                cosine, sine = np.cos(angle), np.sin(angle)
                about = gear["outline"] @ np.array([[cosine, sine], [-sine, cosine]]) + gear["centre"]
                assert distance_to(about, (x, y)) < 4e-3 * shown["gears"][0]["tip_radius"] / 10.0


def distance_to(line: np.ndarray, point: tuple[float, float]) -> float:
    """Least distance of a point from a polygon."""
    start, end = line[:-1], line[1:]
    along = end - start
    length = np.maximum(np.sum(along**2, axis=1), 1e-30)
    share = np.clip(np.sum((np.array(point) - start) * along, axis=1) / length, 0.0, 1.0)
    return float(np.min(np.hypot(*(start + share[:, None] * along - np.array(point)).T)))


def test_gears_of_a_train_stand_and_turn_in_mesh(live):
    """Pitch circles touch at the azimuth of each mesh, and speeds there are equal."""
    shown = live.compute("geometry", of(Document.open("two-stage-reducer")))
    gears = {gear["name"]: gear for gear in shown["train"]["gears"]}
    case = load("two-stage-reducer").case
    for mesh, data in zip(shown["train"]["meshes"], case.meshes, strict=True):
        one, two = gears[mesh["driver"]], gears[mesh["driven"]]
        teeth = data.pair.drive.pinion.teeth, data.pair.drive.gear.teeth
        assert one["turn"] * teeth[0] == pytest.approx(-two["turn"] * teeth[1])
        apart = np.hypot(*np.subtract(one["centre"], two["centre"]))
        assert max(np.hypot(*one["outline"].T)) + max(np.hypot(*two["outline"].T)) > apart
    assert shown["meshes"] == ["first", "second"]
    assert shown["mesh"] == "first"
    other = live.compute("geometry", of(Document.open("two-stage-reducer"), mesh="second"))
    assert other["gears"][1]["teeth"] == 57


def test_planets_go_round_with_their_carrier(live):
    shown = live.compute("geometry", of(Document.open("planetary-24-84")))
    gears = {gear["name"]: gear for gear in shown["train"]["gears"]}
    planets = [gear for name, gear in gears.items() if "planet" in name]
    assert len(planets) >= 3
    assert {round(np.hypot(*np.subtract(one["centre"], one["about"])), 6) for one in planets} == {
        round(np.hypot(*np.subtract(planets[0]["centre"], planets[0]["about"])), 6)
    }
    # Willis: the sun turns (1 + 84/24) times as fast as the carrier
    sun = next(gear for name, gear in gears.items() if "sun" in name)
    assert sun["turn"] / planets[0]["orbit"] == pytest.approx(1.0 + 84.0 / 24.0)


@pytest.mark.parametrize("stage", STAGES)
@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("drive.pinion.teeth", "-5"),
        ("drive.module", "abc"),
        ("operating.gear_torque", "nan N*m"),
        ("drive.pinion.modification.tip_relief", "10 um"),
        ("drive.pinion.profile_shift", "9.0"),
        ("drive.pinion.bore_radius", "90 mm"),
    ],
)
def test_what_is_wrong_is_said_in_the_words_of_the_check(live, tmp_path, stage, key, value):
    document = edited("spur-25-51", **{key.replace(".", "__"): value})
    shown = live.compute(stage, of(document))
    document.path = tmp_path / "wrong.toml"
    document.path.write_text(document.text)
    again = live.compute(stage, of(document))
    assert not shown["ok"]
    assert "Traceback" not in shown["errors"][0]["text"]
    assert shown["errors"][0]["rule"] == again["errors"][0]["rule"]
    assert [error["text"] for error in again["errors"]] == complaints("check", document.path)


def test_of_a_study_without_gears_the_check_is_shown_and_nothing_is_wrong(live):
    document = Document.open("irefc")
    found = {stage: live.compute(stage, of(document)) for stage in STAGES}
    assert all(shown["ok"] for shown in found.values())
    told = {stage for stage, shown in found.items() if "start it by Run" in " ".join(shown["remarks"])}
    assert told == set(STAGES) - {"check"}
    sheet = invoke("check", "irefc", "--full")
    numbers = [row[-1] for table in found["check"]["tables"] for row in table["rows"]]
    assert len(numbers) > 4
    assert [number for number in numbers if number not in sheet] == []


def test_a_duty_without_torque_shows_teeth_and_says_why_nothing_is_loaded(live):
    document = edited("spur-25-51", operating__gear_torque="0 N*m", friction__law="none")
    document.set("film.law", "dowson-higginson")
    document.set("mesh.backlash", "0.1 mm")
    assert live.compute("geometry", of(document))["ok"]
    shown = live.compute("static", of(document))
    assert shown["ok"]
    assert "no torque" in shown["warnings"][0]


def test_safeties_are_those_of_an_assessment(live):
    """The same pair, oil and duty with K_A = 1, as the check of an assessment rates it."""
    rated = live.compute("check", of(edited("assessment-helical-24-95", assessment__application_factor=1.0)))
    iso = rated["data"]["iso"]
    document = Document.open("helical-23-47")
    document.set("drive", "helical-24-95")
    for key, value in Document.open("assessment-helical-24-95").written().items():
        if key in ("lubricant", "operating"):
            document.unset(key)
            document.set(key, value)
    shown = live.compute("strength", of(document))
    assert shown["ok"]
    for side, gear in zip(("pinion", "gear"), shown["gears"], strict=True):
        assert {row["name"]: row["value"] for row in gear} == pytest.approx(
            {name: iso[name][side] for name in ("S_H", "S_F")}, rel=1e-9
        )
    least = {row["name"]: row["value"] for row in shown["rows"]}
    assert least["S_H"] == pytest.approx(min(iso["S_H"].values()))
    assert {row["name"]: row["value"] for row in rated["rows"]} == pytest.approx(
        {name: least[name] for name in ("S_H", "S_F")}, rel=1e-9
    )
    assert any("K_A" in remark for remark in shown["remarks"])


def test_what_a_rating_lacks_is_said(live):
    shown = live.compute("strength", of(Document.open("spur-25-51")))
    assert shown["ok"]
    assert shown["rows"] == []
    assert any("tolerance class" in remark for remark in shown["remarks"])
    assert any("heat treatment" in remark for remark in shown["remarks"])


def test_a_model_that_was_edited_elsewhere_counts(live, tmp_path):
    drive = (shipped("models") / "drives" / "spur-25-51.toml").read_text()
    (tmp_path / "my-drive.toml").write_text(drive)
    document = Document.open("spur-25-51")
    document.set("drive", "my-drive.toml")
    document.save(tmp_path / "mine.toml")
    assert live.compute("geometry", of(document))["gears"][0]["teeth"] == 25
    (tmp_path / "my-drive.toml").write_text(drive.replace("teeth = 25", "teeth = 26"))
    assert live.compute("geometry", of(document))["gears"][0]["teeth"] == 26
