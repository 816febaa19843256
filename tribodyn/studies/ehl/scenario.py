"""A scenario of ``kind = "ehl"``, a pair's contact solved along its way: case, record, cost and tables."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from tribodyn.cases.cost import CostKey, Estimate, recorded, solved_contacts, total
from tribodyn.errors import InputError, quoted
from tribodyn.gears.case import LubricatedCase
from tribodyn.gears.scenario import GearScenario, Oil, broken_gear_rules, gear_fields, oil_fields
from tribodyn.input import units
from tribodyn.input.fields import LoadCurve
from tribodyn.input.quantity import InUnit, Switch, Table, csv_file, written
from tribodyn.input.tables.duty import OiledOperatingTable, broken_driving_rules
from tribodyn.mesh.record_arrays import described
from tribodyn.numerics.parameter import Variable
from tribodyn.record.schema import Layout
from tribodyn.tribology.ehl.grid import STEP
from tribodyn.tribology.law import FilmData

#: Places of a profile, and where they begin and end, in half widths of the Hertz contact.
PLACES, BEGIN, END = 161, -3.0, 1.5

PHASE = Variable(("phase",), "1", "mesh cycles since the pair came into contact")
_over, _profile = partial(Variable, ("phase",)), partial(Variable, ("phase", "place"))

SAMPLES: dict[str, Variable] = {
    "roll_angle": _over(
        "rad", "rotation of the pinion since the pair met at the pitch point, negative before it"
    ),
    "normal_load": _over("N", "normal load of the pair"),
    "line_load": _over("N/m", "normal load per length of the line of contact"),
    "equivalent_radius": _over("m", "equivalent radius"),
    "entrainment_speed": _over("m/s", "entrainment speed"),
    "sliding_speed": _over("m/s", "sliding speed, of the pinion's flank over the gear's"),
    "hertz_pressure": _over("Pa", "maximum Hertz pressure"),
    "half_width": _over("m", "half width of the Hertz contact"),
    "central_film_thickness": _over("m", "mean gap on the line of centres, solved"),
    "minimum_film_thickness": _over("m", "minimum mean gap, solved"),
    "central_film_smooth": _over("m", "film on the line of centres of smooth surfaces, solved"),
    "minimum_film_smooth": _over("m", "minimum film of smooth surfaces, solved"),
    "film_parameter": _over("1", "central film over the roughness of both surfaces"),
    "friction_coefficient": _over("1", "friction coefficient, solved"),
    "asperity_load_ratio": _over("1", "share of the load that asperities carry, solved"),
    "temperature_rise_max": _over("K", "maximum over the contact of the oil's temperature rise"),
    "moes_load": _over("1", "load parameter M of Moes"),
    "moes_material": _over("1", "material parameter L of Moes"),
    "residual": _over("1", "largest imbalance of flow over the flow and of force over the load"),
    "pressure": _profile("Pa", "pressure of fluid and asperities, solved"),
    "film_thickness": _profile("m", "mean gap, solved, up to the end of the film"),
    "temperature_rise": _profile("K", "temperature over the inlet's, mean over the film, solved"),
    "shear_stress": _profile("Pa", "shear stress, mean over the film, solved"),
    "film_by_law": Variable(("phase", "film_law"), "m", "film thickness by the regression"),
    "friction_by_law": Variable(("phase", "friction_law"), "1", "friction coefficient by the law"),
}

#: With squeeze, beside `SAMPLES`.
SQUEEZED: dict[str, Variable] = {
    "transient_central_film_thickness": _over("m", "mean gap on the line of centres, with squeeze"),
    "transient_minimum_film_thickness": _over("m", "minimum mean gap, with squeeze"),
    "transient_friction_coefficient": _over("1", "friction coefficient, with squeeze"),
    "transient_pressure": _profile("Pa", "pressure of fluid and asperities, with squeeze"),
    "transient_film_thickness": _profile("m", "mean gap, with squeeze, up to the end of the film"),
}

TRACTION = {
    "traction": Variable(
        ("slide_to_roll",), "1", "friction coefficient where the load is highest, over slide-to-roll ratio"
    )
}

SCALES = {
    "place": Variable(("place",), "1", "place in the direction of entrainment over the Hertz half width"),
    "film_law": Variable(("film_law",), "1", "film law"),
    "friction_law": Variable(("friction_law",), "1", "friction law"),
    "slide_to_roll": Variable(("slide_to_roll",), "1", "sliding speed over entrainment speed"),
}


def unsolved(variables: Mapping[str, Variable], positions: int) -> dict[str, NDArray[np.float64]]:
    """Arrays of NaN for these datasets at the positions of a way, but for those by laws."""
    sizes = {"phase": positions, "place": PLACES}
    return {
        name: np.full([sizes[dim] for dim in row.dims], np.nan)
        for name, row in variables.items()
        if sizes.keys() >= {*row.dims}
    }


def layout_of(transient: bool, slices: int = 1) -> Layout:
    """Layout of the record of a way, with squeeze or without, of a pair of so many slices."""
    samples = SAMPLES | SQUEEZED if transient else SAMPLES
    return Layout(PHASE, samples, SCALES, TRACTION, {"mesh_cycle": described(slices)})


@dataclass(frozen=True, kw_only=True)
class EhlCase(LubricatedCase):
    """One study of the solved contact, complete.

    It has no laws of its own: every law of the registries is evaluated beside the solution.
    """

    positions: int  # positions of the pair at which its contact is solved
    transient: bool  # whether the way is also solved with squeeze
    #: (array, array); roll angles from the pitch point, rad, and normal loads there, N; None: quasi-static
    loads: tuple[NDArray[np.float64], NDArray[np.float64]] | None
    face_position: float  # z of the section that is followed, of helical pairs, m from the middle of the face
    step: float  # of the contact's grid, over the distance from inlet and end of the film


#: Contacts of the traction curve, and laws beside the solution.
_TRACTION, _LAWS = 9, 12


def estimate(case: EhlCase) -> Estimate:
    """What a run of a case takes."""
    sizes = {"phase": case.positions, "place": PLACES, "slide_to_roll": _TRACTION}
    sizes |= {"film_law": _LAWS, "friction_law": _LAWS}
    return total(
        (CostKey("output.positions", float(case.positions), 40),),
        recorded(layout_of(case.transient), sizes, copies=4.0),
        solved_contacts(
            case.positions, case.positions + _TRACTION, squeeze=case.transient, coarseness=case.step / STEP
        ),
    )


class EhlMesh(Table):
    """By what compliance the pairs in contact share the load."""

    compliance: Literal["energy", "fem"] = "energy"


def loads_of_record(path: Path, key: str) -> dict[str, Any]:
    """Loads of the last pair that passed through the whole mesh in a simulation over time, as columns.

    Raises InputError if the file is no such record, or too short.
    """
    from tribodyn.post.cycles import last_cycles
    from tribodyn.record.reader import Record

    def bad(rule: str, remedy: str) -> InputError:
        return InputError(key, quoted(path.name), rule, remedy, str(path))

    try:
        opened = Record(path)
    except InputError as error:
        raise bad(error.rule, error.remedy) from None
    with opened as record:
        if record.axis != "time" or "normal_load" not in record or "mesh_cycle" not in record.groups:
            raise bad("holds no loads of pairs over time", "give the record of a gear pair's simulation")
        cycle, numbers = record.mesh_cycle, np.asarray(record["pair"])
        if "face_position" in cycle:
            raise bad("is of a helical pair, whose load varies along its lines of contact", "give a table")
        ratio = float(cycle["contact_ratio"])
        window = last_cycles(record, int(np.ceil(ratio)))
        if window.phase[-1] < ratio:
            raise bad("ends before a pair has passed through the mesh", "let it run for more mesh cycles")
        age = window.phase[window.phase <= ratio]
        load = np.asarray(record["normal_load"])[window.part][: len(age)]
    # the pair that entered with the first sample is number 1, then 0, then -1
    column = np.searchsorted(numbers, 1 - np.floor(age + 1e-9).astype(int))
    roll = float(cycle["roll_start"]) + 2.0 * np.pi / float(cycle["pinion_teeth"]) * age
    values = np.nan_to_num(load[np.arange(len(age)), column])
    return {
        "roll_angle": {"unit": "rad", "values": roll.tolist()},
        "normal_load": {"unit": "N", "values": values.tolist()},
    }


LOADS = csv_file("roll_angle", "normal_load", record=loads_of_record)


class EhlContact(Table):
    """How the contact is solved."""

    transient: Switch = False
    loads: Annotated[LoadCurve, LOADS] | None = None
    face_position: Annotated[float, InUnit(units.LENGTH, "8 mm")] = written("0 mm")
    step: Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0.02, le=0.5)] = STEP


class EhlOutput(Table):
    """What is recorded."""

    positions: Annotated[int, Field(strict=True, ge=4)] = 40


class EhlScenario(GearScenario):
    """A scenario file of a study of the solved contact."""

    kind: Literal["ehl"]
    lubricant: Oil
    operating: OiledOperatingTable
    mesh: EhlMesh = written({})
    contact: EhlContact = written({})
    output: EhlOutput = written({})


Scenario = EhlScenario


def case_of(scenario: Scenario, toml: str, sha256: str) -> EhlCase:
    """Return the case of a scenario that has passed schema and rules."""
    contact = scenario.contact
    oil: dict[str, Any] = oil_fields(scenario)
    oil["film"] = FilmData()  # the contact is solved
    return EhlCase(
        **gear_fields(scenario, toml, sha256),
        **oil,
        positions=scenario.output.positions,
        transient=contact.transient,
        loads=contact.loads.in_si() if contact.loads else None,
        face_position=contact.face_position,
        step=contact.step,
    )


def broken_rules(scenario: Scenario) -> Iterator[InputError]:
    """Go through the rules that tie keys of such a scenario together and that this one breaks."""
    yield from broken_gear_rules(scenario)
    drive = scenario.drive
    yield from broken_driving_rules(scenario.operating, (drive.pinion.teeth, drive.gear.teeth))
    if place := scenario.contact.face_position:
        key, shown = "contact.face_position", f"{1e3 * place:g} mm"
        half = min(drive.pinion.face_width, drive.gear.face_width) / 2.0
        if not drive.helix_angle:
            yield InputError(
                key, shown, "is of helical pairs; all sections of a spur pair are alike", "leave it out"
            )
        elif abs(place) > half:
            rule = f"off the face, which ends at ±{1e3 * half:g} mm"
            yield InputError(key, shown, rule, "give a place on it, from its middle")
