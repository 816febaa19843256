"""Powers in a train whose meshes lose a share of what rolls through them: directions, efficiency, locking.

What a mesh loses is a share of its *rolling power*, torque times speed against its carrier (Willis): the gear
by which that power enters drives, and the other one is given the rest. The carrier bears both torques. Speeds
do not depend on losses; which gear of a mesh drives may.
"""

from collections.abc import Mapping, Sequence
from itertools import product
from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.train.willis import Equation, reactions

#: Meshes, those whose losses differ in no direction counted once, up to which every direction is tried.
MOST = 12
#: Share of the largest rolling power below which a mesh carries nothing but rounding.
_NOTHING = 1e-9


class LossyMesh(NamedTuple):
    """A mesh of two bodies, by its teeth (internal ones negative); carrier −1: the axes stand still."""

    one: int
    two: int
    teeth: tuple[float, float]
    carrier: int = -1
    loss: float = 0.0  # share of the rolling power, 0 … 1

    def torques(self, forward: bool) -> tuple[float, float]:
        """Torques on both gears, per torque of a tooth of the one that drives: `forward`, the first."""
        one, two = self.teeth
        return (one, two * (1.0 - self.loss)) if forward else (one * (1.0 - self.loss), two)

    def row(self, forward: bool) -> Equation:
        """These torques, and the carrier's, as `willis.reactions` takes them."""
        one, two = self.torques(forward)
        factors = {self.one: one}
        for body, factor in ((self.two, two), (self.carrier, -one - two)):
            if body >= 0:
                factors[body] = factors.get(body, 0.0) + factor
        return Equation(factors)

    def rolling(self, speeds: Sequence[float]) -> float:
        """Speed with which the first gear's teeth roll, times their number."""
        return self.teeth[0] * (speeds[self.one] - (speeds[self.carrier] if self.carrier >= 0 else 0.0))


class Influence(NamedTuple):
    """What torques from outside and drags make of the torques of meshes, N m, without any other losses.

    Torques of a mesh are those on its second gear, positive where its first one drives. Drags are against
    the motion: of a body, or of a mesh at its first gear against the carrier, which bears them.
    """

    load: Float[Array, " mesh"]  # of the loads
    body: Float[Array, "mesh body"]  # of a drag of 1 N m on a body
    mesh: Float[Array, "mesh mesh"]  # of a drag of 1 N m at the first gear of a mesh


def influence(
    meshes: Sequence[LossyMesh],
    rows: Sequence[Equation],
    speeds: Sequence[float],
    loads: Mapping[int, float],
) -> Influence:
    """Torques of the meshes by loads and by drags; arguments as of `power_flow`.

    Bodies that nothing joins bear nothing.
    """
    balance = [*(mesh._replace(loss=0.0).row(True) for mesh in meshes), *rows]
    known = {body for row in balance for body in row.factors}

    def against(body: int) -> float:
        return -1.0 if speeds[body] > 0.0 else 1.0

    def torques(outside: Mapping[int, float]) -> Float[Array, " mesh"]:
        found = reactions(balance, {body: torque for body, torque in outside.items() if body in known})
        return np.array([-force * each for force, each in zip(found, scale, strict=False)])

    scale = []
    for mesh in meshes:
        carried = speeds[mesh.carrier] if mesh.carrier >= 0 else 0.0
        second = abs(speeds[mesh.two] - carried)
        scale.append(mesh.rolling(speeds) / second if second else abs(mesh.teeth[1]))
    by_body = [
        torques({body: against(body)}) if speeds[body] else 0.0 * np.array(scale)
        for body in range(len(speeds))
    ]
    by_mesh = []
    for mesh in meshes:
        carried = speeds[mesh.carrier] if mesh.carrier >= 0 else 0.0
        way = -1.0 if speeds[mesh.one] - carried > 0.0 else 1.0
        by_mesh.append(torques({mesh.one: way, mesh.carrier: -way}))
    return Influence(torques(loads), np.array(by_body).T, np.array(by_mesh).T)


class PowerFlow(NamedTuple):
    """Torques, N m counter-clockwise, and powers, W."""

    torque: tuple[float, ...]  # that every row of what is not a mesh puts in, as of `willis.reactions`
    rolling: tuple[float, ...]  # of every mesh, what enters: positive where its first gear drives
    loss: tuple[float, ...]  # of every mesh
    on: tuple[tuple[float, float, float], ...]  # torques of every mesh on its first and second body, carrier
    put_in: float
    taken_out: float

    @property
    def efficiency(self) -> float:
        """Power out over power in."""
        return self.taken_out / self.put_in if self.put_in else 0.0


def power_flow(
    meshes: Sequence[LossyMesh],
    rows: Sequence[Equation],
    speeds: Sequence[float],
    loads: Mapping[int, float],
) -> PowerFlow | None:
    """Balance loads (N m, counter-clockwise, on bodies that turn at speeds, rad/s); None: it locks itself.

    `rows` are those of couplings and of bodies that are held or driven, see `willis`. Directions of all
    meshes are those without losses, and where these contradict the torques that follow, as near to them as
    torques agree with. Self-locking: no direction of rolling power agrees with its own torques.
    """
    rolling = [mesh.rolling(speeds) for mesh in meshes]
    forward = [True] * len(meshes)
    lossless = [mesh._replace(loss=0.0) for mesh in meshes]
    first = _directions(lossless, rows, rolling, loads, forward)[0]
    tried = first
    for _ in range(2 * len(meshes) + 2):
        following, found = _directions(meshes, rows, rolling, loads, tried)
        if following == tried:
            return _flow(meshes, rows, rolling, speeds, loads, tried, found)
        tried = following
    alike = _alike(meshes, rolling, speeds)
    if max(alike, default=-1) + 1 > MOST:
        return None
    groups = range(max(alike, default=-1) + 1)
    for flipped in sorted(product((False, True), repeat=len(groups)), key=sum):
        tried = [way is not flipped[group] for way, group in zip(first, alike, strict=True)]
        following, found = _directions(meshes, rows, rolling, loads, tried)
        if following == tried:
            return _flow(meshes, rows, rolling, speeds, loads, tried, found)
    return None


def _directions(
    meshes: Sequence[LossyMesh],
    rows: Sequence[Equation],
    rolling: Sequence[float],
    loads: Mapping[int, float],
    forward: Sequence[bool],
) -> tuple[list[bool], list[float]]:
    """Which first gears drive by the torques that directions give; of what carries nothing these."""
    found = reactions([*(m.row(way) for m, way in zip(meshes, forward, strict=True)), *rows], loads)
    powers = [force * speed for force, speed in zip(found, rolling, strict=False)]
    least = _NOTHING * max(map(abs, powers), default=0.0)
    return [
        way if abs(power) <= least else power < 0.0 for power, way in zip(powers, forward, strict=True)
    ], found


def _alike(meshes: Sequence[LossyMesh], rolling: Sequence[float], speeds: Sequence[float]) -> list[int]:
    """Number alike what differs by its planet alone."""
    numbers: dict[object, int] = {}
    keys = (
        (mesh.teeth, mesh.carrier, mesh.loss, way, speeds[mesh.one], speeds[mesh.two])
        for mesh, way in zip(meshes, rolling, strict=True)
    )
    return [numbers.setdefault(key, len(numbers)) for key in keys]


def _flow(
    meshes: Sequence[LossyMesh],
    rows: Sequence[Equation],
    rolling: Sequence[float],
    speeds: Sequence[float],
    loads: Mapping[int, float],
    forward: Sequence[bool],
    found: Sequence[float],
) -> PowerFlow:
    entering, lost, on = [], [], []
    for mesh, way, force, speed in zip(meshes, forward, found, rolling, strict=False):
        one, two = (force * torque for torque in mesh.torques(way))
        power = -force * speed
        entering.append(power)
        lost.append(mesh.loss * abs(power))
        on.append((one, two, -one - two))
    torque = tuple(found[len(meshes) :])
    powers = [load * speeds[body] for body, load in loads.items()]
    for row, multiplier in zip(rows, torque, strict=True):
        if len(row.factors) == 1:
            ((body, factor),) = row.factors.items()
            powers.append(multiplier * float(factor) * speeds[body])
    put_in = sum(power for power in powers if power > 0.0)
    taken_out = -sum(power for power in powers if power < 0.0)
    return PowerFlow(torque, tuple(entering), tuple(lost), tuple(on), put_in, taken_out)
