"""Stiffness of the 18/36 pair at its pitch point, part by part, compared with ISO 6336 and the FE reference.

    python tools/stiffness_table.py                              # prints the tables
    python tools/stiffness_table.py --into docs/mesh-stiffness.md

Nothing here is tuned to the references; the last column shows what each choice is worth.
"""

import argparse
import math
from pathlib import Path

import numpy as np
from marked_block import put

from tribodyn.compliance.energy import (
    LoadedTooth,
    ToothCompliance,
    hertz_coefficient,
    hertz_linear,
    loaded_tooth,
    tooth_compliance,
)
from tribodyn.compliance.foundation import ring_compliance
from tribodyn.compliance.iso6336 import single_pair_stiffness
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.drive import SIDES, Drive, GearBody
from tribodyn.geometry.families import crc, involute
from tribodyn.geometry.family import Family
from tribodyn.geometry.material import MaterialData
from tribodyn.geometry.path import kinematics
from tribodyn.geometry.tooth import contact_in_tooth_frame
from tribodyn.mesh.data import MeshData
from tribodyn.mesh.quasi_static import cycle_mean, quasi_static
from tribodyn.mesh.tabulate import pair_slots, tabulate

WIDTH, LINE_LOAD = 0.0267, 235e3  # m, N/m
STEEL = MaterialData("steel", 207e9, 0.3, 7850.0, 46.0, 470.0, 6e9)
FE_REFERENCE = 13.8  # plane strain, full rings, generated fillets, Weber-Banaschek contact, at 235 N/mm
PICO = 1e12


def drive(pressure_angle: float, teeth: tuple[int, int], bores: tuple[float, float], width: float) -> Drive:
    """Pair of module 3 mm, standard rack, fillet radius 0.25 modules."""
    pinion, gear = (
        GearBody(float(z), 0.0, 1.0, 1.25, 0.25, width, bore) for z, bore in zip(teeth, bores, strict=True)
    )
    return Drive(0.003, math.radians(pressure_angle), pinion, gear)


def ring_foundation(tooth: LoadedTooth, part: ToothCompliance) -> float:
    """Foundation of a tooth by the exact ring in place of Sainsot & Velex's polynomials, times width."""
    ratio = tooth.tooth.root_radius / tooth.body.bore_radius
    ring = ring_compliance(0.0, tooth.root_half_angle, ratio, 0.3, harmonics=2000) / STEEL.youngs_modulus
    return float(part.root_load[0] @ ring @ part.root_load[0])


def weber_banaschek(tooth: LoadedTooth, relative_curvature: float) -> float:
    """Approach of the contact to the tooth's axis per line load, m²/N (secant at LINE_LOAD, plane strain)."""
    contact = contact_in_tooth_frame(tooth.path, tooth.pitch_half_angle, np.zeros(1))
    depth = contact.y[0] / math.cos(contact.load_angle[0])
    flexibility = (1 - STEEL.poisson_ratio**2) / STEEL.youngs_modulus
    half_width = math.sqrt(4 / math.pi * 2 * flexibility / relative_curvature * LINE_LOAD)
    ratio, nu = depth / half_width, STEEL.poisson_ratio
    near = math.asinh(ratio) - nu / (1 - nu) * ratio**2 * (math.sqrt(1 + ratio**-2) - 1)
    return 2 * flexibility / math.pi * near


def breakdown() -> str:
    pair = drive(20.0, (18, 36), (0.012, 0.025), WIDTH)
    assembly = assemble(involute.FAMILY, pair)
    path = assembly.path
    teeth = [loaded_tooth(assembly, side) for side in SIDES]
    parts = [tooth_compliance(tooth, STEEL, WIDTH, np.zeros(1)) for tooth in teeth]
    rows = ["| part, nm per N/mm | pinion | gear | both |", "|---|---|---|---|"]
    for name in ("bending", "shear", "axial", "foundation"):
        both = [getattr(part, name)[0] * WIDTH * PICO for part in parts]
        rows.append(f"| {name} | {both[0]:.1f} | {both[1]:.1f} | {sum(both):.1f} |")
    exact = [ring_foundation(*pairing) * PICO for pairing in zip(teeth, parts, strict=True)]
    rows.append(f"| *foundation by the exact ring* | {exact[0]:.1f} | {exact[1]:.1f} | {sum(exact):.1f} |")
    linear = hertz_linear(STEEL, STEEL, WIDTH) * WIDTH * PICO
    palmgren = hertz_coefficient(STEEL, STEEL, WIDTH) * (LINE_LOAD * WIDTH) ** -0.1 * WIDTH * PICO
    curvature = float(kinematics(path, np.zeros(1)).relative_curvature[0])
    weber = sum(weber_banaschek(tooth, curvature) for tooth in teeth) * PICO
    rows += [
        f"| Hertz contact, linear | | | {linear:.1f} |",
        f"| *Hertz contact, load-dependent, secant at 235 N/mm* | | | {palmgren:.1f} |",
        f"| *Weber & Banaschek's contact, secant at 235 N/mm* | | | {weber:.1f} |",
    ]
    beam = sum(float((p.bending + p.shear + p.axial)[0]) for p in parts) * WIDTH * PICO
    body = sum(float(p.foundation[0]) for p in parts) * WIDTH * PICO
    strain = 1 - STEEL.poisson_ratio**2
    iso = single_pair_stiffness(18.0, 36.0)
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
        ("ISO 6336 c'_th, theory", float(iso.theoretical) / 1e9),
        ("ISO 6336 c' = 0.8 c'_th, with the correction from measurements", float(iso.single_pair) / 1e9),
    ]
    rows += ["", "| single-pair stiffness at the pitch point | N/(mm µm) |", "|---|---|"]
    rows += [f"| {name} | {value:.1f} |" for name, value in stiffness]
    return "\n".join(rows)


def coupling() -> str:
    rows = [
        "| drive at 500 N·m | single pair at its stiffest, N/(mm µm) | C01/√(C00 C11) in double contact | "
        "mean deflection without, with coupling, µm |",
        "|---|---|---|---|",
    ]
    cases: list[tuple[str, Family, float]] = [
        ("CRC 23/47", crc.FAMILY, 22.81),
        ("involute 23/47", involute.FAMILY, 20.0),
    ]
    for name, family, angle in cases:
        pair = drive(angle, (23, 47), (0.015, 0.025), 0.02)
        assembly = assemble(family, pair)
        slots = pair_slots(assembly)
        cycles = [
            tabulate(assembly, (STEEL, STEEL), MeshData("energy", 0.05, foundation_coupling=on), slots)
            for on in (False, True)
        ]
        c = cycles[1]
        ratio = c.coupling[0, :, 0, 1] / np.sqrt(c.compliance[0, :, 0] * c.compliance[0, :, 1])
        means = [float(cycle_mean(x, quasi_static(x, 500.0).deflection)) * 1e6 for x in cycles]
        peak = 1 / c.compliance.min() / 0.02 / 1e9
        span = f"{ratio.min():.2f} … {ratio.max():.2f}"
        rows.append(f"| {name} | {peak:.1f} | {span} | {means[0]:.1f}, {means[1]:.1f} |")
    return "\n".join(rows)


def main() -> None:
    parser = argparse.ArgumentParser(description="Mesh stiffness compared with its references.")
    parser.add_argument("--into", type=Path, help="page with the marked blocks")
    page = parser.parse_args().into
    for name, text in (("breakdown", breakdown()), ("coupling", coupling())):
        print(text, end="\n\n")
        if page:
            put(page, name, text)


if __name__ == "__main__":
    main()
