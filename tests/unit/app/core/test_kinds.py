"""Gears of studies of kinds that do not move, as they are shown while they are edited."""

import numpy as np
import pytest

from tests.support.verbs import complaints
from tribodyn.app.core.document import Document
from tribodyn.app.core.live import Live, LiveRequest
from tribodyn.studies.protocol.load import load


@pytest.fixture(scope="module")
def live(tmp_path_factory):
    return Live(tmp_path_factory.mktemp("live"))


def of(document: Document, **more) -> LiveRequest:
    return LiveRequest(document.text, str(document.path), **more)


def written(folder, text: str) -> Document:
    path = folder / "mine.toml"
    path.write_text(text)
    return Document.open(path)


@pytest.mark.parametrize(
    ("name", "teeth", "meshes"),
    [
        ("efficiency-involute-18-36", [18, 36], [""]),
        ("load-contact-shafts", [23, 47], [""]),
        ("wear-18-36", [18, 36], [""]),
        ("ehl-involute-23-47", [23, 47], [""]),
        ("assessment-helical-24-95", [24, 95], [""]),
        ("design-shift-23-47", [23, 47], [""]),
        ("map-two-stage-reducer", [23, 69], ["first", "second"]),
    ],
)
def test_teeth_of_any_kind_are_shown(live, name, teeth, meshes):
    shown = live.compute("geometry", of(Document.open(name)))
    assert shown["ok"]
    assert [gear["teeth"] for gear in shown["gears"]] == teeth
    assert shown["meshes"] == meshes
    assert (shown["train"] is not None) is (len(meshes) > 1)
    still = live.compute("motion", of(Document.open(name)))
    assert "start it by Run" in still["remarks"][0]
    assert "curves" not in still


@pytest.mark.parametrize("name", ["load-contact-18-36", "load-contact-misaligned"])
def test_slow_rotation_is_that_of_a_load_contact_study(live, tmp_path, name):
    """The study presses the teeth at each position; the page reads a table of secants at the load."""
    document = Document.open(name)
    slow = live.compute("static", of(document))
    loaded = load(document.save(tmp_path / "mine.toml"))
    run = loaded.study.run(loaded.case, tmp_path / "mine.h5").summary
    error = slow["transmission_error"][0]
    assert np.mean(error) == pytest.approx(1e6 * run["loaded_transmission_error_mean"], rel=5e-3)
    assert np.ptp(error) == pytest.approx(1e6 * run["loaded_transmission_error_peak_to_peak"], rel=1e-2)
    assert np.max(slow["load"]) == pytest.approx(run["normal_load_max"], rel=5e-3)


def test_a_mesh_of_a_mapped_train_is_that_of_the_train(live):
    mapped, train = Document.open("map-two-stage-reducer"), Document.open("two-stage-reducer")
    for stage, name in (("geometry", "contact"), ("static", "transmission_error"), ("torques", "torques")):
        one, other = (live.compute(stage, of(each, mesh="second")) for each in (mapped, train))
        np.testing.assert_array_equal(one[name], other[name])


def test_a_search_is_shown_as_it_begins(live, tmp_path):
    """Values beyond their range are at its nearest end."""
    search = written(
        tmp_path,
        """
        title = "Search"
        kind = "design"
        [scenario]
        like = "ehl-involute-23-47"
        [scenario.drive]
        like = "liu-ni-involute-23-47"
        [scenario.drive.pinion]
        profile_shift = 0.5
        [design]
        minimise = "friction_coefficient_mean"
        free = [
            { key = "drive.pinion.profile_shift", from = -0.1, to = 0.2 },
            { key = "drive.gear.profile_shift", from = 0.1, to = 0.3 },
        ]
        """,
    )
    begun = live.compute("geometry", of(search))
    assert begun["errors"] == []
    assert begun["remarks"] == [
        "Shown is the start of the search: drive.pinion.profile_shift = 0.2, drive.gear.profile_shift = 0.1."
    ]
    pair = Document.open("ehl-involute-23-47")
    for side, shift in (("pinion", 0.2), ("gear", 0.1)):
        pair.set(f"drive.{side}.profile_shift", shift)
    alone = live.compute("geometry", of(pair))
    assert begun["tables"] == alone["tables"]
    np.testing.assert_array_equal(begun["gears"][0]["outline"], alone["gears"][0]["outline"])


def test_what_is_wrong_within_a_scenario_is_named_as_by_the_check(live, tmp_path):
    broken = written(
        tmp_path,
        """
        title = "Map"
        kind = "map"
        [scenario]
        like = "spur-25-51"
        [scenario.drive]
        like = "spur-25-51"
        [scenario.drive.pinion]
        bore_radius = "90 mm"
        """,
    )
    (error,) = live.compute("geometry", of(broken))["errors"]
    assert error["key"] == "scenario.drive.pinion.bore_radius"
    (said,) = complaints("check", broken.path)
    assert error["rule"] in said


def test_helical_teeth_by_finite_elements_are_shown_by_the_energy_method(live):
    """An assessment presses them by finite elements; that the page does not is said."""
    shown = live.compute("geometry", of(Document.open("assessment-helical-24-95")))
    assert any("energy method" in remark for remark in shown["remarks"])
    rated = live.compute("strength", of(Document.open("assessment-helical-24-95")))
    assert "those of the check" in rated["remarks"][0]


def test_safeties_of_an_oiled_pair_are_those_of_its_motion(live):
    """Whatever the kind, the standard rates the same pair, oil and duty."""
    motion = Document.open("helical-23-47")
    motion.set("drive", "helical-24-95")
    contact = Document.open("efficiency-helical-24-95")
    for key in ("lubricant", "operating"):
        value = contact.written()[key]
        motion.unset(key)
        motion.set(key, value)
    one, other = (
        [row["value"] for row in live.compute("strength", of(each))["rows"]] for each in (motion, contact)
    )
    assert len(one) == 3
    assert one == pytest.approx(other, rel=1e-9)


@pytest.mark.parametrize(
    ("name", "key", "value", "mesh"),
    [
        ("ehl-involute-23-47", "drive.gear.profile_shift", 0.1, ""),
        ("efficiency-involute-18-36", "operating.gear_torque", "200 N*m", ""),
        ("map-two-stage-reducer", "scenario.gear.pinion-2.profile_shift", 0.1, "second"),
    ],
)
def test_numbers_are_those_of_the_check_of_the_saved_file(live, tmp_path, name, key, value, mesh):
    document = Document.open(name)
    document.set(key, value)
    geometry, check = (live.compute(stage, of(document, mesh=mesh)) for stage in ("geometry", "check"))
    loaded = load(document.save(tmp_path / "mine.toml"))
    checked = loaded.study.check(loaded.case)
    np.testing.assert_equal(check["data"], checked.data)
    printed = {table.title: list(table.rows) for table in (*checked.tables, *checked.details)}
    for table in geometry["tables"]:
        rows = [tuple(row) for row in table["rows"]]
        assert rows == printed.get(table["title"], rows)[: len(rows)]
    assert {table["title"] for table in geometry["tables"]} <= {*printed} or mesh


def test_the_drive_of_a_scenario_within_one_is_changed_key_by_key(live):
    """A model of a scenario that is itself a model is written as one that is like it."""
    search = Document.open("design-tip-relief-18-36")
    search.set("scenario.drive.gear.modification.tip_relief", "12 um")
    assert search.messages() == ()
    shown = live.compute("geometry", of(search))
    assert "drive.gear.modification.tip_relief = 12.0 um" in shown["remarks"][0]
    assert "operating.gear_torque = 100 N*m" in shown["remarks"][0]
    assert live.compute("static", of(search))["torques"] == pytest.approx(100.0)  # of the first duty
    assert [gear["teeth"] for gear in shown["gears"]] == [18, 36]


def test_a_start_that_cannot_be_made_is_no_mistake_of_the_search(live):
    """Its check passes, as others of its candidates can be made."""
    search = Document.open("design-shift-23-47")
    search.set("scenario.drive.centre_distance", "104 mm")
    shown = {stage: live.compute(stage, of(search)) for stage in ("geometry", "static", "strength", "check")}
    assert [result["errors"] for result in shown.values()] == [[]] * 4
    assert "overlap" in shown["geometry"]["remarks"][0]


def test_safeties_of_each_mesh_are_those_of_the_assessment(live, tmp_path):
    """With all factors 1 they are those of the train itself, mesh by mesh."""
    assessed = written(
        tmp_path,
        """
        title = "Train"
        kind = "assessment"
        [scenario]
        like = "two-stage-reducer"
        quality = 6
        [assessment]
        samples = 0
        """,
    )
    train = Document.open("two-stage-reducer")
    train.set("quality", 6)
    for mesh in ("first", "second"):
        rated, own = (
            {row["name"]: row["value"] for row in live.compute(stage, of(document, mesh=mesh))["rows"]}
            for stage, document in (("check", assessed), ("strength", train))
        )
        assert set(rated) == {"S_H", "S_F"}
        tables = live.compute("check", of(assessed, mesh=mesh))["tables"]
        (factors,) = [table["rows"] for table in tables if table["title"] == f"ISO 6336, {mesh}"]
        (pitting,) = [row[1:3] for row in factors if row[0] == "Pitting S_H"]
        assert min(map(float, pitting)) == pytest.approx(rated["S_H"], abs=0.006)
        assert rated == pytest.approx({name: own[name] for name in rated}, rel=1e-9)


def test_a_start_that_breaks_a_rule_is_said_by_the_check_in_its_words(live, tmp_path):
    search = written(
        tmp_path,
        """
        title = "Search"
        kind = "design"
        [scenario]
        like = "efficiency-involute-18-36"
        [design]
        minimise = "loss"
        free = [{ key = "drive.pinion.modification.tip_relief", from = "5 um", to = "20 um" }]
        """,
    )
    shown, checked = (live.compute(stage, of(search)) for stage in ("geometry", "check"))
    assert "cannot be shown" in shown["remarks"][0]
    assert [error["text"] for error in checked["errors"]] == complaints("check", search.path)
