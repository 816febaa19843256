"""Memory of the finite elements: the estimate, and the refusal of a mesh that does not fit."""

import math
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.twelve_teeth import GEAR, TOOTH
from tribodyn.compliance.fem import gear as mesh_memory
from tribodyn.compliance.fem.cyclic_symmetry import half_sector
from tribodyn.compliance.fem.gear import check_level, gear_compliance, lead_harmonics, memory_needed
from tribodyn.compliance.fem.ring_mesh import half_sector_cells, half_sector_mesh
from tribodyn.errors import InputError

# The peak of this process alone; the system's ru_maxrss starts from that of the process that started it.
STATUS = Path("/proc/self/status")
SOLVE = """
import sys
from pathlib import Path
from tests.support.twelve_teeth import GEAR
from tribodyn.compliance.fem.gear import gear_compliance, lead_harmonics
def peak():
    lines = Path("/proc/self/status").read_text().splitlines()
    return next(1024 * int(s.split()[1]) for s in lines if s.startswith("VmHWM"))
gear_compliance(GEAR)
before = peak()
if sys.argv[1] == "2":
    gear_compliance(GEAR._replace(level=4))
else:
    lead_harmonics(GEAR._replace(level=3), [100.0])
print(peak() - before)
"""


def test_number_of_cells_is_the_mesh_s():
    for level in (1, 3):
        mesh = half_sector_mesh(TOOTH, 12, 8e-3, level)
        cells, flank, root, edge = half_sector_cells(level)
        assert (cells, flank + 1, 2 * root + 1) == (mesh.cells.shape[1], len(mesh.flank), len(mesh.root))
        assert 2 * edge == len(half_sector(mesh.nodes, 12, 8e-3).edge)


@pytest.mark.parametrize("level", [1, 3])
@pytest.mark.parametrize("components", [2, 3])
def test_estimate_counts_what_there_is(monkeypatch, level, components):
    """Two dense matrices of the edge and of the readers, and factors that grow like n log n."""
    monkeypatch.setattr(mesh_memory, "_ENDS", 0.0)
    mesh = half_sector_mesh(TOOTH, 12, 8e-3, level)
    half = half_sector(mesh.nodes, 12, 8e-3)
    sides, points = components * len(half.edge), len(mesh.root) - 1
    # flank loads and readings at two depths; root stress on both sides of the tooth
    readers = 3 * len(mesh.flank) + (2 * points if components == 3 else 0)
    unknowns = components * half.nodes
    dense = 8.0 * 3.0 * unknowns * (sides + readers)
    factors = 24.0 * {2: 10.5, 3: 12.5}[components] * unknowns * math.log2(unknowns)
    assert memory_needed(level, components) == pytest.approx(dense + factors, rel=0.13 / level)


@pytest.mark.skipif(not STATUS.exists(), reason="the system does not tell a process's peak of memory")
@pytest.mark.parametrize(("components", "level"), [pytest.param(2, 4, marks=pytest.mark.soak), (3, 3)])
def test_estimate_meets_the_peak_of_a_process(components, level):
    done = subprocess.run(
        [sys.executable, "-c", SOLVE, str(components)], capture_output=True, text=True, check=True
    )
    assert memory_needed(level, components) == pytest.approx(float(done.stdout), rel=0.2)


@pytest.mark.parametrize("solve", [gear_compliance, lead_harmonics])
def test_mesh_beyond_the_memory_is_refused_at_once(solve):
    waves = [[100.0]] if solve is lead_harmonics else []
    with pytest.raises(InputError, match=r"level = 100000: .* GiB of memory.*use at most \d+"):
        solve(GEAR._replace(level=100_000), *waves)
    needed = memory_needed(100_000, 3 if waves else 2)
    with pytest.raises(InputError, match=f"would need {needed / 2**30:.3g} GiB".replace("+", r"\+")):
        solve(GEAR._replace(level=100_000), *waves)


@pytest.mark.parametrize("components", [2, 3])
@pytest.mark.parametrize("available", [2.0**28, 3e9, 2.0**37])
def test_the_level_that_is_named_fits(monkeypatch, components, available):
    """Into four fifths of the memory, and is hardly less than the largest that does."""
    monkeypatch.setattr(mesh_memory, "available_memory", lambda: available)
    with pytest.raises(InputError) as refused:
        check_level(5000, components)
    level = int(refused.value.remedy.split("at most ")[1].split(";")[0])
    assert memory_needed(level, components) <= 0.8 * available
    assert memory_needed(level + 1 + (level // 9 if level > 17 else 0), components) > 0.8 * available
    check_level(level, components)
    message = f"{memory_needed(5000, components) / 2**30:.3g} GiB of memory, and {available / 2**30:.3g} GiB"
    assert message in str(refused.value)


def test_level_below_one_is_refused():
    with pytest.raises(InputError, match="no cells"):
        check_level(0, 2)
