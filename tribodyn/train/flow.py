"""How torque flows through a train whose bodies are rigid: a first guess, and a scale, for every mesh."""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.train.structure import TURN, TrainLayout


class TreeBranch(NamedTuple):
    """A body with the one that it turns with, nearer to the reference, and what joins the two."""

    body: int
    nearer: int
    mesh: int  # -1 where a link joins them
    link: int  # -1 where a mesh joins them


def tree(layout: TrainLayout, turning_links: tuple[bool, ...]) -> list[TreeBranch]:
    """A tree from the reference to all bodies, nearer ones first; of a closed loop it leaves a joint out."""
    joints = [(a, b, m, -1) for m, (a, b) in enumerate(zip(layout.driver, layout.driven, strict=True))]
    ends = zip(layout.first, layout.second, turning_links, strict=True)
    joints += [(a, b, -1, k) for k, (a, b, turns) in enumerate(ends) if b >= 0 and turns]
    found: list[TreeBranch] = []
    reached = [0]
    for nearer in reached:
        for a, b, mesh, link in joints:
            body = b if a == nearer else a
            if nearer in (a, b) and body not in reached:
                reached.append(body)
                found.append(TreeBranch(body, nearer, mesh, link))
    return found


class Flow(NamedTuple):
    """Torques of a train at rest or accelerated as a rigid one."""

    branches: list[TreeBranch]
    on_driven: Float[Array, " mesh"]  # torque of a mesh on its driven body, N m; > 0 presses driving flanks
    on_body: Float[Array, " body"]  # torque of the joint with the nearer body on each, N m
    on_link: dict[int, float]  # torque with which a link of the tree turns its first end back, N m
    largest: float  # sum of all torques' magnitudes, as on the reference, N m


def flow(model: Any, extra: float = 0.0, largest_extra: float = 0.0) -> Flow:
    """Torques under the constant loads and an extra one on the output; the drive balances or accelerates.

    A mesh that closes a loop is given what flows through all of the train.
    """
    layout, bodies, operation = model.options.layout, model.bodies, model.operation
    ratio, inertia = np.asarray(bodies.ratio, dtype=float), np.asarray(bodies.inertia, dtype=float)
    wanted = np.array(bodies.load, dtype=float)
    largest = float(np.sum(np.abs(wanted) * ratio) + abs(largest_extra) * ratio[layout.output])
    wanted[layout.output] += extra
    if model.options.drive:
        drive = float(operation.drive_torque)
        largest += float(abs(drive) * ratio[layout.input])
        wanted[layout.input] -= drive
        wanted = wanted - inertia * ratio * float(wanted @ ratio) / float(inertia @ ratio**2)
    branches = tree(layout, tuple(np.asarray(model.links.stiffness)[:, TURN] > 0.0))
    through = wanted * ratio  # as on the reference
    for branch in reversed(branches):
        through[branch.nearer] += through[branch.body]
    on_body = through / ratio
    on_driven = np.full(len(model.meshes), np.nan)
    for branch in branches:
        if branch.mesh >= 0:
            mesh, torque = model.meshes[branch.mesh], on_body[branch.body]
            back = -float(mesh.driven_radius / mesh.driver_radius)
            on_driven[branch.mesh] = torque if branch.body == layout.driven[branch.mesh] else back * torque
    for m in np.flatnonzero(np.isnan(on_driven)):
        on_driven[m] = (through[0] if not model.options.drive else largest) / ratio[layout.driven[m]]
    on_link = {
        link: float(-on_body[body] if body == layout.first[link] else on_body[body])
        for body, _, _, link in branches
        if link >= 0
    }
    return Flow(branches, on_driven, on_body, on_link, largest)
