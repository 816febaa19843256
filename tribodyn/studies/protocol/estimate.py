"""What a run takes, said before it begins, and the limits above which it has to be asked for."""

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from tribodyn.errors import InputError
from tribodyn.numerics.parameter import Variable
from tribodyn.record.schema import Layout

GIB = 2.0**30
#: Bytes of the program itself, its libraries and compiled kernels, and of a record without its samples.
PROGRAM, HEAD = 160 * 2.0**20, 30e3


class Driver(NamedTuple):
    """A key that an estimate grows with."""

    key: str
    #: value, usual: here, and usually; or anything of that ratio, where there is a `remedy`
    value: float
    usual: float
    remedy: str = ""  # what to do about it, where that is not to reduce the value


class Estimate(NamedTuple):
    """What a run takes."""

    #: bytes at once, the program included; true within a factor of about two where it is large
    memory: float = 0.0
    record: float = 0.0  # bytes of the record; while it is concluded there are two of it
    seconds: float = 0.0  # of one core, compiling not included; of the right order
    drivers: Sequence[Driver] = ()  # what to reduce
    shared: float = 0.0  # seconds, in addition, that cases of a sweep which share a table spend once


#: Above any of these a run is refused unless it is asked for; from this share on `check` says the estimate.
LIMITS = Estimate(memory=8 * GIB, record=64 * GIB, seconds=1000 * 3600.0)
WORTH_SAYING = 0.05


def record_bytes(layout: Layout, sizes: Mapping[str, int]) -> float:
    """Bytes of a record.

    Parameters
    ----------
    sizes : dimension -> values along it; datasets with another dimension are left out
    """
    return HEAD + variable_bytes(
        (*layout.along.values(), *layout.scales.values(), *layout.others.values()), sizes
    )


def variable_bytes(variables: Iterable[Variable], sizes: Mapping[str, int]) -> float:
    """Bytes of datasets, those along an axis without a size left out."""
    return sum(
        math.prod(float(sizes[dim]) for dim in one.dims) * _bytes(one.dtype)
        for one in variables
        if all(dim in sizes for dim in one.dims)
    )


def _bytes(dtype: str) -> int:
    """Bytes of a number of a type as NumPy names it: "<f8", "i1", "S24"."""
    return int(dtype.lstrip("<>|=")[1:])


def share_of_limits(estimate: Estimate) -> float:
    """The largest of what is taken over what is allowed."""
    pairs = zip(estimate[:3], LIMITS[:3], strict=True)
    return max(taken / most for taken, most in pairs)


def described(estimate: Estimate) -> str:
    """What a run takes, in words."""
    return (
        f"{_size(estimate.memory)} of memory, a record of {_size(estimate.record)} "
        f"and {_time(estimate.seconds + estimate.shared)} of one core"
    )


def as_data(estimate: Estimate) -> dict[str, float]:
    """What a run takes, for programs: bytes and seconds."""
    return {
        "memory": estimate.memory,
        "record": estimate.record,
        "core_seconds": estimate.seconds + estimate.shared,
    }


def refuse_large(estimate: Estimate, allow_large: bool) -> None:
    """Refuse what takes more than `LIMITS`, unless it is allowed.

    Raises
    ------
    InputError
        It names the key whose value is furthest above a usual one.
    """
    whole = estimate._replace(seconds=estimate.seconds + estimate.shared)
    if allow_large or share_of_limits(whole) <= 1.0 or not estimate.drivers:
        return
    worst = max(estimate.drivers, key=lambda one: one.value / one.usual)
    allowed = f"{_size(LIMITS.memory)}, {_size(LIMITS.record)} and {_time(LIMITS.seconds)}"
    raise InputError(
        worst.key,
        None if worst.remedy else f"{worst.value:.10g}",
        f"takes about {described(estimate)}, above the limits: {allowed}",
        f"{worst.remedy or f'reduce it ({worst.usual:g} is usual)'}, or add --allow-large",
    )


def not_resumed(about: str) -> InputError:
    """What to say where a run of a study is to go on that cannot."""
    return InputError("--resume", None, f"{about}: such a run cannot go on", "omit it")


def _size(size: float) -> str:
    for unit, name in ((GIB, "GiB"), (2.0**20, "MiB")):
        if size >= unit:
            return f"{size / unit:.3g} {name}"
    return f"{size / 1024:.3g} KiB"


def _time(seconds: float) -> str:
    for unit, name in ((86400.0, "days"), (3600.0, "hours"), (60.0, "minutes")):
        if seconds >= 2 * unit:
            return f"{seconds / unit:.3g} {name}"
    return f"{seconds:.2g} s"
