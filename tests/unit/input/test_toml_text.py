"""Keys put into the text of a TOML file, which keeps all else."""

import tomllib

import pytest

from tribodyn.input.toml_text import with_keys

KEY = ("drive", "pinion", "modification", "tooth_errors")
TEXTS = {
    "a model's name": 'title = "t"\ndrive = "spur-25-51" # of mine\n\n[mesh]\ndamping_ratio = 0.1\n',
    "a table": '# head\n[drive]\nlike = "x"\n[mesh]\na = 1 # b\n',
    "a table of the gear": '[drive]\nlike = "x"\n[drive.pinion]\nteeth = 25 # more\n',
    "the table itself": "[drive.pinion.modification]\ntip_relief = 1\n[[duty]]\na = 1\n",
    "another value": '[drive.pinion]\nmodification.tooth_errors = "old.csv" # a comment\n',
    "nothing": "# only this\n[mesh]\na = 1\n",
    "in dotted keys": 'drive.like = "x"\ndrive.pinion.teeth = 3\n',
}


@pytest.mark.parametrize("text", TEXTS.values(), ids=TEXTS)
def test_the_key_is_in_and_all_else_as_before(text: str):
    found, kept = with_keys(text, {KEY: "new.csv"})
    data, before = tomllib.loads(found), tomllib.loads(text)
    drive = data["drive"]
    assert drive["pinion"]["modification"].pop("tooth_errors") == "new.csv"
    before_drive = before.pop("drive", {})
    if isinstance(before_drive, str):
        assert drive["like"] == before_drive
    assert {key: value for key, value in data.items() if key != "drive"} == before
    assert kept
    for comment in ("# of mine", "# head", "# b", "# more", "# only this"):
        assert (comment in found) == (comment in text)


def test_what_has_no_place_for_it_is_written_anew():
    text = '# gone\ndrive = { like = "x", pinion = { teeth = 25 } }\n'
    found, kept = with_keys(text, {KEY: "new.csv", ("drive", "pinion", "eccentricity"): "3 um"})
    assert not kept
    assert tomllib.loads(found)["drive"] == {
        "like": "x",
        "pinion": {"teeth": 25, "modification": {"tooth_errors": "new.csv"}, "eccentricity": "3 um"},
    }
