"""Finite-element compliances kept between runs, in the user's cache folder.

A file's name is the digest of everything its content depends on: the tooth as cut, the body, Poisson's ratio,
the mesh and the source of the method with all that it imports.
"""

from importlib import import_module
from typing import Any, TypeVar

import numpy as np

from tribodyn.compliance.fem.gear_compliance import (
    LARGEST_AT_ENDS,
    ElasticGear,
    FreeEnds,
    GearCompliance,
    LeadHarmonics,
    wave_numbers,
)
from tribodyn.geometry.body import tooth_outline
from tribodyn.numerics.elementary import sense
from tribodyn.numerics.files.cache import arrays_kept_or_made, digest_of_numbers
from tribodyn.numerics.processes.libraries import one_blas_thread
from tribodyn.numerics.processes.work import part

Kept = TypeVar("Kept", GearCompliance, LeadHarmonics, FreeEnds)

#: What the stored arrays come from.
_METHODS = ("tribodyn.compliance.fem.gear", "tribodyn.compliance.fem.free_ends")
#: What is kept: start of the file's name, and which module has which function that solves it.
_SOLVERS: dict[type[Any], tuple[str, str, str]] = {
    GearCompliance: ("", _METHODS[0], "gear_compliance"),
    LeadHarmonics: ("lead-", _METHODS[0], "lead_harmonics"),
    FreeEnds: ("ends-", _METHODS[1], "free_ends"),
}


def cached_gear_compliance(gear: ElasticGear, width: float | None = None) -> GearCompliance:
    """Look a gear up in the cache, or solve it and keep it there.

    With a face width (m) also the response to loads that vary along teeth of this width and the root stress:
    some seconds more, once; another width then needs a part of them again.
    """
    with part(0.0, 1.0 if width is None else 0.05):
        plane = _kept(GearCompliance, gear)
    plane = plane._replace(depth=float(plane.depth))
    if width is None:
        return plane
    gear = gear._replace(held=True)  # as the others are solved
    root = float(sense(gear.teeth) * gear.tooth.root_radius)
    module = 2.0 * float(gear.tooth.path.pinion_pitch_radius) / gear.teeth
    with part(0.05, 0.5):
        harmonics = _kept(LeadHarmonics, gear, wave_numbers(module, root))
    with part(0.5, 1.0):
        ends = _kept(FreeEnds, gear, wave_numbers(module, root, LARGEST_AT_ENDS), width)
    return plane._replace(lead=harmonics, ends=ends)


def _kept(kind: type[Kept], gear: ElasticGear, *more: Any) -> Kept:
    """Arrays of a file, or of the solver of that kind, which are then kept in it."""
    begin, module, function = _SOLVERS[kind]
    names = [field for field in kind._fields if field not in kind._field_defaults]

    def made() -> dict[str, Any]:
        with one_blas_thread():
            solved = getattr(import_module(module), function)(gear, *more)
        return {field: getattr(solved, field) for field in names}

    arrays: dict[str, Any] = dict(arrays_kept_or_made("fem", begin + _digest(gear, *more), made))
    return kind(**arrays)


def _digest(gear: ElasticGear, *more: Any) -> str:
    return digest_of_numbers(_METHODS, (*tooth_outline(gear.tooth, 40, 40), np.hstack([*gear[1:], *more])))
