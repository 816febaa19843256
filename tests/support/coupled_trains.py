"""Trains whose coordinates are coupled by matrices: bearings written as entries, and random structures."""

from typing import Any

import numpy as np

from tests.support.train_scenarios import REDUCER, case_of_table
from tribodyn.dynamics.parameters import DRIVE_SPEED, Model
from tribodyn.studies.motion.prepare import prepare
from tribodyn.train.coupling import CoupledMatrices, coupled
from tribodyn.train.structure import IN_SPACE, place_in_space, turn_of

_MATRIX = np.diag([2e8, 3e8, 1e8, 2e5, 3e5, 0.0]).tolist()
BEARINGS = {"matrix": _MATRIX, "matrix_units": "N, m, rad", "damping_ratio": 0.05}


def reducer_in_space(**overrides: Any) -> Model:
    """A two-stage reducer whose bodies move in space."""
    table = REDUCER | {"bearings": {"default": BEARINGS}}
    return prepare(case_of_table(table, overrides)).model


def with_couplings(model: Model, parts: list[CoupledMatrices], modes: int = 0) -> Model:
    """The model with its links in space written as entries, and further ones, over so many coordinates more.

    Coordinates of no body come behind those of the bodies: places of works move.
    """
    layout, links = model.layout, model.links
    parts = [*parts, *_of_links(model)]
    half, kind = layout.half + modes, type(layout.half)
    layout = layout._replace(
        modes=kind(modes),
        half=kind(half),
        mechanical=kind(2 * half),
        states=kind(layout.states + 2 * modes),
    )
    prescribed = model.options.drive == DRIVE_SPEED
    layout, numbers = coupled(layout, parts, model.bodies, prescribed)
    nothing = np.zeros_like(links.stiffness_in_space)
    links = links._replace(stiffness_in_space=nothing, damping_in_space=nothing, coupled=numbers)
    return model._replace(links=links, options=model.options._replace(layout=layout))


def pushed_by_mesh(model: Model, rows: np.ndarray) -> Model:
    """The model whose last mesh pushes the coordinates of no body too, by rows along and across."""
    layout, last = model.layout, model.layout.meshes - 1
    places = type(layout.rim_first)
    count = [rows.shape[1] * (m == last) for m in range(layout.meshes)]
    first = [(layout.half - layout.modes) * (m == last) for m in range(layout.meshes)]
    layout = layout._replace(rim_first=places(first), rim_count=places(count))
    meshes = tuple(mesh._replace(rim=rows) for mesh in model.meshes)
    return model._replace(meshes=meshes, options=model.options._replace(layout=layout))


def _of_links(model: Model) -> list[CoupledMatrices]:
    layout, links, parts = model.layout, model.links, []
    for k, (first, second) in enumerate(zip(layout.first, layout.second, strict=True)):
        if max(first, second) >= layout.spatial:
            continue
        ends = [(first, 1.0), (second, -1.0)] if second >= 0 else [(first, 1.0)]
        places = np.array([place_in_space(end, i, layout) for end, _ in ends for i in range(IN_SPACE)])
        apart = np.hstack([sign * np.eye(IN_SPACE) for _, sign in ends])
        both = [
            apart.T @ np.asarray(of)[k] @ apart for of in (links.stiffness_in_space, links.damping_in_space)
        ]
        parts.append(CoupledMatrices(places, *both, np.zeros_like(both[0]), np.zeros(len(places))))
    return parts


def random_structure(model: Model, modes: int, rng: np.random.Generator) -> CoupledMatrices:
    """A structure that joins all bodies in space and so many coordinates of no body: positive, gyroscopic.

    Its inertia couples rotations too, that of the reference included.
    """
    layout, bodies = model.layout, model.bodies
    moved = [place_in_space(body, i, layout) for body in range(layout.spatial) for i in range(IN_SPACE)]
    turns = [turn_of(body, layout) for body in range(layout.spatial)]
    own = list(range(layout.half, layout.half + modes))
    places = np.array([*moved, *own, *turns])
    count, elastic = len(places), len(moved) + modes
    scale = np.ones(count)
    scale[[n for n, place in enumerate(moved) if n % IN_SPACE > 2]] = 0.05  # tilts, m per rad
    scale[elastic:] = 0.05

    def positive(size: float) -> np.ndarray:
        root = rng.normal(size=(count, count)) / np.sqrt(count)
        return size * root @ root.T * np.outer(scale, scale)

    stiffness, damping, mass = positive(2e8), positive(2e3), positive(float(np.min(bodies.mass)))
    mass[range(len(moved), elastic), range(len(moved), elastic)] += float(np.min(bodies.mass))
    stiffness[elastic:], stiffness[:, elastic:] = 0.0, 0.0
    damping[elastic:], damping[:, elastic:] = 0.0, 0.0
    skew = 1e3 * rng.normal(size=(elastic, elastic)) * np.outer(scale[:elastic], scale[:elastic])
    damping[:elastic, :elastic] += skew - skew.T
    force = np.concatenate([rng.normal(size=elastic) * 500.0 * scale[:elastic], np.zeros(len(turns))])
    return CoupledMatrices(places, stiffness, damping, mass, force)
