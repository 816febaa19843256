"""Help comes quickly, for every verb, with an example that parses."""

import re
import shlex
import sys

import pytest
from typer.main import get_command

from tests.support.verbs import ended, invoke
from tribodyn.cli.app import app
from tribodyn.cli.printing import command_name

VERBS = (
    "run sweep check gear show plot report listen signals compare export import list init schema validate app"
).split()


def test_a_short_option_gives_the_same_help():
    for words in ([], ["run"]):
        assert invoke(*words, "-h") == invoke(*words, "--help")


def test_help_names_every_verb():
    shown = invoke("--help")
    for verb in VERBS:
        assert re.search(rf"^  {verb} ", shown, re.MULTILINE)


@pytest.mark.parametrize("verb", VERBS)
def test_every_verb_shows_an_example_that_parses(verb: str):
    examples = re.findall(rf"^ +tribodyn ({verb}\b.*)$", invoke(verb, "--help"), re.MULTILINE)
    assert examples
    command = get_command(app)
    for example in examples:
        words = shlex.split(example.partition(" > ")[0])[1:]
        command.get_command(None, verb).make_context(verb, words)  # type: ignore[attr-defined]


def test_no_verb_is_help_and_an_unknown_one_is_refused():
    assert "Usage" in ended().output
    refused = ended("rnu")
    assert refused.exit_code == 2
    assert "rnu" in refused.stderr


@pytest.mark.parametrize(
    ("called", "on_path", "typed"),
    [
        ("bin/tribodyn", "", "bin/tribodyn"),
        ("bin/tribodyn", "bin", "tribodyn"),
        ("with a space/tribodyn", "", "'with a space/tribodyn'"),
    ],
)
def test_the_command_is_named_as_it_must_be_typed(called, on_path, typed, tmp_path, monkeypatch):
    program = tmp_path / called
    program.parent.mkdir()
    program.touch(0o755)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PATH", str(tmp_path / on_path))
    monkeypatch.setattr(sys, "argv", [str(program)])
    assert command_name() == typed
