"""Verbs of the command line as tests call them: in this process, or in a new one."""

import os
import subprocess
import sys
from collections.abc import Mapping
from contextlib import chdir
from pathlib import Path
from typing import Any

from typer.testing import CliRunner

from tribodyn.cli.app import app

ROOT = Path(__file__).parents[2]


def ended(*words: object, folder: Path | None = None, **options: Any) -> Any:
    """Run a verb in this process, in a folder; how it ended."""
    with chdir(folder or Path.cwd()):
        result = CliRunner().invoke(app, [str(word) for word in words], **options)
    assert "Traceback" not in result.output
    return result


def invoke(*words: object, folder: Path | None = None) -> str:
    """Run a verb in this process that must succeed; what it prints."""
    result = ended(*words, folder=folder)
    assert result.exit_code == 0, f"{words}\n{result.output}\n{result.exception}"
    return result.stdout


def complaints(*words: object, folder: Path | None = None, status: int = 2, **options: Any) -> list[str]:
    """Run a verb that must fail with a status; its lines of complaint. Bad input prints nothing else."""
    result = ended(*words, folder=folder, **options)
    assert result.exit_code == status, f"{words}\n{result.output}\n{result.exception}"
    assert status != 2 or result.stdout == ""
    return result.stderr.splitlines()


def complaint(*words: object, folder: Path | None = None, status: int = 2, **options: Any) -> str:
    """Run a verb in this process that must fail with a status; its one line of complaint."""
    (line,) = complaints(*words, folder=folder, status=status, **options)
    return line


def sets(*keys: str | Mapping[str, Any]) -> list[str]:
    """Options ``--set`` for texts KEY=VALUE, or for a mapping."""
    texts = [key for key in keys if isinstance(key, str)]
    texts += [f"{name}={value}" for key in keys if not isinstance(key, str) for name, value in key.items()]
    return [word for text in texts for word in ("--set", text)]


def in_a_process(*words: str, folder: Path, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run a verb in a process of its own, in which a warning is an error."""
    return subprocess.run(
        [sys.executable, "-W", "error", "-m", "tribodyn", *words],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=600,
        env={**os.environ, "PYTHONPATH": str(ROOT), **environment},
        check=False,
    )
