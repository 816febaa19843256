"""What every published number of Liu & Ni (2022) depends on: one change at a time, as a Markdown table.

python -m tools.sensitivity                                  # prints the table
python -m tools.sensitivity --into docs/validation.md        # and puts it into the page
python -m tools.sensitivity --only "friction law"            # one group

Each row is three runs: both drives with friction, and the CRC drive without. Nothing is tuned here: the table
shows what choices that the paper leaves open, or printed differently, would do to the comparison.
"""

import argparse
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

import numpy as np

from tools.marked_block import generate, parser_of, table
from tribodyn.record.reader import Record
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run
from tribodyn.validation.published import published

CRC, INVOLUTE, DRY = "crc-23-47", "involute-23-47", "crc-23-47-frictionless"

#: Enough: at 10 rad/s the start has died out within one mesh cycle; the values are those of the last one.
CYCLES = 4
#: At 10 rad/s the mesh vibrates some fifty times per mesh cycle: means need more than the 200 samples of
#: the shipped scenarios, four per period.
SAMPLES = 2000


class Variant(NamedTuple):
    """One changed choice."""

    label: str
    settings: dict[str, Any]  # overrides, for all three scenarios
    stiffness: float | None = None  # factor on the baseline's single-pair stiffness, given as a table


def bearings(stiffness: str) -> dict[str, Any]:
    return {f"bearings.{gear}.stiffness_{axis}": stiffness for gear in ("pinion", "gear") for axis in "xy"}


def both(key: str, value: Any) -> dict[str, Any]:
    return {f"drive.{gear}.{key}": value for gear in ("pinion", "gear")}


def bores(pinion: str, gear: str) -> dict[str, Any]:
    return {"drive.pinion.bore_radius": pinion, "drive.gear.bore_radius": gear}


LAW = "friction.law"
#: Group -> what is changed.
VARIANTS: dict[str, list[Variant]] = {
    "friction law": [
        Variant("limiting shear from the whole mean pressure", {LAW: "masjedi-khonsari-mean-pressure"}),
        Variant("as printed: 447, Péclet without ρ c", {LAW: "masjedi-khonsari-as-printed"}),
        Variant("Coulomb, μ = 0.1", {LAW: "coulomb", "friction.coefficient": 0.1}),
    ],
    "lubricant and surfaces": [
        Variant("f_c = 0.13 instead of 0.11", {"lubricant.asperity_friction": 0.13}),
        Variant("f_c = 0.09", {"lubricant.asperity_friction": 0.09}),
        Variant("Λ_lim = 0.1 instead of 0.091", {"lubricant.limiting_shear_coefficient": 0.1}),
        Variant("σ = 0.42 µm: 0.3 µm on each flank", {"drive.roughness": "0.424 um"}),
        Variant("specific heat × 2", {"drive.material.specific_heat": "868 J/(kg*K)"}),
        Variant("no heating: K_T = 0", {"lubricant.temperature_viscosity": "0 1/K"}),
    ],
    "bearings": [
        Variant("1e8 N/m", bearings("1e8 N/m")),
        Variant("3e8 N/m", bearings("3e8 N/m")),
        Variant("1e10 N/m", bearings("1e10 N/m")),
    ],
    "tooth stiffness": [
        Variant("Hertz contact load-dependent", {"mesh.hertz": "load-dependent"}),
        Variant("pairs do not share the gear bodies", {"mesh.foundation_coupling": False}),
        Variant("not shared, all × 0.7", {}, 0.7),
        Variant("not shared, all × 1.3", {}, 1.3),
        Variant("constant, 3e8 N/m", {"mesh.compliance": "constant", "mesh.stiffness": "3e8 N/m"}),
        Variant("bores 10/15 mm instead of 15/25", bores("10 mm", "15 mm")),
        Variant("bores 20/40 mm", bores("20 mm", "40 mm")),
        Variant("fillet radius 0.1 m instead of 0.25", both("fillet_radius", 0.1)),
        Variant("fillet radius 0.3 m", both("fillet_radius", 0.3)),
    ],
    "damping": [
        Variant("mesh damping ratio 0.01 instead of 0.05", {"mesh.damping_ratio": 0.01}),
        Variant("mesh damping ratio 0.1", {"mesh.damping_ratio": 0.1}),
    ],
    "speed": [
        Variant("5 rad/s", {"operating.pinion_speed": "5 rad/s"}),
        Variant("20 rad/s", {"operating.pinion_speed": "20 rad/s"}),
        Variant("100 rad/s", {"operating.pinion_speed": "100 rad/s"}),
    ],
    "formulation": [
        Variant("sliding of the vibrating bodies", {"friction.sliding": "dynamic"}),
        Variant("energy-consistent", {"mesh.formulation": "energy-consistent"}),
    ],
    "numerics": [
        Variant("reversal width 5 µm instead of 20", {"friction.reversal_width": "5 um"}),
        Variant("reversal width 80 µm", {"friction.reversal_width": "80 um"}),
        Variant("contact width 0.02 µm instead of 0.1", {"mesh.contact_width": "0.02 um"}),
        Variant("contact width 0.5 µm", {"mesh.contact_width": "0.5 um"}),
        Variant("rtol = 1e-8 instead of 1e-6", {"solver.rtol": 1e-8}),
        Variant("200 samples per cycle instead of 2000", {"output.samples_per_cycle": 200}),
    ],
}

#: Heading of a column, the row of the paper that it belongs to (if any), and how it is written.
COLUMNS = (
    ("ε CRC", "contact-ratio-crc", ".3f"),
    ("ε inv.", "contact-ratio-involute", ".3f"),
    ("F_n single, N", "load-stcp-6dof", ".0f"),
    ("F_f 1 CRC, N", "friction-pair1-crc", ".0f"),
    ("F_f 0 CRC, N", "friction-pair0-crc", ".0f"),
    ("F_f 1 inv., N", "friction-pair1-involute", ".0f"),
    ("F_f 0 inv., N", "friction-pair0-involute", ".0f"),
    ("η CRC", "efficiency-crc", ".4f"),
    ("η inv.", "efficiency-involute", ".4f"),
    ("loss inv./CRC", None, ".2f"),
    ("DTE CRC − inv., µm", None, "+.2f"),
)


def stiffness_table(record: Record, factor: float) -> dict[str, Any]:
    """Single-pair stiffness over roll angle as a scenario writes it, from a record's mesh cycle."""
    table = record.mesh_cycle
    pitch = 2 * np.pi / table["pinion_teeth"]
    fronts = int(np.sum(table["side"] > 0))
    rolls, values = [], []
    for slot in range(fronts):
        inside = table["in_contact"][:, slot] > 0
        rolls.append(table["roll_start"] + (table["phase"][inside] + fronts - 1 - slot) * pitch)
        values.append(factor / table["compliance"][inside, slot])
    # where one slot takes over from another the angle stands twice
    roll, index = np.unique(np.round(np.concatenate(rolls), 9), return_index=True)
    stiffness = np.concatenate(values)[index]
    return {
        "roll_angle": {"unit": "rad", "values": roll.tolist()},
        "stiffness": {"unit": "N/m", "values": stiffness.tolist()},
    }


def load_in_single_contact(record: Record) -> float:
    """Mean load over the samples of the last cycle at which one pair carries alone, N."""
    samples = record.scenario["output"]["samples_per_cycle"]
    load = record["normal_load"][-samples - 1 : -1]
    return float(np.mean(np.sum(load, axis=1)[np.sum(load > 0, axis=1) == 1]))


def results(folder: Path, settings: dict[str, dict[str, Any]]) -> list[float]:
    """Run the three scenarios, each with its settings, and return the columns' values."""
    friction, efficiency, ratio, error = {}, {}, {}, {}
    load = np.nan
    for name in (CRC, INVOLUTE, DRY):
        case = load_scenario(
            name, {"solver.cycles": CYCLES, "output.samples_per_cycle": SAMPLES, **settings[name]}
        )
        result = run(case, folder / f"{name}.h5", force=True)
        if result.status != "complete":
            raise SystemExit(f"{name}: {result.message}")
        with Record(result.path) as record:
            if name == DRY:
                load = load_in_single_contact(record)
                continue
            summary = record.summary
            friction[name] = [summary["friction_force_mean"][record.pairs.index(pair)] for pair in (1, 0)]
            efficiency[name], ratio[name] = summary["efficiency"], summary["contact_ratio"]
            error[name] = summary["transmission_error_normal_mean"]
    loss = (1 - efficiency[INVOLUTE]) / (1 - efficiency[CRC])
    return [
        ratio[CRC],
        ratio[INVOLUTE],
        load,
        *friction[CRC],
        *friction[INVOLUTE],
        efficiency[CRC],
        efficiency[INVOLUTE],
        loss,
        (error[CRC] - error[INVOLUTE]) * 1e6,
    ]


def written(values: list[float]) -> list[str]:
    return [format(value, code) for value, (_, _, code) in zip(values, COLUMNS, strict=True)]


def published_row() -> list[str]:
    rows = published("liu-ni-2022")
    cells = [format(rows[f"liu-ni/{key}"]["published"], code) if key else "" for _, key, code in COLUMNS]
    inverse = [1 - rows[f"liu-ni/efficiency-{drive}"]["published"] for drive in ("involute", "crc")]
    cells[-2:] = [f"{inverse[0] / inverse[1]:.2f}", "> 0"]
    return cells


def settings_of(variant: Variant, tables: dict[str, dict[str, Any]]) -> dict[str, dict[str, Any]]:
    """Overrides for each scenario; a scaled stiffness goes in as a table, dry flanks stay dry."""
    settings = {name: dict(variant.settings) for name in (CRC, INVOLUTE, DRY)}
    for key in ("friction.law", "friction.coefficient"):
        settings[DRY].pop(key, None)
    if variant.stiffness is not None:
        for name in settings:
            table = tables[name]
            scaled = [value * variant.stiffness for value in table["stiffness"]["values"]]
            settings[name]["mesh.compliance"] = "table"
            settings[name]["mesh.table"] = {**table, "stiffness": {"unit": "N/m", "values": scaled}}
    return settings


def sensitivity(given: argparse.Namespace) -> str:
    """Run everything and return the table."""
    rows = [["**published**", *published_row()]]
    with TemporaryDirectory(prefix="tribodyn-") as name:
        folder = Path(name)
        rows.append(["**ours**", *written(results(folder, {name: {} for name in (CRC, INVOLUTE, DRY)}))])
        tables = {}
        for scenario in (CRC, INVOLUTE, DRY):
            with Record(folder / f"{scenario}.h5") as record:
                tables[scenario] = stiffness_table(record, 1.0)
        for group in [given.only] if given.only else VARIANTS:
            rows.append([f"*{group}*", *[""] * len(COLUMNS)])
            for variant in VARIANTS[group]:
                print(f"{group}: {variant.label}", file=sys.stderr)
                rows.append([variant.label, *written(results(folder, settings_of(variant, tables)))])
    head = ["what is changed", *(heading for heading, _, _ in COLUMNS)]
    return table(head, rows, "l" + "r" * len(COLUMNS))


if __name__ == "__main__":
    parser = parser_of(__doc__)
    parser.add_argument("--only", choices=sorted(VARIANTS))
    generate(__doc__, parser=parser, sensitivity=sensitivity)
