"""A version of the package: where its files lie, and how it runs the cases, each in a process of its own."""

import hashlib
import importlib.metadata
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from time import perf_counter
from typing import NamedTuple

from tools.compare_versions.cases import Case

#: What a case's results depend on besides its words.
PARTS = ("tribodyn", "models", "scenarios")
LIBRARIES = ("numpy", "scipy", "jax", "diffrax", "numba", "h5py", "scikit-fem")
#: Name of the file that says how a case's results were made; it is written last.
MADE = "made.json"


class Version(NamedTuple):
    """A checkout, the name it was given by, the digest of its files, and the folder of its results."""

    name: str
    checkout: Path
    digest: str
    results: Path

    def folder(self, case: Case) -> Path:
        """Return the folder of a case's results."""
        return self.results / case.name.replace(" ", "_").replace(",", "")


@contextmanager
def opened(name: str, repository: Path, keep: Path, scratch: Path) -> Iterator[Version]:
    """Open a version: a folder that holds the package, or a revision, checked out into `scratch`.

    The repository knows the revision; results stay in `keep`, where versions with equal files share them.
    """
    checkout = Path(name).resolve()
    if not (checkout / "tribodyn").is_dir():
        checkout = scratch / hashlib.sha256(name.encode()).hexdigest()[:12]
        git = ["git", "-C", str(repository)]
        commit = subprocess.run(
            [*git, "rev-parse", "--verify", f"{name}^{{commit}}"], capture_output=True, text=True, check=False
        )
        if commit.returncode:
            raise SystemExit(f"{name}: neither a folder with tribodyn/ nor a revision of {repository}")
        archive = subprocess.run([*git, "archive", commit.stdout.strip()], capture_output=True, check=True)
        checkout.mkdir(parents=True)
        subprocess.run(["tar", "-x", "-C", str(checkout)], input=archive.stdout, check=True)
    digest = _digest(checkout)
    yield Version(name, checkout, digest, keep / digest[:16])


def _digest(checkout: Path) -> str:
    """Digest of the files that results depend on, and of the libraries' versions."""
    total = hashlib.sha256()
    total.update(f"{sys.version} {[importlib.metadata.version(library) for library in LIBRARIES]}".encode())
    for part in PARTS:
        for path in sorted((checkout / part).rglob("*")):
            if path.is_file() and "__pycache__" not in path.parts:
                total.update(f"{path.relative_to(checkout)} ".encode() + path.read_bytes())
    return total.hexdigest()


def run(version: Version, case: Case, words: dict[str, list[str]]) -> None:
    """Run a case, unless its results are there already: status, output and records go to its folder.

    `words` are those of the commands that this version wants written otherwise: old word -> new words.
    """
    folder = version.folder(case)
    commands = [[new for word in command for new in words.get(word, [word])] for command in case.commands]
    made = folder / MADE
    if made.is_file() and json.loads(made.read_text(encoding="utf-8"))["commands"] == commands:
        return
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    start = perf_counter()
    status: list[int] = []
    for command in commands:
        with (folder / "stdout").open("w") as out, (folder / "stderr").open("w") as err:
            streams = {"stdin": subprocess.DEVNULL, "stdout": out, "stderr": err}
            command = [sys.executable, "-m", "tribodyn", *command]
            status.append(subprocess.call(command, cwd=folder, env=_environment(version), **streams))
    seconds = perf_counter() - start
    how = {"commands": commands, "status": status, "seconds": round(seconds, 1)}
    made.write_text(json.dumps(how), encoding="utf-8")
    print(f"{version.name}: {case.name}: {seconds:.0f} s, status {status[-1]}", flush=True)


def _environment(version: Version) -> dict[str, str]:
    return {
        **os.environ,
        "PYTHONPATH": str(version.checkout),
        "TRIBODYN_CACHE": str(version.results / "cache"),
        "OPENBLAS_NUM_THREADS": "1",
        "COLUMNS": "200",
    }


def check_import(version: Version) -> None:
    """Make sure that a process of this version imports the package from its checkout."""
    command = [sys.executable, "-c", "import tribodyn; print(tribodyn.__file__)"]
    where = {"cwd": version.results, "env": _environment(version)}
    shown = subprocess.check_output(command, text=True, **where).strip()
    if version.checkout not in Path(shown).resolve().parents:
        raise SystemExit(f"{version.name}: imports {shown}, not {version.checkout}")
