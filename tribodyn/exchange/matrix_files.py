"""Matrices of super-elements in files: HDF5, NPZ, MATLAB, Matrix Market, and punched by Nastran.

Files of named arrays hold `mass`, `stiffness`, `damping` (or M, K, C); `seats`, their names; `places` (seat,
3); `points`, names, with `recovery` (point, 3, coordinate); `area`, or `radiation` (line, coordinate,
coordinate) with `radiation_frequency` (Hz), of `superelement.Radiation`; and `units`, a text such as
"mm, t, s". What is not there the scenario says. Coordinates are as in `train.elastic.superelement`.
"""

import io
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from tribodyn.errors import InputError, quoted
from tribodyn.exchange.nastran import punched_matrices
from tribodyn.record.soundness import through_a_child
from tribodyn.train.elastic.superelement import SuperElement

#: Other names of arrays.
NAMES = {
    "mass": ("mass", "M"),
    "stiffness": ("stiffness", "K"),
    "damping": ("damping", "C", "B"),
    "seats": ("seats",),
    "places": ("places",),
    "points": ("points",),
    "recovery": ("recovery",),
    "area": ("area",),
    "radiation": ("radiation",),
    "radiation_frequency": ("radiation_frequency",),
    "units": ("units",),
}
_TEXTS, _WRITTEN_IN = ("seats", "points"), "m, kg, s"
#: Bytes of a file, and elements of an array.
MOST_BYTES, MOST_ELEMENTS = 256 * 2**20, 4_000_000


def read_matrices(path: Path, key: str) -> dict[str, Any]:
    """What a file says of a super-element, as a table of a scenario; InputError at `key`."""
    reader = READERS.get(path.suffix.lower())
    if reader is None:
        rule, remedy = "no format of matrices", f"use one of {', '.join(READERS)}"
        raise InputError(key, quoted(path.name), rule, remedy)
    if path.stat().st_size > MOST_BYTES:
        raise InputError(key, quoted(path.name), f"larger than {MOST_BYTES >> 20} MiB", "reduce it further")
    try:
        arrays = reader(path)
        table = {name: _plain(name, array) for name, array in arrays.items()}
    except (OSError, ValueError, KeyError, TypeError, IndexError, NotImplementedError, EOFError) as error:
        why = " ".join(str(error).split())[:200] or type(error).__name__
        raise InputError(key, quoted(path.name), f"cannot be read: {why}", "write it again") from None
    for name in ("mass", "stiffness"):
        if name not in table:
            rule = f"has no {name}"
            raise InputError(key, quoted(path.name), rule, f"put it in as {' or '.join(NAMES[name])}")
    return table


def write_matrices(element: SuperElement, path: str | Path) -> Path:
    """Write a super-element as a file that `[housing] matrices` and `flexible_carrier` read, in SI units.

    Parameters
    ----------
    element : as `td.plate_housing` makes it
    path : ends in .h5 or .npz; what is there is replaced

    Returns
    -------
    the path

    Raises
    ------
    InputError
        For another ending.
    """
    path = Path(path)
    arrays: dict[str, Any] = {
        "mass": element.mass,
        "stiffness": element.stiffness,
        "damping": element.damping,
        "places": element.places,
    }
    if element.points:
        arrays["recovery"] = element.recovery
    if element.radiation is not None:
        arrays["area"] = element.radiation.area
        if len(element.radiation.frequency):
            arrays["radiation"] = element.radiation.resistance
            arrays["radiation_frequency"] = element.radiation.frequency
    texts = {"seats": list(element.seats), "points": list(element.points)}
    if path.suffix == ".npz":
        named = {name: np.array(values) for name, values in texts.items() if values}
        np.savez_compressed(path, units=np.array(_WRITTEN_IN), **named, **arrays)
    elif path.suffix == ".h5":
        import h5py

        with h5py.File(path, "w") as file:
            file.attrs["format"] = "tribodyn-superelement"
            file.attrs["units"] = _WRITTEN_IN
            for name, array in arrays.items():
                file.create_dataset(name, data=array, compression="gzip", shuffle=True)
            for name, values in texts.items():
                if values:
                    file.create_dataset(name, data=values, dtype=h5py.string_dtype())
    else:
        raise InputError("path", quoted(path.name), "no format that is written", "use .h5 or .npz")
    return path


def _plain(name: str, array: Any) -> Any:
    """An array as a scenario has it: a text, a list of names, or rows of numbers."""
    if name == "units":
        return _text(np.ravel(np.asarray(array))[0])
    if name in _TEXTS:
        return [_text(one) for one in np.ravel(np.asarray(array))]
    numbers = np.asarray(array, dtype=float)
    if numbers.size > MOST_ELEMENTS:
        raise ValueError(f"{name} has {numbers.size} elements, more than {MOST_ELEMENTS}")
    if name == "radiation_frequency":
        return numbers.ravel().tolist()
    if name in ("recovery", "radiation") and numbers.ndim == 3:
        numbers = numbers.reshape(-1, numbers.shape[-1])
    if numbers.ndim != 2:
        raise ValueError(f"{name} has {numbers.ndim} dimensions, not two")
    return numbers.tolist()


def _text(one: Any) -> str:
    """A name, of bytes, of a text, or of a cell of MATLAB, which is an array of one."""
    while isinstance(one, np.ndarray):
        one = one.ravel()[0]
    text = one.decode() if isinstance(one, bytes) else str(one)
    return text.strip()


def _named(there: Mapping[str, Any], get: Callable[[str], Any]) -> dict[str, Any]:
    found = {}
    for name, others in NAMES.items():
        key = next((other for other in others if other in there), None)
        if key is not None:
            found[name] = get(key)
    return found


def _hdf5(path: Path) -> dict[str, Any]:
    if wrong := through_a_child(look_into_hdf5, path):
        raise ValueError(wrong)
    import h5py

    with h5py.File(path, "r") as file:
        found = _named(file, lambda name: _dataset(file[name]))
        if "units" in file.attrs:
            found["units"] = file.attrs["units"]
    return found


def _dataset(data: Any) -> Any:
    """Content of a dataset; MATLAB writes columns first, and texts as numbers."""
    content = data[()]
    if "MATLAB_class" not in data.attrs:
        return content
    if data.attrs["MATLAB_class"] == b"char":
        return "".join(map(chr, np.ravel(content)))
    return np.asarray(content).T


def look_into_hdf5(path: Path) -> str:
    """What is wrong with an HDF5 file of matrices; "": nothing."""
    import h5py

    try:
        with h5py.File(path, "r") as file:
            for name in (other for others in NAMES.values() for other in others if other in file):
                if not isinstance(file.get(name, getlink=True), h5py.HardLink):
                    return f"{name} lies in another file"
                data = file[name]
                if not isinstance(data, h5py.Dataset) or data.is_virtual or data.external:
                    return f"{name} is no array of its own"
                if (data.size or 0) > MOST_ELEMENTS:
                    return f"{name} has {data.size} elements, more than {MOST_ELEMENTS}"
                data[()]
    except Exception as error:  # whatever HDF5 says of it
        return " ".join(str(error).split()) or type(error).__name__
    return ""


def _npz(path: Path) -> dict[str, Any]:
    with np.load(path, allow_pickle=False) as file:
        return _named(dict.fromkeys(file.files), lambda name: file[name])


def _matlab(path: Path) -> dict[str, Any]:
    from scipy.io import loadmat

    with path.open("rb") as file:
        if b"MATLAB 7.3" in file.read(64):
            return _hdf5(path)
    content = loadmat(path, variable_names=[name for names in NAMES.values() for name in names])
    return _named(content, lambda name: _dense(content[name]))


def _matrix_market(path: Path) -> dict[str, Any]:
    """A set of files: that of the stiffness is named, the others have another word in its place."""
    from scipy.io import mmread

    if "stiffness" not in path.stem:
        raise ValueError('the name of a Matrix Market file must have the word "stiffness" in it')
    found = {}
    for name in ("stiffness", "mass", "damping"):
        file = path.with_name(path.name.replace("stiffness", name))
        if name != "damping" or file.is_file():
            found[name] = _dense(mmread(io.BytesIO(file.read_bytes())))
    return found


def _dense(matrix: Any) -> Any:
    if not hasattr(matrix, "toarray"):
        return matrix
    if np.prod(matrix.shape) > MOST_ELEMENTS:
        raise ValueError(f"{matrix.shape[0]} rows: not reduced to the seats")
    return matrix.toarray()


READERS: dict[str, Callable[[Path], dict[str, Any]]] = {
    ".h5": _hdf5,
    ".npz": _npz,
    ".mat": _matlab,
    ".mtx": _matrix_market,
    ".pch": punched_matrices,
    ".dmig": punched_matrices,
}
