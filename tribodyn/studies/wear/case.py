"""A case of the wear study: what one run needs to know, records and takes; SI units."""

import math
from dataclasses import dataclass
from functools import partial

import numpy as np

from tribodyn.cases.cost import (
    TOUCHING,
    CostKey,
    Estimate,
    in_memory,
    load_sharing,
    recorded,
    total,
)
from tribodyn.gears.case import GearCase, LubricatedCase
from tribodyn.geometry.body import GEOMETRY
from tribodyn.mesh.record_arrays import MESH_CYCLE
from tribodyn.numerics.parameter import Variable
from tribodyn.record.schema import Layout
from tribodyn.tribology.wear.law import RunningIn, WearData

BODIES = ("pinion", "gear")
#: Teeth that wear alike, or each by itself.
ALIKE, EACH = "alike", "each"

REVOLUTIONS = Variable(("revolutions",), "1", "revolutions of the pinion")
_SCALES = {
    "body": Variable(("body",), "1", "gear that a flank is of"),
    "roll": Variable(
        ("roll",),
        "rad",
        "rotation of the pinion since a pair in mid-face met at the pitch point, negative before it",
    ),
    "slice": Variable(("slice",), "m", "middle of the slice, from the middle of the face"),
    "cycle": Variable(("cycle",), "1", "mesh cycles until the same teeth meet again, from 0"),
    "phase": Variable(("phase",), "1", "phase of the mesh in mesh cycles, 0 where a pair enters its path"),
    "pinion_tooth": Variable(("pinion_tooth",), "1", "tooth of the pinion, in the order of entering, from 0"),
    "gear_tooth": Variable(("gear_tooth",), "1", "tooth of the gear, in the order of entering, from 0"),
}
_along = partial(Variable, ("revolutions",))
_body = partial(Variable, ("revolutions", "body"))
_flank = partial(Variable, ("revolutions", "body", "roll", "slice"))
_path = partial(Variable, ("revolutions", "roll", "slice"))

#: Over the revolutions. The two of single teeth are left out where all wear alike.
SAMPLES: dict[str, Variable] = {
    "time": _along("s", "time of running at the pinion's speed"),
    "worn_depth": _flank("m", "depth worn off the flanks along their normal, mean of all teeth"),
    "pinion_tooth_depth": Variable(
        ("revolutions", "pinion_tooth", "roll", "slice"), "m", "depth worn off each tooth of the pinion"
    ),
    "gear_tooth_depth": Variable(
        ("revolutions", "gear_tooth", "roll", "slice"), "m", "depth worn off each tooth of the gear"
    ),
    "wear_rate": _flank("m", "depth worn off the flanks in a revolution of the pinion, mean of all teeth"),
    "worn_volume": _body("m3", "volume worn off all teeth"),
    "worn_mass": _body("kg", "mass worn off all teeth"),
    "debris_rate": _along("kg/s", "mass worn off both gears per time"),
    "loaded_transmission_error": Variable(
        ("revolutions", "cycle", "phase"), "m", "loaded static transmission error, of the gears' rotations"
    ),
    "transmission_error_peak_to_peak": _along("m", "peak to peak of the loaded static transmission error"),
    "line_load": _path("N/m", "normal load of a pair per length of the line of contact, mean of all teeth"),
    "hertz_pressure": _path("Pa", "maximum Hertz pressure, mean of all teeth"),
    "friction_coefficient": _path("1", "friction coefficient; NaN where nothing is carried"),
    "central_film_thickness": _path("m", "film thickness by the film law; NaN where nothing is carried"),
    "power_friction": _along("W", "mean power of tooth friction"),
    "film_min": _along("m", "minimum of the film over mesh cycle and face"),
    "roughness": _along("m", "composite rms roughness of the flanks"),
    "hertz_pressure_max": _along("Pa", "maximum of the Hertz pressure over mesh cycle and face"),
    "worn_volume_by_time": _along(
        "m3", "integral over time of coefficient, load and sliding speed: the volume worn off either gear"
    ),
    "next_step": _along("1", "revolutions that the next step tries, for a run that goes on from here"),
    "steps": _along("1", "steps taken"),
    "steps_rejected": _along("1", "steps that moved a load too far, and were halved"),
}
LAYOUT = Layout(REVOLUTIONS, SAMPLES, _SCALES, groups={"mesh_cycle": MESH_CYCLE, "geometry": GEOMETRY})
#: Those of a study with a lubricant.
OF_FILM = ("central_film_thickness", "film_min", "roughness")
#: Those of teeth that wear each by itself.
OF_TEETH = ("pinion_tooth_depth", "gear_tooth_depth")


@dataclass(frozen=True, kw_only=True)
class WearCase(GearCase):
    """One study of wear, complete."""

    wear: WearData  # by which law
    revolutions: float  # of the pinion, > 0
    every: float  # revolutions between two records, > 0
    load_change: float = 0.02  # share of the largest load by which a step may move that of any place
    each_tooth: bool = False  # whether every tooth has a history of its own
    positions_per_cycle: int = 60  # positions of the pinion in one mesh cycle
    running_in: RunningIn | None = None  # how the roughness falls; None: it stays
    #: friction coefficient without a lubricant, ≥ 0
    friction_coefficient: float = 0.0
    #: the same gears with oil; None: they run without
    lubricated: LubricatedCase | None = None

    @property
    def counts(self) -> tuple[int, int]:
        """Numbers of teeth of pinion and gear."""
        return round(abs(float(self.drive.pinion.teeth))), round(abs(float(self.drive.gear.teeth)))

    @property
    def cycles(self) -> int:
        """Mesh cycles until the same teeth meet again; 1 where all wear alike."""
        return math.lcm(*self.counts) if self.each_tooth else 1


def layout_of(case: WearCase) -> Layout:
    """Of the record of a case."""
    omitted = set() if case.lubricated else set(OF_FILM)
    omitted |= set() if case.each_tooth else set(OF_TEETH)
    return LAYOUT._replace(
        samples={name: variable for name, variable in SAMPLES.items() if name not in omitted}
    )


def recorded_at(case: WearCase, after: float = -1.0) -> np.ndarray:
    """Revolutions at which a case is recorded, those after so many; the last one is its end."""
    count = math.ceil(case.revolutions / case.every - 1e-9)
    rows = np.append(case.every * np.arange(count), case.revolutions)
    return rows[rows > after * (1.0 + 1e-9)]


#: Evaluations of the loads between two records, and in a run at least; times that friction changes them.
_BETWEEN, _LEAST, _FRICTION = 3.0, 100.0, 3.0


def estimate(case: WearCase) -> Estimate:
    """What a run of a case takes."""
    positions, slices = float(case.positions_per_cycle * case.cycles), case.mesh.slices
    rows = len(recorded_at(case))
    nodes = round(2.0 * case.positions_per_cycle)
    pinion, gear = case.counts
    sizes = {
        "revolutions": rows,
        "body": 2,
        "roll": nodes,
        "slice": slices,
        "cycle": case.cycles,
        "phase": case.positions_per_cycle,
        "pinion_tooth": pinion,
        "gear_tooth": gear,
    }
    evaluations = max(_LEAST, _BETWEEN * rows) * (_FRICTION if case.lubricated else 1.0)
    return total(
        (
            CostKey("output.positions_per_cycle", case.positions_per_cycle, 60),
            CostKey("mesh.slices", slices, 21),
            CostKey("wear.revolutions", rows, 21, "record less often (output.every)"),
            CostKey("wear.teeth", case.cycles, 100, 'let all teeth wear alike (wear.teeth = "alike")'),
        ),
        recorded(layout_of(case), sizes, copies=2.0, outlines=True),
        load_sharing(evaluations * positions, slices, positions),
        in_memory(case.positions_per_cycle * slices**2 * TOUCHING**2 + nodes * positions, 16.0),
        Estimate(shared=20.0 if slices > 1 else 1.0),
    )
