"""Figures of a train."""

from tribodyn.post.figures.drawing import Drawing

DRAWINGS: dict[str, Drawing] = {}
