"""FMUs of trains: the same transients as runs by time, oil at other temperatures, every platform."""

import zipfile
from pathlib import Path

import numpy as np
import pytest

import tribodyn as td
from tests.support.fmus import Unit, against_run, fmu_of

#: From rest, against each other, and the names of meshes in the FMU and in the record.
TRAINS = {
    "two-stage-reducer": (
        {
            "operating.input_torque": "300 N*m",
            "film.law": "dowson-higginson",
            "friction.law": "masjedi-khonsari",
        },
        {"first": "first", "second": "second"},
    ),
    "planetary-24-84": (
        {"operating.input_torque": "300 N*m", "stage.0.frame_forces": False},
        {"set_sun_2": "set-sun-2", "set_ring_1": "set-ring-1"},
    ),
}
FROM_REST = {
    "operating.source": "torque",
    "operating.start_speed": "0 rad/s",
    "operating.drive_inertia": "0.05 kg*m**2",
    "solver.duration": "10 ms",
    "solver.rtol": 1e-8,
    "output.samples_per_cycle": 32,
}


@pytest.mark.parametrize("name", TRAINS)
def test_a_transient_of_a_train_is_that_of_a_run_by_time(name: str, tmp_path: Path):
    settings, meshes = TRAINS[name]
    run = td.run(name, {**FROM_REST, **settings}, output=tmp_path / "run.h5")
    off = against_run(fmu_of(name, {**FROM_REST, **settings}), run, dict(meshes))
    assert max(off.values()) <= 1e-5, off


def test_another_temperature_of_the_oil_is_that_of_the_scenario_there():
    """Of teeth that begin without load, so that both begin alike."""
    settings, _ = TRAINS["two-stage-reducer"]
    settings = {**settings, "solver.initial": "unloaded", "solver.rtol": 1e-8, "operating.source": "torque"}
    cool = Unit(fmu_of("two-stage-reducer", settings), oil_temperature=273.15 + 47.7).step(1e-4, 100)
    own = Unit(fmu_of("two-stage-reducer", {**settings, "operating.oil_temperature": "47.7 degC"}))
    there = own.step(1e-4, 100)
    for name in ("first.film_min", "second.lambda_min", "friction_loss", "input_speed"):
        assert cool.get(name) == pytest.approx(there.get(name), rel=1e-5)


#: The beginning of a library, and where a number says for what processor it is.
HEADS = {
    "x86_64-linux": (b"\x7fELF\x02\x01", slice(18, 20), "<u2", 62),
    "aarch64-linux": (b"\x7fELF\x02\x01", slice(18, 20), "<u2", 183),
    "x86_64-darwin": (b"\xcf\xfa\xed\xfe", slice(4, 8), "<u4", 0x01000007),
    "aarch64-darwin": (b"\xcf\xfa\xed\xfe", slice(4, 8), "<u4", 0x0100000C),
}


def test_libraries_for_every_platform_are_what_their_folders_say():
    path, again = (fmu_of("involute-23-47", {"platforms": "linux,windows,macos"}) for _ in range(2))
    assert path.read_bytes() == again.read_bytes()
    with zipfile.ZipFile(path) as archive:
        libraries = {
            name.split("/")[1]: archive.read(name)
            for name in archive.namelist()
            if name.startswith("binaries/")
        }
    assert libraries.keys() == {*HEADS, "x86_64-windows"}
    for platform, (head, where, kind, processor) in HEADS.items():
        content = libraries[platform]
        assert content.startswith(head)
        assert np.frombuffer(content[where], kind)[0] == processor
    windows = libraries["x86_64-windows"]
    start = int(np.frombuffer(windows[60:64], "<u4")[0])
    assert windows[:2] == b"MZ"
    assert windows[start : start + 6] == b"PE\0\0\x64\x86"
    assert all(b"fmi3DoStep" in content for content in libraries.values())
    # beside the system's own, no library is needed
    assert b"libpython" not in b"".join(libraries.values())


def test_a_universal_library_of_fmi_2_is_for_both_processors_of_macos():
    with zipfile.ZipFile(fmu_of("involute-23-47", {"platforms": "macos", "fmi": "2.0"})) as archive:
        content = archive.read("binaries/darwin64/unit.dylib")
    numbers = np.frombuffer(content[8:48], ">u4").reshape(2, 5)
    for (processor, _, offset, size, _), platform in zip(
        numbers.tolist(), ("x86_64-darwin", "aarch64-darwin"), strict=True
    ):
        part = content[offset : offset + size]
        head, where, kind, known = HEADS[platform]
        assert part.startswith(head)
        assert np.frombuffer(part[where], kind)[0] == processor == known
