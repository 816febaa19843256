"""Picture of docs/wear.md: the shipped wear study from new to worn flanks.

python -m tools.wear_picture            # writes docs/pictures/wear.png
"""

from pathlib import Path
from tempfile import TemporaryDirectory

from tools.marked_block import PICTURES as FOLDER
from tribodyn.post.style import save
from tribodyn.record.reader import Record
from tribodyn.studies.pages import figure
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run

SCENARIO = "wear-18-36"


def main() -> None:
    with TemporaryDirectory(prefix="tribodyn-") as temporary:
        result = run(load_scenario(SCENARIO), Path(temporary) / f"{SCENARIO}.h5")
        with Record(result.path) as record:
            print(save(figure("overview", [record]), FOLDER / "wear.png", force=True))


if __name__ == "__main__":
    main()
