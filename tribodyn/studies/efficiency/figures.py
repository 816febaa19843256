"""Figures of an efficiency study: those over the mesh cycle, and of helical pairs the line load."""

from tribodyn.post.figures import over_face, over_mesh

DRAWINGS = {**over_mesh.DRAWINGS, "line-load": over_face.LINE_LOAD}
