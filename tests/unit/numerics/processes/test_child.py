"""Processes of the program: they see no current folder, inherit nothing, and end with their parent."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import pytest

import tribodyn
from tribodyn.numerics.processes import child

pytestmark = pytest.mark.skipif(not Path("/proc/self/fd").exists(), reason="looks at processes in /proc")

#: Starts a child that computes without end, and one of its own in that; says their numbers and waits.
PARENT = """
import os, sys, time
from tribodyn.numerics.processes import child
busy = "import os; os.fork(); os.write(1, b'%d\\\\n' % os.getpid())\\nwhile True: pass"
process = child.start("builtins:exec", busy)
EXTRA
print(int(process.stdout.readline()), int(process.stdout.readline()), sep="\\n", flush=True)
time.sleep(600)
"""
#: A process that has inherited the pipes' ends and outlives its parent.
FORK = "if os.fork() == 0: time.sleep(20); os._exit(0)\n"


def code(program: str, environment: dict[str, str] | None = None) -> str:
    """What a program prints that a child executes."""
    process = child.start("builtins:exec", program, environment=environment)
    try:
        return child.answer(process, 60.0).decode()
    finally:
        child.end(process)


def alive(number: int) -> bool:
    try:
        state = Path(f"/proc/{number}/stat").read_text(encoding="ascii").rpartition(")")[2].split()[0]
    except OSError:
        return False
    return state != "Z"


def gone(numbers: list[int], limit: float) -> bool:
    end = time.monotonic() + limit
    while any(map(alive, numbers)) and time.monotonic() < end:
        time.sleep(0.02)
    return not any(map(alive, numbers))


@pytest.fixture
def busy(request: pytest.FixtureRequest) -> Iterator[tuple["subprocess.Popen[str]", list[int]]]:
    """A process, and those that compute for it."""
    command = [sys.executable, "-c", PARENT.replace("EXTRA", request.param)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as parent:
        assert parent.stdout is not None
        numbers = [int(parent.stdout.readline()) for _ in range(2)]
        yield parent, numbers
        parent.kill()
        for number in numbers:
            with suppress(OSError):
                os.kill(number, signal.SIGKILL)


@pytest.mark.parametrize("busy", ["", FORK], indirect=True, ids=["alone", "with a fork"])
def test_a_busy_child_ends_with_a_parent_that_is_killed(busy):
    """And what it has started; within a second or so, where another process holds the ends of the pipes."""
    parent, numbers = busy
    assert all(map(alive, numbers))
    parent.send_signal(signal.SIGKILL)
    assert gone(numbers, 15.0)


def test_an_end_takes_along_what_the_child_has_started():
    process = child.start("builtins:exec", "import os, time; print(os.fork(), flush=True); time.sleep(600)")
    assert process.stdout is not None
    numbers = [process.pid, int(process.stdout.readline())]
    child.end(process)
    assert gone(numbers, 15.0)


def test_no_answer_within_the_limit():
    process = child.start("time:sleep", "600")  # a text is no number: it ends at once, without an answer
    assert child.answer(process, 60.0) == b""
    child.end(process)
    process = child.start("builtins:exec", "import time; time.sleep(600)")
    with pytest.raises(TimeoutError):
        child.answer(process, 0.3)
    child.end(process)


def test_it_inherits_no_file_and_no_state_of_signals(tmp_path):
    """Open are its three pipes and the two by which its input is passed on."""
    with open(tmp_path / "file", "w") as file:
        os.set_inheritable(file.fileno(), True)
        before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGTERM, signal.SIGUSR1})
        try:
            open_files, blocked, group = code(
                "import os, signal\nfiles = [os.readlink(f'/proc/self/fd/{n}') for n in range(3, 99)"
                " if os.path.islink(f'/proc/self/fd/{n}')]\n"
                "print([file for file in files if not file.startswith('pipe:')])\n"
                "print(signal.pthread_sigmask(signal.SIG_BLOCK, ()))\nprint(os.getpgrp() == os.getpid())"
            ).splitlines()
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)
    assert (open_files, blocked, group) == ("[]", "set()", "True")


PATHS = {
    "safe": ("-P", ""),
    "its first entry": ("", ""),
    "an empty entry of PYTHONPATH": ("-P", "{else}::"),
    "a relative one": ("-P", "."),
    "one with the separator in its name": ("-P", ""),
}


@pytest.mark.parametrize("how", PATHS)
def test_the_current_folder_is_not_on_the_path(how, tmp_path):
    """Whatever put it on that of the parent, which imports first what it needs."""
    option, variable = PATHS[how]
    (tmp_path / "else").mkdir()
    program = "import sys, tribodyn\nfrom tribodyn.numerics.processes import child\n"
    program += "import subprocess, select, pickle\n"
    if "separator" in how:
        program += f"sys.path.insert(0, {str(tmp_path / 'no:.')!r})\n"
    program += (
        "import os; os.chdir(sys.argv[1])\n"
        "process = child.start('builtins:exec', 'import sys, json, tribodyn; print(json.dumps([sys.path,"
        " tribodyn.__file__]))')\nprint(child.answer(process, 60).decode())"
    )
    for name in ("json", "sitecustomize", "usercustomize"):
        (tmp_path / f"{name}.py").write_text(
            f"open({str(tmp_path / 'marker')!r}, 'a').write('{name} ')\nfrom importlib import *\n"
        )
    path = variable.format(**{"else": tmp_path / "else"})
    environment = {**os.environ, "PYTHONPATH": path}
    environment.pop("PYTHONSAFEPATH", None)
    if not option:
        program = "import sys; sys.path.insert(0, '')\n" + program
    ended = subprocess.run(
        [sys.executable, "-P", "-c", program, str(tmp_path)],
        cwd="/",
        env=environment,
        capture_output=True,
        text=True,
        check=True,
    )
    found, package = json.loads(ended.stdout)
    assert package == tribodyn.__file__
    assert str(tmp_path) not in found
    assert all(map(os.path.isabs, found))
    assert (str(tmp_path / "else") in found) == ("else" in variable)
    assert not (tmp_path / "marker").exists()


def test_a_program_of_the_current_folder_is_not_an_installed_one(tmp_path, monkeypatch):
    (tmp_path / "chromium").write_text("#!/bin/sh\n")
    (tmp_path / "chromium").chmod(0o755)
    monkeypatch.chdir(tmp_path)
    for path in ("", ".", f".{os.pathsep}", f"{os.pathsep}/no-such"):
        monkeypatch.setenv("PATH", path)
        assert child.installed_program(["chromium"]) is None
    monkeypatch.setenv("PATH", str(tmp_path))
    assert child.installed_program(["no-such", "chromium"]) == str(tmp_path / "chromium")


def test_a_program_is_run_and_ended_with_what_it_started(tmp_path):
    ended = child.run_program(["sh", "-c", "echo said; echo complained >&2; exit 3"], 60.0)
    assert (ended.returncode, ended.stdout, ended.stderr) == (3, "said\n", "complained\n")
    numbers = tmp_path / "numbers"
    with pytest.raises(TimeoutError):
        child.run_program(["sh", "-c", f"sleep 600 & echo $! $$ > {numbers}; wait"], 2.0)
    assert gone([int(number) for number in numbers.read_text().split()], 15.0)
    with pytest.raises(OSError, match="no-such"):
        child.run_program(["/no-such-program"], 60.0)
