"""Methods for the friction of rolling bearings by the names that a scenario has."""

from collections.abc import Mapping
from typing import NamedTuple

from tribodyn.tribology.losses.bearings import BALLS, BearingFormula
from tribodyn.tribology.losses.iso_bearings import (
    BATH_FACTORS,
    FRICTION_COEFFICIENTS,
    iso_14179_1,
    iso_14179_2,
)
from tribodyn.tribology.losses.palmgren import DRAG_FACTORS, palmgren
from tribodyn.tribology.losses.skf import skf
from tribodyn.tribology.losses.skf_constants import CONSTANTS


class BearingMethod(NamedTuple):
    """A formula, and what it asks of a bearing."""

    formula: BearingFormula
    #: types that it knows, and the series of each; none: it does not distinguish them
    series: Mapping[str, tuple[str, ...]]
    sizes: tuple[str, ...] = ()  # sizes without which it has no result
    #: types whose loss under load needs the static rating
    rated: tuple[str, ...] = ()


def _series(known: Mapping[str, Mapping[str, object]]) -> dict[str, tuple[str, ...]]:
    return {kind: tuple(filter(None, table)) for kind, table in known.items()}


BEARING_METHODS = {
    "palmgren": BearingMethod(palmgren, dict.fromkeys(DRAG_FACTORS, ()), rated=BALLS),
    "iso-14179-1": BearingMethod(
        iso_14179_1,
        {kind: _series(BATH_FACTORS)[kind] for kind in FRICTION_COEFFICIENTS},
        ("bore",),
    ),
    "iso-14179-2": BearingMethod(iso_14179_2, _series(BATH_FACTORS), rated=BALLS),
    "skf": BearingMethod(skf, _series(CONSTANTS), ("bore", "outside_diameter"), ("deep-groove-ball",)),
}
