"""Friction of a mixed contact over the constants of its asperities, by finish and beside it.

python -m tools.asperity_table --into docs/ehl.md

The pair of 25 and 60 teeth of `docs/ehl.md`, its contact solved at positions along the way of a pair.
"""

from functools import partial

from tools.marked_block import generate, table
from tribodyn.interface.scenario import scenario
from tribodyn.studies.ehl.run import quantities_of
from tribodyn.tribology.contact import BY_FINISH

PAIR = {
    "title": "25 and 60 teeth",
    "kind": "ehl",
    "lubricant": "iso-vg-220-mineral",
    "drive": {
        "family": "involute",
        "module": "3 mm",
        "pressure_angle": "20 deg",
        "centre_distance": "129 mm",
        "mean_roughness": "0.8 um",
        "material": "16MnCr5",
        "pinion": {"teeth": 25, "face_width": "40 mm", "bore_radius": "12 mm", "profile_shift": 0.2},
        "gear": {"teeth": 60, "face_width": "40 mm", "bore_radius": "20 mm", "profile_shift": 0.1},
    },
    "operating": {"pinion_speed": "1800 rpm", "power": "20 kW", "oil_temperature": "80 degC"},
    "output": {"positions": 12},
}
#: σβn and σ/β that are no finish of `contact.BY_FINISH`.
OTHERS = ((0.03, 0.01), (0.05, 0.1), (0.1, 0.01))


def row(name: str, density: float, slope: float) -> list[str]:
    """Return a row of the table."""
    found = quantities_of(scenario(PAIR, {"drive.asperity_density": density, "drive.asperity_slope": slope}))
    return [
        name,
        f"{density:g}",
        f"{slope:g}",
        f"{found['asperity_load_ratio_max']:.2f}",
        f"{found['friction_coefficient_mean']:.3f}",
        f"{1e6 * found['central_film_min']:.2f}",
    ]


def asperities(_: object) -> str:
    """Return the table."""
    rows = [row(f"`{name}`", *constants) for name, (constants, _) in BY_FINISH.items()]
    rows += [row("", *constants) for constants in OTHERS]
    head = ("`finish`", "σβn", "σ/β", "asperities' share, maximum", "friction, mean", "mean gap, minimum, µm")
    return table(head, rows, "lrrrrr")


if __name__ == "__main__":
    generate(__doc__, asperities=partial(asperities))
