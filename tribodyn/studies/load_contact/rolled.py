"""Load contact studies as curves: over the phase of the mesh, and over the roll angle of one pair."""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.numerics.shapes import Array, Float
from tribodyn.record.reader import Record


class FaceMap(NamedTuple):
    """A quantity of one pair over its roll angle and the face."""

    #: (positions,); roll angle of the pair, 0 at the pitch point, increasing, rad
    roll: Float[Array, " position"]
    face: Float[Array, " slice"]  # (slices,); middles of the slices from the middle of the face, m
    values: Float[Array, "position slice"]  # (positions, slices)


def require_positions(record: Record) -> None:
    """Refuse a record that holds nothing to draw."""
    if record.samples < 2:
        raise InputError("record", str(record.path), "holds no samples to draw", "run the scenario again")


def over_phase(record: Record, name: str) -> tuple[Float[Array, " position"], Float[Array, "position ..."]]:
    """Give phase and a quantity over it; a study of a single mesh cycle is given twice, for it repeats."""
    phase, values = record["phase"], record[name]
    period = _cycles(record)
    copies = 2 if period == 1 else 1
    x = np.concatenate([phase + copy * period for copy in range(copies)] + [[copies * period]])
    return x, np.concatenate([values] * copies + [values[:1]])


def pair_over_phase(
    record: Record, name: str, pair: int
) -> tuple[Float[Array, " position"], Float[Array, " position"]]:
    """Give a pair's quantity over the phase as `over_phase` does, broken where the number passes on.

    At the end of a cycle the teeth that were pair 1 become pair 0: the last point of a piece is taken from
    there.
    """
    x, _ = over_phase(record, "phase")
    _, values = over_phase(record, name)
    slot = record.pairs.index(pair)
    older = values[:, slot - 1] if slot > 0 else np.full(len(x), np.nan)
    begins = np.flatnonzero(np.diff(np.floor(x + 1e-9), prepend=-1.0))
    pieces_x, pieces_y = [], []
    for start, end in pairwise(begins):
        pieces_x += [x[start : end + 1], [np.nan]]
        pieces_y += [values[start:end, slot], [older[end], np.nan]]
    return np.concatenate(pieces_x), np.concatenate(pieces_y)


def over_roll(
    record: Record, values: Float[Array, "sample pair ..."]
) -> tuple[Float[Array, " position"], Float[Array, "position ..."]]:
    """Give roll angle (rad, increasing) and values (…) of one pair through its life.

    In a study of one cycle all pairs are alike, and each number covers another part of it. Where teeth differ
    and there are cycles enough, it is the first pair whose beginning is recorded.

    Parameters
    ----------
    values : (phase, pair, …)
    """
    cycle = np.floor(record["phase"] + 1e-9).astype(int)
    pairs = len(record.pairs)
    enough = _cycles(record) >= pairs
    parts = [(np.flatnonzero(cycle == (pairs - 1 - slot if enough else 0)), slot) for slot in range(pairs)]
    roll = np.concatenate([record["roll_angle"][rows, slot] for rows, slot in parts])
    order = np.argsort(roll, kind="stable")
    return roll[order], np.concatenate([values[rows, slot] for rows, slot in parts])[order]


def face_map(record: Record, name: str) -> FaceMap:
    """Give a quantity over (phase, pair, slice) as a map of one pair, where the pair carries load."""
    roll, load = over_roll(record, record["normal_load"])
    _, values = over_roll(record, record[name])
    carrying = np.flatnonzero(load > 0.0)
    part = slice(max(carrying[0] - 1, 0), carrying[-1] + 2) if carrying.size else slice(None)
    return FaceMap(roll[part], record["slice"], values[part])


def face_edges(record: Record) -> Float[Array, " edge"]:
    """Edges of the slices (slices + 1,), m from the middle of the face."""
    width = float(record.mesh_cycle["face_width"])
    return np.linspace(-width / 2, width / 2, len(record["slice"]) + 1)


def at_pitch_point(record: Record, name: str) -> Float[Array, " slice"]:
    """Give a quantity over the face (slices,) where a pair is nearest to the pitch point."""
    roll = np.abs(record["roll_angle"])
    position, pair = np.unravel_index(np.argmin(roll), roll.shape)
    return record[name][position, pair]


def _cycles(record: Record) -> int:
    """Mesh cycles in the record."""
    return max(1, int(np.floor(record["phase"][-1] + 1e-9)) + 1)
