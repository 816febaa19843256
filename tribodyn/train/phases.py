"""Where every mesh of a train stands in its cycle, from the teeth as they are drawn.

A tooth's place is the angle from the line of centres to the tooth's axis, counted in the gear's own sense of
rotation. When a pair touches at the pitch point, the driver's tooth stands at −ψ_1 (it has not passed yet)
and the driven gear's at +ψ_2, with the half thickness angles ψ on the working pitch circles; when the driver
has turned by φ from there, at −ψ_1 + φ and ψ_2 + φ z_1/z_2. The cycle's phase is 0 where φ is the angle of
entry. With β the direction of a tooth (counter-clockwise from x), A the azimuth of the driven axis as seen
from the driver's, and s the senses,

    phase = z_1 (s_1 (β_1 − A) + ψ_1 − φ_entry)/2π  =  (z_2 (s_2 (β_2 − A − π) − ψ_2) − z_1 φ_entry)/2π,

up to whole cycles: the one or the other follows where the teeth of one gear are known. One pair's phase is
given: the reference mesh begins its cycle at turn 0.
"""

from collections.abc import Sequence
from math import pi
from typing import NamedTuple

from tribodyn.errors import InputError

#: Cycles by which teeth that close a loop may miss: the rounding of azimuths in degrees with two decimals
#: moves them by a few thousandths, as vibration does.
LOOP_TOLERANCE = 0.01
_ROUNDING = 1e-12


class ToothedShaft(NamedTuple):
    """A gear by the shaft it turns with; bodies that a coupling joins count as one shaft."""

    name: str
    shaft: int
    teeth: int  # negative of an internal gear
    sense: int  # +1 counter-clockwise seen from +z, −1 clockwise; of a gear of a set against its carrier
    tooth_angle: float = 0.0  # of one of its teeth from the shaft's mark, counter-clockwise, rad
    #: places, evenly about its axis, in which its shaft may stand while the shaft's other gear stays in its
    #: gaps: of a stepped planet that gear's teeth
    places: int = 1

    @property
    def signed_sense(self) -> int:
        """The sense in which a gear of the signed radius turns positively."""
        return self.sense if self.teeth > 0 else -self.sense

    @property
    def signed_angle(self) -> float:
        """The tooth's angle in polar coordinates whose radius is negative of an internal gear, rad."""
        return self.tooth_angle if self.teeth > 0 else self.tooth_angle + pi


class Engagement(NamedTuple):
    """A mesh by its gears and by how their teeth touch."""

    key: str  # where it stands in the scenario, dotted
    gears: tuple[int, int]  # driver and driven gear
    azimuth: float  # of the driven axis as seen from the driver's, rad
    #: half thickness angles of the driver's and the driven gear's teeth on their working pitch circles, rad
    half_angles: tuple[float, float]
    entry: float  # driver's angle from the pitch point at phase 0 of the mesh cycle (< 0), rad


class Phases(NamedTuple):
    """How the teeth of a train stand at turn 0."""

    meshes: tuple[float, ...]  # phase of every mesh, in its own cycles, 0 ≤ … < 1; that of mesh 0 is 0
    teeth: tuple[float, ...]  # direction of a tooth's axis of every gear, counter-clockwise from x, rad


def nominal_phases(gears: Sequence[ToothedShaft], meshes: Sequence[Engagement]) -> Phases:
    """Put the teeth together from mesh 0 outward, at the turn at which its cycle begins.

    Where no mesh reaches a shaft, for it drives a carrier, the first mesh behind it begins its cycle too.
    Raises InputError where the teeth of a loop's last mesh do not meet, by more than `LOOP_TOLERANCE`.
    """
    first = meshes[0]
    marks = {gears[first.gears[0]].shaft: _driver_mark(gears, first, 0.0)}
    phases: dict[int, float] = {}
    while len(phases) < len(meshes):
        before = len(phases)
        for place, mesh in enumerate(meshes):
            driver, driven = (gears[end] for end in mesh.gears)
            if place in phases or (driver.shaft not in marks and driven.shaft not in marks):
                continue
            if driver.shaft in marks:
                _fit_planet(gears, mesh, marks)
                phase = driver_phase(driver, mesh, marks[driver.shaft])
                if driven.shaft in marks:
                    _check_loop(gears, mesh, phase, marks)
                else:
                    marks[driven.shaft] = _driven_mark(gears, mesh, phase)
            else:
                phase = driven_phase(gears, mesh, marks[driven.shaft])
                marks[driver.shaft] = _driver_mark(gears, mesh, phase)
            phases[place] = phase
        if len(phases) == before:
            place = next(place for place in range(len(meshes)) if place not in phases)
            marks[gears[meshes[place].gears[0]].shaft] = _driver_mark(gears, meshes[place], 0.0)
    return Phases(
        tuple(0.0 if place == 0 else phases[place] for place in range(len(meshes))),
        tuple((marks[gear.shaft] + gear.tooth_angle) % (2.0 * pi) for gear in gears),
    )


def driver_phase(driver: ToothedShaft, mesh: Engagement, mark: float) -> float:
    """Phase of a mesh, 0 ≤ … < 1, by its driver, whose shaft's mark stands in this direction (rad)."""
    return _fraction(_driver_cycles(driver, mesh, mark + driver.signed_angle))


def driven_phase(gears: Sequence[ToothedShaft], mesh: Engagement, mark: float) -> float:
    """Phase of a mesh, 0 ≤ … < 1, by its driven gear, whose shaft's mark stands in this direction (rad)."""
    return _fraction(_driven_cycles(gears, mesh, mark + gears[mesh.gears[1]].signed_angle))


def _driver_cycles(driver: ToothedShaft, mesh: Engagement, direction: float) -> float:
    """Mesh cycles since the driver's tooth in this direction (polar, rad) entered."""
    place = driver.signed_sense * (direction - mesh.azimuth)
    return driver.teeth * (place + mesh.half_angles[0] - mesh.entry) / (2.0 * pi)


def _driven_cycles(gears: Sequence[ToothedShaft], mesh: Engagement, direction: float) -> float:
    """The same of the driven gear's tooth."""
    driver, driven = (gears[end] for end in mesh.gears)
    place = driven.signed_sense * (direction - mesh.azimuth - pi)
    turned = driven.teeth * (place - mesh.half_angles[1]) - driver.teeth * mesh.entry
    return turned / (2.0 * pi)


def entering_teeth(
    gears: Sequence[ToothedShaft],
    meshes: Sequence[Engagement],
    phases: Phases,
    further: Sequence[float] | None = None,
) -> list[tuple[int, int]]:
    """Numbers of the driver's and the driven gear's teeth that entered every mesh last, at turn 0.

    Tooth 0 of a gear is the one whose direction is given; the others follow in the order in which they enter.
    `further` are cycles by which the meshes stand further than that, see `solve.twist`; they may make another
    tooth the last one.
    """
    numbers = []
    for place, mesh in enumerate(meshes):
        driver, driven = (gears[end] for end in mesh.gears)
        one, two = (phases.teeth[end] for end in mesh.gears)
        ahead = phases.meshes[place] + (further[place] if further is not None else 0.0)
        turned = round(ahead - ahead % 1.0)
        cycles = (
            _driver_cycles(driver, mesh, one + (0.0 if driver.teeth > 0 else pi)),
            _driven_cycles(gears, mesh, two + (0.0 if driven.teeth > 0 else pi)),
        )
        entering = (round(number - phases.meshes[place]) + turned for number in cycles)
        first, second = entering
        numbers.append((first % abs(driver.teeth), second % abs(driven.teeth)))
    return numbers


def _fraction(cycles: float) -> float:
    """What is beyond whole cycles; 0 where that is rounding."""
    fraction = cycles % 1.0
    return fraction if _ROUNDING < fraction < 1.0 - _ROUNDING else 0.0


def _driver_mark(gears: Sequence[ToothedShaft], mesh: Engagement, phase: float) -> float:
    """Direction of the mark of the driver's shaft at a phase of the mesh, rad."""
    driver = gears[mesh.gears[0]]
    place = 2.0 * pi * phase / driver.teeth + mesh.entry - mesh.half_angles[0]
    return mesh.azimuth + driver.signed_sense * place - driver.signed_angle


def _driven_mark(gears: Sequence[ToothedShaft], mesh: Engagement, phase: float) -> float:
    """Direction of the mark of the driven gear's shaft at a phase of the mesh, rad."""
    driver, driven = (gears[end] for end in mesh.gears)
    place = (2.0 * pi * phase + driver.teeth * mesh.entry) / driven.teeth + mesh.half_angles[1]
    return mesh.azimuth + pi + driven.signed_sense * place - driven.signed_angle


def _fit_planet(gears: Sequence[ToothedShaft], mesh: Engagement, marks: dict[int, float]) -> None:
    """Turn a stepped planet, by pitches of the gear that stands in its gaps, to where the other fits best."""
    turned = next((gears[end] for end in mesh.gears if gears[end].places > 1), None)
    if turned is None or any(gears[end].shaft not in marks for end in mesh.gears):
        return
    places = [marks[turned.shaft] + 2.0 * pi * k / turned.places for k in range(turned.places)]
    driver = gears[mesh.gears[0]]

    def missed(place: float) -> float:
        at = marks | {turned.shaft: place}
        return round(abs(_missed(gears, mesh, driver_phase(driver, mesh, at[driver.shaft]), at)), 9)

    marks[turned.shaft] = min(places, key=missed)


def _missed(gears: Sequence[ToothedShaft], mesh: Engagement, phase: float, marks: dict[int, float]) -> float:
    """Cycles by which the driver, at this phase, is ahead of the driven gear."""
    driven = gears[mesh.gears[1]]
    return (phase - driven_phase(gears, mesh, marks[driven.shaft]) + 0.5) % 1.0 - 0.5


def _check_loop(
    gears: Sequence[ToothedShaft], mesh: Engagement, phase: float, marks: dict[int, float]
) -> None:
    driven = gears[mesh.gears[1]]
    missed = _missed(gears, mesh, phase, marks)
    if abs(missed) <= LOOP_TOLERANCE:
        return
    rule = (
        f"closes a loop whose teeth do not meet: those of {driven.name} stand {abs(missed):.3g} pitches "
        "beside the gaps of its mate"
    )
    remedy = "change an azimuth"
    for end, cycles in zip(mesh.gears, (-missed, missed), strict=True):
        gear = gears[end]
        if sum(other.shaft == gear.shaft for other in gears) > 1:
            pitch = 2.0 * pi / abs(gear.teeth)
            turned = gear.tooth_angle + gear.sense * cycles * pitch
            wanted = (turned + pitch / 2.0) % pitch - pitch / 2.0
            remedy += f', or turn {gear.name} on its shaft: tooth_angle = "{180.0 / pi * wanted:.6f} deg"'
            break
    raise InputError(mesh.key, None, rule, remedy)
