"""Names of the lines that gears make: by their orders, cycles per turn of the reference shaft."""

from collections.abc import Iterable, Iterator, Sequence
from math import gcd
from typing import NamedTuple

#: Sorts of lines: tooth meshing, turns of shafts, the same two teeth again, planets that pass a place, teeth
#: of a planetary set that meet their mates, rolling elements that pass a ring.
MESH, SHAFT, HUNTING, PASS, FAULT, BEARING = SORTS = ("mesh", "shaft", "hunting", "pass", "fault", "bearing")


class SignalLine(NamedTuple):
    """A line: its name, its sort (one of `SORTS`) and its order."""

    name: str
    sort: str
    order: float

    def teeth_of(self, mesh: "SignalLine") -> int:
        """Cycles of a mesh in a turn of this shaft where that is a whole number, as of its gears; else 0."""
        cycles = mesh.order / self.order if self.order else 0.0
        whole = round(cycles)
        return whole if whole and abs(cycles - whole) < 1e-6 * cycles else 0


class NamedOrder(NamedTuple):
    """An order with what it is called: 2 × mesh − pinion."""

    order: float
    label: str
    sort: str  # of its line; "sideband" beside a mesh


def lines_of_pair(first: str, second: str, teeth: tuple[int, int]) -> tuple[SignalLine, ...]:
    """Lines of a pair of gears, per turn of the first: mesh, both shafts, the hunting tooth.

    The same two teeth meet again after lcm(z_1, z_2) pitches: f_mesh gcd(z_1, z_2)/(z_1 z_2).
    """
    one, two = teeth
    return (
        SignalLine("mesh", MESH, float(one)),
        SignalLine(first, SHAFT, 1.0),
        SignalLine(second, SHAFT, one / two),
        SignalLine("hunting tooth", HUNTING, gcd(one, two) / two),
    )


class SetFrequencies(NamedTuple):
    """What repeats in a planetary set, in the unit of the mesh frequency that it is made of."""

    mesh: float  # of the sun with the planets
    carrier_against_ring: float  # turns of the carrier as the ring sees it
    planet_pass: float  # planets that pass a tooth of the ring
    sun_fault: float  # a tooth of the sun meets a planet
    planet_fault: float  # one flank of a planet's tooth meets the ring, or the sun
    ring_fault: float  # a tooth of the ring meets a planet


def set_frequencies(
    sun: int, planet: int, ring: int, planets: int, mesh: float, ring_mesh: float | None = None
) -> SetFrequencies:
    """Frequencies of a planetary set of so many teeth, by that of its meshes, whichever member is held.

    `planet` are the teeth of the gear that meshes with the sun, at the frequency `mesh`; `ring_mesh` is that
    of the ring, of stepped planets another one.

    In the frame of the carrier all gears mesh with f_mesh = z abs(n − n_c), so that each turns there with
    f_mesh/z, and meets `planets` mates in a turn; a planet meets sun and ring with opposite flanks.
    """
    at_ring = mesh if ring_mesh is None else ring_mesh
    return SetFrequencies(
        mesh,
        at_ring / ring,
        planets * at_ring / ring,
        planets * mesh / sun,
        mesh / planet,
        planets * at_ring / ring,
    )


def named_orders(
    lines: Iterable[SignalLine], most: float, *, sidebands: int = 2, harmonics: int = 3
) -> Iterator[NamedOrder]:
    """Orders up to `most` that lines stand for: of meshes all harmonics with sidebands, of others some.

    `sidebands` are those of every shaft, carrier and passing planets on either side of a mesh harmonic,
    `harmonics` those of what is no mesh.
    """
    lines = list(lines)
    slow = [line for line in lines if line.sort in (SHAFT, PASS) and line.order]
    for line in lines:
        if not line.order:
            continue
        last = int(most / line.order + 1e-9)
        for k in range(1, (last if line.sort == MESH else min(last, harmonics)) + 1):
            label = line.name if k == 1 else f"{k} × {line.name}"
            yield NamedOrder(k * line.order, label, line.sort)
            if line.sort != MESH:
                continue
            for modulating in slow:
                for n in (*range(-sidebands, 0), *range(1, sidebands + 1)):
                    order = k * line.order + n * modulating.order
                    if 0.0 < order <= most:
                        times = "" if abs(n) == 1 else f"{abs(n)} "
                        sign = "−" if n < 0 else "+"
                        yield NamedOrder(order, f"{label} {sign} {times}{modulating.name}", "sideband")


def names_at(order: float, candidates: Sequence[NamedOrder], within: float) -> list[NamedOrder]:
    """What an order may be, the nearest first; meshes before others that are as near."""
    near = [one for one in candidates if abs(one.order - order) <= within]
    return sorted(
        near,
        key=lambda one: (
            round(abs(one.order - order) / within, 1),
            SORTS.index(one.sort) if one.sort in SORTS else len(SORTS),
            len(one.label),
        ),
    )
