"""EXUDYN beside the history of a two-stage reducer in `tests/support/two_stage_histories.py`.

::

    python -m tools.peers.exudyn_train             # both histories, and their differences
    python -m tools.peers.exudyn_train --rigid     # both gears of the middle shaft on one body
    python -m tools.peers.exudyn_train --share 0.1 --radians-per-step 0.01

EXUDYN (Gerstmayr 2024, doi:10.1007/s11044-023-09937-1; ``pip install exudyn``) is a multibody program. It
gets masses and moments of inertia of rigid bodies in the plane, Cartesian and torsional springs, and for
every mesh the string that draws involutes: a rope over both base circles, crossed, fixed to either body. How
the rope's length depends on displacements and rotations, which forces and moments follow and how the
equations are integrated is EXUDYN's; no normal, moment or matrix is handed over. The rope's geometry is
exact, so that what linear equations leave out is in the differences: it is proportional to the load.

The integration is by the trapezoidal rule: the error goes with the square of the step, nothing is damped by
it.
"""

import argparse
from typing import Any, NamedTuple

import numpy as np

from tests.support.train_matrices import (
    Mesh,
    Train,
    free_coordinates,
    natural_frequencies,
    towards_driven,
)
from tests.support.two_stage_histories import LOAD, History, output_load, step_response, two_stage

Array = Any

DURATION, SAMPLES = 10e-3, 200
#: Step in radians of the fastest mode.
RADIANS_PER_STEP = 0.02
#: Radius at which a rope is fixed to its body, over the base radius.
OUTSIDE = 1.5


class Found(NamedTuple):
    """EXUDYN's history: displacements (time, coordinate), mesh forces (time, mesh)."""

    displacement: Array
    mesh_force: Array


def exudyn_history(
    train: Train, before: float, after: float, times: Array, radians_per_step: float = RADIANS_PER_STEP
) -> Found:
    """What EXUDYN makes of a torque on the output that steps at time 0 from equilibrium.

    `times` are uniform from 0 on; the speed of body 0 is held, as in `step_response`.
    """
    import exudyn  # pyright: ignore[reportMissingImports]

    container = exudyn.SystemContainer()
    system = container.AddSystem()
    nodes, ropes = _model(exudyn, system, train)
    sense = float(output_load(train, 1.0)[-1])
    output = system.AddMarker({"markerType": "NodeCoordinate", "nodeNumber": nodes[-1], "coordinate": 2})
    load = system.AddLoad({"loadType": "Coordinate", "markerNumber": output, "load": sense * before})
    kinds = exudyn.OutputVariableType
    moved = [
        system.AddSensor(
            {
                "sensorType": "Node",
                "nodeNumber": node,
                "storeInternal": True,
                "outputVariableType": kinds.Coordinates,
            }
        )
        for node in nodes
    ]
    pressed = [
        system.AddSensor(
            {
                "sensorType": "Object",
                "objectNumber": rope,
                "storeInternal": True,
                "outputVariableType": kinds.ForceLocal,
            }
        )
        for rope in ropes
    ]
    system.Assemble()

    settings = exudyn.SimulationSettings()
    settings.solution.file.write = False
    for newton in (settings.staticSolver.newton, settings.timeIntegration.newton):
        newton.relativeTolerance = newton.absoluteTolerance = 1e-9
    system.SolveStatic(settings, updateInitialValues=True)
    system.SetLoadParameter(load, "load", sense * after)
    step = float(times[1] - times[0])
    fastest = 2.0 * np.pi * natural_frequencies(train, free_coordinates(train, (0,)))[-1]
    settings.timeIntegration.numberOfSteps = int(np.ceil(step * fastest / radians_per_step)) * (
        len(times) - 1
    )
    settings.timeIntegration.endTime = float(times[-1])
    settings.solution.sensors.writePeriod = step
    system.SolveDynamic(settings, solverType=exudyn.DynamicSolverType.TrapezoidalIndex2)
    histories = [system.GetSensorStoredData(sensor) for sensor in moved]
    stored = histories[0][:, 0]
    if len(stored) != len(times) or np.max(np.abs(stored - times)) > 1e-6 * step:
        raise RuntimeError(
            f"EXUDYN stored {len(stored)} samples up to {stored[-1]:.4g} s, not those asked for"
        )
    pulls = [system.GetSensorStoredData(sensor)[:, 1] for sensor in pressed]
    return Found(np.hstack([history[:, 1:4] for history in histories]), -np.stack(pulls, axis=1))


def _model(exudyn: Any, system: Any, train: Train) -> tuple[list[Any], list[Any]]:
    """Nodes and ropes of the train, with bearings, shafts and the input's rotation held."""
    ground = system.AddObject({"objectType": "Ground"})
    places, nodes, bodies = _places(train), [], []
    for body, place in zip(train.bodies, places, strict=True):
        nodes.append(system.AddNode({"nodeType": "RigidBody2D", "referenceCoordinates": [*place, 0.0]}))
        rigid = {"objectType": "RigidBody2D", "nodeNumber": nodes[-1]}
        bodies.append(system.AddObject({**rigid, "mass": body.mass, "inertia": body.inertia}))

    def marker(body: Any, place: Array | tuple[float, float] = (0.0, 0.0)) -> Any:
        """A point of a body, with its rotation."""
        return system.AddMarker(
            {"markerType": "BodyRigid", "bodyNumber": body, "localPosition": [*place, 0.0]}
        )

    for bearing in train.bearings:
        system.AddObject(
            {
                "objectType": "ConnectorCartesianSpringDamper",
                "markerNumbers": [marker(ground, places[bearing.body]), marker(bodies[bearing.body])],
                "stiffness": [*bearing.stiffness, 0.0],
                "damping": [*bearing.damping, 0.0],
            }
        )
    for shaft in train.shafts:
        system.AddObject(
            {
                "objectType": "ConnectorTorsionalSpringDamper",
                "markerNumbers": [marker(bodies[end]) for end in shaft.ends],
                "stiffness": shaft.stiffness,
                "damping": shaft.damping,
            }
        )
    ropes = [system.AddObject(_rope(exudyn, mesh, bodies, marker)) for mesh in train.meshes]
    fixed = system.AddNode({"nodeType": "PointGround"})
    held = [
        system.AddMarker({"markerType": "NodeCoordinate", "nodeNumber": node, "coordinate": coordinate})
        for node, coordinate in ((fixed, 0), (nodes[0], 2))
    ]
    system.AddObject({"objectType": "ConnectorCoordinate", "markerNumbers": held})
    return nodes, ropes


def _places(train: Train) -> Array:
    """Axes of the bodies, from mesh to mesh; the two gears of a compliant shaft stand on one axis."""
    places = {0: np.zeros(2)}
    for mesh in train.meshes:
        driver, driven = mesh.ends
        if driver not in places:
            places[driver] = next(places[shaft.ends[0]] for shaft in train.shafts if shaft.ends[1] == driver)
        places[driven] = places[driver] + sum(mesh.radii) * towards_driven(mesh)
    return np.array([places[i] for i in range(len(train.bodies))])


def _rope(exudyn: Any, mesh: Mesh, bodies: list[Any], marker: Any) -> dict[str, Any]:
    """The string that draws the involutes of a mesh, from the driver to the driven body along the motion.

    It is fixed outside the base circles and lies on each for a quarter turn. The driver, when ahead, brings
    its end nearer: the rope is pressed.
    """
    bases = [radius * np.cos(mesh.pressure_angle) for radius in mesh.radii]
    # where it leaves the driver's base circle; it meets the other at the opposite side
    leaves = mesh.azimuth - mesh.sense * mesh.pressure_angle
    back = mesh.sense * (0.5 * np.pi + np.arccos(1.0 / OUTSIDE))
    ends = [
        marker(bodies[body], OUTSIDE * base * np.array([np.cos(angle), np.sin(angle)]))
        for body, base, angle in zip(mesh.ends, bases, (leaves - back, leaves + np.pi - back), strict=True)
    ]
    length = sum(bases) * (np.sqrt(OUTSIDE**2 - 1.0) + 0.5 * np.pi + np.tan(mesh.pressure_angle))
    axes = [np.array([0.0, 0.0, sense]) for sense in (1.0, mesh.sense, -mesh.sense, 1.0)]
    return {
        "objectType": "ConnectorReevingSystemSprings",
        "markerNumbers": [ends[0], *(marker(bodies[body]) for body in mesh.ends), ends[1]],
        "sheavesAxes": exudyn.Vector3DList(axes),
        "sheavesRadii": [0.0, *bases, 0.0],
        "stiffnessPerLength": mesh.stiffness * length,
        "dampingPerLength": mesh.damping * length,
        "referenceLength": length,
        "regularizationForce": -1.0,  # below 0: it presses as well as it pulls
    }


def differences(found: Array, expected: Array) -> Array:
    """Maximum over time of each column's difference, over the maximum of the expected one."""
    return np.max(np.abs(found - expected), axis=0) / np.max(np.abs(expected), axis=0)


def compared(
    rigid: bool, share: float = 1.0, radians_per_step: float = RADIANS_PER_STEP
) -> tuple[History, Found]:
    """Both histories of the reducer under a share of its load step."""
    train, times = two_stage(rigid), np.linspace(0.0, DURATION, SAMPLES + 1)
    before, after = (share * torque for torque in LOAD)
    ours = step_response(train, output_load(train, before), output_load(train, after), times)
    return ours, exudyn_history(train, before, after, times, radians_per_step)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--rigid", action="store_true", help="one body for both gears of the middle shaft")
    parser.add_argument("--share", type=float, default=1.0, help="of the loads before and after the step")
    parser.add_argument("--radians-per-step", type=float, default=RADIANS_PER_STEP)
    given = parser.parse_args()
    ours, theirs = compared(given.rigid, given.share, given.radians_per_step)
    print("            mesh 1, N          mesh 2, N      rotation of the output, µrad")
    print("   ms    SciPy   EXUDYN     SciPy   EXUDYN     SciPy   EXUDYN")
    for i in range(0, len(ours.time), 10):
        pairs = [*zip(ours.mesh_force[i], theirs.mesh_force[i], strict=True)]
        pairs.append((1e6 * ours.rotation[i, -1], 1e6 * theirs.displacement[i, -1]))
        print(f"{1e3 * ours.time[i]:5.1f}", *(f"{one:9.2f}{other:9.2f}" for one, other in pairs))
    print("maximum difference over time, over each one's maximum")
    free = [i for i in range(ours.displacement.shape[1]) if i != 2]
    for name, values in (
        ("mesh forces", differences(theirs.mesh_force, ours.mesh_force)),
        ("rotations", differences(theirs.displacement[:, 5::3], ours.rotation[:, 1:])),
        ("all coordinates", differences(theirs.displacement[:, free], ours.displacement[:, free])),
    ):
        print(f"{name:16}", *(f"{value:.1e}" for value in values))


if __name__ == "__main__":
    main()
