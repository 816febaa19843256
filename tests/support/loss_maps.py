"""Records of maps with losses in closed form."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import h5py
import numpy as np

RATIO, NOMINAL_TORQUE, NOMINAL_SPEED = -0.1, 400.0, 150.0
#: Stiffness at the output, inertia at either end, backlash.
STIFFNESS, INPUT_INERTIA, BACKLASH = 2e5, 0.003, 8e-4
TORQUES = np.array([-400.0, -200.0, -50.0, 0.0, 50.0, 200.0, 400.0])
SPEEDS = np.array([-200.0, -80.0, 0.0, 40.0, 100.0, 200.0])
TEMPERATURES = np.array([300.0, 340.0, 380.0])
#: Loss of the meshes as a share of the load; drag at standstill, and its growth with speed.
SHARE, STANDSTILL, VISCOUS = 0.04, 0.3, 0.002


def mesh_drag(temperature: Any, torque: Any, speed: Any) -> Any:
    """Proportional to the load: η forward, 2 - 1/η backward."""
    return SHARE * abs(RATIO * torque) + 0.0 * (speed + temperature)


def seal_drag(temperature: Any, torque: Any, speed: Any) -> Any:
    """Coulomb and viscous, falling with temperature."""
    return (STANDSTILL + VISCOUS * abs(speed)) * (300.0 / temperature) + 0.0 * torque


Drag = Callable[[Any, Any, Any], Any]
SOURCES: dict[tuple[str, str, str], Drag] = {
    ("P_VZP", "high", "closed form"): mesh_drag,
    ("P_VD", "input, seal", "closed form"): seal_drag,
}
#: Meshes and their cycles per turn of the input; amplitudes at the nominal torque (mesh, harmonic).
MESHES = {"high": 20.0, "low": 6.0}
AMPLITUDES = np.array([[4e-5, 1e-5], [2e-5, 5e-6]])


def write_map(
    path: Path,
    sources: Mapping[tuple[str, str, str], Drag] | None = None,
    changes: Mapping[str, Any] | None = None,
) -> Path:
    """Write the record of a map; `changes` takes the place of axes and attributes, None of a dataset."""
    sources = SOURCES if sources is None else sources
    given = dict(changes or {})
    axes = {
        "speed": given.pop("speed", SPEEDS),
        "torque": given.pop("torque", TORQUES),
        "oil_temperature": given.pop("oil_temperature", TEMPERATURES),
        "source": np.arange(len(sources)),
        "mesh": np.array(list(MESHES), "S"),
        "harmonic": np.arange(1, AMPLITUDES.shape[1] + 1),
    }
    where = np.meshgrid(axes["oil_temperature"], axes["torque"], axes["speed"], indexing="ij")
    drag = np.stack([drag(*where) for drag in sources.values()])
    load = 0.2 + 0.8 * np.abs(axes["torque"]) / NOMINAL_TORQUE
    texts = {
        f"source_{part}": np.array([words[n] for words in sources], "S") for n, part in enumerate(_PARTS)
    }
    data: dict[str, tuple[str, tuple[str, ...], Any]] = {
        "drag": ("N*m", ("source", "oil_temperature", "torque", "speed"), drag),
        "power_loss": ("W", ("oil_temperature", "torque", "speed"), drag.sum(axis=0) * np.abs(where[2])),
        **{name: ("1", ("source",), values) for name, values in texts.items()},
        "stiffness_total": ("N*m/rad", ("torque",), STIFFNESS * load),
        "backlash": ("rad", (), BACKLASH),
        "mesh_order": ("1", ("mesh",), np.array(list(MESHES.values()))),
        "transmission_error_output": (
            "rad",
            ("mesh", "torque", "harmonic"),
            AMPLITUDES[:, None, :] * load[None, :, None],
        ),
        "transmission_error_phase": ("rad", ("mesh", "torque", "harmonic"), np.zeros((2, len(load), 2))),
    }
    for name in [name for name in given if name in data and given[name] is None]:
        del data[name], given[name]
    with h5py.File(path, "w") as file:
        file.attrs.update(
            {
                "format": "tribodyn-record",
                "format_version": 2,
                "kind": "gearbox-map",
                "created": "2026-01-01T00:00:00+00:00",
                "message": "",
                "scenario": 'title = "map"\n[mesh]\ndamping_ratio = 0.07\n',
                "scenario_sha256": "0" * 64,
                "status": "complete",
                "tribodyn_version": "0.2.0",
                "axis": "speed",
                "ratio": RATIO,
                "nominal_torque": NOMINAL_TORQUE,
                "nominal_speed": NOMINAL_SPEED,
                "inertia_input": INPUT_INERTIA,
                "inertia_output": INPUT_INERTIA / RATIO**2,
                "interpolation_error_max": 0.008,
                "interpolation_error_mean": 0.001,
                **given,
            }
        )
        file.create_group("summary")
        for name, values in axes.items():
            file.create_dataset(name, data=values).make_scale(name)
        for name, (units, dims, values) in data.items():
            dataset = file.create_dataset(name, data=values)
            dataset.attrs.update({"units": units, "long_name": name.replace("_", " ")})
            for number, dim in enumerate(dims):
                dataset.dims[number].attach_scale(file[dim])
        file["samples_written"] = len(axes["speed"])
        file.attrs["datasets"] = " ".join([*axes, *data])
    return path


_PARTS = ("term", "element", "method")
