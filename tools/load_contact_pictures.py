"""Pictures of docs/load-contact.md: line loads of misaligned gears, and a Harris map.

python -m tools.load_contact_pictures            # writes docs/pictures/load-contact-*.png
"""

from contextlib import ExitStack
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from tools.marked_block import PICTURES as FOLDER
from tribodyn.post.style import save
from tribodyn.record.reader import Record
from tribodyn.studies.pages import figure
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run

UNRELIEVED = {
    "drive.pinion.modification.lead_relief_start": "0 um",
    "drive.pinion.modification.lead_relief_end": "0 um",
}
FINE = {"output.positions_per_cycle": 120}
TORQUES = [f"{torque} N*m" for torque in (40, 80, 120, 160, 200, 240, 280, 318.3, 360, 400, 440, 480)]
#: Pictures: figure, and the runs in it as legend, scenario, overrides.
PICTURES: dict[str, tuple[str, list[tuple[str, str, dict[str, Any]]]]] = {
    "load-contact-line-load": (
        "line-load",
        [
            (
                "aligned",
                "load-contact-misaligned",
                {**UNRELIEVED, **FINE, "mesh.misalignment.in_plane": "0 arcmin", "mesh.slices": 21},
            ),
            ("2 arcmin", "load-contact-misaligned", {**UNRELIEVED, **FINE}),
            ("2 arcmin, relieved", "load-contact-misaligned", FINE),
        ],
    ),
    "load-contact-harris": (
        "harris",
        [
            ("without relief", "load-contact-18-36", {"operating.gear_torques": TORQUES}),
            ("12.4 µm of tip relief", "harris-18-36-tip-relief", {"operating.gear_torques": TORQUES}),
        ],
    ),
}


def main() -> None:
    for picture, (name, runs) in PICTURES.items():
        with TemporaryDirectory(prefix="tribodyn-") as temporary, ExitStack() as stack:
            records = []
            for number, (label, scenario, overrides) in enumerate(runs):
                result = run(load_scenario(scenario, overrides), Path(temporary) / f"{number}.h5")
                record = stack.enter_context(Record(result.path))
                record.label = label
                records.append(record)
                # what the page says of a run: face load factor, maximum values
                summary = record.summary.items()
                print(label, {key: value for key, value in summary if key.endswith(("_max", "factor"))})
            print(save(figure(name, records), FOLDER / f"{picture}.png", force=True))


if __name__ == "__main__":
    main()
