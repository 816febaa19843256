"""Stiffness of the 18/36 pair at its pitch point, part by part, compared with ISO 6336 and the FE reference.

python -m tools.stiffness_table                              # prints the tables
python -m tools.stiffness_table --into docs/mesh-stiffness.md

Nothing here is tuned to the references; the last column shows what each choice is worth.
"""

import math
from itertools import product

import numpy as np

from tools.marked_block import generate, table
from tribodyn.compliance.energy import (
    LoadedTooth,
    hertz_coefficient,
    hertz_linear,
    loaded_tooth,
    polynomials_over_ring,
    tooth_compliance,
)
from tribodyn.compliance.foundation import Foundation
from tribodyn.compliance.iso6336 import MEASURED_CORRECTION, theoretical_stiffness
from tribodyn.compliance.sharing.load_sharing import LoadedFlanks, flexibility
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.drive import SIDES, Drive, GearBody, MaterialData
from tribodyn.geometry.families import Family, crc, involute
from tribodyn.geometry.path import kinematics
from tribodyn.geometry.tooth import contact_in_tooth_frame
from tribodyn.mesh.quasi_static import cycle_mean, quasi_static
from tribodyn.mesh.table import MeshData
from tribodyn.mesh.tabulate import pair_slots, tabulate

WIDTH, LINE_LOAD = 0.0267, 235e3  # m, N/m
STEEL = MaterialData("steel", 207e9, 0.3, 7850.0, 46.0, 470.0, 6e9)
FE_REFERENCE = 13.8  # plane strain, full rings, generated fillets, Weber-Banaschek contact, at 235 N/mm
PICO = 1e12
#: Compliance of the contact, m/N, load-dependent as the secant at LINE_LOAD.
CONTACTS = {
    "linear": hertz_linear(STEEL, STEEL, WIDTH),
    "load-dependent": hertz_coefficient(STEEL, STEEL, WIDTH) * (LINE_LOAD * WIDTH) ** -0.1,
}


def drive(pressure_angle: float, teeth: tuple[int, int], bores: tuple[float, float], width: float) -> Drive:
    """Pair of module 3 mm, standard rack, fillet radius 0.25 modules."""
    pinion, gear = (
        GearBody(float(z), 0.0, 1.0, 1.25, 0.25, width, bore) for z, bore in zip(teeth, bores, strict=True)
    )
    return Drive(0.003, math.radians(pressure_angle), pinion, gear)


def weber_banaschek(tooth: LoadedTooth, relative_curvature: float) -> float:
    """Approach of the contact to the tooth's axis per line load, m²/N (secant at LINE_LOAD, plane strain)."""
    contact = contact_in_tooth_frame(tooth.path, tooth.pitch_half_angle, np.zeros(1))
    depth = contact.y[0] / math.cos(contact.load_angle[0])
    flexibility = (1 - STEEL.poisson_ratio**2) / STEEL.youngs_modulus
    half_width = math.sqrt(4 / math.pi * 2 * flexibility / relative_curvature * LINE_LOAD)
    ratio, nu = depth / half_width, STEEL.poisson_ratio
    near = math.asinh(ratio) - nu / (1 - nu) * ratio**2 * (math.sqrt(1 + ratio**-2) - 1)
    return 2 * flexibility / math.pi * near


def breakdown(_: object) -> str:
    pair = drive(20.0, (18, 36), (0.012, 0.025), WIDTH)
    assembly = assemble(involute.FAMILY, pair)
    path = assembly.path
    teeth = [loaded_tooth(assembly, side, held=True) for side in SIDES]
    parts, on_ring = (
        [tooth_compliance(tooth, STEEL, WIDTH, np.zeros(1), body) for tooth in teeth]
        for body in ("sainsot-velex", "ring")
    )
    rows = []
    for name in ("bending", "shear", "axial", "foundation"):
        both = [getattr(part, name)[0] * WIDTH * PICO for part in parts]
        rows.append([name, *(f"{value:.1f}" for value in (*both, sum(both)))])
    exact = [float(part.foundation[0]) * WIDTH * PICO for part in on_ring]
    rows.append(["*foundation by the exact ring*", *(f"{value:.1f}" for value in (*exact, sum(exact)))])
    linear, palmgren = (compliance * WIDTH * PICO for compliance in CONTACTS.values())
    curvature = float(kinematics(path, np.zeros(1)).relative_curvature[0])
    weber = sum(weber_banaschek(tooth, curvature) for tooth in teeth) * PICO
    rows += [
        ["Hertz contact, linear", "", "", f"{linear:.1f}"],
        ["*Hertz contact, load-dependent, secant at 235 N/mm*", "", "", f"{palmgren:.1f}"],
        ["*Weber & Banaschek's contact, secant at 235 N/mm*", "", "", f"{weber:.1f}"],
    ]
    beam = sum(float((p.bending + p.shear + p.axial)[0]) for p in parts) * WIDTH * PICO
    body = sum(float(p.foundation[0]) for p in parts) * WIDTH * PICO
    strain = 1 - STEEL.poisson_ratio**2
    iso = theoretical_stiffness((18.0, 36.0))
    stiffness = [
        ('energy method, linear Hertz (`hertz = "linear"`)', 1e3 / (beam + body + linear)),
        (
            'energy method, load-dependent Hertz at 235 N/mm (`hertz = "load-dependent"`)',
            1e3 / (beam + body + palmgren),
        ),
        ("the same with the exact ring for the bodies", 1e3 / (beam + sum(exact) + palmgren)),
        ("exact ring, Weber & Banaschek's contact", 1e3 / (beam + sum(exact) + weber)),
        (
            "the same, teeth and bodies in plane strain (× 1 − ν²)",
            1e3 / (strain * (beam + sum(exact)) + weber),
        ),
        ("FE reference at 235 N/mm", FE_REFERENCE),
        ("ISO 6336-1 c'_th, theory", iso / 1e9),
        ("ISO 6336-1 c'_th times 0.8, the correction from measurements", MEASURED_CORRECTION * iso / 1e9),
    ]
    parts_of_both = table(["part, nm per N/mm", "pinion", "gear", "both"], rows)
    head = "single-pair stiffness at the pitch point", "N/(mm µm)"
    return f"{parts_of_both}\n\n{table(head, [(name, f'{value:.1f}') for name, value in stiffness])}"


def equal_pair(teeth: int, ratio: float) -> Drive:
    """Pair of equal gears whose root radius is `ratio` times their bore's."""
    bore = 0.003 * (teeth / 2 - 1.25) / ratio
    return drive(20.0, (teeth, teeth), (bore, bore), WIDTH)


def rims(_: object) -> str:
    bodies: tuple[Foundation, ...] = ("sainsot-velex", "ring")
    columns = list(product(CONTACTS, bodies))
    head = ["teeth", "root over bore radius", "rim, modules", "body, polynomials over ring"]
    head += ["finite elements, N/(mm µm)", *(f"`{body}`, `{contact}`" for contact, body in columns)]
    rows = []
    for teeth, ratio in product((20, 30, 50, 90), (1.06, 1.15, 1.4, 2.1, 5.0)):
        assembly = assemble(involute.FAMILY, equal_pair(teeth, ratio))
        tooth = loaded_tooth(assembly, "pinion", held=True)
        cosine = math.cos(float(assembly.path.pressure_angle(0.0)))
        torque = LINE_LOAD * WIDTH * cosine * float(assembly.path.gear_pitch_radius)
        flexible = flexibility(assembly, (STEEL, STEEL), held=True)
        loaded = LoadedFlanks(flexible).share(np.zeros((1, 1)), torque)
        elements = LINE_LOAD / (float(loaded.deflection[0]) * cosine)
        rim = teeth / 2 - 1.25 - float(tooth.body.bore_radius) / 0.003
        row = [teeth, ratio, f"{rim:.1f}", f"{polynomials_over_ring(tooth, STEEL):.2f}"]
        row.append(f"{elements / 1e9:.1f}")
        for contact, body in columns:
            compliance = 2 * tooth_compliance(tooth, STEEL, WIDTH, np.zeros(1), body).total[0]
            stiffness = 1 / ((compliance + CONTACTS[contact]) * WIDTH)
            row.append(f"{100 * (stiffness / elements - 1):+.0f} %")
        rows.append(row)
    return table(head, rows)


def coupling(_: object) -> str:
    head = (
        "drive at 500 N·m",
        "single pair at its stiffest, N/(mm µm)",
        "C01/√(C00 C11) in double contact",
        "mean deflection without, with coupling, µm",
    )
    rows = []
    cases: list[tuple[str, Family, float]] = [
        ("CRC 23/47", crc.FAMILY, 22.81),
        ("involute 23/47", involute.FAMILY, 20.0),
    ]
    for name, family, angle in cases:
        pair = drive(angle, (23, 47), (0.015, 0.025), 0.02)
        assembly = assemble(family, pair)
        slots = pair_slots(assembly)
        cycles = [
            tabulate(assembly, (STEEL, STEEL), mesh, slots)
            for mesh in (
                MeshData("energy", 0.05, foundation_coupling=on, body="held") for on in (False, True)
            )
        ]
        c = cycles[1]
        ratio = c.coupling[0, :, 0, 1] / np.sqrt(c.compliance[0, :, 0] * c.compliance[0, :, 1])
        means = [float(cycle_mean(x, quasi_static(x, 500.0).deflection)) * 1e6 for x in cycles]
        peak = 1 / c.compliance.min() / 0.02 / 1e9
        span = f"{ratio.min():.2f} … {ratio.max():.2f}"
        rows.append([name, f"{peak:.1f}", span, f"{means[0]:.1f}, {means[1]:.1f}"])
    return table(head, rows)


if __name__ == "__main__":
    generate(__doc__, breakdown=breakdown, rims=rims, coupling=coupling)
