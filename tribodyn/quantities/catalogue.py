"""All reported quantities by name."""

from collections.abc import Mapping

from tribodyn.quantities import computation, load, losses, motion, oscillator, rolling, solved
from tribodyn.quantities.quantity import Quantity

QUANTITIES: Mapping[str, Quantity] = {
    quantity.name: quantity
    for module in (motion, losses, load, solved, rolling, oscillator, computation)
    for quantity in module.QUANTITIES
}


def quantities(*names: str) -> tuple[Quantity, ...]:
    """Quantities of the catalogue by name."""
    return tuple(QUANTITIES[name] for name in names)


def scatter_of(name: str) -> Quantity:
    """Percentiles of a quantity over samples of the deviations that a tolerance class allows."""
    return QUANTITIES[name]._replace(
        name=f"{name}_spread",
        label=f"{QUANTITIES[name].label}, over samples: median, 5, 95 %",
        digits=".3f",
        definition="Percentiles of the same over samples of the deviations that the tolerance class allows.",
        symbol="",
        below="over samples: median, 5, 95 %",
        listed=True,
    )
