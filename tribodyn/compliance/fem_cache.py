"""Finite-element compliances kept between runs, in the user's cache folder.

A file's name is the digest of everything its content depends on: the tooth as cut, the body, Poisson's ratio,
the mesh and the source of the method. Files are written beside their place and renamed into it, so that runs
at the same time never see half of one; a file that cannot be read is made anew.
"""

import hashlib
import os
import tempfile
import zipfile
from functools import lru_cache
from pathlib import Path

import numpy as np

from tribodyn.compliance.gear_compliance import GearCompliance
from tribodyn.geometry.tooth import Tooth, tooth_outline

_SOURCES = ("gear_compliance.py", "fem.py", "ring_mesh.py")


def cache_folder() -> Path:
    """Folder of the cached compliances: in TRIBODYN_CACHE if that is set, else in the user's cache folder."""
    if given := os.environ.get("TRIBODYN_CACHE"):
        return Path(given) / "fem"
    from platformdirs import user_cache_path

    return user_cache_path("tribodyn") / "fem"


def cached_gear_compliance(
    tooth: Tooth, teeth: int, bore_radius: float, poisson_ratio: float, depth: float, level: int
) -> GearCompliance:
    """Look `fem.gear_compliance` up in the cache, or solve it and keep it there. Arguments as there."""
    file = cache_folder() / f"{_digest(tooth, teeth, bore_radius, poisson_ratio, depth, level)}.npz"
    known = _read(file)
    if known is not None:
        return known
    from tribodyn.compliance.fem import gear_compliance

    solved = gear_compliance(tooth, teeth, bore_radius, poisson_ratio, depth, level)
    _write(file, solved)
    return solved


def _digest(tooth: Tooth, *numbers: float) -> str:
    outline = tooth_outline(tooth, 40, 40)
    digest = hashlib.sha256(_source_digest())
    for part in (*outline, np.array(numbers, dtype=float)):
        # rounded: the last bits differ between processors
        digest.update(np.char.mod("%.11e", np.atleast_1d(np.asarray(part, dtype=float))).tobytes())
    return digest.hexdigest()[:32]


@lru_cache(maxsize=1)
def _source_digest() -> bytes:
    folder = Path(__file__).parent
    return hashlib.sha256(b"".join((folder / name).read_bytes() for name in _SOURCES)).digest()


def _read(file: Path) -> GearCompliance | None:
    try:
        with file.open("rb") as stream, np.load(stream, allow_pickle=False) as stored:
            parts = {name: stored[name] for name in GearCompliance._fields}
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
        return None
    found = GearCompliance(parts["radius"], parts["inside"], parts["between"], parts["depth"])
    count = len(found.radius)
    fits = found.inside.shape == (2, count) and found.between.shape[1:] == (count, count)
    if not fits or not all(np.all(np.isfinite(part)) for part in parts.values()):
        return None
    return found._replace(depth=float(parts["depth"]))


def _write(file: Path, gear: GearCompliance) -> None:
    """Keep it, or do without where the folder cannot be written: the cache is a convenience."""
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=file.parent, suffix=".tmp")
        try:
            with os.fdopen(handle, "wb") as stream:
                np.savez(
                    stream, radius=gear.radius, inside=gear.inside, between=gear.between, depth=gear.depth
                )
            os.replace(name, file)
        except BaseException:
            Path(name).unlink(missing_ok=True)
            raise
    except OSError:
        return
