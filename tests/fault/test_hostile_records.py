"""Records made by somebody who means harm: one message, no other file read, no end of memory or time."""

import os
import shutil
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from tests.support.record_samples import block, gear_pair_writer, geometry
from tests.support.verbs import complaint
from tribodyn.errors import InputError
from tribodyn.post.page.sensors import sensed_section
from tribodyn.record import schema, soundness
from tribodyn.record.reader import Record
from tribodyn.record.sensors import Sensed, SensorSignal, write_sensed
from tribodyn.record.sweep_reader import open_any
from tribodyn.signals.lines import SignalLine

LOAD = "normal_load"
SECRET = np.arange(10.0)
#: Records of another version.
OLD = Path(__file__).parents[1] / "fixtures" / "records-0.1.0"


@pytest.fixture(scope="module")
def good(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("good") / "run.h5"
    with gear_pair_writer(
        path, 10, outlines=geometry(), scenario_toml='kind = "gear-pair"\n', sha256="0"
    ) as writer:
        writer.write(0, block(0, 10))
        return writer.finish({"efficiency": 0.9})


@pytest.fixture
def path(good: Path, tmp_path: Path) -> Path:
    shutil.copyfile(good, tmp_path / "run.h5")
    with h5py.File(tmp_path / "secret.h5", "w") as file:
        file["normal_load"] = SECRET
    (tmp_path / "secret.bin").write_bytes(SECRET.tobytes())
    return tmp_path / "run.h5"


def layout() -> h5py.VirtualLayout:
    made = h5py.VirtualLayout((10,), "f8")
    made[:] = h5py.VirtualSource("secret.h5", "normal_load", (10,))
    return made


#: What stands in place of the dataset normal_load.
REPLACED: dict[str, Callable[[Any], object]] = {
    "external link": lambda f: f.__setitem__(LOAD, h5py.ExternalLink("secret.h5", "/normal_load")),
    "external storage": lambda f: f.create_dataset(LOAD, (10,), "f8", external=[("secret.bin", 0, 80)]),
    "virtual": lambda f: f.create_virtual_dataset(LOAD, layout()),
    "soft link": lambda f: f.__setitem__(LOAD, h5py.SoftLink("/normal_load")),
    "enormous": lambda f: f.create_dataset(LOAD, (10**9, 10**9), "f8", chunks=(1, 1000)),
    "enormous in one piece": lambda f: f.create_dataset(LOAD, (10**6, 10**9), "f8"),
    "text for numbers": lambda f: f.__setitem__(LOAD, np.full((10, 2), b"x")),
    "a column of texts": lambda f: with_unit(f.create_dataset(LOAD, data=np.full(10, b"x"))),
    "compound": lambda f: f.__setitem__(LOAD, np.zeros((10, 2), [("a", "f8"), ("b", "S4")])),
    "one large part": lambda f: f.create_dataset(LOAD, (2**24,), "f8", chunks=(2**24,), compression="gzip"),
    "objects": lambda f: f.__setitem__(LOAD, ["a", "text"]),
}


def with_unit(dataset: Any) -> None:
    dataset.attrs["units"] = "N"


def scales_of(count: int) -> Callable[[Any], object]:
    """The attribute that connects normal_load with scales, of so many axes; HDF5 asks not how many it has."""

    def change(file: Any) -> None:
        del file[LOAD].attrs["DIMENSION_LIST"]
        kind = h5py.special_dtype(vlen=h5py.ref_dtype)
        listed = np.empty(count, kind)
        for axis in range(count):
            listed[axis] = np.array([file["time"].ref], h5py.ref_dtype)
        file[LOAD].attrs.create("DIMENSION_LIST", listed, dtype=kind)

    return change


#: What is added or changed.
CHANGED: dict[str, Callable[[Any], object]] = {
    "group in itself": lambda f: f["geometry"].__setitem__("again", f["geometry"]),
    "negative count": lambda f: f["samples_written"].__setitem__(..., -1),
    "huge count": lambda f: f["samples_written"].__setitem__(..., 2**62),
    "status of numbers": lambda f: f.attrs.__setitem__("status", np.arange(3.0)),
    "version of words": lambda f: f.attrs.__setitem__("format_version", "new"),
    "datatype": lambda f: f.__setitem__("type", np.dtype("f8")),
    "more scales than axes": scales_of(7),
    "many more scales than axes": scales_of(500),
    "fewer scales than axes": scales_of(1),
    "scales of a text": lambda f: f[LOAD].attrs.__setitem__("DIMENSION_LIST", "x" * 50),
    "a scale's datasets of a text": lambda f: f["time"].attrs.__setitem__("REFERENCE_LIST", "x" * 200),
    "a long mark of a scale": lambda f: f["time"].attrs.__setitem__("CLASS", np.bytes_(b"DIMENSION" * 99)),
    "a number for a scale's name": lambda f: f["time"].attrs.__setitem__("NAME", 3),
}


RATE, SAMPLES = 1000.0, 400
#: What is wrong with the signals of sensors: group, dataset or attribute, and what it holds.
SENSED: dict[str, Callable[[Any], object]] = {
    "a high rate": lambda g: g.attrs.__setitem__("rate", 1e300),
    "a low rate": lambda g: g.attrs.__setitem__("rate", 1e-9),
    "no rate": lambda g: g.attrs.__setitem__("rate", np.nan),
    "a long time": lambda g: g["time"].__setitem__(..., np.linspace(0.0, 1e12, SAMPLES)),
    "a time that jumps": lambda g: g["time"].__setitem__(-1, 1e12),
    "no order": lambda g: g.parent["lines/order"].__setitem__(..., np.nan),
    "a high order": lambda g: g.parent["lines/order"].__setitem__(..., 1e12),
}
#: Signals that could be measured, but of which nothing can be made.
UNHEARD: dict[str, Callable[[Any], object]] = {
    "rotation that jumps": lambda g: g["reference_angle"].__setitem__(-1, 1e9),
    "many turns": lambda g: g["reference_angle"].__setitem__(..., np.linspace(0.0, 1e12, SAMPLES)),
}


def add_sensor(path: Path) -> None:
    """A sensor of 1000 samples per second, at a gear that turns 50 times in a second."""
    time = np.arange(SAMPLES) / RATE
    angle, values = 100.0 * np.pi * time, np.sin(1000.0 * time)
    signal = SensorSignal("top", "housing", "acceleration", "m/s2", RATE, time, angle, values)
    with h5py.File(path, "r+") as file:
        write_sensed(Sensed((signal,), (SignalLine("mesh", "mesh", 1e-5),), "pinion"), file)


@pytest.mark.parametrize("what", [*SENSED, *UNHEARD])
def test_signals_that_no_sensor_gives_are_refused(what: str, path: Path, tmp_path: Path):
    """Nothing is made of rates, times and rotations that would fill the memory; a slow mesh has few names."""
    add_sensor(path)
    with Record(path) as record:
        assert sensed_section(record).lines is not None
    with h5py.File(path, "r+") as file:
        (SENSED | UNHEARD)[what](file["sensors/at_1000_Hz"])
    if what in SENSED:
        assert "damaged" in complaint("listen", path, folder=tmp_path)
        return
    with Record(path) as record, pytest.raises(InputError, match="samples would be made of 400"):
        sensed_section(record)


@pytest.mark.parametrize("shift", ["1e-9", "inf", "nan", "1e9", "0", "-1"])
def test_a_sound_that_would_not_end_or_not_begin_is_refused(shift: str, path: Path, tmp_path: Path):
    add_sensor(path)
    line = complaint("listen", path, "--shift", shift, folder=tmp_path)
    assert "400 samples at 1000 Hz can be shifted by 0.00067 to 4.4e+04" in line


def test_a_look_ends_by_the_processor_too(path: Path, monkeypatch):
    """Where HDF5 goes around in circles; other work beside it counts for nothing."""
    monkeypatch.setattr(soundness, "PROCESSOR_LIMIT", 0.1)
    assert soundness.forked(counts_without_end, path).startswith("reading it did not end within 0.1 s of the")


def counts_without_end(path: Path) -> str:
    while True:
        pass


def damage(path: Path, what: str) -> None:
    with h5py.File(path, "r+") as file:
        if what in REPLACED:
            del file[LOAD]
        (REPLACED | CHANGED)[what](file)


@pytest.mark.parametrize("what", [*REPLACED, *CHANGED])
def test_it_is_refused_in_python_and_on_the_command_line(what: str, good: Path, path: Path):
    damage(path, what)
    with pytest.raises(InputError, match="damaged"):
        open_any(path)
    verbs = (["show"], ["show", "--json"], ["plot"], ["compare", good])
    # all of them open a record in one way
    for verb, *more in verbs if what in ("external link", "external storage", "virtual") else verbs[:1]:
        assert "damaged" in complaint(verb, path, *more)


def test_a_long_text_in_a_record_makes_no_long_message(path: Path):
    with h5py.File(path, "r+") as file:
        file.attrs["kind"] = "x" * 10_000
    assert len(complaint("show", path)) < 2000


@pytest.mark.parametrize("name", schema.HEAD)
@pytest.mark.parametrize("kind", ["gear-pair", "sweep"])
def test_an_attribute_that_every_record_has_is_missing(name: str, kind: str, tmp_path: Path):
    shutil.copy(OLD / f"{kind}.h5", tmp_path / "some.h5")
    open_any(tmp_path / "some.h5").close()
    with h5py.File(tmp_path / "some.h5", "a") as file:
        del file.attrs[name]
    with pytest.raises(InputError, match="damaged"):
        open_any(tmp_path / "some.h5")


def test_compressed_data_that_would_fill_the_memory_are_refused(path: Path):
    with h5py.File(path, "r+") as file:
        del file[LOAD]
        file.create_dataset(LOAD, (10**8,), "f8", chunks=(10**6,), compression="gzip", fillvalue=0.0)
    with pytest.raises(InputError, match="larger than the file"):
        open_any(path)


needs_fork = pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")


def never_ends(path: Path) -> str:
    """A stand-in for a file in which HDF5 goes around in circles."""
    time.sleep(100)
    return ""


def dies(path: Path) -> str:
    """A stand-in for a file on which HDF5 crashes."""
    os.kill(os.getpid(), 9)
    return ""


def test_a_structure_without_end_is_given_up(path: Path, monkeypatch):
    monkeypatch.setattr(soundness, "TIME_LIMIT", 0.3)
    monkeypatch.setattr(soundness, "unsound", never_ends)
    monkeypatch.setattr(soundness, "through_a_child", soundness.forked)
    with pytest.raises(InputError, match="did not end within"):
        open_any(path)


@needs_fork
def test_a_crash_of_the_library_is_not_ours(path: Path, monkeypatch):
    monkeypatch.setattr(soundness, "unsound", dies)
    monkeypatch.setattr(soundness, "through_a_child", soundness.forked)
    with pytest.raises(InputError, match="HDF5 crashes on it"):
        open_any(path)


def test_a_good_record_is_looked_through_once(path: Path, monkeypatch):
    looked = []
    original = soundness.through_a_child
    monkeypatch.setattr(
        soundness, "through_a_child", lambda look, path: looked.append(path) or original(look, path)
    )
    for _ in range(3):
        with Record(path) as record:
            assert record.samples == 10
    assert looked == [path]
    damage(path, "external link")
    with pytest.raises(InputError, match="damaged"):
        Record(path)


@pytest.fixture
def kept():
    """Processes that are kept for looks end with the test."""
    yield soundness._kept
    while soundness._processes:
        soundness._processes.popitem()[1].end()


@needs_fork
def test_all_ways_of_looking_agree(path: Path, kept):
    ways = (soundness.forked, lambda look, path: look(path), lambda look, path: kept(look).answer(path))
    for way in ways:
        assert way(soundness.unsound, path) == ""
    damage(path, "external link")
    for way in ways:
        assert way(soundness.unsound, path) == "'normal_load' is a link to somewhere else"


@needs_fork
def test_a_process_that_is_kept_survives_what_it_looks_at(path: Path, kept, monkeypatch):
    process = kept(dies)
    assert process.answer(path) == process.answer(path) == soundness.CRASHED
    assert kept(dies) is process
    process._process.kill()
    assert process.answer(path) == soundness.CRASHED
    assert kept(dies) is not process
    monkeypatch.setattr(soundness, "START_LIMIT", 0.2)
    monkeypatch.setattr(soundness, "TIME_LIMIT", 0.2)
    assert "did not end within" in kept(never_ends).answer(path)


def test_an_error_of_a_users_own_is_no_damage(path: Path):
    """While a record is open a script may fail for reasons of its own."""
    script: dict[str, object] = {"Record": Record, "path": path}
    with pytest.raises(ZeroDivisionError):
        exec("with Record(path) as record:\n    1 / 0", script | {"__name__": "script"})
