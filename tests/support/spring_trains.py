"""The package's models of planar trains of constant mesh stiffness, and their motions in one global frame.

A train is written as the scenario of a bare model. In the tables of its meshes one pair of teeth, the newest,
carries alone and all the time: with involutes that is one spring along the line of action, to which nothing
happens when the next pair takes over.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from tests.support.train_matrices import GROUND, Train
from tests.support.train_scenarios import case_of_table
from tribodyn.gears.tabulated import Tabulated
from tribodyn.mesh.cycle import polynomials
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.case import Gearbox
from tribodyn.studies.motion.prepare import prepare, tabulated
from tribodyn.train.structure import shift_of, turn_of


class Gears(NamedTuple):
    """What a mesh has beside its spring: teeth of driver and driven gear, module (m)."""

    teeth: tuple[int, int]
    module: float


def scenario_of(
    train: Train,
    gears: Sequence[Gears],
    damping_ratio: float,
    operating: dict[str, Any],
    friction: dict[str, Any] | None = None,
) -> dict[str, Any]:
    """The scenario of a train whose bodies are called b0, b1, …, as TOML has it.

    Dampers of the meshes are by the ratio, whatever the train says; pitch radii those of the gears.
    `operating` has speed and torque; input and output are the first and the last body, in the sense of the
    first mesh.
    """
    names = [f"b{number}" for number in range(len(train.bodies))]
    links: list[dict[str, Any]] = []
    for bearing in train.bearings:
        links.append({"ends": [names[bearing.body], "ground"]})
        for axis, stiffness, damping in zip("xy", bearing.stiffness, bearing.damping, strict=True):
            links[-1] |= {f"stiffness_{axis}": f"{stiffness} N/m", f"damping_{axis}": f"{damping} N*s/m"}
    for shaft in train.shafts:
        assert GROUND not in shaft.ends
        torsion = {"stiffness": f"{shaft.stiffness} N*m/rad", "damping": f"{shaft.damping} N*m*s/rad"}
        links.append({"ends": [names[end] for end in shaft.ends], **torsion})
    meshes = [
        {
            "bodies": [names[end] for end in mesh.ends],
            "teeth": list(own.teeth),
            "module": f"{own.module} m",
            "pressure_angle": f"{mesh.pressure_angle} rad",
            "face_width": "20 mm",
            "azimuth": f"{mesh.azimuth} rad",
            "stiffness": f"{mesh.stiffness} N/m",
            "damping_ratio": damping_ratio,
        }
        for mesh, own in zip(train.meshes, gears, strict=True)
    ]
    return {
        "title": "A train of springs",
        "kind": "gear-train",
        "lubricant": "iso-vg-220-mineral",
        "material": "18CrNiMo7-6",
        "mean_roughness": "0.6 um",
        "body": [
            {"name": name, "mass": f"{body.mass} kg", "inertia": f"{body.inertia} kg*m**2"}
            for name, body in zip(names, train.bodies, strict=True)
        ],
        "link": links,
        "mesh": meshes,
        "bearings": {},
        "operating": {
            "input": names[0],
            "output": names[-1],
            "sense": "counter-clockwise" if train.meshes[0].sense > 0 else "clockwise",
            "oil_temperature": "70 degC",
            **operating,
        },
        "friction": friction or {"law": "none"},
        "film": {"law": "dowson-higginson"},  # named: none is chosen by a solved contact
    }


def one_spring(made: Tabulated) -> Tabulated:
    """Tables in which the newest pair of driving flanks is the only one, and always in contact."""
    cycle = made.cycle
    newest = np.where(np.arange(cycle.slots) == cycle.front_pairs - 1, 1.0, 0.0)
    cycle = cycle._replace(in_contact=np.broadcast_to(newest, np.shape(cycle.in_contact)).copy())
    return made._replace(cycle=cycle, table=polynomials(cycle))


def prepared_springs(case: Gearbox) -> PreparedGearbox:
    """The model of a case with one spring for every mesh."""
    return prepare(case, tuple(one_spring(made) for made in tabulated(case)))


def spring_model(scenario: dict[str, Any], overrides: dict[str, Any] | None = None) -> PreparedGearbox:
    """The same of a scenario."""
    return prepared_springs(case_of_table(scenario, overrides))


def in_global_frame(
    states: Float[Array, "sample state"], prepared: PreparedGearbox, rates: bool = False
) -> Float[Array, "sample coordinate"]:
    """Displacements (x, y, θ of every body b0, b1, …) against the reference's rotation, θ counter-clockwise.

    With `rates` their derivatives by time, those of rotation against the reference's speed.
    """
    layout = prepared.model.layout
    start = layout.half if rates else 0
    found = np.zeros((len(states), layout.bodies, 3))
    for place, name in enumerate(prepared.names):
        body = int(name.removeprefix("b"))
        if place < layout.planar:
            found[:, body, :2] = states[:, start + shift_of(place) : start + shift_of(place) + 2]
        if place > 0:
            sense = prepared.case.bodies[prepared.order[place]].sense
            found[:, body, 2] = sense * states[:, start + turn_of(place, layout)]
    return found.reshape(len(states), -1)
