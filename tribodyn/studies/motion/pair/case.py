"""A gear pair as its scenario gives it, in SI units, and the gearbox that it is."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from math import nan, pi

from tribodyn.dynamics.data import BearingData
from tribodyn.gears.case import LubricatedCase, OutputData
from tribodyn.geometry.drive import SIDES, internal_side
from tribodyn.sensing.data import HousingData, SensorData
from tribodyn.solve.methods import SolverData
from tribodyn.studies.motion.case import (
    HOUSING,
    BodyData,
    Gearbox,
    GearData,
    LinkData,
    LoadData,
    SourceData,
    TrainMesh,
)

#: Name of the mesh; the bodies have those of the gears.
MESH = "mesh"
#: The gear stands above the pinion, which turns clockwise: x is along the pitch tangent.
UPWARD, CLOCKWISE = pi / 2.0, -1


@dataclass(frozen=True, kw_only=True)
class Case(LubricatedCase):
    """One simulation, complete: gears, oil and laws, bearings of pinion and gear, solver, output."""

    bearings: tuple[BearingData, BearingData]
    shafts: Mapping[str, tuple[float, float]]  # mass, inertia beside those of the gears: kg, kg m²
    solver: SolverData
    output: OutputData
    sensors: tuple[SensorData, ...] = ()
    housing: HousingData = field(default_factory=HousingData)  # that they sit on

    def gearbox(self) -> Gearbox:
        """The gearbox that the pair is."""
        return _gearbox(self)


def _gearbox(case: Case) -> Gearbox:
    """The train of one stage that a pair is: the same gears, bearings, drive and load by their names."""
    operating, drive = case.operating, case.drive
    teeth = [round(float(gear.teeth)) for gear in (drive.pinion, drive.gear)]
    ratio = Fraction(abs(teeth[0]), abs(teeth[1]))
    rigid = operating.source == "speed" or operating.shaft_stiffness is None
    attached = operating.drive_inertia if rigid else 0.0, operating.load_inertia
    # both gears of a ring turn alike
    senses = CLOCKWISE, -CLOCKWISE if internal_side(drive) is None else CLOCKWISE
    torque = operating.pinion_torque
    return Gearbox(
        title=case.title,
        name=case.name,
        kind=case.kind,
        toml=case.toml,
        sha256=case.sha256,
        scenario_file=case.scenario_file,
        gears=tuple(
            GearData(
                name=side,
                key=f"drive.{side}",
                body=number,
                shaft=number,
                teeth=teeth[number],
                plane=1,
                tooth_angle=0.0,
                given=case.masses[number],
                density=case.materials[number].density,
                meshes=((0, side),),
                face_width=float((drive.pinion, drive.gear)[number].face_width),
            )
            for number, side in enumerate(SIDES)
        ),
        bodies=tuple(
            BodyData(
                name=side,
                key=f"drive.{side}",
                gears=(number,),
                mass=case.shafts.get(side, (0.0, 0.0))[0],
                inertia=attached[number] + case.shafts.get(side, (0.0, 0.0))[1],
                ratio=(Fraction(1), ratio)[number],
                sense=senses[number],
                centre=((0.0, 0.0), (0.0, nan))[number],  # as far apart as its path of contact says
                attached=attached[number],
                floating=True,
            )
            for number, side in enumerate(SIDES)
        ),
        links=tuple(
            LinkData.of_bearing(f"bearing-{side}", f"bearings.{side}", (number, HOUSING), held, bearing=held)
            for number, (side, held) in enumerate(zip(SIDES, case.bearings, strict=True))
        ),
        meshes=(TrainMesh(MESH, "drive", 0, 1, (0, 1), UPWARD, Fraction(1), case),),
        source=SourceData.of(
            operating,
            0,
            operating.pinion_speed,
            operating.gear_torque * float(ratio) if torque is None else torque,
        ),
        loads=(
            LoadData(
                1,
                operating.gear_torque,
                operating.load_damping,
                operating.torque_table,
                operating.torque_harmonics,
            ),
        ),
        period=1,
        max_period=1,
        solver=case.solver,
        output=case.output,
        sensors=case.sensors,
        housing=case.housing,
        named=False,
    )
