"""Efficiencies of the shipped 23/47 drives under every friction law and load sharing, as a Markdown table.

python -m tools.efficiency_table                             # prints the table
python -m tools.efficiency_table --into docs/efficiency.md   # and puts it into the page
"""

from itertools import product

from tools.marked_block import generate, table
from tribodyn.errors import InputError
from tribodyn.studies.efficiency.run import efficiencies, prepare
from tribodyn.studies.efficiency.scenario import EfficiencyCase
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


def by_law_and_drive(_: object) -> str:
    rows = []
    for (conditions, overrides), law, (drive, name) in product(CONDITIONS.items(), LAWS, DRIVES.items()):
        case = load_scenario("efficiency-crc-23-47", {"drive": drive, "friction.law": law, **overrides})
        assert isinstance(case, EfficiencyCase)
        try:
            values = efficiencies(prepare(case))
        except InputError:  # a mean law where radius and speed vanish at the pitch point
            continue
        cells = [f"{100 * values[key]:.3f}" if key in values else "–" for key in COLUMNS]
        rows.append([conditions, f"`{law}`", name, *cells])
    return table(["conditions", "law", "drive", *COLUMNS.values()], rows)


if __name__ == "__main__":
    generate(__doc__, efficiencies=by_law_and_drive)
