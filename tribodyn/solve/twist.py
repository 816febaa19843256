"""How much further the load brings every mesh than nominal rotation does: the static twist of its driver."""

from collections.abc import Sequence
from fractions import Fraction

import numpy as np

from tribodyn.dynamics.parameters import Model, frictionless
from tribodyn.errors import SimulationError
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.initial import static_equilibria
from tribodyn.train.schedule import common_period, interval_of, schedule_of
from tribodyn.train.structure import turned

#: Static equilibria over the common period, of which the mean is taken.
PLACES = 4


def static_twist(model: Model, rates: Sequence[Fraction]) -> Float[Array, " mesh"]:
    """Cycles by which the load at the start brings every mesh further, z ϑ/2π of its driver's z teeth.

    The mean over the common period of ϑ, the micro-rotation of the driver against the reference at rest
    without friction. 0 for meshes that the reference drives, and for all where no equilibrium is found. Of a
    planet's meshes, by how much the rotation of its carrier moves the pitch point it is less. `rates` are
    those of the meshes: of the period no more is laid out than the places.
    """
    layout, period = model.layout, common_period(rates)
    further = np.zeros(layout.meshes)
    if not any(layout.driver) and not any(layout.pins):
        return further
    smooth = frictionless(model)
    boundaries = [np.asarray(mesh.table.boundary) for mesh in model.meshes]
    begun = np.asarray(model.schedule.offset)[0].tolist()
    schedules, phases, intervals, before = [], [], [], 0
    for place in range(PLACES):
        cycle, eighths = divmod((2 * place + 1) * period, 2 * PLACES)
        stand = [phase + float(rate * cycle % 1) for phase, rate in zip(begun, rates, strict=True)]
        schedules.append(schedule_of(boundaries, rates, stand, 1))
        phases.append(eighths / (2 * PLACES))
        intervals.append(before + int(interval_of(np.array(phases[-1]), schedules[-1])[-1]))
        before += len(schedules[-1].start)
    laid = {
        name: np.concatenate([getattr(each, name) for each in schedules])
        for name in ("start", "end", "segment", "opens", "offset", "driver_tooth", "driven_tooth")
    }
    there = smooth._replace(schedule=schedules[0]._replace(**laid))
    try:
        states = static_equilibria(there, np.array(phases), np.array(intervals))
    except SimulationError:
        return further
    mean = np.mean(states, axis=0)
    for m, mesh in enumerate(model.meshes):
        ends = layout.driver[m], layout.driven[m]
        turn = float(turned(ends[0], mean, layout))
        for k, planet in enumerate(layout.first):
            if layout.pins[k] and planet in ends:
                sense = float(np.sign(mesh.driver_carried))  # of the carrier, by that of the driver
                turn -= sense * float(turned(layout.second[k], mean, layout))
        further[m] = float(mesh.driver_sense) * turn / float(mesh.table.pitch_angle)
    # cycles are counted from where the reference mesh begins one
    return further - further[0] * np.asarray(model.schedule.rate)
