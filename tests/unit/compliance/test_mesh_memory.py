"""Memory of the finite elements: the estimate, and the refusal of a mesh that does not fit."""

import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.twelve_teeth import TOOTH
from tribodyn.compliance import mesh_memory
from tribodyn.compliance.fem import gear_compliance, lead_harmonics
from tribodyn.compliance.mesh_memory import check_level, memory_needed
from tribodyn.compliance.ring_mesh import half_sector_cells, half_sector_mesh
from tribodyn.errors import InputError

# The peak of this process alone; the system's ru_maxrss starts from that of the process that started it.
STATUS = Path("/proc/self/status")
SOLVE = """
import sys
from pathlib import Path
from tests.support.twelve_teeth import TOOTH
from tribodyn.compliance.fem import gear_compliance, lead_harmonics
def peak():
    lines = Path("/proc/self/status").read_text().splitlines()
    return next(1024 * int(s.split()[1]) for s in lines if s.startswith("VmHWM"))
gear_compliance(TOOTH, 12, 8e-3, 0.3, 0.75e-3, 1)
before = peak()
if sys.argv[1] == "2":
    gear_compliance(TOOTH, 12, 8e-3, 0.3, 0.75e-3, 4)
else:
    lead_harmonics(TOOTH, 12, 8e-3, 0.3, 0.75e-3, 3, [100.0])
print(peak() - before)
"""


def test_number_of_cells_is_the_mesh_s():
    for level in (1, 3):
        mesh = half_sector_mesh(TOOTH, 12, 8e-3, level)
        cells, flank, root, _ = half_sector_cells(level)
        assert (cells, flank + 1, 2 * root + 1) == (mesh.cells.shape[1], len(mesh.flank), len(mesh.root))


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
        solve(TOOTH, 12, 8e-3, 0.3, 0.75e-3, 100_000, *waves)


def test_the_level_that_is_named_fits(monkeypatch):
    monkeypatch.setattr(mesh_memory, "available_memory", lambda: 2.0**30)
    for components in (2, 3):
        with pytest.raises(InputError) as refused:
            check_level(500, components)
        level = int(refused.value.remedy.split("at most ")[1].split(";")[0])
        assert memory_needed(level, components) < 2.0**30 < memory_needed(2 * level, components)
        check_level(level, components)


def test_level_below_one_is_refused():
    with pytest.raises(InputError, match="no cells"):
        check_level(0, 2)


def test_more_memory_than_a_machine_has_is_not_said_to_be_free():
    assert 0 < mesh_memory.available_memory() < 2.0**50
