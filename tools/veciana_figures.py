"""Figures of Veciana et al., Machines 12 (2024) 943, and the numbers behind them as HDF5.

python tools/veciana_figures.py pictures           # computes and draws: pictures/veciana-figure-*.{h5,png}
python tools/veciana_figures.py pictures --redraw  # draws from the records that are there

`tribodyn validate veciana-2024 --plots FOLDER` draws the same without the records.
"""

import argparse
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from tribodyn.post.style import house_style, save
from tribodyn.validation.veciana_figures import FIGURES, Arrays


def write(path: Path, arrays: Arrays, about: str) -> None:
    """Keep arrays in HDF5; the unit stands in brackets behind a name and becomes an attribute."""
    with h5py.File(path, "w") as file:
        file.attrs["title"] = about
        for key, values in arrays.items():
            name, _, unit = key.rpartition(" [")
            dataset = file.create_dataset(name, data=np.asarray(values, dtype=float))
            dataset.attrs["long_name"] = name
            dataset.attrs["units"] = unit.rstrip("]").replace(" per ", "/")


def read(path: Path) -> Arrays:
    """Inverse of `write`."""
    with h5py.File(path, "r") as file:
        datasets: dict[str, Any] = {name: dataset for name, dataset in file.items()}
        return {
            f"{name} [{str(dataset.attrs['units']).replace('/', ' per ')}]": np.asarray(dataset[()])
            for name, dataset in datasets.items()
        }


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", type=Path, nargs="?", default=Path("veciana"))
    parser.add_argument("--redraw", action="store_true", help="draw from the records that are there")
    arguments = parser.parse_args()
    folder: Path = arguments.folder
    folder.mkdir(parents=True, exist_ok=True)
    for name, (compute, draw) in FIGURES.items():
        record = folder / f"veciana-{name}.h5"
        if not arguments.redraw:
            write(record, compute(), f"Veciana et al. (2024), {name}")
        with house_style():
            figure = draw(read(record))
        print(save(figure, folder / f"veciana-{name}.png", force=True))


if __name__ == "__main__":
    main()
