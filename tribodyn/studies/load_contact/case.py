"""A case of the static load contact study: everything one run needs to know, in SI units."""

from dataclasses import dataclass

from tribodyn.studies.gears.case import GearCase, LubricatedCase
from tribodyn.studies.load_contact.layout import LAYOUT, OILED
from tribodyn.studies.protocol.cost import FINITE_ELEMENTS, TOUCHING, load_sharing, recorded, total
from tribodyn.studies.protocol.estimate import Driver, Estimate


@dataclass(frozen=True, kw_only=True)
class LoadContactCase(GearCase):
    """One study of teeth in slow rotation under load, complete."""

    #: torques of the Harris map, > 0 and increasing, N m; empty: none is made
    gear_torques: tuple[float, ...] = ()
    friction_coefficient: float = 0.0  # μ of all pairs, ≥ 0
    positions_per_cycle: int = 60  # positions of the pinion in one mesh cycle
    cycles: int = 1  # mesh cycles to roll through; more than one where teeth differ
    #: the same gears with oil, at a speed > 0, for the film over the face; None: there is no lubricant
    lubricated: LubricatedCase | None = None


def estimate(case: LoadContactCase) -> Estimate:
    """What a run of a case takes."""
    positions, slices, torques = (
        case.positions_per_cycle * case.cycles,
        case.mesh.slices,
        len(case.gear_torques),
    )
    sizes = {"phase": positions, "pair": TOUCHING, "slice": slices, "body": 2}
    if torques:
        sizes["torque"] = torques
    return total(
        (
            Driver("output.positions_per_cycle", case.positions_per_cycle, 60),
            Driver("output.cycles", case.cycles, 1),
            Driver("mesh.slices", slices, 21),
            Driver("operating.gear_torques", 1 + torques, 10),
        ),
        recorded(OILED if case.lubricated else LAYOUT, sizes, copies=4.0, outlines=True),
        load_sharing(float(positions) * (1 + torques), slices, positions),
        FINITE_ELEMENTS,
    )
