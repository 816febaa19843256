"""The cache of finite-element compliances: same result, other gears, concurrent runs, no folder."""

import multiprocessing

import numpy as np
import pytest

from tests.support.twelve_teeth import GEAR, few_cells
from tribodyn.compliance.fem.cache import _digest, cached_gear_compliance
from tribodyn.compliance.fem.gear_compliance import GearCompliance
from tribodyn.numerics.files.cache import cache_folder


def solve(poisson_ratio: float = 0.3, bore: float = 8e-3, width: float | None = None) -> GearCompliance:
    return cached_gear_compliance(GEAR._replace(bore_radius=bore, poisson_ratio=poisson_ratio), width)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    few_cells(monkeypatch)
    monkeypatch.setenv("TRIBODYN_CACHE", str(tmp_path))
    assert cache_folder() / "fem" == tmp_path / "fem"
    return tmp_path / "fem"


def same(first: GearCompliance, second: GearCompliance) -> bool:
    both = [[*gear[:-2], *(gear.lead or ()), *(gear.ends or ())] for gear in (first, second)]
    return all(np.array_equal(a, b) for a, b in zip(*both, strict=True))


def test_second_look_up_reads_the_file(folder, monkeypatch):
    first = solve()
    assert len(list(folder.iterdir())) == 1
    monkeypatch.setattr("tribodyn.compliance.fem.gear.gear_compliance", None)  # must not be needed again
    assert same(first, solve())


def test_every_number_of_a_gear_is_in_the_name_of_its_file():
    others = [GEAR._replace(**{field: 2 * getattr(GEAR, field)}) for field in GEAR._fields[1:-2]]
    others += [GEAR._replace(free_rim=True), GEAR._replace(held=True)]
    others.append(GEAR._replace(tooth=GEAR.tooth._replace(tip_distance=0.9 * GEAR.tooth.tip_distance)))
    names = [*map(_digest, others), *(_digest(GEAR, *more) for more in ([], [1.0], [2.0], [np.ones(2)]))]
    assert len(set(names)) == len(others) + 4


def test_a_file_of_another_gear_under_this_name_is_made_anew(folder):
    first = solve()
    (file,) = folder.iterdir()
    whole = file.read_bytes()
    solve(bore=9e-3)
    (other,) = {*folder.iterdir()} - {file}
    file.write_bytes(other.read_bytes())
    assert same(first, solve())
    assert file.read_bytes() == whole


def test_folder_that_cannot_be_written_only_costs_time(tmp_path, monkeypatch):
    few_cells(monkeypatch)
    blocked = tmp_path / "file"
    blocked.write_text("not a folder")
    monkeypatch.setenv("TRIBODYN_CACHE", str(blocked))
    assert len(solve().radius) == 3


def test_runs_at_the_same_time_agree(tmp_path, monkeypatch):
    monkeypatch.setenv("TRIBODYN_CACHE", str(tmp_path))
    context = multiprocessing.get_context("spawn")
    with context.Pool(2) as pool:
        found = pool.starmap(solve, [(0.3,), (0.3,)])
    assert same(*found)
    assert len(list((tmp_path / "fem").iterdir())) == 1
