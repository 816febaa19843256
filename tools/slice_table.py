"""Slices that hold each other compared with slices that do not, on the pair 18/36 at 318.3 N m.

python -m tools.slice_table                               # prints the table
python -m tools.slice_table --into docs/load-contact.md   # and puts it into the page
"""

import numpy as np

from tools.marked_block import generate, table
from tribodyn.compliance.sharing.load_sharing import LoadedFlanks, flexibility
from tribodyn.compliance.sharing.loaded_contact import LoadedContact, roll_through
from tribodyn.compliance.sharing.slices import PairFlexibility
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.families import family
from tribodyn.geometry.modification import FlankModification, LeadRelief, Misalignment, Modifications
from tribodyn.studies.protocol.load import load_scenario

SLICES, POSITIONS = 21, 60
HEAD = (
    "",
    "K_Hβ at the pitch point",
    "maximum pressure there, GPa",
    "pinion's root, maximum tension, MPa",
    "mean mesh stiffness, N/(mm µm)",
    "loaded error, peak to peak, µm",
)
CASES = {
    "unmodified": Modifications(),
    **{
        f"axes in the plane of action {tilt * 1e3:g} mrad": Modifications(misalignment=Misalignment(tilt))
        for tilt in (2.5e-4, 5e-4, 1e-3, 2e-3)
    },
    **{
        f"crowned by {crown * 1e6:g} µm": Modifications(FlankModification(lead=LeadRelief(crown, crown)))
        for crown in (5e-6, 10e-6, 20e-6)
    },
    "crowned by 10 µm, axes 1 mrad": Modifications(
        FlankModification(lead=LeadRelief(10e-6, 10e-6)), misalignment=Misalignment(1e-3)
    ),
}


def figures(
    flexible: PairFlexibility, modifications: Modifications, torque: float, coupled: bool
) -> list[str]:
    loaded: LoadedContact = roll_through(
        LoadedFlanks(flexible, modifications, SLICES, coupled), torque, POSITIONS
    )
    at = np.unravel_index(np.argmin(np.abs(loaded.roll)), loaded.roll.shape)
    return [
        f"{loaded.face_load_factor[at]:.2f}",
        f"{np.max(loaded.pressure[at]) / 1e9:.2f}",
        f"{np.max(loaded.root_tension[0]) / 1e6:.0f}",
        f"{np.mean(loaded.mesh_stiffness) / flexible.width * 1e-9:.1f}",
        f"{loaded.peak_to_peak * 1e6:.2f}",
    ]


def coupled_and_free(_: object) -> str:
    case = load_scenario("involute-18-36-fem").pair
    flexible = flexibility(assemble(family(case.family), case.drive), case.materials, lead=True, held=True)
    rows = []
    for name, modifications in CASES.items():
        both = (figures(flexible, modifications, case.operating.gear_torque, way) for way in (True, False))
        rows.append([name, *map(", ".join, zip(*both, strict=True))])
    return table(HEAD, rows)


if __name__ == "__main__":
    generate(__doc__, slices=coupled_and_free)
