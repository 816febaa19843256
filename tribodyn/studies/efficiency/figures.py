"""Figures of an efficiency study: those of every record over the mesh cycle."""

from tribodyn.post.figures.over_mesh import DRAWINGS

__all__ = ["DRAWINGS"]
