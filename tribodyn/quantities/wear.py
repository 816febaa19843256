"""Quantities of a wear study: what is worn off, and what becomes of loads, errors and films."""

from tribodyn.quantities.quantity import Quantity

QUANTITIES = (
    Quantity("wear_revolutions", "Revolutions of the pinion", digits=",.0f").defined_as(
        "Revolutions of the pinion at the end of the run, of which each is a load cycle of its teeth."
    ),
    Quantity("wear_time", "Time of running", "h", ",.1f").defined_as("The same at the pinion's speed."),
    Quantity("pinion_worn_depth_max", "Maximum depth worn off, pinion", "µm", ".3g").defined_as(
        "Maximum over flank and face of the depth along the normal that is worn off the pinion's teeth, the "
        "mean of all its teeth."
    ),
    Quantity("gear_worn_depth_max", "Maximum depth worn off, gear", "µm", ".3g").defined_as(
        "The same of the gear."
    ),
    Quantity("pinion_worn_volume", "Volume worn off, pinion", "mm³", ".4g").defined_as(
        "Volume missing on the flanks of all teeth of the pinion."
    ),
    Quantity("gear_worn_volume", "Volume worn off, gear", "mm³", ".4g").defined_as("The same of the gear."),
    Quantity("pinion_worn_mass", "Mass worn off, pinion", "mg", ".4g").defined_as(
        "The same volume times the density of the pinion's material."
    ),
    Quantity("gear_worn_mass", "Mass worn off, gear", "mg", ".4g").defined_as("The same of the gear."),
    Quantity("debris_rate", "Debris of both gears", "mg/h", ".3g").defined_as(
        "Mass worn off both gears per time at the end of the run."
    ),
    Quantity("debris_rate_unworn", "Debris, new flanks", "mg/h", ".3g", below="of new flanks").defined_as(
        "The same of new flanks."
    ),
    Quantity(
        "loaded_transmission_error_peak_to_peak_unworn",
        "Loaded transmission error, peak to peak, new flanks",
        "µm",
        below="of new flanks",
    ).defined_as("Peak to peak of the loaded transmission error before anything is worn."),
    Quantity(
        "hertz_pressure_max_unworn", "Maximum Hertz pressure, new flanks", "GPa", ".3g", below="of new flanks"
    ).defined_as("Maximum Hertz pressure before anything is worn."),
    Quantity(
        "power_friction_mean_unworn", "Loss to friction, new flanks", "W", below="of new flanks"
    ).defined_as("Mean power of tooth friction before anything is worn."),
    Quantity("film_min_unworn", "Minimum film, new flanks", "µm", ".3g", below="of new flanks").defined_as(
        "Minimum film before anything is worn."
    ),
    Quantity(
        "film_parameter_min_unworn",
        "Minimum film over roughness, new flanks",
        digits=".3g",
        below="of new flanks",
    ).defined_as("Minimum film over roughness before anything is worn."),
    Quantity("corner_sliding_share", "Sliding in corner contact", "%", ".2g").defined_as(
        "Share of the integral of load and sliding speed that is off the path of contact, where the corner "
        "of a tip touches; it wears nothing here. At the end of the run."
    ),
    Quantity("wear_balance", "Residual of the worn volume", digits=".1e").defined_as(
        "Volume missing on the flanks over the integral over time of wear coefficient, load and sliding "
        "speed, less 1; the larger magnitude of both gears."
    ),
    Quantity("wear_steps", "Steps", digits=",d").defined_as("Steps over the revolutions."),
    Quantity("wear_steps_rejected", "Steps halved", digits=",d").defined_as(
        "Steps that moved the load of a place by more than `wear.load_change`."
    ),
)
