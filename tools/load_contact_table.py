"""The energy method compared with the load contact model, over the shipped drives.

python -m tools.load_contact_table                               # prints the table
python -m tools.load_contact_table --into docs/load-contact.md   # and puts it into the page
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from tools.marked_block import generate, table
from tribodyn.compliance.sharing.load_sharing import flexibility
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.families import family
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.quasi_static import cycle_mean, quasi_static
from tribodyn.mesh.table import MeshData
from tribodyn.mesh.tabulate import pair_slots, tabulate
from tribodyn.mesh.tabulate_loaded import tabulate_loaded
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.validation.papers.diez_ibarbia_study import load_contact

DRIVES = (
    "diez-ibarbia-18-36",
    "liu-ni-involute-23-47",
    "liu-ni-crc-23-47",
    "cycloidal-23-47",
    "parabolic-23-47",
    "circular-arc-23-47",
    "s-gear-23-47",
    "jia-involute-17-29",
    "jia-parabolic-17-29",
    "involute-35-70-high-contact-ratio",
)
LINE_LOAD = 200e3  # N/m on a single pair, at the pitch point
MESH = MeshData("energy", 0.05, body="held")


class Deflections(NamedTuple):
    """Mean and peak to peak of the deflection on the pitch circles, m, and the load's share over roll."""

    mean: float
    swing: float
    roll: np.ndarray
    share: np.ndarray


def deflections(cycle: MeshCycle, torque: float) -> Deflections:
    state = quasi_static(cycle, torque)
    pairs = cycle.front_pairs
    position = cycle.phase[..., None] + np.arange(pairs - 1.0, -1.0, -1.0)
    roll = cycle.roll_start + cycle.pitch_angle * position
    inside = (np.broadcast_to(cycle.in_contact[:, None, :], roll.shape) > 0).ravel()
    share = state.normal_load * cycle.gear_pitch_radius / torque
    order = np.argsort(roll.ravel()[inside], kind="stable")
    deflection = state.deflection
    return Deflections(
        float(cycle_mean(cycle, deflection)),
        float(np.ptp(deflection)),
        roll.ravel()[inside][order],
        share.ravel()[inside][order],
    )


def row(name: str) -> list[str]:
    case = load_scenario("involute-18-36", {"drive": name}).pair
    teeth, drive = family(case.family), case.drive
    assembly = assemble(teeth, drive)
    arm = float(assembly.path.gear_pitch_radius * np.cos(assembly.path.pressure_angle(0.0)))
    torque = LINE_LOAD * min(drive.pinion.face_width, drive.gear.face_width) * arm
    elements = deflections(tabulate_loaded(assembly, case.materials, MESH, torque), torque)
    ratio = load_contact(flexibility(assembly, case.materials, held=True), torque, 0.0).contact_ratio
    cells = [
        name,
        f"{assembly.contact_ratio:.3f}, {ratio:.3f}",
        f"{elements.mean * 1e6:.1f}, {elements.swing * 1e6:.1f}",
    ]
    for hertz in ("linear", "load-dependent"):
        mesh = replace(MESH, hertz=hertz)
        energy = deflections(tabulate(assembly, case.materials, mesh, pair_slots(assembly)), torque)
        at = np.linspace(elements.roll[0], elements.roll[-1], 2001)
        shares = [np.interp(at, x.roll, x.share, left=0.0, right=0.0) for x in (elements, energy)]
        inside = (at > energy.roll[0]) & (at < energy.roll[-1])
        off = float(np.sqrt(np.mean((shares[1] - shares[0])[inside] ** 2)))
        cells.append(f"{100 * (elements.mean / energy.mean - 1):+.0f}")
        cells.append(f"{100 * (energy.swing / elements.swing - 1):+.0f}")
        cells.append(f"{100 * off:.0f}")
    return cells


def differences(_: object) -> str:
    head = ["drive", "contact ratio: path, effective", "deflection: mean, peak to peak, µm"]
    for contact in ("linear", "load-dependent"):
        head += [f"{contact} contact: stiffness, %", "swing, %", "share, %"]
    return table(head, [row(drive) for drive in DRIVES], "lllrrrrrr")


if __name__ == "__main__":
    generate(__doc__, energy=differences)
