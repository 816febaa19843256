"""Finite-element compliances kept between runs, in the user's cache folder.

A file's name is the digest of everything its content depends on: the tooth as cut, the body, Poisson's ratio,
the mesh and the source of the method with all that it imports.
"""

import hashlib
from collections.abc import Callable
from functools import lru_cache
from typing import Any, TypeVar

import numpy as np

from tribodyn.compliance.fem.gear_compliance import (
    LARGEST_AT_ENDS,
    FreeEnds,
    GearCompliance,
    LeadHarmonics,
    wave_numbers,
)
from tribodyn.geometry.body import tooth_outline
from tribodyn.geometry.tooth import Tooth
from tribodyn.numerics.blas_threads import one_blas_thread
from tribodyn.numerics.cache import arrays_kept_or_made
from tribodyn.numerics.sources import digest_of
from tribodyn.numerics.work import part

Kept = TypeVar("Kept", GearCompliance, LeadHarmonics, FreeEnds)

#: What the stored arrays come from.
_METHODS = ("tribodyn.compliance.fem.gear", "tribodyn.compliance.fem.free_ends")


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
    width : optional; face width, m: with the response to loads that vary along teeth of this width and the
        root stress. Some seconds more, once; another width then needs a part of them again
    """
    numbers = (teeth, bore_radius, poisson_ratio, depth, level)
    with part(0.0, 1.0 if width is None else 0.05):
        plane = _kept(GearCompliance, _digest(tooth, *numbers), lambda: _plane(tooth, *numbers))
    plane = plane._replace(depth=float(plane.depth))
    if width is None:
        return plane
    module = 2.0 * float(tooth.path.pinion_pitch_radius) / teeth
    waves = wave_numbers(module, float(tooth.root_radius))
    with part(0.05, 0.5):
        harmonics = _kept(
            LeadHarmonics,
            "lead-" + _digest(tooth, *numbers, *waves),
            lambda: _lead(tooth, *numbers, waves),
        )
    shorter = wave_numbers(module, float(tooth.root_radius), LARGEST_AT_ENDS)
    with part(0.5, 1.0):
        ends = _kept(
            FreeEnds,
            "ends-" + _digest(tooth, *numbers, *shorter, width),
            lambda: _ends(tooth, *numbers, shorter, width),
        )
    return plane._replace(lead=harmonics, ends=ends)


def _plane(*arguments: Any) -> GearCompliance:
    from tribodyn.compliance.fem import gear as fem

    return fem.gear_compliance(*arguments)


def _lead(*arguments: Any) -> LeadHarmonics:
    from tribodyn.compliance.fem import gear as fem

    return fem.lead_harmonics(*arguments)


def _ends(*arguments: Any) -> FreeEnds:
    from tribodyn.compliance.fem.free_ends import free_ends

    return free_ends(*arguments)


def _kept(kind: type[Kept], name: str, solve: Callable[[], Kept]) -> Kept:
    """Arrays of a file, or of `solve`, which are then kept in it."""
    names = [field for field in kind._fields if field not in kind._field_defaults]

    def made() -> dict[str, Any]:
        with one_blas_thread():
            solved = solve()
        return {field: getattr(solved, field) for field in names}

    arrays: dict[str, Any] = dict(arrays_kept_or_made("fem", name, made))
    return kind(**arrays)


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
