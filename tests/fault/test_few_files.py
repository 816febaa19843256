"""A process that may have hardly any file open: a sound record is not called damaged for it."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tribodyn.errors import TOO_MANY_FILES

RECORD = next(iter(sorted((Path(__file__).parents[1] / "fixtures").rglob("*.h5"))))
#: Reads a record with ever fewer descriptors to spare; what it needs on first use is imported before.
SCRIPT = """
import os, resource, sys
from tribodyn.errors import InputError
from tribodyn.record import soundness
from tribodyn.record.sweep_reader import open_any

def read():
    soundness._sound.clear()
    with open_any(sys.argv[1]) as record:
        _ = [record[name] for name in record], record.scenario

read()
hard = resource.getrlimit(resource.RLIMIT_NOFILE)[1]
lowest = os.dup(0)
os.close(lowest)
for spare in (0, 1, 2, 3, 12):
    resource.setrlimit(resource.RLIMIT_NOFILE, (lowest + spare, hard))
    try:
        read()
        print("read")
    except InputError as error:
        print(f"{error.rule}; {error.remedy}")
"""


@pytest.mark.skipif(os.name != "posix", reason="Windows has no such limit")
def test_a_sound_record_is_not_called_damaged():
    command = [sys.executable, "-P", "-c", SCRIPT, str(RECORD)]
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[2])}
    run = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    said = run.stdout.splitlines()
    assert len(said) == 5, run.stderr
    assert said[0] == "; ".join(TOO_MANY_FILES)
    assert said[-1] == "read"
    assert set(said) == {said[0], "read"}
