"""The names that a Python program imports from the package itself."""

import subprocess
import sys
from pathlib import Path

import pytest

import tribodyn


def test_a_run_from_python(tmp_path: Path):
    case = tribodyn.load_scenario("crc-23-47-300", {"solver.cycles": 1, "output.samples_per_cycle": 8})
    result = tribodyn.run(case, tmp_path / "run.h5")
    assert result.status == "complete"
    with tribodyn.open_record(result.path) as record:
        assert len(record["time"]) == 9
    with pytest.raises(tribodyn.InputError, match="the file exists"):
        tribodyn.run(case, tmp_path / "run.h5")


def test_names_come_when_asked_for_and_no_sooner():
    program = (
        "import sys, tribodyn; assert 'numpy' not in sys.modules;"
        "tribodyn.load_scenario; assert 'numpy' in sys.modules"
    )
    subprocess.run([sys.executable, "-c", program], check=True)
    assert all(hasattr(tribodyn, name) for name in tribodyn.__all__)
    with pytest.raises(AttributeError, match="no attribute 'runn'"):
        tribodyn.__getattr__("runn")
