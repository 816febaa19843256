"""Values put into the text of a scenario, which keeps all else."""

import tomllib
from pathlib import Path

import pytest

from tribodyn.input.edit import Models, with_values
from tribodyn.input.messages import Key
from tribodyn.studies.protocol.load import table_of

KEY: Key = ("drive", "pinion", "modification", "tooth_errors")
TEXTS = {
    "a model's name": 'title = "t"\ndrive = "spur-25-51" # of mine\n\n[mesh]\ndamping_ratio = 0.1\n',
    "a table": '# head\n[drive]\nlike = "spur-25-51"\n[mesh]\na = 1 # b\n',
    "a table of the gear": '[drive]\nlike = "spur-25-51"\n[drive.pinion]\nteeth = 25 # more\n',
    "the table itself": "[drive.pinion.modification]\ntip_relief = 1\n[[duty]]\na = 1\n",
    "another value": '[drive.pinion]\nmodification.tooth_errors = "old.csv" # a comment\n',
    "an inline table": '# head\ndrive = { like = "spur-25-51", pinion = { teeth = 25 } } # of mine\n',
    "nothing": "# only this\n[mesh]\na = 1\n",
    "in dotted keys": 'drive.like = "spur-25-51"\ndrive.pinion.teeth = 3\n',
}


@pytest.mark.parametrize("text", TEXTS.values(), ids=TEXTS)
def test_values_are_in_and_all_else_as_before(text: str):
    models = Models(tomllib.loads(text), table_of({"kind": "gear-pair"}), Path("t.toml"))
    found = with_values(text, {KEY: "new.csv", ("drive", "pinion", "eccentricity"): "3 um"}, models)
    data, before = tomllib.loads(found), tomllib.loads(text)
    drive, before_drive = data.pop("drive"), before.pop("drive", {})
    assert drive["pinion"]["modification"].pop("tooth_errors") == "new.csv"
    assert drive["pinion"].pop("eccentricity") == "3 um"
    if isinstance(before_drive, str):
        assert drive["like"] == before_drive
    assert data == before
    for comment in ("# of mine", "# head", "# b", "# more", "# only this"):
        assert (comment in found) == (comment in text)
