"""Outlines as lines through points, and how far a point is from them."""

import numpy as np


def turned(points, angle):
    """Points (n, 2) turned about the origin, anticlockwise."""
    c, s = np.cos(angle), np.sin(angle)
    return points @ np.array([[c, s], [-s, c]])


def closed(points):
    """The points, and the first one again."""
    return np.concatenate([points, points[:1]])


def distance(point, line):
    """Distance of a point from the nearest piece of a line through points (n, 2)."""
    start, along = line[:-1], np.diff(line, axis=0)
    share = np.sum((point - start) * along, axis=1) / np.maximum(np.sum(along**2, axis=1), 1e-30)
    return np.min(np.linalg.norm(start + np.clip(share, 0, 1)[:, None] * along - point, axis=1))
