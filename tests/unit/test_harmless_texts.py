"""Texts from files never reach a terminal or a picture with what these would obey."""

import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.verbs import complaint
from tribodyn.cli.printing import quoted_path
from tribodyn.errors import InputError, harmless
from tribodyn.studies.protocol.load import load_scenario

EVIL = "a\x1b[31mb\x9bc\u202ed\x00e\x7f"


@pytest.mark.parametrize("text", ["", "µ ρ̄² 300 N\u00b7m\u00a0– 漢字\n\tnext line"])
def test_what_is_harmless_stays(text: str):
    assert harmless(text) == text


def test_what_is_obeyed_is_escaped():
    assert harmless(EVIL) == r"a\x1b[31mb\x9bc\u202ed\x00e\x7f"
    assert harmless("\udccc") == r"\udccc"


@pytest.mark.parametrize("key", ["title", "drive.title", "lubricant.source"])
def test_a_scenario_with_such_a_text_is_refused(key: str):
    with pytest.raises(InputError, match="control character") as error:
        load_scenario("crc-23-47", {key: EVIL})
    assert error.value.key == key
    assert harmless(str(error.value)) == str(error.value)


def test_a_key_with_such_a_text_is_named_on_one_line():
    with pytest.raises(InputError) as error:
        load_scenario("crc-23-47", {f"operating.gear_torque.{EVIL}\n.x": 1})
    assert error.value.key.endswith(".x")
    said = str(error.value)
    assert harmless(said) == said
    assert len(said.splitlines()) == 1


def test_messages_are_harmless():
    said = complaint("run", f"{EVIL}.toml")
    assert harmless(said) == said


def test_a_path_with_such_a_name_can_be_pasted():
    path = quoted_path("it's \x1b here.h5")
    assert harmless(path) == path
    said = subprocess.run(["bash", "-c", f"printf %s {path}"], capture_output=True, check=True).stdout
    assert said == b"it's \x1b here.h5"


@pytest.mark.parametrize("word", ["list", "schema"])
def test_any_encoding_of_the_output_will_do(word: str, tmp_path: Path):
    env = {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONIOENCODING": "ascii", "PATH": "/usr/bin:/bin"}
    command = [sys.executable, "-m", "tribodyn", word]
    ended = subprocess.run(command, cwd=tmp_path, env=env, capture_output=True, check=False)
    assert (ended.returncode, ended.stderr) == (0, b"")
    assert ended.stdout.isascii()


def test_closed_output_is_no_bug(tmp_path: Path):
    closed = f"{sys.executable} -m tribodyn list >&- 2>&-"
    assert subprocess.run(["sh", "-c", closed], cwd=tmp_path, check=False).returncode == 0
