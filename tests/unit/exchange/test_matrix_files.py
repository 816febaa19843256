"""Every format gives back the matrices that were put in; what is no file of matrices is one line."""

import h5py
import numpy as np
import pytest
import scipy.sparse as sparse
from scipy.io import mmwrite, savemat

from tests.support.beam_element import bar
from tribodyn.errors import InputError
from tribodyn.exchange.matrix_files import read_matrices, write_matrices
from tribodyn.train.elastic.beam_matrices import SIX

KEY = "housing.matrices"


def _matlab(element, path):
    content = {"M": element.mass, "K": element.stiffness, "C": element.damping, "places": element.places}
    savemat(path, {**content, "seats": np.array(element.seats, dtype=object), "units": "m, kg, s"})


def _matlab_73(element, path):
    """As MATLAB lays out its HDF5: columns first, texts as numbers, its mark in front."""
    with h5py.File(path, "w", userblock_size=512) as file:
        for name, array in {"M": element.mass, "K": element.stiffness, "places": element.places}.items():
            file.create_dataset(name, data=array.T).attrs["MATLAB_class"] = np.bytes_(b"double")
        text = file.create_dataset("units", data=np.array([list(map(ord, "m, kg, s"))], dtype="u2").T)
        text.attrs["MATLAB_class"] = np.bytes_(b"char")
    with path.open("r+b") as raw:
        raw.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64")


def _matrix_market(element, path):
    for name in ("mass", "stiffness", "damping"):
        file = path.with_name(path.name.replace("stiffness", name))
        mmwrite(file, sparse.coo_matrix(getattr(element, name)), symmetry="symmetric", precision=17)


def _punch(element, path):
    """Large fields, half of each matrix, seats as grids 101 and 205 with modes as scalar points."""
    places = [(grid, component) for grid in (101, 205) for component in range(1, SIX + 1)]
    places += [(9001 + mode, 0) for mode in range(element.modes)]
    lines = ["$ by hand", "GRID*                101               0  0.00000000E+00  0.00000000E+00"]
    lines += ["*                  0.0", "GRID         205       0      0.      0.     5-1"]
    for name, matrix in (("KAAX", element.stiffness), ("MAAX", element.mass), ("BAAX", element.damping)):
        lines.append(f"DMIG    {name:8}{0:8d}{6:8d}{2:8d}{0:8d}{'':8}{'':8}{len(matrix):8d}")
        for column, (grid, component) in enumerate(places):
            lines.append(f"DMIG*   {name:16}{grid:16d}{component:16d}{'':16}")
            for row in range(column, len(matrix)):
                value = f"{matrix[row, column]:.8E}".replace("E", "D")
                lines.append(f"*       {places[row][0]:16d}{places[row][1]:16d}{value:>16}"[:72])
    path.write_text("\n".join(lines) + "\n")


WRITERS = {
    "housing.h5": write_matrices,
    "housing.npz": write_matrices,
    "housing.mat": _matlab,
    "new.mat": _matlab_73,
    "housing-stiffness.mtx": _matrix_market,
    "housing.pch": _punch,
}


@pytest.mark.parametrize("name", WRITERS)
def test_a_file_gives_back_what_it_holds(name, tmp_path):
    element, path = bar(), tmp_path / name
    WRITERS[name](element, path)
    table = read_matrices(path, KEY)
    digits = 1e-7 if name.endswith(".pch") else 1e-14  # fields of 16 characters
    for matrix in ("mass", "stiffness"):
        expected = getattr(element, matrix)
        np.testing.assert_allclose(table[matrix], expected, atol=digits * np.abs(expected).max())
    if "places" in table:
        np.testing.assert_allclose(table["places"], element.places)
    if name in ("housing.h5", "housing.npz"):
        assert table["seats"] == ["A", "B"]
        np.testing.assert_array_equal(np.reshape(table["recovery"], (1, 3, -1)), element.recovery)
    if name == "housing.mat":
        assert (table["seats"], table["units"]) == (["A", "B"], "m, kg, s")
    if name == "housing.pch":
        assert table["seats"] == ["grid-101", "grid-205"]
        assert "places" in table


def _with_pickle(path):
    np.savez(path, M=np.array([print], dtype=object), K=np.eye(6))


def _linked(path):
    write_matrices(bar(), path.with_name("other.h5"))
    with h5py.File(path, "w") as file:
        file["mass"] = h5py.ExternalLink("other.h5", "mass")
        file["stiffness"] = np.eye(12)


@pytest.mark.parametrize(
    ("name", "write", "words"),
    [
        ("a.csv", lambda path: path.write_text("1"), "no format of matrices"),
        ("a.h5", lambda path: path.write_text("1"), "cannot be read"),
        ("a.npz", _with_pickle, "cannot be read"),
        ("a.npz", lambda path: np.savez(path, M=np.eye(6)), "has no stiffness"),
        ("a.h5", _linked, "lies in another file"),
        ("a.mat", lambda path: path.write_bytes(b"x" * 200), "cannot be read"),
        ("k.mtx", lambda path: path.write_text("1"), "stiffness"),
        ("a.pch", lambda path: path.write_text("GRID,1,,0.,0.,0.\n"), "no DMIG"),
        ("a.pch", lambda path: path.write_text("DMIG,KAAX,1,1,,1,1,2.0\n"), "no header"),
    ],
)
def test_what_is_no_file_of_matrices_is_one_line(name, write, words, tmp_path):
    path = tmp_path / name
    write(path)
    with pytest.raises(InputError, match=words) as refused:
        read_matrices(path, KEY)
    assert refused.value.key == KEY
    assert "\n" not in str(refused.value)


def test_numbers_of_nastran_in_small_fields_and_with_commas(tmp_path):
    path = tmp_path / "a.pch"
    small = (
        "DMIG    KAAX           7       1               7       1   1.5+3\n+              7       2    -2.0\n"
    )
    path.write_text("DMIG,KAAX,0,6,2,0,,,6\n" + small + "DMIG,MAAX,0,6,2,0,,,6\nDMIG,MAAX,7,6,,7,6,1.5-3\n")
    table = read_matrices(path, KEY)
    assert table["stiffness"][0][:2] == [1500.0, -2.0]
    assert table["stiffness"][1][0] == -2.0
    assert table["mass"][5][5] == 1.5e-3
