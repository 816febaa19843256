"""Meshes that close a loop without backlash, and pins of planets that leave none: such a train jams."""

from collections.abc import Sequence

import numpy as np

from tribodyn.geometry.helix import pitch_slope
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.case import HOUSING, Gearbox, SetData
from tribodyn.studies.motion.drivetrain.mesh_groups import together
from tribodyn.train.planetary import IN_PAIRS
from tribodyn.train.structure import TURN

#: Backlash that is none, m: what is left by rounding.
NONE = 1e-9


def jams(prepared: PreparedGearbox) -> list[str]:
    """Say which meshes of closed loops have no backlash, and which sets none beside the errors of their pins.

    Where back flanks never touch, `mesh.backlash` not given, nothing jams in the model.
    """
    case = prepared.case
    none = [
        m
        for m, mesh in enumerate(case.meshes)
        if mesh.pair.mesh.backlash is not None and mesh.pair.mesh.backlash <= NONE and _closes_a_loop(case, m)
    ]
    sentences = []
    if none:
        gear = case.gears[case.meshes[none[0]].gears[1]].name
        sentences.append(
            f"no backlash where meshes close a loop, {together(case.meshes[m].name for m in none)}: both "
            "flanks touch and the gears jam, make teeth thinner "
            f'(gear.{gear}.thickness_allowance = "-40 um") or give mesh.backlash'
        )
    return [*sentences, *filter(None, (_by_pins(prepared, gearset, none) for gearset in case.sets))]


def _closes_a_loop(case: Gearbox, m: int) -> bool:
    """Whether both bodies of a mesh are joined by other meshes and turning links too."""
    joints = [(mesh.driver, mesh.driven) for k, mesh in enumerate(case.meshes) if k != m]
    joints += [link.ends for link in case.links if HOUSING not in link.ends and link.stiffness[TURN] > 0.0]
    reached = {case.meshes[m].driver}
    for _ in case.bodies:
        reached |= {body for ends in joints if reached & set(ends) for body in ends}
    return case.meshes[m].driven in reached


def _by_pins(prepared: PreparedGearbox, gearset: SetData, none: Sequence[int]) -> str:
    """Say of a set where the errors of its pins leave no backlash, on the normal; "": everywhere is some.

    A pin that is e too far out opens its mesh with the sun by 2 e sin α and closes that with the ring. One
    that is e too far ahead moves both of its flanks by e cos α: a sun and a ring that only turn leave every
    planet a span as wide as the backlash of both its meshes, and these must have a place in common.
    """
    case = prepared.case
    if gearset.teeth.kind in IN_PAIRS:  # their pins have no errors
        return ""
    offsets = {link.ends[0]: link.offset for link in case.links if link.lever}
    ahead, room = np.zeros((2, len(gearset.planets)))
    for k, (planet, angle) in enumerate(zip(gearset.planets, gearset.angles, strict=True)):
        x, y = offsets.get(planet, (0.0, 0.0))
        outwards, onwards = x * np.cos(angle) + y * np.sin(angle), y * np.cos(angle) - x * np.sin(angle)
        for m, mesh in enumerate(case.meshes):
            if planet not in (mesh.driver, mesh.driven):
                continue
            backlash = mesh.pair.mesh.backlash
            if backlash is None or m in none:
                return ""
            assembly = prepared.tables[m].assembly
            angle_there = float(assembly.path.pressure_angle(0.0))
            lean = 1.0 / np.hypot(1.0, float(pitch_slope(assembly)) * np.cos(angle_there))
            internal = min(case.gears[gear].teeth for gear in mesh.gears) < 0
            used = 2.0 * outwards * np.sin(angle_there) * lean * (1.0 if internal else -1.0)
            if backlash - used <= NONE:
                return _said(gearset, used, backlash, f"of the mesh {mesh.name}")
            room[k] += backlash - used
            ahead[k] += onwards * np.cos(angle_there) * lean
    first = int(np.argmax(ahead - room))
    used = float(ahead[first] - np.min(ahead))
    if used < room[first] or any(case.bodies[body].floating for body in gearset.bodies):
        return ""
    return _said(gearset, used, float(room[first]), "of both meshes of a planet")


def _said(gearset: SetData, used: float, backlash: float, of: str) -> str:
    return (
        f"pin errors of the stage {gearset.name} take {1e6 * used:.3g} um, where the backlash {of} is "
        f"{1e6 * backlash:.3g} um: the gears jam, tighten the pins' tolerances or make teeth thinner "
        "(thickness_allowance)"
    )
