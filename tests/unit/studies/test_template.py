"""Every tooth family that the comments of a template offer can be chosen as they say."""

import re
from pathlib import Path

import pytest

from tribodyn.geometry.families import FAMILIES
from tribodyn.input.sources import shipped
from tribodyn.studies.protocol.load import filled, load


@pytest.mark.parametrize("name", list(FAMILIES))
def test_every_family_can_be_chosen_as_the_comments_say(name, tmp_path):
    text = filled("gear-pair", "mine")
    if name != "involute":
        offer = re.search(rf'^# family = "{name}"\n((?:#   .*\n)*)', text, re.MULTILINE)
        assert offer is not None
        lines = [line.removeprefix("#   ") for line in offer[1].splitlines()]
        text = text.replace('family = "involute"', f'family = "{name}"', 1)
        if "it has no pressure_angle" in lines:
            text = text.replace('pressure_angle = "20 deg"\n', "")
        keys = "".join(f"{line}\n" for line in lines if line.startswith("shape = "))
        text = text.replace("\n[drive.pinion]", f"{keys}\n[drive.pinion]")
    if name == "points":  # the shipped ones are of other gears
        text = text.replace("teeth = 18", "teeth = 23").replace("teeth = 36", "teeth = 47")
        text = text.replace('"20 deg"', '"22.81 deg"')
    path = shipped("models") / "drives" / "points-23-47-path.csv"
    (tmp_path / "path.csv").write_text(Path(str(path)).read_text(encoding="utf-8"), encoding="utf-8")
    (tmp_path / "mine.toml").write_text(text, encoding="utf-8")
    loaded = load(tmp_path / "mine.toml")
    assert loaded.case.pair.family == name
    assert loaded.study.check(loaded.case).data["geometry"]["contact ratio"][0] > 1.0
