"""Shafts: ``[[shaft]]``, and ``[shaft.pinion]`` and ``[shaft.gear]`` for those of a pair as drawn."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Annotated, Any

from pydantic import Discriminator, Field, Tag

from tribodyn.errors import InputError, broken_list, unknown_name
from tribodyn.geometry.drive import SIDES
from tribodyn.input import units
from tribodyn.input.fields import Inertia, PartName, TorsionalDamping, TorsionalStiffness
from tribodyn.input.quantity import InUnit, NotNegative, Table, Text, written
from tribodyn.input.tables.bearings import Bearings
from tribodyn.input.tables.drawn_shafts import DrawnShaft, broken_shaft, torsional_stiffness
from tribodyn.input.tables.laws import LinkTable, broken_link_law

#: Shafts of a gearbox.
MOST_SHAFTS = 100


class Shaft(LinkTable):
    """Gears that turn together: one rigid body, two bodies with a torsional spring between, or a drawing."""

    name: PartName
    gears: tuple[Text, ...] = Field(min_length=1)
    drawn: DrawnShaft | None = None
    stiffness: TorsionalStiffness | None = None
    damping: TorsionalDamping = written("0 N*m*s/rad")
    damping_ratio: NotNegative = 0.0
    mass: Annotated[float, InUnit(units.not_negative(units.MASS))] = written("0 kg")
    inertia: Inertia = written("0 kg*m**2")

    @property
    def rigid(self) -> bool:
        """Whether all that it names is one body."""
        return self.stiffness is None and (self.drawn is None or not self.drawn.positions)


class DrawnShafts(Table):
    """Shafts that are drawn, by the gear that they carry, in place of a list."""

    pinion: DrawnShaft | None = None
    gear: DrawnShaft | None = None


def _sort(shafts: Any) -> str:
    return "(list)" if isinstance(shafts, (list, tuple)) else "(table)"


Shafts = Annotated[
    Annotated[DrawnShafts, Tag("(table)")]
    | Annotated[tuple[Shaft, ...], Tag("(list)"), Field(max_length=MOST_SHAFTS)],
    Discriminator(_sort),
]


def listed(shafts: Any) -> tuple[Shaft, ...]:
    """The shafts of a list; none of a table, which draws those of gears without more."""
    return shafts if isinstance(shafts, tuple) else ()


def in_order(shaft: Shaft) -> list[str]:
    """Names of all that a shaft drawn with positions carries, along it."""
    positions = shaft.drawn.positions if shaft.drawn is not None else {}
    return sorted(positions, key=lambda name: positions[name])


def torsional_springs(shaft: Shaft) -> Iterator[tuple[str, str, float, float]]:
    """Neighbours that a drawn shaft carries, its stiffness in torsion between, N m/rad, and damping ratio."""
    for one, two in pairwise(in_order(shaft)):
        assert shaft.drawn is not None
        span = shaft.drawn.positions[one], shaft.drawn.positions[two]
        yield one, two, torsional_stiffness(shaft.drawn, span), shaft.drawn.damping_ratio


def drawn_shafts(shafts: Any) -> dict[str, tuple[str, DrawnShaft]]:
    """Gears whose shafts are drawn, with the key and the drawing; of no shafts none."""
    if isinstance(shafts, DrawnShafts):
        known = {side: getattr(shafts, side) for side in SIDES}
        return {side: (f"shaft.{side}", shaft) for side, shaft in known.items() if shaft is not None}
    return {
        shaft.gears[0]: (f"shaft.{number}.drawn", shaft.drawn)
        for number, shaft in enumerate(listed(shafts))
        if shaft.drawn is not None
    }


def broken_shafts(
    shafts: Any, gears: Collection[str], bearings: Bearings | None, bodies: Collection[str] = ()
) -> Iterator[InputError]:
    """Go through what is wrong with shafts that carry some of the `gears`, and of the other `bodies`."""
    rigid: dict[str, str] = {}
    for number, shaft in enumerate(listed(shafts)):
        yield from _broken_in_list(f"shaft.{number}", shaft, gears, bodies)
        carried = {*shaft.gears, *(shaft.drawn.positions if shaft.drawn is not None else ())}
        for name in carried if shaft.stiffness is None else ():
            if rigid.setdefault(name, shaft.name) != shaft.name:
                rule = f"{name} turns with the shaft {rigid[name]} already"
                yield InputError(f"shaft.{number}.gears", None, rule, "write all of its gears there")
    for gear, (key, drawn) in drawn_shafts(shafts).items():
        if gear not in gears and isinstance(shafts, DrawnShafts):
            yield unknown_name(key, gear, gears, "gear")
        yield from broken_shaft(key, drawn)
        if isinstance(shafts, DrawnShafts):
            yield from _broken_places(f"{key}.positions", drawn.positions, [gear], ())
        shaft_of = [one for one in listed(shafts) if gear in one.gears]
        names = gear, *(name for one in shaft_of for name in (one.name, *one.gears, *drawn.positions))
        given = bearings.by_name if bearings is not None and bearings.written_out else ()
        for name in (name for name in names if name in given):
            rule = f"gives the stiffness of the shaft of {gear} again, which [{key}] draws"
            yield InputError(f"bearings.{name}", None, rule, "leave out the one or the other")


def _broken_in_list(
    key: str, shaft: Shaft, gears: Collection[str], bodies: Collection[str]
) -> Iterator[InputError]:
    yield from broken_list(f"{key}.gears", shaft.gears, gears, "gear")
    for name in ("stiffness", "mass", "inertia") if shaft.drawn is not None else ():
        if getattr(shaft, name):
            rule = "follows from the sections of the drawn shaft"
            yield InputError(f"{key}.{name}", None, rule, f"leave {name} out")
    if shaft.drawn is not None and shaft.drawn.positions:
        yield from _broken_places(f"{key}.drawn.positions", shaft.drawn.positions, shaft.gears, bodies)
    elif shaft.drawn is not None and len(shaft.gears) > 1:
        rule = f"has {len(shaft.gears)} gears, and gear_position is the place of one"
        example = ", ".join(f'{name} = "50 mm"' for name in shaft.gears)
        yield InputError(f"{key}.drawn.gear_position", None, rule, f"write positions = {{ {example} }}")
    elif shaft.drawn is None and len(shaft.gears) == 1:
        rule, remedy = "names one gear alone", "name the gears that turn together, or draw the shaft"
        yield InputError(f"{key}.gears", None, rule, remedy)
    elif shaft.stiffness is not None and len(shaft.gears) > 2:
        rule = f"a compliant shaft has two gears, and this has {len(shaft.gears)}"
        remedy = "write one [[shaft]] for every length between two gears"
        yield InputError(f"{key}.gears", None, rule, remedy)
    if shaft.stiffness is None:
        for name in ("damping", "damping_ratio"):
            if shaft.rigid and getattr(shaft, name):
                rule, remedy = "a rigid shaft has no damping", f"add stiffness, or leave {name} out"
                yield InputError(f"{key}.{name}", None, rule, remedy)
    yield from broken_link_law(key, shaft)


def _broken_places(
    key: str, positions: Mapping[str, float], gears: Sequence[str], bodies: Collection[str]
) -> Iterator[InputError]:
    """What is wrong with the names of what a shaft of some gears carries, and where."""
    known = [*gears, *bodies]
    for name in positions:
        if name not in known:
            yield unknown_name(f"{key}.{name}", name, known, "gear of the shaft or [[body]]")
    for name in gears if positions else ():
        if name not in positions:
            rule, remedy = f"has no place for {name}, a gear of the shaft", f'add {name} = "50 mm"'
            yield InputError(key, None, rule, remedy)
