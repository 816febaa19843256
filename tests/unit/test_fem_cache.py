"""The cache of finite-element compliances: same result, damaged files, concurrent runs, no folder."""

import multiprocessing

import numpy as np
import pytest

from tribodyn.compliance.fem_cache import cache_folder, cached_gear_compliance
from tribodyn.compliance.gear_compliance import GearCompliance
from tribodyn.geometry.drive import Drive, GearBody
from tribodyn.geometry.involute import FAMILY
from tribodyn.geometry.tooth import cut_tooth

BODY = GearBody(12, 0.3, 1.0, 1.25, 0.25, 0.02, 8e-3)
DRIVE = Drive(3e-3, np.radians(20.0), BODY, BODY)


def solve(poisson_ratio: float = 0.3, bore: float = 8e-3) -> GearCompliance:
    return cached_gear_compliance(cut_tooth(FAMILY, DRIVE, "pinion"), 12, bore, poisson_ratio, 0.75e-3, 1)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("TRIBODYN_CACHE", str(tmp_path))
    assert cache_folder() == tmp_path / "fem"
    return tmp_path / "fem"


def same(one: GearCompliance, other: GearCompliance) -> bool:
    return all(np.array_equal(a, b) for a, b in zip(one, other, strict=True))


def test_second_look_up_reads_the_file(folder, monkeypatch):
    first = solve()
    assert [file.suffix for file in folder.iterdir()] == [".npz"]
    monkeypatch.setattr("tribodyn.compliance.fem.gear_compliance", None)  # must not be needed again
    assert same(first, solve())


def test_other_material_or_body_is_another_file(folder):
    solve()
    solve(poisson_ratio=0.25)
    solve(bore=9e-3)
    assert len(list(folder.iterdir())) == 3


@pytest.mark.parametrize("damage", [b"", b"PK\x03\x04 cut off", "half"])
def test_damaged_file_is_made_anew(folder, damage):
    first = solve()
    (file,) = folder.iterdir()
    whole = file.read_bytes()
    file.write_bytes(whole[: len(whole) // 2] if damage == "half" else damage)
    assert same(first, solve())
    assert len(file.read_bytes()) == len(whole)


def test_file_with_wrong_content_is_made_anew(folder):
    first = solve()
    (file,) = folder.iterdir()
    np.savez(file, radius=np.ones(3), inside=np.ones((2, 4)), between=np.ones((5, 3, 3)), depth=1.0)
    assert same(first, solve())
    with np.load(file) as stored:
        assert len(stored["radius"]) == len(first.radius)


def test_folder_that_cannot_be_written_only_costs_time(tmp_path, monkeypatch):
    blocked = tmp_path / "file"
    blocked.write_text("not a folder")
    monkeypatch.setenv("TRIBODYN_CACHE", str(blocked))
    assert len(solve().radius) == 11


def test_runs_at_the_same_time_agree(folder):
    context = multiprocessing.get_context("spawn")
    with context.Pool(2) as pool:
        found = pool.starmap(solve, [(0.3,), (0.3,)])
    assert same(*found)
    assert len(list(folder.iterdir())) == 1
