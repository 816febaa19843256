"""EXUDYN beside a spur stage on two shafts in a flexible housing, `tests/support/spur_in_box.py`.

::

    python -m tools.peers.exudyn_housing

EXUDYN (Gerstmayr 2024, doi:10.1007/s11044-023-09937-1; ``pip install exudyn``) gets the nodes of the housing
with the sparse matrices of all its finite elements, bolted nodes held, and no reduction of them; masses and
moments of inertia of both gears with their shafts as rigid bodies; springs of the bearings between the ends
of the shafts and the mean of the nodes of their bores; and a spring along the line of action. Equations and
frequencies are its own; here the housing is reduced to its seats with 8 kHz of modes (Craig & Bampton).
"""

import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from tests.support.spur_in_box import (
    AXES,
    AXIAL,
    BEARING,
    PRESSURE_ANGLE,
    SIZE,
    SPAN,
    frequencies,
    mean_stiffness,
    prepared,
    rotors,
    whole,
)
from tribodyn.studies.motion.prepare import PreparedGearbox

MODES = 12


def exudyn_frequencies(made: PreparedGearbox, modes: int = MODES) -> np.ndarray:
    """The lowest frequencies, Hz, with the pinion held in rotation."""
    import exudyn  # pyright: ignore[reportMissingImports]
    from exudyn.solver import ComputeODE2Eigenvalues  # pyright: ignore[reportMissingImports]

    box = whole()
    system = exudyn.SystemContainer().AddSystem()
    nodes = [system.AddNode({"nodeType": "Point", "referenceCoordinates": place}) for place in box.places]
    matrices = []
    for matrix in (box.mass, box.stiffness):
        matrices.append(exudyn.MatrixContainer())
        matrices[-1].SetWithSparseMatrix(matrix.tocsr())
    housing = system.AddObject(
        {
            "objectType": "GenericODE2",
            "nodeNumbers": nodes,
            "massMatrix": matrices[0],
            "stiffnessMatrix": matrices[1],
        }
    )
    gears = []
    for axis, rotor in zip(AXES, rotors(made), strict=True):
        place = [*axis, SIZE[2] / 2.0, 0.0, 0.0, 0.0]
        node = system.AddNode({"nodeType": "RigidBodyRxyz", "referenceCoordinates": place})
        inertia = [rotor.transverse, rotor.transverse, rotor.polar, 0.0, 0.0, 0.0]
        body = {"objectType": "RigidBody", "nodeNumber": node}
        gears.append(system.AddObject({**body, "mass": rotor.mass, "inertia": inertia}))

    def marker(gear: int, place: list[float]) -> Any:
        return system.AddMarker(
            {"markerType": "BodyRigid", "bodyNumber": gears[gear], "localPosition": place}
        )

    for number, ring in enumerate(box.rings):
        gear, end = divmod(number, 2)
        seat = system.AddMarker(
            {
                "markerType": "SuperElementPosition",
                "bodyNumber": housing,
                "meshNodeNumbers": [int(node) for node in ring],
                "weightingFactors": [1.0 / len(ring)] * len(ring),
            }
        )
        shaft = marker(gear, [0.0, 0.0, (end - 0.5) * SPAN])
        spring = {"objectType": "ConnectorCartesianSpringDamper", "markerNumbers": [seat, shaft]}
        system.AddObject({**spring, "stiffness": [*BEARING, 0.0 if end else AXIAL]})
    sense = made.case.bodies[0].sense
    normal = np.array([np.sin(PRESSURE_ANGLE), sense * np.cos(PRESSURE_ANGLE), 0.0])
    along = np.zeros((6, 6))
    along[:3, :3] = mean_stiffness(made) * np.outer(normal, normal)
    teeth = [
        marker(gear, [way * rotor.radius, 0.0, 0.0])
        for gear, way, rotor in zip((0, 1), (1, -1), rotors(made), strict=True)
    ]
    mesh = {"objectType": "ConnectorRigidBodySpringDamper", "markerNumbers": teeth}
    system.AddObject({**mesh, "stiffness": along})
    system.Assemble()
    held = [3 * int(node) + direction for node in box.bolted for direction in range(3)]
    held.append(3 * len(nodes) + 5)  # rotation of the pinion about z
    found, _ = ComputeODE2Eigenvalues(
        system,
        useSparseSolver=True,
        numberOfEigenvalues=modes,
        constrainedCoordinates=held,
        convert2Frequencies=True,
    )
    return np.sort(np.asarray(found))[:modes]


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        gearbox = prepared(Path(folder))
    ours, theirs = frequencies(gearbox)[:MODES], exudyn_frequencies(gearbox)
    for one, other in zip(ours, theirs, strict=True):
        print(f"{one:10.3f} Hz   EXUDYN {other:10.3f} Hz   {100.0 * (one / other - 1.0):+.4f} %")
