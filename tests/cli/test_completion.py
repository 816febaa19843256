"""What the shell is offered while a command is typed."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tribodyn.cli import options
from tribodyn.input.sources import find_scenario
from tribodyn.studies import STUDIES

MAIN = "from tribodyn.cli import main; main()"


def offered(typed: str, folder: Path) -> list[str]:
    """What bash offers for the last word of what is typed."""
    last = len(typed.split()) - (0 if typed.endswith(" ") else 1)
    asked = {"_TRIBODYN_COMPLETE": "complete_bash", "COMP_WORDS": typed, "COMP_CWORD": str(last)}
    ended = subprocess.run(
        [sys.executable, "-c", MAIN],
        env={**os.environ, **asked},
        cwd=folder,
        capture_output=True,
        text=True,
        check=True,
    )
    return ended.stdout.split()


def test_verbs_and_options_are_completed(tmp_path):
    assert offered("tribodyn va", tmp_path) == ["validate"]
    assert "--set" in offered("tribodyn run crc-23-47 --s", tmp_path)


def test_names_and_files_are_completed(tmp_path):
    (tmp_path / "crc-mine.toml").touch()
    (tmp_path / "crc.h5").touch()
    names = offered("tribodyn run crc", tmp_path)
    assert names[0] == "crc-mine.toml"
    assert "crc-23-47" in names
    assert "crc.h5" not in names


def test_keys_are_completed_a_table_at_a_time(tmp_path):
    offered_keys = offered("tribodyn run crc-23-47 --set oper", tmp_path)
    assert offered_keys == ["operating."]
    offered_keys = offered("tribodyn run crc-23-47 --set operating.gear_torq", tmp_path)
    assert "operating.gear_torque=" in offered_keys
    (tmp_path / "mine.toml").write_text('kind = "load-contact"\n', encoding="utf-8")
    varied = offered("tribodyn sweep mine.toml --vary output.", tmp_path)
    assert "output.positions_per_cycle=" in varied
    assert "output.samples_per_cycle=" not in varied


@pytest.fixture
def files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("a.toml", "a.h5", "sub/b.h5"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()


def test_every_sort_of_word_has_its_own_names(files):
    assert options.kinds("") == list(STUDIES)
    assert all(find_scenario(name).exists() for name in options.scenarios(""))
    assert {"liu-ni-crc-23-47", "crc-23-47", "a.toml"} <= set(options.drives(""))
    assert options.papers("jia") == ["jia-2022"]
    assert {"a.h5", "a.toml"} <= set(options.scenarios_and_records("a"))
    assert options.records_and_plots("a") == ["a.h5", "all"]
    assert options.records_and_plots("sub/") == ["sub/b.h5"]
    assert options.records_and_plots("wat") == ["waterfall"]
