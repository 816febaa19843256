"""Gears that cannot be made or cannot run, and CSV files that cannot be read: one clear line each."""

from collections.abc import Callable
from pathlib import Path

import pytest

Refused = Callable[..., tuple[int, list[str]]]

GEOMETRY = {
    "undercut": ("drive.pinion.teeth=13", "drive.pinion.profile_shift", "undercut", "use at least"),
    "pointed tip": ("drive.pinion.profile_shift=1.4", "drive.pinion.", "pointed", "at most"),
    "contact ratio": (
        "drive.pinion.addendum=0.05",
        "drive.pinion.addendum",
        "contact ratio",
        "larger addenda",
    ),
    "bore": ("drive.pinion.bore_radius=34 mm", "drive.pinion.bore_radius", "", ""),
    "tip below the root": ("drive.gear.tip_radius=60 mm", "drive.gear.tip_radius", "", ""),
    "cutter's corner": ("drive.pinion.fillet_radius=0.9", "drive.pinion.fillet_radius", "", ""),
    "pressure angle": ("drive.pressure_angle=60 deg", "drive.pressure_angle", "45°", ""),
}


@pytest.mark.parametrize(("setting", "key", "rule", "remedy"), GEOMETRY.values(), ids=list(GEOMETRY))
def test_gears_that_cannot_be(
    refused: Refused, scenario: Path, setting: str, key: str, rule: str, remedy: str
):
    code, lines = refused("check", str(scenario), "--set", setting)
    assert code == 2
    (line,) = lines
    file, _, rest = line.partition(": ")
    assert file == "--set" or Path(file).is_file()
    assert rest.startswith(key)
    assert rule in rest
    assert remedy in rest


#: As users ask for gears that are not modelled: setting, what is said of it.
OTHER_GEARS = {
    "drive.type=herringbone": "double helical gears",
    "drive.type=bevel": "bevel, worm and hypoid gears",
}


@pytest.mark.parametrize("setting", ["drive.pinion.helix=15", 'drive.beta="15 deg"', "drive.family=helical"])
def test_a_helix_has_one_key(refused: Refused, scenario: Path, setting: str):
    code, (line,) = refused("check", str(scenario), "--set", setting)
    assert code == 2
    assert "the key of a helix is helix_angle" in line
    assert 'write helix_angle = "20 deg" in [drive]' in line


@pytest.mark.parametrize(
    "setting", ["stage.0.beta=0.3", 'stage.0.helix="15 deg"', "gear.wheel-1.helix_angle=0.3"]
)
def test_a_helix_of_a_train_stands_in_its_stage(refused: Refused, setting: str):
    code, (line,) = refused("check", "two-stage-reducer", "--set", setting)
    assert code == 2
    assert "the key of a helix is helix_angle" in line
    assert 'write helix_angle = "20 deg" in its [[stage]]' in line
    assert "[drive]" not in line


#: A helix that cannot be: settings, key of the message, rule, remedy.
HELICES = {
    "too steep": (['helix_angle="45 deg"'], "helix_angle = 45 deg", "less than 45 deg", "8 to 35 deg"),
    "negative": (['helix_angle="-15 deg"'], "helix_angle = -15 deg", "not be negative", 'hand = "left"'),
    "one hand": (
        ['helix_angle="15 deg"', "hand=left", "gear.hand=left"],
        'gear.hand = "left"',
        "opposite hands",
        'write "right"',
    ),
    "no angle": (["pinion.hand=left"], 'pinion.hand = "left"', "spur gears", 'helix_angle = "20 deg"'),
    "no such hand": (['helix_angle="15 deg"', "hand=up"], 'hand = "up"', "not one of", '"right" or "left"'),
    "wide": (
        ['helix_angle="30 deg"', 'pinion.face_width="0.9 m"', 'gear.face_width="0.9 m"'],
        "helix_angle = 30 deg",
        "an overlap ratio of",
        "at most",
    ),
}


@pytest.mark.parametrize(("settings", "key", "rule", "remedy"), HELICES.values(), ids=list(HELICES))
def test_a_helix_that_cannot_be(
    refused: Refused, scenario: Path, settings: list[str], key: str, rule: str, remedy: str
):
    given = [part for setting in settings for part in ("--set", f"drive.{setting}")]
    code, (line,) = refused("check", str(scenario), *given)
    assert code == 2
    assert f": drive.{key}: " in line
    assert rule in line
    assert remedy in line


@pytest.mark.parametrize(
    "setting", ["drive.gear.teeth=-60", "drive.gear.type=internal", "drive.ring.teeth=80"]
)
def test_an_internal_gear_has_one_key(refused: Refused, scenario: Path, setting: str):
    code, (line,) = refused("check", str(scenario), "--set", setting)
    assert code == 2
    assert "the key of an internal gear is internal" in line
    assert "write internal = true in [drive.gear]" in line


#: What a study says of an internal gear: scenario, settings, key, and a part of the message.
INTERNAL = [
    ("ehl-involute-23-47", [], "drive.gear.internal", "external gears alone"),
    ("ring-36-93", ["drive.pinion.internal=true"], "drive.pinion.internal", "[drive.gear]"),
    ("involute-18-36", [], "drive.gear.bore_radius", "outer_diameter"),
    ("ring-36-93", ["drive.gear.rim=pins"], "drive.gear.pins", "give pins"),
    ("ring-36-93", ["drive.gear.pins=12"], "drive.gear.pins", 'write rim = "pins"'),
    ("ring-36-93", ["drive.gear.rim=pins", "drive.gear.pins=2"], "drive.gear.pins", "3"),
    ("ring-36-93", ["drive.pinion.pins=12"], "drive.pinion.pins", "add internal = true"),
    ("ring-36-93", ["mesh.compliance=fem", "mesh.slices=7"], "mesh.slices", "even along the face"),
    ("ring-36-93", ["losses.windage=dawson"], "losses.windage", "external gears"),
    ("ring-36-93", ["temperature.model=iso"], "temperature.model", 'use "network"'),
]


@pytest.mark.parametrize(("name", "settings", "key", "says"), INTERNAL)
def test_studies_say_what_they_have_not_of_internal_gears(
    refused: Refused, name: str, settings: list[str], key: str, says: str
):
    given = [part for setting in settings or ["drive.gear.internal=true"] for part in ("--set", setting)]
    code, lines = refused("check", name, *given)
    assert code == 2
    assert any(key in line and says in line for line in lines)


#: As users ask for several stages of a pair of gears: setting, key of the message.
SEVERAL_STAGES = {
    "stages=2": "stages",
    "shafts.input=1": "shafts",
    "drive.gear2.teeth=40": "drive.gear2",
    "idler.teeth=30": "idler",
    "gear.wheel-1.teeth=40": "gear",
    "body=[]": "body",
    "kind=gearbox": "kind",
    "operating.input=pinion-1": "operating.input",
}


@pytest.mark.parametrize(("setting", "what"), OTHER_GEARS.items())
def test_gears_that_are_not_modelled(refused: Refused, scenario: Path, setting: str, what: str):
    code, (line,) = refused("check", str(scenario), "--set", setting)
    key = setting.partition("=")[0]
    assert code == 2
    assert f": {key}" in line or f": {key.rpartition('.')[0]} = " in line
    assert f"{what} are not modelled: this version computes spur and helical gears" in line


@pytest.mark.parametrize(
    ("name", "setting"),
    [
        ("", "kind=planetary"),
        ("", "drive.planets=3"),
        ("", "drive.carrier.speed=1"),
        ("two-stage-reducer", "planets=3"),
        ("two-stage-reducer", "carrier.speed=1"),
    ],
)
def test_planets_are_sent_to_their_stage(refused: Refused, scenario: Path, name: str, setting: str):
    code, (line,) = refused("check", name or str(scenario), "--set", setting)
    assert code == 2
    assert "planetary gears are a stage of a train" in line
    assert 'write a [[stage]] of type = "planetary" in a scenario of the kind for trains' in line


@pytest.mark.parametrize(("setting", "key"), SEVERAL_STAGES.items())
def test_several_stages_are_sent_to_the_kind_that_has_them(
    refused: Refused, scenario: Path, setting: str, key: str
):
    code, (line,) = refused("check", str(scenario), "--set", setting)
    assert code == 2
    assert f": {key} = " in line
    assert "several stages are of another kind of study; write [gear.NAME] and [[stage]]" in line


def test_a_planetary_gearbox_is_refused_once(refused: Refused, scenario: Path):
    stage = '[[stage]]\ntype = "planetary"\nplanets = 3\n[stage.ring]\nteeth = -80\n'
    scenario.write_text(f'title = "a wheel hub"\nkind = "gear-pair"\n{stage}', encoding="utf-8")
    code, (line,) = refused("run", str(scenario))
    assert code == 2
    assert line.startswith(f"{scenario}: stage = ")
    assert "kind for trains (tribodyn list kinds)" in line


@pytest.mark.parametrize("setting", ["operating.shaft_stifness=1", "drive.ringg=1", "drive.gear.teeth=-1"])
def test_other_mistakes_are_none_of_them(refused: Refused, scenario: Path, setting: str):
    _, (line,) = refused("check", str(scenario), "--set", setting)
    assert "not modelled" not in line


CURVES = {
    "empty": ("# nothing\n", "line 1", "the file is empty"),
    "no units": ("time,torque\n0,1\n1,2\n", "line 1", 'no column "time [unit]"'),
    "no column": ("time [s],load [N*m]\n0,1\n1,2\n", "line 1", 'no column "torque [unit]"'),
    "not a number": ("time [s],torque [N*m]\n0,1\n1,x\n", "line 3", '"x" is not a number (torque)'),
    "not finite": ("time [s],torque [N*m]\n0,1\n1,nan\n", "torque.values.1 = nan", "not a finite number"),
    "wrong unit": ("time [s],torque [N]\n0,1\n1,2\n", "operating.gear_torque_table", "not a unit of torque"),
    "not sorted": ("time [s],torque [N*m]\n0,1\n0,2\n", "operating.gear_torque_table", "does not increase"),
}


@pytest.mark.parametrize(("text", "place", "rule"), CURVES.values(), ids=list(CURVES))
def test_a_mistake_in_a_csv_file(refused: Refused, scenario: Path, text: str, place: str, rule: str):
    curve = scenario.with_name("load.csv")
    curve.write_text(text, encoding="utf-8")
    code, lines = refused("check", str(scenario), "--set", "operating.gear_torque_table=load.csv")
    assert code == 2
    assert lines
    for line in lines:
        assert line.startswith(f"{curve}: operating.gear_torque_table")
    assert place in lines[0]
    assert rule in lines[0]
