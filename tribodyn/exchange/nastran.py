"""Matrices punched by Nastran as DMIG entries (PARAM,EXTOUT,DMIGPCH; EXTSEOUT).

MSC Nastran Quick Reference Guide, DMIG: a header ``DMIG NAME 0 IFO TIN TOUT POLAR - NCOL``, IFO 6 for a
symmetric matrix of which half is written, then columns ``DMIG NAME GJ CJ - G1 C1 A1 …``; small fields of 8
characters, large ones (``DMIG*``) of 16, or with commas. Grids with components 1 to 6 are seats, in the order
of their numbers; scalar points (component 0) are modes.
"""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

#: Name of a matrix, without its end -> name here; of ones assembled (…AAX) and reduced (…HH) likewise.
_MATRICES = {"K": "stiffness", "M": "mass", "B": "damping"}
_NAME = re.compile(r"(?P<letter>[KMB])(?:AAX|GG|2GG|2PP|AA|HH|OO)?\d*$")
_SYMMETRIC = 6
#: Digits run into their exponent: 1.5-3 is 1.5e-3.
_EXPONENT = re.compile(r"(?<=[\d.])([+-]\d+)$")
_MOST = 3000


def punched_matrices(path: Path) -> dict[str, Any]:
    """Arrays of a file by name, `places` and `seats` too where its grids are in it; ValueError."""
    headers: dict[str, int] = {}
    entries: dict[str, list[tuple[tuple[int, int], tuple[int, int], float]]] = {}
    grids: dict[int, tuple[float, ...]] = {}
    for card, fields in _cards(path.read_text(encoding="latin-1").splitlines()):
        if card == "GRID":
            grids[int(fields[0])] = tuple(_number(text) for text in (*fields, "", "", "")[2:5])
        elif card == "DMIG":
            match = _NAME.match(fields[0].upper())
            if match is None:
                continue
            name = _MATRICES[match["letter"]]
            if fields[1] == "0" and name not in headers:
                headers[name] = int(fields[2])
                if int(fields[3]) > 2:
                    raise ValueError(f"{fields[0]} is complex")
                continue
            column = int(fields[1]), int(fields[2] or 0)
            for start in range(4, len(fields), 4):
                row, component, value, *_ = (*fields[start : start + 4], "", "")
                if row:
                    place = int(row), int(component or 0)
                    entries.setdefault(name, []).append((place, column, _number(value)))
    if not entries:
        raise ValueError("no DMIG of K, M or B in it")
    for name in entries:
        if name not in headers:
            raise ValueError(f"the DMIG of {name} has no header")
    places = {place for rows in entries.values() for row in rows for place in row[:2]}
    seats = sorted({grid for grid, component in places if component})
    scalars = sorted({grid for grid, component in places if not component})
    order = [(grid, component) for grid in seats for component in range(1, 7)]
    order += [(grid, 0) for grid in scalars]
    if len(order) > _MOST:
        raise ValueError(f"{len(order)} coordinates: not reduced to the seats")
    number = {place: n for n, place in enumerate(order)}
    found: dict[str, Any] = {}
    for name, rows in entries.items():
        matrix = np.zeros((len(order), len(order)))
        for row, column, value in rows:
            matrix[number[row], number[column]] = value
        if headers[name] == _SYMMETRIC:
            half = np.where(matrix != 0.0, matrix, matrix.T)
            matrix = half
        found[name] = matrix
    found["seats"] = [f"grid-{grid}" for grid in seats]
    if all(grid in grids for grid in seats):
        found["places"] = np.array([grids[grid] for grid in seats])
    return found


def _cards(lines: list[str]) -> Iterator[tuple[str, list[str]]]:
    """Bulk data entries that matter, with their fields; continuations put behind."""
    card, fields = "", list[str]()
    for line in lines:
        line = line.split("$")[0].rstrip()
        if not line:
            continue
        if "," in line:
            first, *rest = (part.strip() for part in line.split(","))
            rest = (rest + [""] * 8)[:8] if len(rest) > 4 or not first.endswith("*") else rest
        else:
            line = line.expandtabs(8)
            first, width = line[:8].strip(), 16 if "*" in line[:8] else 8
            rest = [line[at : at + width].strip() for at in range(8, 72, width)]
        if not first or first[0] in "*+":
            fields += rest
            continue
        if card:
            yield card, fields
        name = first.rstrip("*").upper()
        card, fields = (name if name in ("DMIG", "GRID") else ""), list(rest)
    if card:
        yield card, fields


def _number(text: str) -> float:
    """A real number as Nastran writes it: 1.5D+03, 1.5+3, blank for nothing."""
    text = text.strip().upper().replace("D", "E")
    if not text:
        return 0.0
    return float(text if "E" in text else _EXPONENT.sub(r"E\1", text))
