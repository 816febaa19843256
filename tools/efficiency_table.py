"""Efficiencies of the shipped 23/47 drives under every friction law and load sharing, as a Markdown table.

python tools/efficiency_table.py                             # prints the table
python tools/efficiency_table.py --into docs/efficiency.md   # and puts it into the page
"""

import argparse
from pathlib import Path

from marked_block import put

from tribodyn.errors import InputError
from tribodyn.studies.efficiency.case import EfficiencyCase
from tribodyn.studies.efficiency.run import efficiencies, prepare
from tribodyn.studies.protocol.load import load_scenario

DRIVES = {
    "liu-ni-crc-23-47": "CRC",
    "liu-ni-involute-23-47": "involute",
    "cycloidal-23-47": "cycloidal",
    "parabolic-23-47": "parabolic",
}
LAWS = ("masjedi-khonsari", "xu", "benedict-kelley", "niemann", "iso-14179-1")
COLUMNS = {
    "efficiency_elastic": "elastic",
    "efficiency_uniform": "uniform",
    "efficiency_single_pair": "single pair",
    "efficiency_torque_ratio": "torque ratio",
}
CONDITIONS = {
    "10 rad/s, 500 N m, 0.35 Pa s": {},
    "300 rad/s, 500 N m, 0.035 Pa s": {
        "operating.pinion_speed": "300 rad/s",
        "lubricant.inlet_viscosity": "0.035 Pa*s",
    },
}


def lines() -> list[str]:
    table = [
        f"| conditions | law | drive | {' | '.join(COLUMNS.values())} |",
        f"|---|---|---|{'---|' * len(COLUMNS)}",
    ]
    for conditions, overrides in CONDITIONS.items():
        for law in LAWS:
            for drive, name in DRIVES.items():
                case = load_scenario(
                    "efficiency-crc-23-47", {"drive": drive, "friction.law": law, **overrides}
                )
                assert isinstance(case, EfficiencyCase)
                try:
                    values = efficiencies(prepare(case))
                    cells = [f"{100 * values[key]:.3f}" if key in values else "–" for key in COLUMNS]
                except InputError:  # a mean law where radius and speed vanish at the pitch point
                    continue
                table.append(f"| {conditions} | `{law}` | {name} | {' | '.join(cells)} |")
    return table


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--into", type=Path, help="Markdown page with the marked block efficiencies")
    page: Path | None = parser.parse_args().into
    table = "\n".join(lines())
    print(table)
    if page is not None:
        put(page, "efficiencies", table)


if __name__ == "__main__":
    main()
