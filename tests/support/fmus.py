"""FMUs for tests: a pair that starts from rest, and another program that drives it."""

import subprocess
import sys
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

import numpy as np
import pytest

import tribodyn as td

fmpy = pytest.importorskip("fmpy")
if find_spec("ziglang") is None:
    pytest.skip("no compiler for FMUs", allow_module_level=True)
if sys.platform != "linux":
    pytest.skip("libraries of this machine are made for Linux here", allow_module_level=True)

PAIR = "involute-23-47"
#: A motor turns the pair from rest, faster than it needs to, and the teeth lie against each other at last.
FROM_REST = {
    "operating.source": "torque",
    "operating.pinion_torque": "80 N*m",
    "operating.gear_torque": "100 N*m",
    "operating.start_speed": "0 rad/s",
    "operating.drive_inertia": "0.01 kg*m**2",
    "operating.load_inertia": "0.05 kg*m**2",
    "solver.duration": "20 ms",
    "solver.rtol": 1e-8,
    "solver.max_steps": 8000,
    "output.samples_per_cycle": 64,
    "mesh.backlash": "0.1 mm",
}


@cache
def pair_fmu(version: str, kind: str) -> Path:
    """The pair as an FMU of a version, with torques or speeds at both ends, for this machine."""
    choices = {"fmi": version, "input_kind": kind, "output_kind": kind}
    return fmu_of(PAIR, {**FROM_REST, **choices})


def fmu_of(scenario: str, settings: dict[str, Any]) -> Path:
    """The FMU of a scenario, for this machine unless the settings say otherwise."""
    folder = Path(mkdtemp(prefix="fmu-"))
    chosen = {"platforms": "x86_64-linux", **settings}
    (path,) = td.export(scenario, "fmu", folder / "unit.fmu", chosen).files
    return path


class Unit:
    """One instance of an FMU in this process, by the names of its variables."""

    def __init__(self, path: Path, tolerance: float | None = None, **values: float) -> None:
        described = fmpy.read_model_description(path)
        self.references = {each.name: each.valueReference for each in described.modelVariables}
        self.messages: list[str] = []
        folder = fmpy.extract(path)
        third = described.fmiVersion == "3.0"
        kind = fmpy.fmi3.FMU3Slave if third else fmpy.fmi2.FMU2Slave
        self.slave = kind(
            guid=described.guid,
            unzipDirectory=folder,
            modelIdentifier=described.coSimulation.modelIdentifier,
            instanceName="one",
        )
        if third:
            self.slave.instantiate(logMessage=lambda *words: self.messages.append(words[-1].decode()))
        else:
            self.slave.instantiate()
            self.slave.setupExperiment(tolerance)
        self.third, self.time = third, 0.0
        self.set(**values)
        self.slave.enterInitializationMode(*([tolerance] if third else []))
        self.slave.exitInitializationMode()

    def set(self, **values: float) -> None:
        """Set variables, "__" for a point."""
        for name, value in values.items():
            reference = [self.references[name.replace("__", ".")]]
            (self.slave.setFloat64 if self.third else self.slave.setReal)(reference, [value])

    def get(self, *names: str) -> np.ndarray:
        """Values of variables; without names of all."""
        wanted = [self.references[name] for name in names or self.references]
        return np.array((self.slave.getFloat64 if self.third else self.slave.getReal)(wanted))

    def step(self, size: float, count: int = 1) -> "Unit":
        """Go on by so many steps."""
        for _ in range(count):
            self.slave.doStep(self.time, size)
            self.time += size
        return self


def compiled_harness(folder: Path) -> Path:
    """The program of `fmu_harness.c`."""
    source, program = Path(__file__).with_name("fmu_harness.c"), folder / "harness"
    words = ["cc", "-O1", "-Wall", "-Wextra", "-Werror", str(source), "-lpthread", "-o", str(program)]
    subprocess.run([sys.executable, "-m", "ziglang", *words], check=True)
    return program


def relative(found: np.ndarray, exact: np.ndarray) -> float:
    """Largest difference over the range of what is exact."""
    return float(np.max(np.abs(found - exact)) / np.ptp(exact))


def against_run(path: Path, run: Any, meshes: dict[str, str | None]) -> dict[str, float]:
    """How far a transient of an FMU is from a run by time, by quantity, over the ranges.

    `meshes` are the names of the FMU's meshes with those of the record.
    """
    import xarray

    data = xarray.open_dataset(run.path, engine="h5netcdf")
    times = data.time.values
    step = float(times[1])
    rows = fmpy.simulate_fmu(
        str(path), stop_time=times[-1] + 0.5 * step, step_size=step, output_interval=step
    )
    rows = rows[: len(times)]
    assert np.allclose(rows["time"], times, atol=1e-9 * times[-1])
    off = {"stored_energy": relative(rows["stored_energy"], data.stored_energy.values)}
    for name, recorded in meshes.items():
        mesh = data if recorded is None else data.sel(mesh=recorded)
        load, film = mesh.normal_load.values, mesh.central_film_thickness.values
        loaded = np.where(load > 0.0, film, np.inf).min(axis=1)
        loaded = np.where(np.isfinite(loaded), loaded, 0.0)
        off |= {
            f"{name} error": relative(
                rows[f"{name}.transmission_error"], mesh.transmission_error_rotational.values
            ),
            f"{name} load": relative(rows[f"{name}.normal_load"], np.nansum(load, axis=1)),
            f"{name} film": relative(rows[f"{name}.film_min"], loaded),
        }
    return off
