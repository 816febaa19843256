"""What a train consists of, by numbers: where the state keeps its motion, and what meets what."""

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import NamedTuple

from tribodyn.numerics.elementary import Indices, RuntimeIndices, StaticInt
from tribodyn.train.structure import GROUND, OF_MESHES, WORKS_OF_MESH


class TrainLayout(NamedTuple):
    """What the train consists of: hashable, static for JAX; of two gears compiled into native kernels."""

    spatial: int  # bodies that move in space, of those that move in the plane
    planar: int  # bodies that move in the plane, or in space
    bodies: int
    meshes: int
    links: int
    half: int  # coordinates; state half + i is the rate of state i
    lag: int  # place of the reference's lag, among the rates that of its slip
    tilts: int  # place of the first z; of every body that moves in space z and tilts about x and y
    mechanical: int  # states that the mechanics depend on; the rest are works
    states: int
    driver: tuple[int, ...]  # this and the next: bodies at the ends of every mesh
    driven: tuple[int, ...]
    carrier: tuple[int, ...]  # of every mesh the body that carries it; `GROUND`: the housing
    first: tuple[int, ...]  # this and the next: bodies at the ends of every link; `GROUND`
    second: tuple[int, ...]
    pins: tuple[int, ...]  # of every link 1 where its ends have levers or an offset, else 0
    #: of every link `DRIVES` or `BRAKES` where it holds its first end at its nominal speed, else 0
    holds: tuple[int, ...]
    frames: int  # 1 where bodies are in a frame that turns, else 0
    input: int  # body that the drive acts on
    output: int  # body that bears the load that varies in time
    clutches: int = 0
    clutch_first: tuple[int, ...] = RuntimeIndices(())  # this and the next: bodies at the ends; `GROUND`
    clutch_second: tuple[int, ...] = RuntimeIndices(())
    modes: int = 0  # coordinates that are no body's, behind those of the bodies
    #: this and the next: of every mesh the place of the first coordinate of the rim that it pushes, their
    #: number; places of none are 0
    rim_first: tuple[int, ...] = RuntimeIndices(())
    rim_count: tuple[int, ...] = RuntimeIndices(())
    #: coupled: 1 where coordinates are coupled by `coupling.Couplings`; the next two: their places by entry
    coupled: int = 0
    coupled_rows: tuple[int, ...] = RuntimeIndices(())
    coupled_columns: tuple[int, ...] = RuntimeIndices(())
    forced: tuple[int, ...] = RuntimeIndices(())  # places of the constant forces
    inertial: int = 0  # likewise of coordinates whose inertia is coupled
    inertial_rows: tuple[int, ...] = RuntimeIndices(())
    inertial_columns: tuple[int, ...] = RuntimeIndices(())
    #: of every stiffness that passes the first entry, and the number of all; the next two: their places
    passing_first: tuple[int, ...] = RuntimeIndices(())
    passing_rows: tuple[int, ...] = RuntimeIndices(())
    passing_columns: tuple[int, ...] = RuntimeIndices(())


def layout_of(
    planar: int,
    bodies: int,
    meshes: Sequence[tuple[int, int]],
    links: Sequence[tuple[int, int]],
    drives: int,
    loaded: int,
    spatial: int = 0,
    *,
    pins: Sequence[int] = (),
    holding: Mapping[int, int] = MappingProxyType({}),
    frames: int = 0,
    carriers: Sequence[int] = (),
    modes: int = 0,
    clutches: Sequence[tuple[int, int]] = (),
) -> TrainLayout:
    """The layout of so many bodies; meshes (driver, driven) and links by their ends; input and output.

    `pins` are numbers of links, `holding` of those that hold what `TrainLayout.holds` says of them.
    `carriers` are those of the meshes; none: all in the housing. `modes`: so many coordinates of no body.
    `clutches` by their ends. Of two gears in bearings that move in the plane, which nearly all pairs are, the
    machine code has all numbers; all else shares machine code that reads them.
    """
    half = 2 * planar + bodies + 3 * spatial + modes
    states = 2 * half + OF_MESHES + WORKS_OF_MESH * len(meshes) + len(clutches)
    two_gears = (planar, bodies, spatial, len(meshes), len(links), modes) == (2, 2, 0, 1, 2, 0)
    compiled_in = two_gears and not (pins or holding or clutches)
    number, places = (StaticInt, Indices) if compiled_in else (int, RuntimeIndices)
    driver, driven, first, second = (
        places([pair[end] for pair in pairs]) for pairs in (meshes, links) for end in (0, 1)
    )
    clutch_first, clutch_second = (RuntimeIndices(pair[end] for pair in clutches) for end in (0, 1))
    return TrainLayout(
        spatial=number(spatial),
        planar=number(planar),
        bodies=number(bodies),
        meshes=number(len(meshes)),
        links=number(len(links)),
        half=number(half),
        lag=number(2 if planar else 0),
        tilts=number(2 * planar + bodies),
        mechanical=number(2 * half),
        states=number(states),
        driver=driver,
        driven=driven,
        carrier=places(carriers or [GROUND] * len(meshes)),
        first=first,
        second=second,
        pins=places([int(link in pins) for link in range(len(links))]),
        holds=places([holding.get(link, 0) for link in range(len(links))]),
        frames=number(frames),
        input=number(drives),
        output=number(loaded),
        clutches=number(len(clutches)),
        clutch_first=clutch_first,
        clutch_second=clutch_second,
        modes=number(modes),
        rim_first=places([0] * len(meshes)),
        rim_count=places([0] * len(meshes)),
        coupled=number(0),
        inertial=number(0),
    )


def displacements(layout: TrainLayout) -> list[int]:
    """Places of all coordinates but the lag."""
    return [i for i in range(layout.half) if i != layout.lag]


def rim_places(layout: TrainLayout) -> list[int]:
    """Places of the coordinates of all rims."""
    runs = zip(layout.rim_first, layout.rim_count, strict=True)
    return sorted({first + e for first, count in runs for e in range(count)})


def velocities(layout: TrainLayout) -> list[int]:
    """Places of their rates."""
    return [layout.half + i for i in displacements(layout)]


def works(layout: TrainLayout) -> list[int]:
    """Places of all works."""
    return list(range(layout.mechanical, layout.states))


def work_of(layout: TrainLayout, which: int) -> int:
    """Place of a work of the whole train: `IN`, `OUT`, `DAMPING`, `PARAMETRIC`."""
    return layout.mechanical + which


def work_of_mesh(layout: TrainLayout, mesh: int, which: int) -> int:
    """Place of a work of a mesh: `FRICTION`, `SLIDING`."""
    return layout.mechanical + OF_MESHES + WORKS_OF_MESH * mesh + which


def works_of_clutches(layout: TrainLayout) -> list[int]:
    """Places of what friction takes in all clutches."""
    return list(range(layout.states - layout.clutches, layout.states))


def works_of_meshes(layout: TrainLayout, which: int) -> list[int]:
    """Places of a work of all meshes."""
    return [work_of_mesh(layout, mesh, which) for mesh in range(layout.meshes)]
