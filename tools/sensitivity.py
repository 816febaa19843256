"""What every published figure of Liu & Ni (2022) depends on: one change at a time, as a Markdown table.

    python tools/sensitivity.py                                  # prints the table
    python tools/sensitivity.py --into docs/validation.md        # and puts it into the page
    python tools/sensitivity.py --only "friction law"            # one group

Each row is three runs: both drives with friction, and the CRC drive without. Nothing is tuned here: the table
shows what choices that the paper leaves open, or printed differently, would do to the comparison.
"""

import argparse
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

import numpy as np
from marked_block import put

from tribodyn.record.reader import Record, open_record
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run
from tribodyn.validation.rows import published

CRC, INVOLUTE, DRY = "crc-23-47", "involute-23-47", "crc-23-47-frictionless"

#: Enough: at 10 rad/s the start has died out within one mesh cycle; the figures are those of the last one.
CYCLES = 4
#: At 10 rad/s the mesh vibrates some fifty times per mesh cycle: means need more than the 200 samples of
#: the shipped scenarios, four per period.
SAMPLES = 2000


class Variant(NamedTuple):
    """One changed choice.

    Attributes
    ----------
    group, label : str
    settings : dict
        Overrides, for all three scenarios.
    stiffness : float or None
        Factor on the baseline's single-pair stiffness, given to the run as a table.
    """

    group: str
    label: str
    settings: dict[str, Any]
    stiffness: float | None = None


def bearings(stiffness: str) -> dict[str, Any]:
    return {f"bearings.{gear}.stiffness_{axis}": stiffness for gear in ("pinion", "gear") for axis in "xy"}


def both(key: str, value: Any) -> dict[str, Any]:
    return {f"drive.{gear}.{key}": value for gear in ("pinion", "gear")}


def bores(pinion: str, gear: str) -> dict[str, Any]:
    return {"drive.pinion.bore_radius": pinion, "drive.gear.bore_radius": gear}


LAW = "friction.law"
VARIANTS = (
    Variant(
        "friction law", "limiting shear from the whole mean pressure", {LAW: "masjedi-khonsari-mean-pressure"}
    ),
    Variant("friction law", "as printed: 447, Péclet without ρ c", {LAW: "masjedi-khonsari-as-printed"}),
    Variant("friction law", "Coulomb, μ = 0.1", {LAW: "coulomb", "friction.coefficient": 0.1}),
    Variant("lubricant and surfaces", "f_c = 0.13 instead of 0.11", {"lubricant.asperity_friction": 0.13}),
    Variant("lubricant and surfaces", "f_c = 0.09", {"lubricant.asperity_friction": 0.09}),
    Variant(
        "lubricant and surfaces",
        "Λ_lim = 0.1 instead of 0.091",
        {"lubricant.limiting_shear_coefficient": 0.1},
    ),
    Variant("lubricant and surfaces", "σ = 0.42 µm: 0.3 µm on each flank", {"drive.roughness": "0.424 um"}),
    Variant("lubricant and surfaces", "specific heat × 2", {"drive.material.specific_heat": "868 J/(kg*K)"}),
    Variant("lubricant and surfaces", "no heating: K_T = 0", {"lubricant.temperature_viscosity": "0 1/K"}),
    Variant("bearings", "1e8 N/m", bearings("1e8 N/m")),
    Variant("bearings", "3e8 N/m", bearings("3e8 N/m")),
    Variant("bearings", "1e10 N/m", bearings("1e10 N/m")),
    Variant("tooth stiffness", "Hertz contact load-dependent", {"mesh.hertz": "load-dependent"}),
    Variant("tooth stiffness", "pairs do not share the gear bodies", {"mesh.foundation_coupling": False}),
    Variant("tooth stiffness", "not shared, all × 0.7", {}, 0.7),
    Variant("tooth stiffness", "not shared, all × 1.3", {}, 1.3),
    Variant(
        "tooth stiffness", "constant, 3e8 N/m", {"mesh.compliance": "constant", "mesh.stiffness": "3e8 N/m"}
    ),
    Variant("tooth stiffness", "bores 10/15 mm instead of 15/25", bores("10 mm", "15 mm")),
    Variant("tooth stiffness", "bores 20/40 mm", bores("20 mm", "40 mm")),
    Variant("tooth stiffness", "fillet radius 0.1 m instead of 0.25", both("fillet_radius", 0.1)),
    Variant("tooth stiffness", "fillet radius 0.3 m", both("fillet_radius", 0.3)),
    Variant("damping", "mesh damping ratio 0.01 instead of 0.05", {"mesh.damping_ratio": 0.01}),
    Variant("damping", "mesh damping ratio 0.1", {"mesh.damping_ratio": 0.1}),
    Variant("speed", "5 rad/s", {"operating.pinion_speed": "5 rad/s"}),
    Variant("speed", "20 rad/s", {"operating.pinion_speed": "20 rad/s"}),
    Variant("speed", "100 rad/s", {"operating.pinion_speed": "100 rad/s"}),
    Variant("formulation", "sliding of the vibrating bodies", {"friction.sliding": "dynamic"}),
    Variant("formulation", "energy-consistent", {"mesh.formulation": "energy-consistent"}),
    Variant("numerics", "reversal width 5 µm instead of 20", {"friction.reversal_width": "5 um"}),
    Variant("numerics", "reversal width 80 µm", {"friction.reversal_width": "80 um"}),
    Variant("numerics", "contact width 0.02 µm instead of 0.1", {"mesh.contact_width": "0.02 um"}),
    Variant("numerics", "contact width 0.5 µm", {"mesh.contact_width": "0.5 um"}),
    Variant("numerics", "rtol = 1e-8 instead of 1e-6", {"solver.rtol": 1e-8}),
    Variant("numerics", "200 samples per cycle instead of 2000", {"output.samples_per_cycle": 200}),
)

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
    ("DTE CRC − inv., µm", None, "+.1f"),
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


def figures(folder: Path, settings: dict[str, dict[str, Any]]) -> list[float]:
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
        with open_record(result.path) as record:
            if name == DRY:
                load = load_in_single_contact(record)
                continue
            summary = record.summary
            friction[name] = [summary["friction_force_mean"][record.pairs.index(pair)] for pair in (1, 0)]
            efficiency[name], ratio[name] = summary["efficiency"], summary["contact_ratio"]
            error[name] = summary["transmission_error_mean"]
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


def row(cells: list[str]) -> str:
    return f"| {' | '.join(cells)} |"


def written(values: list[float]) -> list[str]:
    return [format(value, code) for value, (_, _, code) in zip(values, COLUMNS, strict=True)]


def published_row() -> list[str]:
    rows = published("liu-ni-2022")
    cells = []
    for _, key, code in COLUMNS:
        cells.append("" if key is None else format(rows[f"liu-ni/{key}"]["published"], code))
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


def table(only: str | None) -> str:
    """Run everything and write the table."""
    lines = [row(["what is changed", *(heading for heading, _, _ in COLUMNS)])]
    lines.append("|---|" + "--:|" * len(COLUMNS))
    lines.append(row(["**published**", *published_row()]))
    with TemporaryDirectory(prefix="tribodyn-") as name:
        folder = Path(name)
        lines.append(
            row(["**ours**", *written(figures(folder, {name: {} for name in (CRC, INVOLUTE, DRY)}))])
        )
        tables = {}
        for scenario in (CRC, INVOLUTE, DRY):
            with open_record(folder / f"{scenario}.h5") as record:
                tables[scenario] = stiffness_table(record, 1.0)
        group = ""
        for variant in VARIANTS:
            if only and variant.group != only:
                continue
            sys.stderr.write(f"{variant.group}: {variant.label}\n")
            if variant.group != group:
                group = variant.group
                lines.append(row([f"*{group}*", *[""] * len(COLUMNS)]))
            lines.append(row([variant.label, *written(figures(folder, settings_of(variant, tables)))]))
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description="Sensitivity of Liu & Ni's published figures.")
    parser.add_argument("--only", choices=sorted({variant.group for variant in VARIANTS}))
    parser.add_argument("--into", type=Path, help="page to put the table into")
    options = parser.parse_args()
    text = table(options.only)
    print(text)
    if options.into:
        put(options.into, "sensitivity", text)


if __name__ == "__main__":
    main()
