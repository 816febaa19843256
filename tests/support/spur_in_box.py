"""A spur stage on two rigid shafts in a small box of plates, all of whose numbers another program may get."""

from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from tests.support.train_scenarios import case_of_table
from tribodyn.dynamics.modes import natural_frequencies
from tribodyn.exchange.matrix_files import write_matrices
from tribodyn.studies.motion.prepare import PreparedGearbox, prepare
from tribodyn.train.elastic.plate_housing import WholeBox, plate_housing, whole_box

SIZE, THICKNESS, RADIUS = (0.26, 0.2, 0.12), 0.02, 0.025
#: Axes in x and y, m: 20 and 30 teeth of 4 mm.
AXES, CENTRE_DISTANCE = ((0.08, 0.1), (0.18, 0.1)), 0.1
ELEMENT = 0.2
BEARING, AXIAL = (2e8, 3e8), 1e8  # N/m in x and y, and along z at the first
SPAN = SIZE[2] - THICKNESS
DIAMETER, DENSITY = 0.04, 7850.0
STIFF = 206e9 * 1e3  # of shafts, Pa
PAIR = 3e8  # of a pair of teeth, N/m
PRESSURE_ANGLE = np.radians(20.0)


class Rotor(NamedTuple):
    """A gear with its shaft as a rigid body, the middle of the shaft in that of the gear."""

    mass: float
    transverse: float
    polar: float
    radius: float  # of the pitch circle


def bores() -> dict[str, Any]:
    """Bores of the box by the seats' names."""
    return {
        seat: (*axis, wall, RADIUS)
        for axis, names in zip(AXES, ("AB", "CD"), strict=True)
        for seat, wall in zip(names, ("front", "back"), strict=True)
    }


@lru_cache
def whole() -> WholeBox:
    """All of the box."""
    return whole_box(SIZE, THICKNESS, bores(), element_size=ELEMENT)


def prepared(folder: Any, modes_up_to: float = 20e3) -> PreparedGearbox:
    """The gearbox with the box reduced, its file in a folder."""
    box = plate_housing(SIZE, THICKNESS, bores(), highest=8e3, element_size=ELEMENT)
    file = write_matrices(box, folder / "box.npz")

    def shaft(name: str, gear: str, seats: str) -> dict[str, Any]:
        springs = {"stiffness_x": f"{BEARING[0]} N/m", "stiffness_y": f"{BEARING[1]} N/m"}
        bearings = [
            springs | {"position": f"{1e3 * place} mm", "seat": seat}
            for place, seat in zip((0.0, SPAN), seats, strict=True)
        ]
        bearings[0]["stiffness_axial"] = f"{AXIAL} N/m"
        drawn = {
            "positions": {gear: f"{1e3 * SPAN / 2.0} mm"},
            "section": [{"length": f"{1e3 * SPAN} mm", "diameter": f"{1e3 * DIAMETER} mm"}],
            "youngs_modulus": f"{STIFF} Pa",
            "density": f"{DENSITY} kg/m**3",
            "bearing": bearings,
        }
        return {"name": name, "gears": [gear], "drawn": drawn}

    table = {
        "title": "A spur stage in a box",
        "kind": "gear-train",
        "lubricant": "iso-vg-220-mineral",
        "material": "18CrNiMo7-6",
        "mean_roughness": "0.6 um",
        "gear": {
            "pinion": {"teeth": 20, "face_width": "30 mm", "bore_diameter": "40 mm"},
            "wheel": {"teeth": 30, "face_width": "30 mm", "bore_diameter": "40 mm"},
        },
        "stage": [
            {
                "gears": ["pinion", "wheel"],
                "module": "4 mm",
                "pressure_angle": "20 deg",
                "centre_distance": f"{1e3 * CENTRE_DISTANCE} mm",
                "azimuth": "0 deg",
            }
        ],
        "shaft": [shaft("fast", "pinion", "AB"), shaft("slow", "wheel", "CD")],
        "bearings": {},
        "housing": {"matrices": str(file), "modes_up_to": f"{modes_up_to} Hz"},
        "operating": {
            "input": "pinion",
            "output": "wheel",
            "input_speed": "1 rpm",
            "output_torque": "100 N*m",
            "oil_temperature": "60 degC",
        },
        "mesh": {"compliance": "constant", "stiffness": f"{PAIR} N/m", "damping_ratio": 0.05},
        "friction": {"law": "none"},
    }
    return prepare(case_of_table(table))


def rotors(made: PreparedGearbox) -> list[Rotor]:
    """Both gears with their shafts."""
    mass = np.pi / 4.0 * DIAMETER**2 * SPAN * DENSITY
    polar, transverse = mass * DIAMETER**2 / 8.0, mass * (3.0 * DIAMETER**2 / 4.0 + SPAN**2) / 12.0
    mesh = made.model.meshes[0]
    inertias = [made.inertias[body] for body in made.order]
    return [
        Rotor(each.mass + mass, each.tilting + transverse, each.inertia + polar, float(radius))
        for each, radius in zip(inertias, (mesh.driver_radius, mesh.driven_radius), strict=True)
    ]


def frequencies(made: PreparedGearbox) -> np.ndarray:
    """Natural frequencies, Hz, with the pinion held in rotation."""
    return natural_frequencies(made.model, [one.cycle for one in made.tables])


def mean_stiffness(made: PreparedGearbox) -> float:
    """Stiffness of the mesh, mean over the mesh cycle, N/m: that of a pair times the contact ratio."""
    return PAIR * float(made.cycle.contact_ratio)
