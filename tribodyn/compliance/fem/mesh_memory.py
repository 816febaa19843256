"""Memory that a gear's finite elements need, estimated before any of it is taken."""

from pathlib import Path

import numpy as np

from tribodyn.compliance.fem.ring_mesh import half_sector_cells
from tribodyn.errors import InputError

# Entries of both triangular factors over n log2 n, largest of levels 2 to 8 with 2 and 3 components per node,
# bytes of each with SuperLU's own working space, and copies of the dense sides and readers held at once:
# together they meet the peaks measured (22 MB to 960 MB) within a fifth (test_mesh_memory).
_FILL = {2: 10.5, 3: 12.5}
_BYTES_PER_ENTRY = 24.0
_COPIES = 3.0
# The end faces of a gear, whose mesh is always the same; measured.
_ENDS = 80e6

_LIMITS = (Path("/sys/fs/cgroup/memory.max"), Path("/sys/fs/cgroup/memory.current"))


def memory_needed(level: int, components: int) -> float:
    """Bytes that solving a gear takes at its peak.

    Parameters
    ----------
    level : refinement of the mesh
    components : int
        Of the displacement: 2 in plane strain, 3 for loads that vary along the teeth, with root stress, and
        for free end faces after them.
    """
    cells, flank, root, edge = half_sector_cells(level)
    unknowns = components * 4.0 * cells
    readers = 3.0 * (flank + 1) + (4.0 * root if components == 3 else 0.0)
    dense = 8.0 * _COPIES * unknowns * (components * 2.0 * edge + readers)
    whole = dense + _BYTES_PER_ENTRY * _FILL[components] * unknowns * np.log2(unknowns)
    return max(whole, _ENDS) if components == 3 else whole


def available_memory() -> float:
    """Bytes that this process can still take; infinite where the system does not say."""
    limits = [np.inf]
    try:
        lines = Path("/proc/meminfo").read_text(encoding="ascii").splitlines()
        limits += [1024.0 * float(line.split()[1]) for line in lines if line.startswith("MemAvailable:")]
    except OSError:
        pass
    try:
        limit, used = (path.read_text(encoding="ascii").strip() for path in _LIMITS)
        if limit != "max":
            limits.append(float(limit) - float(used))
    except OSError:
        pass
    return min(limits)


def check_level(level: int, components: int) -> None:
    """Refuse a mesh that cannot be, or that would not fit into the memory.

    Raises
    ------
    InputError
        Saying how much memory the level needs, and which one would fit.
    """
    if level < 1:
        raise InputError(
            "level", level, "the mesh has no cells", "use 1 or more; 2 is within 0.1 % of the limit"
        )
    needed, available = memory_needed(level, components), available_memory()
    if needed <= available:
        return
    fits = level
    while fits > 1 and memory_needed(fits, components) > 0.8 * available:
        fits = fits * 9 // 10 if fits > 20 else fits - 1
    raise InputError(
        "level",
        level,
        f"the finite elements would need {needed / 2**30:.3g} GiB of memory, and {available / 2**30:.3g} GiB "
        "are available",
        f"use at most {fits}; 2 is within 0.1 % of the limit",
    )
