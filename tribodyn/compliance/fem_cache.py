"""Finite-element compliances kept between runs, in the user's cache folder.

A file's name is the digest of everything its content depends on: the tooth as cut, the body, Poisson's ratio,
the mesh and the source of the method with all that it imports. A file that cannot be read is made again.
"""

import hashlib
import io
import struct
import zipfile
import zlib
from collections.abc import Callable
from functools import lru_cache
from typing import Any, TypeVar

import numpy as np

from tribodyn.compliance.gear_compliance import NEIGHBOURS, FreeEnds, GearCompliance, LeadHarmonics
from tribodyn.compliance.lead_harmonics import LARGEST_AT_ENDS, wave_numbers
from tribodyn.geometry.tooth import Tooth, tooth_outline
from tribodyn.numerics.cache import alone, keep, read_kept
from tribodyn.numerics.sources import digest_of
from tribodyn.numerics.work import part

Kept = TypeVar("Kept", GearCompliance, LeadHarmonics, FreeEnds)

_SECTORS = 2 * NEIGHBOURS + 1
_FOLDER = "fem"
#: What the stored arrays come from.
_METHODS = ("tribodyn.compliance.fem", "tribodyn.compliance.free_ends")


def cached_gear_compliance(
    tooth: Tooth,
    teeth: int,
    bore_radius: float,
    poisson_ratio: float,
    depth: float,
    level: int,
    width: float | None = None,
) -> GearCompliance:
    """Look a gear up in the cache, or solve it and keep it there.

    Parameters
    ----------
    tooth, teeth, bore_radius, poisson_ratio, depth, level
        As for `fem.gear_compliance`.
    width : float, optional
        Face width, m: with the response to loads that vary along teeth of this width and the root stress.
        Some seconds more, once; another width then needs a part of them again.
    """
    numbers = (teeth, bore_radius, poisson_ratio, depth, level)
    with part(0.0, 1.0 if width is None else 0.05):
        plane = _kept(GearCompliance, _plane_fits, _digest(tooth, *numbers), lambda: _plane(tooth, *numbers))
    plane = plane._replace(depth=float(plane.depth))
    if width is None:
        return plane
    module = 2.0 * float(tooth.path.pinion_pitch_radius) / teeth
    waves = wave_numbers(module, float(tooth.root_radius))
    with part(0.05, 0.5):
        harmonics = _kept(
            LeadHarmonics,
            lambda stored: _lead_fits(stored, len(waves), len(plane.radius)),
            "lead-" + _digest(tooth, *numbers, *waves),
            lambda: _lead(tooth, *numbers, waves),
        )
    shorter = wave_numbers(module, float(tooth.root_radius), LARGEST_AT_ENDS)
    with part(0.5, 1.0):
        ends = _kept(
            FreeEnds,
            lambda stored: _ends_fit(stored, len(shorter), harmonics.root_position.shape[-1]),
            "ends-" + _digest(tooth, *numbers, *shorter, width),
            lambda: _ends(tooth, *numbers, shorter, width),
        )
    return plane._replace(lead=harmonics, ends=ends)


def _plane(*arguments: Any) -> GearCompliance:
    from tribodyn.compliance import fem

    return fem.gear_compliance(*arguments)


def _lead(*arguments: Any) -> LeadHarmonics:
    from tribodyn.compliance import fem

    return fem.lead_harmonics(*arguments)


def _ends(*arguments: Any) -> FreeEnds:
    from tribodyn.compliance.free_ends import free_ends

    return free_ends(*arguments)


def _kept(kind: type[Kept], fits: Callable[[Kept], bool], name: str, solve: Callable[[], Kept]) -> Kept:
    """Arrays of a file, or of `solve`, which are then kept in it."""
    file = f"{name}.npz"
    stored = _read(kind, file)
    if stored is not None and fits(stored):
        return stored
    with alone(_FOLDER, file):
        stored = _read(kind, file)  # another process may have kept it meanwhile
        if stored is not None and fits(stored):
            return stored
        solved = solve()
        _write(file, solved)
    return solved


def _plane_fits(stored: GearCompliance) -> bool:
    count = len(stored.radius)
    return stored.inside.shape == (2, count) and stored.between.shape == (_SECTORS, count, count)


def _lead_fits(stored: LeadHarmonics, waves: int, count: int) -> bool:
    points = stored.root_position.shape[-1]
    return (
        stored.wave_number.shape == (waves,)
        and stored.inside.shape == (waves, 2, count)
        and stored.between.shape == (waves, _SECTORS, count, count)
        and stored.root_position.shape == (2, points)
        and stored.root_stress.shape == (waves, _SECTORS, 2, points, count)
    )


def _ends_fit(stored: FreeEnds, waves: int, points: int) -> bool:
    count = len(stored.radius)
    return (
        stored.wave_number.shape == (waves,)
        and stored.own.shape == (2, waves, waves, count)
        and stored.between.shape == (2, waves, waves, _SECTORS, count, count)
        and stored.root_stress.shape == (2, waves, waves, _SECTORS, 2, points, count)
    )


def _digest(tooth: Tooth, *numbers: float) -> str:
    outline = tooth_outline(tooth, 40, 40)
    digest = hashlib.sha256(_source_digest())
    for values in (*outline, np.array(numbers, dtype=float)):
        # rounded: the last bits differ between processors
        digest.update(np.char.mod("%.11e", np.atleast_1d(np.asarray(values, dtype=float))).tobytes())
    return digest.hexdigest()[:32]


@lru_cache(maxsize=1)
def _source_digest() -> bytes:
    return digest_of(*_METHODS)


def _read(kind: type[Kept], file: str) -> Kept | None:
    content = read_kept(_FOLDER, file)
    if content is None:
        return None
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as listed:
            if any(one.compress_type != zipfile.ZIP_STORED for one in listed.infolist()):
                return None  # not written here, and of unknown size
        with np.load(io.BytesIO(content), allow_pickle=False) as stored:
            parts = {name: stored[name] for name in _arrays(kind)}
    except (OSError, ValueError, KeyError, EOFError, MemoryError, SyntaxError):
        return None
    except (zipfile.BadZipFile, zlib.error, RuntimeError, OverflowError, struct.error):  # or said encrypted
        return None
    if not all(part.dtype == float and np.all(np.isfinite(part)) for part in parts.values()):
        return None
    return kind(**parts)


def _arrays(kind: Any) -> list[str]:
    return [name for name in kind._fields if name not in kind._field_defaults]


def _write(file: str, solved: GearCompliance | LeadHarmonics | FreeEnds) -> None:
    content = io.BytesIO()
    np.savez(content, **{part: getattr(solved, part) for part in _arrays(type(solved))})
    keep(_FOLDER, file, content.getvalue())
