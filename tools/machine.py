"""Where, when and beside what a table was measured."""

import os
import platform
from datetime import UTC, datetime
from pathlib import Path
from time import perf_counter


def machine() -> str:
    """Processor and cores."""
    model = platform.processor() or platform.machine()
    cpuinfo = Path("/proc/cpuinfo")
    if cpuinfo.is_file():
        lines = cpuinfo.read_text(encoding="utf-8").splitlines()
        model = next(
            (line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), model
        )
    return f"{model}, {os.cpu_count()} cores"


def measured_on() -> str:
    """Date, machine, and how many of its cores other processes kept busy since this module was imported."""
    said = f"{datetime.now(UTC):%Y-%m-%d}, {machine()}"
    elapsed = perf_counter() - _BEGUN
    if not STAT.is_file() or elapsed <= 0.0:
        return said
    others = max(_busy_seconds() - _BUSY_BEFORE, 0.0) / elapsed
    return f"{said}, {others:.1f} of them busy with other work"


STAT = Path("/proc/stat")


def _busy_seconds() -> float:
    """Processor seconds of all but this process and its children since the machine started."""
    if not STAT.is_file():
        return 0.0
    user, nice, system, _, _, irq, softirq, *_ = map(int, STAT.read_text(encoding="ascii").split()[1:9])
    return (user + nice + system + irq + softirq) / os.sysconf("SC_CLK_TCK") - sum(os.times()[:4])


_BEGUN, _BUSY_BEFORE = perf_counter(), _busy_seconds()
