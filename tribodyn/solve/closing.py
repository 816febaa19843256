"""States in which the flanks of all meshes are closed, and the sizes of displacements there."""

import numpy as np

from tribodyn.dynamics.parameters import Model
from tribodyn.numerics.shapes import Array, Float
from tribodyn.train.flow import Flow
from tribodyn.train.links.chain import twist_under
from tribodyn.train.structure import driven_arm, driver_arm, shift_of, turn_of, turned


def closed_state(model: Model, errors: Float[Array, " mesh"], torques: Flow) -> Float[Array, " state"]:
    """State in which the meshes have rotational errors (m) and shafts the twist of their torque."""
    layout = model.layout
    if any(layout.pins):
        return _closed_on_pins(model, errors, torques)
    y = np.zeros(layout.states)
    for body, nearer, m, link in torques.branches:
        start = float(turned(nearer, y, layout))
        if link >= 0:
            twist = twist_under(link, torques.on_link[link], model)
            value = start + twist if body == layout.first[link] else start - twist
        else:
            mesh = model.meshes[m]
            ends = float(driver_arm(mesh)), float(driven_arm(mesh))
            if body == layout.driven[m]:
                value = (ends[0] * start - errors[m]) / ends[1]
            else:
                value = (ends[1] * start + errors[m]) / ends[0]
        y[turn_of(body, layout)] = value
    return y


def _closed_on_pins(model: Model, errors: Float[Array, " mesh"], torques: Flow) -> Float[Array, " state"]:
    """The same where planets close loops, by the smallest rotations; planets go with their carriers."""
    layout, y = model.layout, np.zeros(model.layout.states)
    rows, wanted = np.zeros((layout.meshes + len(torques.on_link), layout.bodies)), []
    for m, mesh in enumerate(model.meshes):
        rows[m, layout.driver[m]] += float(driver_arm(mesh))
        rows[m, layout.driven[m]] -= float(driven_arm(mesh))
        rows[m, layout.carrier[m]] -= float(mesh.carrier_arm)  # 0 of one in the housing
        wanted.append(float(errors[m]))
    for row, (link, torque) in enumerate(torques.on_link.items(), start=layout.meshes):
        if layout.second[link] >= 0:
            rows[row, layout.first[link]], rows[row, layout.second[link]] = 1.0, -1.0
        wanted.append(twist_under(link, torque, model) if layout.second[link] >= 0 else 0.0)
    still = [0, *(body for k, body in enumerate(layout.first) if layout.holds[k])]
    still += torques.clutches.roots if torques.clutches is not None else ()
    rows[:, still] = 0.0
    size = np.linalg.norm(rows, axis=1)
    size[size == 0.0] = 1.0
    turns, *_ = np.linalg.lstsq(rows / size[:, None], np.array(wanted) / size)
    y[[turn_of(body, layout) for body in range(layout.bodies)]] = turns
    for k, planet in enumerate(layout.first):
        if layout.pins[k]:
            moved = np.asarray(model.links.lever)[k, 1] * turns[layout.second[k]]
            y[shift_of(planet) : shift_of(planet) + 2] = moved
    return y


def sizes_of(model: Model, deflection: Float[Array, " mesh"]) -> Float[Array, " state"]:
    """Sizes of displacements, from the deflections of the meshes; m, rad."""
    layout = model.layout
    scale = np.zeros(layout.states)
    ends = [(layout.driver, "driver_radius"), (layout.driven, "driven_radius")]
    for bodies, radius in ends:
        for m, body in enumerate(bodies):
            if body < layout.planar:
                place = shift_of(body)
                scale[place : place + 2] = np.maximum(scale[place : place + 2], deflection[m])
            if body < layout.spatial:
                place = layout.tilts + 3 * body
                scale[place] = max(scale[place], deflection[m])
                tilt = deflection[m] / abs(float(getattr(model.meshes[m], radius)))
                scale[place + 1 : place + 3] = np.maximum(scale[place + 1 : place + 3], tilt)
            i = turn_of(body, layout)
            scale[i] = max(scale[i], deflection[m] / abs(float(getattr(model.meshes[m], radius))))
    # of what no mesh moves: as large as any
    rest = scale == 0.0
    turns = [turn_of(body, layout) for body in range(layout.bodies)]
    scale[rest] = np.max(deflection)
    tilts = [layout.tilts + 3 * body + i for body in range(layout.spatial) for i in (1, 2)]
    scale[[i for i in (*turns, *tilts) if rest[i]]] = max(scale[i] for i in turns if not rest[i])
    return scale
