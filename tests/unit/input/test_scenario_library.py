"""The names that a Python program imports from the package itself."""

import subprocess
import sys

import pytest

import tribodyn


def test_names_come_when_asked_for_and_no_sooner():
    program = (
        "import sys, tribodyn; assert 'numpy' not in sys.modules;tribodyn.run; assert 'numpy' in sys.modules"
    )
    subprocess.run([sys.executable, "-c", program], check=True)
    assert all(hasattr(tribodyn, name) for name in tribodyn.__all__)
    with pytest.raises(AttributeError, match="no attribute 'runn'"):
        tribodyn.__getattr__("runn")
