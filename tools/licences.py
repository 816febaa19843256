"""Licences of everything that tribodyn is tested with, from the metadata of what is installed, into a page.

::

    python -m tools.licences           # print the table
    python -m tools.licences --write   # into docs/licences.md
"""

import re
import sys
from collections.abc import Iterator
from importlib.metadata import PackageNotFoundError, metadata, requires
from typing import NamedTuple

from packaging.requirements import Requirement

from tools.marked_block import DOCS, ROOT, put
from tools.marked_block import table as table_of

PAGE = DOCS / "licences.md"
#: What is not installed with the tests, and what metadata say without naming the licence, read in its files.
READ_BY_HAND = {
    "axe-playwright-python": "MIT; axe-core in it, MPL-2.0",
    "editables": "MIT",
    "exudyn": "its own, in the words of BSD-3-Clause",
    "scikit-sundae": "BSD-3-Clause",
    "diffrax": "Apache-2.0",
    "equinox": "Apache-2.0",
    "lineax": "Apache-2.0",
    "optimistix": "Apache-2.0",
    "wadler_lindig": "Apache-2.0",
    "jaxtyping": "MIT",
    "contourpy": "BSD-3-Clause",
    "graphemeu": "MIT",
    "h5netcdf": "BSD-3-Clause",
    "kiwisolver": "BSD-3-Clause",
    "scipy": "BSD-3-Clause",
    "matplotlib": "PSF-2.0",
    "cycler": "BSD-3-Clause",
    "scikit-learn": "BSD-3-Clause",
    "joblib": "BSD-3-Clause",
    "threadpoolctl": "BSD-3-Clause",
    "comm": "BSD-3-Clause",
    "docutils": "public domain, BSD-2-Clause; a mode for Emacs, which is not installed, GPL",
    "jupyter_client": "BSD-3-Clause",
    "nbclient": "BSD-3-Clause",
    "nbformat": "BSD-3-Clause",
    "nest-asyncio2": "BSD-2-Clause",
    "ptyprocess": "ISC",
    "traitlets": "BSD-3-Clause",
    "trimesh": "MIT",
    "ziamath": "MIT; its font, STIX Two Math, OFL-1.1",
}
#: Families of licences, by what a licence's name holds.
COPYLEFT = re.compile(r"GPL|SSPL|EUPL|CC-BY-SA|AGPL", re.IGNORECASE)


class Row(NamedTuple):
    """A package: name and version of constraints.txt, its licence, and what needs it."""

    name: str
    version: str
    licence: str
    needed_for: str


def constraints() -> dict[str, str]:
    """Names and versions of constraints.txt."""
    lines = (ROOT / "constraints.txt").read_text(encoding="utf-8").splitlines()
    pairs = (line.partition("==") for line in lines if line and not line.startswith("#"))
    return {name.strip(): version.strip() for name, _, version in pairs}


def same_name(name: str) -> str:
    """A package's name as indexes compare it."""
    return re.sub(r"[-_.]+", "-", name).lower()


def licence_of(name: str) -> str:
    """The licence of an installed package; ``READ_BY_HAND`` where its metadata do not name it."""
    if name in READ_BY_HAND:
        return READ_BY_HAND[name]
    known = metadata(name)
    written = [*(known.get_all("License-Expression") or []), *(known.get_all("License") or [])]
    classified = [
        classifier.rpartition("::")[2].strip()
        for classifier in known.get_all("Classifier") or []
        if classifier.startswith("License")
    ]
    return " ".join((next(iter(written), "") or "; ".join(classified) or "unknown").split())


def needed(extras: tuple[str, ...] = ()) -> set[str]:
    """Packages that an installation draws in, by name; with these extras of tribodyn."""
    known = {same_name(name) for name in constraints()}
    found: set[str] = set()
    waiting = list(_required("tribodyn", extras))
    while waiting:
        name, wanted = waiting.pop()
        if name not in found and name in known:
            found.add(name)
            waiting += _required(name, wanted)
    return found


def _required(name: str, extras: tuple[str, ...]) -> Iterator[tuple[str, tuple[str, ...]]]:
    try:
        lines = requires(name) or []
    except PackageNotFoundError:
        return
    for line in lines:
        requirement = Requirement(line)
        marker = requirement.marker
        if marker is None or any(marker.evaluate({"extra": extra}) for extra in ("", *extras)):
            yield same_name(requirement.name), tuple(requirement.extras)


def is_known(name: str) -> bool:
    """Whether the licence of a package can be told: it is installed, or was read by hand."""
    try:
        return name in READ_BY_HAND or bool(metadata(name))
    except PackageNotFoundError:
        return False


def rows() -> list[Row]:
    """A row for every package of constraints.txt whose licence is known here, see `is_known`."""
    default, optional = needed(), needed(("xarray", "cluster", "design", "fmu", "app"))
    found = []
    for name, version in constraints().items():
        if is_known(name):
            needed_for = "extras" if same_name(name) in optional else "development"
            needed_for = "runs" if same_name(name) in default else needed_for
            found.append(Row(name, version, licence_of(name), needed_for))
    return found


def table() -> str:
    """The rows as a table of a page."""
    return table_of(["package", "version", "licence", "needed for"], rows())


if __name__ == "__main__":
    if "--write" in sys.argv:
        if unknown := [name for name in constraints() if not is_known(name)]:
            sys.exit(f"not installed: {', '.join(unknown)}; make test docs installs them")
        put(PAGE, "licences", table())
    else:
        sys.stdout.write(table() + "\n")
