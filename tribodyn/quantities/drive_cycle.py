"""Quantities of a gearbox over a drive cycle."""

from tribodyn.quantities.quantity import Quantity

QUANTITIES = (
    Quantity("cycle_duration", "Duration of the cycle", "s", ".5g").defined_as(
        "From the first row to the last one, all repetitions."
    ),
    Quantity("cycle_energy_in", "Energy in", "kJ", ",.1f").defined_as(
        "Energy that the input has taken at the end: that of the loads and that lost."
    ),
    Quantity("cycle_energy_out", "Energy out", "kJ", ",.1f").defined_as(
        "Integral of the loads' torque times their speed; negative where loads drive more than they take."
    ),
    Quantity("cycle_energy_lost", "Energy lost", "kJ", ",.1f").defined_as(
        "Integral of all losses at the temperatures that they make."
    ),
    Quantity("cycle_efficiency", "Efficiency of the cycle", "%", ".3f").defined_as(
        "Energy out over energy in, where the loads take more than they give."
    ),
    Quantity("cycle_loss_mean", "Loss, mean", "W", ".4g").defined_as("Energy lost over the duration."),
    Quantity("cycle_loss_max", "Loss, maximum", "W", ".4g").defined_as("Maximum over the rows."),
    Quantity("cycle_heat_stored", "Heat stored at the end", "kJ", ",.1f").defined_as(
        "Heat capacities of all parts times what they have warmed since the start."
    ),
    Quantity("cycle_heat_gone", "Heat given off", "kJ", ",.1f").defined_as(
        "Heat that has left to the surroundings, the coolant and the oil that flows through."
    ),
    Quantity("cycle_oil_temperature_max", "Temperature of the oil, maximum", "°C", ".1f").defined_as(
        "Maximum over the rows of the temperature of the sump."
    ),
    Quantity("cycle_oil_temperature_end", "Temperature of the oil at the end", "°C", ".1f").defined_as(
        "Temperature of the sump at the last row."
    ),
    Quantity("cycle_bulk_temperature_max", "Bulk temperature of the teeth, maximum", "°C", ".1f").defined_as(
        "Maximum over rows and meshes of the mean of both gears."
    ),
    Quantity("cycle_hottest_part", "Warmest part").defined_as(
        "The part of the thermal network that gets warmest."
    ),
    Quantity("cycle_heat_balance", "Heat not accounted for, share of the loss", digits=".1e").defined_as(
        "Maximum over the rows of heat that has arisen and is neither stored nor given off, over all heat."
    ),
    Quantity("cycle_loss_error", "Losses integrated against evaluated", digits=".1e").defined_as(
        "Maximum difference over the rows of the losses that were integrated, interpolated over the "
        "temperature, and of those evaluated at it, over the largest loss."
    ),
)
