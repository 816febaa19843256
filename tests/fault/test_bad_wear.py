"""Wear that cannot be studied: one clear line each, exit status 2, nothing written."""

from collections.abc import Callable
from pathlib import Path

import pytest

Refused = Callable[..., tuple[int, list[str]]]

STUDY = "wear-18-36"
COEFFICIENT = "wear.coefficient = "
#: Settings; the key that is named, what the rule says and what the remedy.
MISTAKES = {
    "no wear": (("wear.coefficient=0 m**2/N",), "wear.coefficient = ", "must be greater than zero", "write"),
    "negative wear": (
        ("wear.coefficient=-1e-18 m**2/N",),
        "wear.coefficient = ",
        "greater than zero",
        "write",
    ),
    "a coefficient without a unit": (
        ("wear.coefficient=1e-18",),
        "wear.coefficient = ",
        "without a unit",
        "m**2/N",
    ),
    "a coefficient in another unit": (
        ("wear.coefficient=1e-18 m/N",),
        "wear.coefficient",
        "not a unit",
        "m**2/N",
    ),
    "no revolutions": (("wear.revolutions=0",), "wear.revolutions = 0", "greater than 0", ""),
    "unknown law": (("wear.law=archimedes",), "wear.law = ", "no such wear law", "archard"),
    "unknown key": (("wear.hardness=3",), "wear.hardness = 3", "unknown key", "coefficient"),
    "another law's key": (
        ("wear.energy_coefficient=1e-8 mm**3/J",),
        "wear.energy_coefficient",
        'it is a key of law = "energy"',
        "leave energy_coefficient out",
    ),
    "an energy law without a coefficient": (
        ("wear.law=energy",),
        "wear.energy_coefficient",
        "missing",
        "add",
    ),
    "films in the wrong order": (
        ("wear.separating_film_parameter=0.3",),
        "wear.separating_film_parameter = 0.3",
        "must be above boundary_film_parameter, 0.5",
        "write a larger number",
    ),
    "a step that moves all": (("wear.load_change=0.5",), "wear.load_change = 0.5", "0.2", ""),
    "too many records": (("output.every=1",), "output.every = 1", "more than 100000 records", "larger"),
    "teeth alike that differ": (
        (f"drive.pinion.modification.pitch_errors={['1 um'] * 18}",),
        "drive.pinion.modification.pitch_errors",
        'contradicts wear.teeth = "alike"',
        'wear.teeth = "each"',
    ),
    "a gear that drives": (
        ("operating.gear_torque=-100 N*m",),
        "operating.gear_torque = -100 N*m",
        "must be greater than zero",
        "write a torque",
    ),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_it_is_refused_in_one_line(mistake: str, refused: Refused, tmp_path: Path):
    settings, *parts = MISTAKES[mistake]
    words = [word for setting in settings for word in ("--set", setting)]
    status, lines = refused("run", STUDY, *words, "-o", str(tmp_path / "worn.h5"))
    assert status == 2
    (line,) = lines
    for part in parts:
        assert part in line
    assert not list(tmp_path.glob("worn*"))


DRY = """title = "Dry"
kind = "wear"
drive = "diez-ibarbia-18-36"
[operating]
pinion_speed = "150 rpm"
gear_torque = "300 N*m"
[wear]
law = "LAW"
revolutions = 1e6
"""
#: Of flanks without a lubricant: law, further tables; the key that is named and what the rule says.
WITHOUT_OIL = {
    "a law of the film": ("priest-taylor", "", "wear.law", "there is no lubricant"),
    "asperities under a film": ("archard-asperities", "", "wear.law", "there is no lubricant"),
    "a film law": ("archard", '[film]\nlaw = "moes"\n', "film", "without a lubricant there is no film"),
    "a law of oil": ("archard", '[friction]\nlaw = "xu"\n', "friction.law", "of lubricated flanks"),
    "energy without friction": (
        "energy",
        "",
        "wear.law",
        "goes by friction, and there is none",
    ),
}


@pytest.mark.parametrize("mistake", WITHOUT_OIL)
def test_without_a_lubricant(mistake: str, refused: Refused, tmp_path: Path):
    law, more, key, rule = WITHOUT_OIL[mistake]
    path = tmp_path / "dry.toml"
    text = DRY.replace("LAW", law)
    if law == "energy":
        text += 'energy_coefficient = "1e-8 mm**3/J"\n'
    path.write_text(text + more, encoding="utf-8")
    status, (line,) = refused("run", str(path), "-o", str(tmp_path / "worn.h5"))
    assert status == 2
    assert line.startswith(f"{path}: {key}")
    assert rule in line


def test_another_scenario_does_not_go_on(refused: Refused, tmp_path: Path):
    from tribodyn.studies.protocol.load import load_scenario
    from tribodyn.studies.protocol.run import run

    path = tmp_path / "worn.h5"
    keys = {"wear.revolutions": 1e6, "output.every": 1e6, "output.positions_per_cycle": 12}
    run(load_scenario(STUDY, keys), path)
    words = ("--set", "operating.gear_torque=200 N*m", "--resume", "-o", str(path))
    status, (line,) = refused("run", STUDY, *words)
    assert status == 2
    assert "--resume" in line
    assert "made from another scenario" in line
