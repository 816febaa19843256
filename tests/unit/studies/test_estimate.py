"""Estimates of memory, record and time against what runs really take; the limits, refused and lifted."""

import tracemalloc
from pathlib import Path
from time import process_time
from typing import Any, NamedTuple

import pytest

from tests.support.short_studies import short_case
from tribodyn.cases import cost
from tribodyn.cases.cost import (
    HEAD,
    LIMITS,
    PROGRAM,
    CostKey,
    Estimate,
    described,
    record_bytes,
    refuse_large,
)
from tribodyn.errors import InputError
from tribodyn.numerics.parameter import Variable, flag
from tribodyn.record.schema import Layout
from tribodyn.studies import STUDIES
from tribodyn.studies.protocol.run import run

MIB = 2.0**20


class Size(NamedTuple):
    """A run of a kind: what is set beside what makes it short."""

    kind: str
    more: dict[str, Any]


SIZES = [
    Size("gear-pair", {"solver__cycles": 8, "output__samples_per_cycle": 4000}),
    Size("gear-pair", {"mesh__points": 1501}),
    Size("efficiency", {"output__samples_per_cycle": 2500}),
    Size("load-contact", {"output__positions_per_cycle": 800, "mesh__slices": 3}),
    Size("wear", {"output__positions_per_cycle": 400}),
    Size("irefc", {"output__samples_per_cycle": 2000}),
    Size("backlash-oscillator", {}),
]


@pytest.fixture(scope="module")
def warm() -> set[str]:
    """Kinds whose modules are imported and whose kernels are compiled."""
    return set()


@pytest.mark.parametrize(
    "size", SIZES, ids=lambda size: f"{size.kind}-{'-'.join(map(str, size.more.values()))}"
)
def test_estimates_are_true(size: Size, tmp_path: Path, warm: set[str]):
    """Memory and record within a factor of two, with a few MiB that no estimate counts; time by its order."""
    if size.kind not in warm:
        run(short_case(size.kind, tmp_path), tmp_path / "warm.h5")
        warm.add(size.kind)
    case = short_case(size.kind, tmp_path, **size.more)
    said = STUDIES[size.kind].estimate(case)
    tracemalloc.start()
    started = process_time()
    try:
        result = run(case, tmp_path / "run.h5")
        taken = process_time() - started
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    record = result.path.stat().st_size
    assert 0.5 < record / said.record < 2.0
    assert 0.5 * (said.memory - PROGRAM) - 10 * MIB < peak < 2.0 * (said.memory - PROGRAM) + 10 * MIB
    assert taken < 10.0 * (said.seconds + said.shared) + 2.0
    assert said.seconds < 10.0 * taken + 2.0


def test_a_record_is_counted_by_its_layout():
    layout = Layout(
        Variable(("time",), "s", "time"),
        {"load": Variable(("time", "pair"), "N", "load"), "inside": flag(("time",), "inside", "no yes")},
        {"pair": Variable(("pair",), "1", "pair")},
        {"map": Variable(("torque", "time"), "m", "map")},
    )
    assert record_bytes(layout, {"time": 100, "pair": 3}) == HEAD + 100 * (8 + 24 + 1) + 24
    assert record_bytes(layout, {"time": 100, "pair": 3, "torque": 2}) == HEAD + 100 * (8 + 24 + 1 + 16) + 24


DRIVERS = (CostKey("a.long", 50, 10), CostKey("a.wide", 300, 10))


@pytest.mark.parametrize("name", ["memory", "record", "seconds", "shared"])
def test_what_is_too_large_is_refused_by_the_key_to_reduce(name: str):
    most = getattr(LIMITS, "seconds" if name == "shared" else name)
    refuse_large(Estimate(drivers=DRIVERS)._replace(**{name: 0.99 * most}), False)
    large = Estimate(drivers=DRIVERS)._replace(**{name: 1.01 * most})
    refuse_large(large, True)
    with pytest.raises(InputError) as error:
        refuse_large(large, False)
    assert (error.value.key, error.value.value) == ("a.wide", "300")
    assert described(large) in error.value.rule
    assert "--allow-large" in error.value.remedy


LARGE = {
    "gear-pair": [("output.samples_per_cycle", 10**9), ("solver.cycles", 10**9), ("mesh.points", 10**6)],
    "gear-train": [("output.samples_per_cycle", 10**9), ("solver.cycles", 10**9), ("mesh.points", 10**6)],
    "efficiency": [("output.samples_per_cycle", 10**9)],
    "load-contact": [("output.positions_per_cycle", 10**9), ("output.cycles", 10**9)],
    "ehl": [("output.positions", 10**9)],
    "wear": [("output.positions_per_cycle", 10**9)],
    "irefc": [("output.samples_per_cycle", 10**9)],
    "backlash-oscillator": [("frequency.from", 1e-29)],
    "assessment": [("assessment.speeds", 10**9)],
    "train-assessment": [("scenario.output.samples_per_cycle", 10**9)],
    "design": [("scenario.output.positions_per_cycle", 10**9)],
    "drive-cycle": [("cycle.step", "1e-7 s")],
    "map": [("map.most_points", 2_000_000)],
}
#: Kinds that run others, again and again.
LONG = ("assessment", "design")


@pytest.mark.parametrize("kind", LARGE)
def test_every_kind_refuses_what_is_too_large_before_any_work(kind: str, tmp_path: Path):
    study = STUDIES[kind]
    for key, value in LARGE[kind]:
        case = short_case(kind, tmp_path, **{key.replace(".", "__"): value})
        for work in (lambda case=case: run(case, tmp_path / "large.h5"), lambda case=case: study.check(case)):
            started = process_time()
            with pytest.raises(InputError) as error:
                work()
            assert "above the limits" in error.value.rule
            assert process_time() - started < 2.0
    assert not list(tmp_path.glob("*.h5"))
    assert set(LARGE) == set(STUDIES)


@pytest.mark.parametrize(
    "kind", [pytest.param(kind, marks=pytest.mark.soak if kind in LONG else ()) for kind in LARGE]
)
def test_lifted_it_goes_on_to_the_work(kind: str, tmp_path: Path, monkeypatch):
    monkeypatch.setattr(cost, "LIMITS", Estimate(1.0, 1.0, 1.0))
    case = short_case(kind, tmp_path)
    with pytest.raises(InputError, match="allow-large"):
        run(case, tmp_path / "small.h5")
    assert run(case, tmp_path / "small.h5", allow_large=True).status == "complete"
