"""Kernels as the Python functions that they are made of: nothing is compiled."""

from types import FunctionType, ModuleType
from typing import Any

import pytest

from tribodyn.kernels.native import Kernel


def plain(kernel: Any) -> Any:
    """The function of a kernel."""
    return kernel.function


def interpreted(kernel: Any, *but: Any) -> Any:
    """The function of a kernel, and those of all kernels that it calls, but of some that stay."""
    function = kernel.function
    names = {
        name: interpreted(value, kernel, *but)
        for name in function.__code__.co_names
        if isinstance(value := function.__globals__.get(name), Kernel) and value not in but
    }
    return FunctionType(function.__code__, function.__globals__ | names, function.__name__)


def make_plain(monkeypatch: pytest.MonkeyPatch, *modules: ModuleType) -> None:
    """Let the kernels that some modules name be Python functions."""
    for module in modules:
        for name, value in list(vars(module).items()):
            if isinstance(value, Kernel):
                monkeypatch.setattr(module, name, value.function)
