"""A map of losses as a MATLAB file: tables for Simulink's n-D Lookup Table and for Simscape's Simple Gear.

MathWorks, "n-D Lookup Table": table data (n-D) and a vector of breakpoints per dimension. "Simple Gear",
Simscape Driveline, friction model "Temperature and load-dependent efficiency": vectors of temperature and of
the load at the base gear, and a matrix of efficiencies, a row for every temperature.
"""

import io
from collections.abc import Mapping
from typing import Any

import numpy as np
from scipy.io import loadmat, savemat

from tribodyn import __version__
from tribodyn.exchange.format import MAP, Deviation, ExchangeFormat, Exported, Written, deviation
from tribodyn.exchange.heading import heading
from tribodyn.exchange.maps.chosen import SPEED, nominal, shares
from tribodyn.record.loss_map import GridValues

#: Bytes of the text at the beginning of a MAT-file.
_TEXT = 116


def write(exported: Exported, name: str, choices: Mapping[str, float]) -> Written:
    """Two structures of tables, which are read back and compared, and one of the statics."""
    losses = exported.losses
    simulink = {
        "breakpoints1": losses.torque,
        "breakpoints2": losses.speed,
        "breakpoints3": losses.oil_temperature,
        "drag": losses.total.transpose(1, 2, 0),
        "torque_at_input": losses.torque_at_input().transpose(1, 2, 0),
        "axes": "torque at the output (N m), speed of the input (rad/s), oil temperature (K)",
    }
    tables: dict[str, Any] = {"ratio": losses.ratio, "simulink": simulink}
    if (gear := _simple_gear(exported, choices)) is not None:
        tables["simscape"] = gear
    statics: dict[str, Any] = {"torque": losses.torque, "inertia_input": losses.inertia_input}
    tables["statics"] = statics
    if np.isfinite(losses.backlash):
        statics["backlash"] = losses.backlash
    if losses.stiffness.size:
        statics["stiffness"] = losses.stiffness
    if losses.error_amplitude.size:
        statics |= {"transmission_error": losses.error_amplitude, "mesh_order": losses.mesh_order}
    found = _compared(exported, _saved(tables))
    remarks = () if gear is not None else ("no load of the map is driven forward: no table for Simscape",)
    tables["about"] = heading(exported, "", found, remarks)
    return Written({".mat": _saved(tables)}, found, remarks)


def _simple_gear(exported: Exported, choices: Mapping[str, float]) -> dict[str, Any] | None:
    """Efficiency over oil temperature and load at the base gear, the input, at one speed."""
    losses = exported.losses
    loads = losses.torque[losses.torque > 0.0]
    if not loads.size:
        return None
    speed = nominal(exported, "speed", choices, losses.speed)
    drag = losses.at(losses.oil_temperature[:, None], loads, speed)
    forward = abs(losses.ratio) * loads
    # the load at the base includes the loss, and has to be one vector for all temperatures
    base = forward + drag.mean(axis=0)
    lost = np.stack([np.interp(base, forward + row, row) for row in drag])
    return {
        "temperature": losses.oil_temperature,
        "load_at_base_gear": base,
        "efficiency": 1.0 - lost / base,
        "follower_to_base_teeth_ratio": 1.0 / abs(losses.ratio),
        "speed": speed,
    }


def _saved(tables: Mapping[str, Any]) -> bytes:
    stream = io.BytesIO()
    savemat(stream, dict(tables), do_compression=True, oned_as="row")
    text = f"MATLAB 5.0 MAT-file, written by tribodyn {__version__}".ljust(_TEXT).encode()
    # without the time: the same map gives the same file
    return text[:_TEXT] + stream.getvalue()[_TEXT:]


def _compared(exported: Exported, content: bytes) -> tuple[Deviation, ...]:
    losses = exported.losses
    read = loadmat(io.BytesIO(content), squeeze_me=False, simplify_cells=True)
    axes = tuple(np.atleast_1d(read["simulink"][f"breakpoints{number}"]) for number in (1, 2, 3))
    drag = np.reshape(read["simulink"]["drag"], tuple(len(axis) for axis in axes))
    temperature, torque, speed = losses.points
    table = GridValues(axes, drag)(torque, speed, temperature)
    found = [deviation("drag at the input (simulink)", "N m", table, losses.total)]
    if "simscape" in read:
        gear = read["simscape"]
        axes = tuple(np.atleast_1d(gear[name]) for name in ("temperature", "load_at_base_gear"))
        efficiency = GridValues(axes, np.reshape(gear["efficiency"], tuple(len(axis) for axis in axes)))
        forward = torque > 0.0
        base = losses.torque_at_input()[forward]
        lost = (1.0 - efficiency(temperature[forward], base)) * base
        over = "all points of the map where the input drives; it knows one speed"
        weights = shares(losses.oil_temperature, losses.torque, losses.speed)[forward]
        found.append(
            deviation("drag at the input (simscape)", "N m", lost, losses.total[forward], over, weights)
        )
    return tuple(found)


FORMAT = ExchangeFormat(
    "mat",
    "MATLAB file: tables for Simulink's n-D Lookup Table and Simscape's Simple Gear, and the statics",
    (".mat",),
    takes=(MAP,),
    write=write,
    choices=SPEED,
)
