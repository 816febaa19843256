"""How often a train turns and meshes: shafts, meshes, passing planets, teeth that meet again."""

from collections.abc import Iterator
from math import gcd, pi

from tribodyn.gears.bearings_in_time import passing_of
from tribodyn.signals.lines import (
    BEARING,
    FAULT,
    HUNTING,
    MESH,
    PASS,
    SHAFT,
    SetFrequencies,
    SignalLine,
    lines_of_pair,
    set_frequencies,
)
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.drivetrain.mesh_groups import alike_of, together
from tribodyn.studies.motion.planetary.results import meshes_of_member
from tribodyn.train.planetary import CARRIER, IN_PAIRS, RING, SECOND_SUN, SUN


def mesh_frequencies(prepared: PreparedGearbox) -> list[float]:
    """Of the meshes at nominal speed, Hz."""
    operation = prepared.model.operation
    first = float(operation.nominal_speed / operation.pitch_angle)
    return [float(mesh.rate) * first for mesh in prepared.case.meshes]


def distinct_meshes(prepared: PreparedGearbox) -> Iterator[tuple[str, float]]:
    """Frequencies of the meshes, Hz, equal ones once; those of a planetary set by its name.

    Where its meshes have several, by the member too.
    """
    case, of_rate = prepared.case, {}
    sets = {gearset.members[CARRIER]: gearset.name for gearset in case.sets}
    several = {
        carrier for carrier in sets if len({mesh.rate for mesh in case.meshes if mesh.carrier == carrier}) > 1
    }
    for mesh, frequency, alike in zip(case.meshes, mesh_frequencies(prepared), alike_of(case), strict=True):
        name = alike if mesh.carrier in several else sets.get(mesh.carrier, mesh.name)
        of_rate.setdefault(mesh.rate, (frequency, []))[1].append(name)
    for frequency, names in of_rate.values():
        yield together(names), frequency


def passes(prepared: PreparedGearbox) -> Iterator[tuple[str, float]]:
    """Frequencies at which planets pass a tooth of the ring and of the sun, N |n_c − n|, Hz."""
    turning = [body.sense * float(body.ratio) for body in prepared.case.bodies]
    shaft = reference_frequency(prepared)
    for gearset in prepared.case.sets:
        for member in (m for m in (RING, SUN, SECOND_SUN) if m in gearset.members):
            passing = turning[gearset.members[CARRIER]] - turning[gearset.members[member]]
            yield (
                f"{gearset.name}: planets pass {member.replace('_', ' ')}",
                gearset.arms * shaft * abs(passing),
            )


def reference_frequency(prepared: PreparedGearbox) -> float:
    """Turns of the reference body in a second, at nominal speed."""
    return float(prepared.model.operation.nominal_speed) / (2.0 * pi)


def of_sets(prepared: PreparedGearbox) -> dict[str, SetFrequencies]:
    """What repeats in every planetary set, Hz."""
    case, by_set = prepared.case, {}
    each = mesh_frequencies(prepared)
    for gearset in case.sets:
        at_sun, at_ring = (each[meshes_of_member(case, gearset, member)[0]] for member in (SUN, RING))
        teeth = gearset.teeth.sun, gearset.teeth.planet, abs(gearset.teeth.ring)
        by_set[gearset.name] = set_frequencies(*teeth, gearset.arms, at_sun, at_ring)
    return by_set


def bearing_lines(prepared: PreparedGearbox) -> list[SignalLine]:
    """Rolling elements of the bearings in time that pass their rings, per turn of the reference."""
    lines, turning = [], float(prepared.model.operation.nominal_speed)
    for name, (speed, passing) in passing_of(prepared.case.system).items():
        lines += [
            SignalLine(f"{name} elements pass outer ring", BEARING, passing.outer_pass * speed / turning),
            SignalLine(f"{name} elements pass inner ring", BEARING, passing.inner_pass * speed / turning),
            SignalLine(f"{name} cage", BEARING, passing.cage * speed / turning),
        ]
    return lines


def lines_of(prepared: PreparedGearbox) -> tuple[SignalLine, ...]:
    """Lines of a gearbox, per turn of the reference body; equal ones once."""
    case, shaft = prepared.case, reference_frequency(prepared)
    if not case.named:
        one, two = case.gears
        of_gears = lines_of_pair(one.name, two.name, (abs(one.teeth), abs(two.teeth)))
        return (*of_gears, *bearing_lines(prepared))
    lines = [SignalLine(name, MESH, frequency / shaft) for name, frequency in distinct_meshes(prepared)]
    if len(lines) == 1:
        lines = [lines[0]._replace(name="mesh")]
    planets = {planet for gearset in case.sets for planet in gearset.planets}
    for number, body in zip(prepared.order, prepared.bodies, strict=False):
        if number not in planets and body.ratio:
            lines.append(SignalLine(body.name, SHAFT, float(body.ratio)))
    for own, (name, gearset) in zip(case.sets, of_sets(prepared).items(), strict=True):
        lines += [
            SignalLine(f"planets of {name} pass", PASS, gearset.planet_pass / shaft),
            SignalLine(f"sun tooth of {name}", FAULT, gearset.sun_fault / shaft),
            SignalLine(f"planet tooth of {name}", FAULT, gearset.planet_fault / shaft),
        ]
        order = gearset.mesh / shaft
        if own.teeth.kind in IN_PAIRS:
            lines.append(SignalLine(f"second planet tooth of {name}", FAULT, order / own.teeth.second_planet))
        if own.teeth.second_sun:
            fault = own.arms * order / own.teeth.second_sun
            lines.append(SignalLine(f"second sun tooth of {name}", FAULT, fault))
    for mesh, frequency in zip(case.meshes, mesh_frequencies(prepared), strict=True):
        if mesh.carrier < 0:
            one, two = (int(abs(case.gears[gear].teeth)) for gear in mesh.gears)
            again = frequency * gcd(one, two) / (one * two)
            lines.append(SignalLine(f"hunting tooth of {mesh.name}", HUNTING, again / shaft))
    lines += bearing_lines(prepared)
    seen: set[tuple[str, float]] = set()
    distinct = []
    for line in lines:
        key = (line.sort, round(line.order, 9))
        if key not in seen:
            seen.add(key)
            distinct.append(line)
    return tuple(distinct)
