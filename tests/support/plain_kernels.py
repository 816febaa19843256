"""Kernels as the Python functions that they are made of: nothing is compiled."""

from types import ModuleType
from typing import Any

import pytest

from tribodyn.kernels.native import Kernel


def plain(kernel: Any) -> Any:
    """The function of a kernel."""
    return kernel.function


def make_plain(monkeypatch: pytest.MonkeyPatch, *modules: ModuleType) -> None:
    """Let the kernels that some modules name be Python functions."""
    for module in modules:
        for name, value in list(vars(module).items()):
            if isinstance(value, Kernel):
                monkeypatch.setattr(module, name, value.function)
