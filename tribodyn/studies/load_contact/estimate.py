"""What a load contact study takes, before any work."""

from tribodyn.studies.gears.estimate import (
    FINITE_ELEMENTS,
    OUTLINES,
    TOUCHING,
    pressed_memory,
    pressed_seconds,
)
from tribodyn.studies.load_contact.case import LoadContactCase
from tribodyn.studies.load_contact.layout import LAYOUT, OILED
from tribodyn.studies.protocol.estimate import PROGRAM, Driver, Estimate, record_bytes

#: How often what is recorded is held at once.
HELD = 4.0


def estimate(case: LoadContactCase) -> Estimate:
    """What a run of a case takes."""
    positions = case.positions_per_cycle * case.cycles
    sizes = {"phase": positions, "pair": TOUCHING, "slice": case.mesh.slices, "body": 2}
    if case.gear_torques:
        sizes["torque"] = len(case.gear_torques)
    record = record_bytes(OILED if case.lubricated else LAYOUT, sizes) + OUTLINES
    seconds = pressed_seconds(float(positions) * (1 + len(case.gear_torques)), case.mesh.slices)
    return Estimate(
        PROGRAM + HELD * record + pressed_memory(positions, case.mesh.slices),
        record,
        seconds,
        (
            Driver("output.positions_per_cycle", case.positions_per_cycle, 60),
            Driver("output.cycles", case.cycles, 1),
            Driver("mesh.slices", case.mesh.slices, 21),
            Driver("operating.gear_torques", 1 + len(case.gear_torques), 10),
        ),
        FINITE_ELEMENTS,
    )
