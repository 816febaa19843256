"""Extremes of a mesh over a run: of the recorded samples, and of the dense motion between them."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from tribodyn.gears.case import TRIBOLOGY
from tribodyn.gears.motion.recorded import pair_numbers
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.quantities.catalogue import QUANTITIES

#: Summary name -> record name and sign of what is largest there, over the whole run and over its last cycles.
RECORDED = {
    "normal_load_max": ("normal_load", 1),
    "film_min": ("central_film_thickness", -1),
    "film_parameter_min": ("film_parameter", -1),
    "hertz_pressure_max": ("hertz_pressure", 1),
    "flash_temperature_max": ("flash_temperature_rise", 1),
    "line_load_max": ("line_load", 1),
}

#: Prefix of the names of extremes of the driving flanks (1) and of the back flanks (−1).
WORKING = {1.0: "", -1.0: "back_"}


class Extreme(NamedTuple):
    """An extreme of a run: its value, and where it is."""

    value: float
    time: float  # s
    mesh_cycle: float  # mesh cycles since the start, whole and fraction
    pair: int | None  # number of the pair; None where it is the whole mesh's


class RunningExtremes:
    """Extremes of a run that arrives in blocks of states: samples, and where its dense motion is extreme."""

    def __init__(self, cycle: MeshCycle) -> None:
        self.by_name: dict[str, Extreme] = {}
        sides = np.asarray(cycle.pair_side)
        self._slots = {sign: np.flatnonzero(sides * sign > 0) for sign in WORKING}
        self._pairs = pair_numbers(cycle.front_pairs, np.size(cycle.pair_side))

    def add(self, cycles: np.ndarray, time: np.ndarray, block: Mapping[str, np.ndarray]) -> None:
        """Take a block into account: cycles of the mesh since the start, time (s), what is recorded there."""
        if not len(cycles):
            return
        error = block["transmission_error_rotational"]
        for name, (recorded, sign) in RECORDED.items():
            if recorded in block:  # line loads: of helical pairs
                self._add(name, sign, block[recorded], cycles, time)
        for name, sign in (("max", 1), ("min", -1)):
            self._add(f"transmission_error_{name}", sign, error, cycles, time)
        for side, slots in self._slots.items():
            if slots.size:
                flanks, newest = WORKING[side], block["transmission_error_normal"][:, slots[-1]]
                for name, sign in (("max", 1), ("min", -1)):
                    quantity = f"{flanks}transmission_error_normal_{name}"
                    self._add(quantity, sign, newest, cycles, time)
                self._add(f"{flanks}mesh_force_max", 1, mesh_force(block, slots), cycles, time)

    def _add(self, name: str, sign: int, values: np.ndarray, cycles: np.ndarray, time: np.ndarray) -> None:
        value = float((np.fmax if sign > 0 else np.fmin).reduce(values, axis=None))  # NaN: nothing there
        old = self.by_name.get(name)
        if sign * value > (-np.inf if old is None else sign * old.value):
            row, *pair = np.unravel_index(int(np.argmax(values == value)), values.shape)
            number = self._pairs[int(pair[0])] if pair else None
            self.by_name[name] = Extreme(value, float(time[row]), float(cycles[row]), number)

    def values(self) -> dict[str, float]:
        """Values of `RECORDED`."""
        return {name: self.by_name[name].value for name in RECORDED if name in self.by_name}

    def where(self, name: str, cycle: MeshCycle) -> dict[str, float]:
        """Roll angle (rad, 0 at the pitch point) at which a driving pair has an extreme, by summary name."""
        extreme = self.by_name.get(name)
        if extreme is None or extreme.pair is None or extreme.pair > 1:
            return {}
        turned = extreme.mesh_cycle % 1.0 + 1 - extreme.pair
        roll = float(cycle.roll_start) + turned * float(cycle.pitch_angle)
        return {f"{name}_roll_angle": roll}

    def described(self) -> dict[str, dict[str, Any]]:
        """All extremes by name, for a summary."""
        return {name: extreme._asdict() for name, extreme in self.by_name.items()}

    def spread(self, name: str) -> float:
        """Maximum less minimum of an error."""
        if f"{name}_max" not in self.by_name:
            return float("nan")
        return self.by_name[f"{name}_max"].value - self.by_name[f"{name}_min"].value


def mesh_force(block: Mapping[str, np.ndarray], slots: np.ndarray) -> np.ndarray:
    """Force of a side's flanks along the pitch tangent (n,), N: the mesh moment over the pitch radius."""
    return np.sum(block["tangent_load"][:, slots], axis=1)


#: Relative difference between the extremes of the whole run and those of its last cycles that is said.
DIFFERENT = 0.005


def on_extremes(summary: Mapping[str, Any]) -> list[str]:
    """Say which extremes of the whole run, or of its last mesh cycles, are not those of the table."""
    extremes = summary.get("extremes")
    if not extremes:  # a record of 0.1.0, or of a run that stopped at once
        return []
    sentences = []
    for part, words in (("run", "Over the whole run"), ("last_cycles", "Over the last mesh cycles")):
        others = []
        for quantity in (QUANTITIES["normal_load_max"], *TRIBOLOGY):
            extreme, value = extremes.get(part, {}).get(quantity.name), summary.get(quantity.name)
            if extreme is None or value is None or not abs(extreme["value"] - value) > DIFFERENT * abs(value):
                continue
            name = quantity.title[0].lower() + quantity.title[1:]
            at = f" at t = {extreme['time']:.4g} s" if part == "run" and "time" in extreme else ""
            others.append(f"{name} {quantity.with_unit(extreme['value'])}" + at)
        if others:
            sentences.append(f"{words}: {', '.join(others)}.")
    return sentences
