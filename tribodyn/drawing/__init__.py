"""Drawings of a gear pair: pictures, DXF for CAD, profile points; the geometry only delivers the points."""
