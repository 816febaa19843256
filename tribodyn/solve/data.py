"""What a case says of its solution."""

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class SolverData:
    """Method, relative tolerance, mesh cycles to run, steps allowed per cycle, and where the run starts."""

    method: str = "auto"
    rtol: float = 1e-6
    cycles: int = 20
    max_steps: int = 1_000_000
    initial: Literal["static", "unloaded"] = "static"
