"""A scenario of ``kind = "load-contact"``, teeth in slow rotation: its case, record, cost and tables."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field

from tribodyn.cases.cost import (
    FINITE_ELEMENTS,
    TOUCHING,
    CostKey,
    Estimate,
    load_sharing,
    recorded,
    total,
)
from tribodyn.errors import InputError
from tribodyn.gears.case import GearCase, LubricatedCase
from tribodyn.gears.prepare import with_chosen_laws
from tribodyn.gears.scenario import (
    FilmKeys,
    GearScenario,
    MatrixKeys,
    MeshTable,
    Oil,
    ShaftKeys,
    broken_film_keys,
    broken_gear_rules,
    broken_support_keys,
    gear_fields,
    mesh_data,
    oil_fields,
)
from tribodyn.geometry.body import GEOMETRY
from tribodyn.input import units
from tribodyn.input.quantity import Count, InUnit, NotNegative, Table, written
from tribodyn.input.tables.duty import OiledOperatingTable, broken_driving_rules
from tribodyn.input.tables.gears.tooth_data import driving_internal
from tribodyn.mesh.record_arrays import MESH_CYCLE
from tribodyn.numerics.parameter import Variable
from tribodyn.record.schema import Layout

PHASE = Variable(("phase",), "1", "phase of the mesh in mesh cycles from the first position")
PAIR = Variable(
    ("pair",),
    "1",
    "pair of teeth: 1 passed the beginning of the path of contact last, 0 the one before it, 2 is the next",
)
SLICE = Variable(("slice",), "m", "middle of the slice, from the middle of the face")
BODY = Variable(("body",), "1", "gear that a root stress is of")
TORQUE = Variable(("torque",), "N*m", "torque on the gear")

BODIES = ("pinion", "gear")

_phase, _pair = partial(Variable, ("phase",)), partial(Variable, ("phase", "pair"))
_face = partial(Variable, ("phase", "pair", "slice"))
_root = partial(Variable, ("phase", "body", "pair", "slice"))

#: Over the positions of the pinion. `phase` itself is the dimension scale of the first axis.
SAMPLES: dict[str, Variable] = {
    "pinion_angle": _phase("rad", "rotation of the pinion from the first position"),
    "roll_angle": _pair(
        "rad",
        "rotation of the pinion since the pair met at the pitch point in mid-face, negative before it",
    ),
    "loaded_transmission_error": _phase("m", "loaded static transmission error, of the gears' rotations"),
    "unloaded_transmission_error": _phase(
        "m", "unloaded (kinematic) transmission error, of the gears' rotations"
    ),
    "normal_load": _pair("N", "normal load of the pair"),
    "line_load": _face("N/m", "normal load per length of the line of contact"),
    "hertz_pressure": _face("Pa", "maximum Hertz pressure"),
    "half_width": _face("m", "half width of the Hertz contact"),
    "face_load_factor": _pair(
        "1", "maximum line load over the mean along the face; NaN where the pair carries none"
    ),
    "root_tension": _root("Pa", "maximum surface stress along the fillet on the loaded side"),
    "root_compression": _root("Pa", "minimum surface stress along the fillet on the other side"),
    "mesh_stiffness": _phase(
        "N/m", "derivative of the load at the pitch radius by the loaded transmission error"
    ),
    "torque_residual": _phase("1", "torque of the loads over the gear's torque, less 1"),
}

#: What a study with a lubricant adds.
FILM: dict[str, Variable] = {
    "central_film_thickness": _face("m", "film thickness by the film law; NaN where the slice carries none"),
    "closure_in_range": _face("1", "1 where the film law is inside its range, 0 outside"),
}

#: What a study at several torques adds: a Harris map.
MAP: dict[str, Variable] = {
    "map_transmission_error": Variable(
        ("torque", "phase"), "m", "loaded static transmission error at the torque"
    ),
    "map_peak_to_peak": Variable(
        ("torque",), "m", "peak to peak of the loaded static transmission error at the torque"
    ),
}

LAYOUT = Layout(
    PHASE,
    SAMPLES,
    {"pair": PAIR, "slice": SLICE, "body": BODY, "torque": TORQUE},
    MAP,
    {"mesh_cycle": MESH_CYCLE, "geometry": GEOMETRY},
)
OILED = LAYOUT._replace(samples={**SAMPLES, **FILM})


@dataclass(frozen=True, kw_only=True)
class LoadContactCase(GearCase):
    """One study of teeth in slow rotation under load, complete."""

    #: torques of the Harris map, > 0 and increasing, N m; empty: none is made
    gear_torques: tuple[float, ...] = ()
    friction_coefficient: float = 0.0  # μ of all pairs, ≥ 0
    positions_per_cycle: int = 60  # positions of the pinion in one mesh cycle
    cycles: int = 1  # mesh cycles to roll through; more than one where teeth differ
    #: the same gears with oil, at a speed > 0, for the film over the face; None: there is no lubricant
    lubricated: LubricatedCase | None = None


def estimate(case: LoadContactCase) -> Estimate:
    """What a run of a case takes."""
    positions, slices = case.positions_per_cycle * case.cycles, case.mesh.slices
    torques = len(case.gear_torques)
    drive = case.drive
    width = min(float(drive.pinion.face_width), float(drive.gear.face_width))
    overlap = width * abs(math.tan(float(drive.helix_angle))) / (math.pi * float(drive.module))
    pairs = TOUCHING + math.ceil(overlap)
    sizes = {"phase": positions, "pair": pairs, "slice": slices, "body": 2}
    if torques:
        sizes["torque"] = torques
    return total(
        (
            CostKey("output.positions_per_cycle", case.positions_per_cycle, 60),
            CostKey("output.cycles", case.cycles, 1),
            CostKey("mesh.slices", slices, 21),
            CostKey("operating.gear_torques", 1 + torques, 10),
        ),
        recorded(OILED if case.lubricated else LAYOUT, sizes, copies=4.0, outlines=True),
        load_sharing(float(positions) * (1 + torques), slices * pairs / TOUCHING, positions),
        FINITE_ELEMENTS,
    )


Load = Annotated[float, InUnit(units.positive(units.TORQUE))]


class LoadContactOperating(OiledOperatingTable):
    """The load, against the gear's motion; a speed only where the load is given as power, or for the film."""

    gear_torques: tuple[Load, ...] = Field((), max_length=1000)


class LoadContactMesh(MeshTable):
    """Slices of the face, friction, and how the axes stand."""

    friction_coefficient: NotNegative = 0.0


class LoadContactOutput(Table):
    """What is recorded."""

    positions_per_cycle: Annotated[int, Field(strict=True, ge=8)] = 60
    cycles: Count = 1


class LoadContactScenario(GearScenario):
    """A scenario file of a load contact study."""

    internal_gears: ClassVar[bool] = True
    driving_rings: ClassVar[bool] = False
    kind: Literal["load-contact"]
    lubricant: Oil | None = None
    operating: LoadContactOperating
    bearings: MatrixKeys = None
    shaft: ShaftKeys = None
    mesh: LoadContactMesh = written({})
    film: FilmKeys = None
    output: LoadContactOutput = written({})


Scenario = LoadContactScenario


def case_of(scenario: Scenario, toml: str, sha256: str) -> LoadContactCase:
    """Return the case of a scenario that has passed schema and rules."""
    gears: dict[str, Any] = gear_fields(scenario, toml, sha256) | {
        "mesh": mesh_data(scenario, every_tooth=True)
    }
    oiled = None
    if scenario.lubricant is not None:
        oiled = with_chosen_laws(LubricatedCase(**gears, **oil_fields(scenario)))
    return LoadContactCase(
        **gears,
        gear_torques=scenario.operating.gear_torques,
        friction_coefficient=scenario.mesh.friction_coefficient,
        positions_per_cycle=scenario.output.positions_per_cycle,
        cycles=scenario.output.cycles,
        lubricated=oiled,
    )


def broken_rules(scenario: Scenario) -> Iterator[InputError]:
    """Go through the rules that tie keys of such a scenario together and that this one breaks."""
    yield from broken_gear_rules(scenario)
    yield from driving_internal(scenario.drive)
    yield from broken_support_keys(scenario)
    drive, operating, oiled = scenario.drive, scenario.operating, scenario.lubricant is not None
    yield from broken_driving_rules(operating, (drive.pinion.teeth, drive.gear.teeth), speed_needed=oiled)
    if not oiled:
        yield from broken_film_keys(scenario)
    torques = operating.gear_torques
    if len(torques) == 1:
        rule = "a single torque makes no map"
        yield InputError("operating.gear_torques", f"{torques[0]:g} N*m", rule, "give at least two")
    for number, (torque, after) in enumerate(pairwise(torques), start=1):
        if after <= torque:
            key, rule = f"operating.gear_torques.{number}", f"not greater than the {torque:g} N*m before it"
            yield InputError(key, f"{after:g} N*m", rule, "give the torques in increasing order")
            break
