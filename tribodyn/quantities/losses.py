"""Quantities of gear pairs: film and friction, energy, temperature, load spectrum."""

from tribodyn.quantities.quantity import Quantity

CONTACTS = (
    Quantity("film_min", "Minimum film thickness", "µm", ".3g").defined_as(
        "Minimum of all pairs under load; the central film, or the minimum film where the law gives that."
    ),
    Quantity("film_parameter_min", "Minimum film parameter", digits=".3g", symbol="λ").defined_as(
        "Minimum of film thickness over composite RMS roughness. Below 1 mixed to boundary, above 3 full "
        "film lubrication."
    ),
    Quantity(
        "film_parameter_min_roll_angle",
        "Roll angle of the minimum film parameter",
        "°",
        ".3g",
        below="at the roll angle from the pitch point",
    ).defined_as(
        "Rotation of the pinion since the pair with the minimum film parameter passed the pitch point; "
        "negative before it."
    ),
    Quantity("hertz_pressure_max", "Maximum Hertz pressure", "GPa", ".3g").defined_as(
        "Maximum of the pressure in the middle of the dry contact, at the highest line load along the face."
    ),
    Quantity("flash_temperature_max", "Maximum flash temperature rise", "K", ".3g").defined_as(
        "Maximum rise of the contact's temperature above the bulk of the teeth, which is as warm as the oil "
        "where [temperature] does not say otherwise."
    ),
    Quantity("friction_coefficient_mean", "Friction coefficient, mean", digits=".4f").defined_as(
        "Mean weighted with normal load times sliding speed: the coefficient that gives the same loss."
    ),
    Quantity("friction_force_mean", "Friction force, mean over the cycle", "N", ".1f").defined_as(
        "Mean magnitude, by number of the pair; zero while a number has no contact."
    ),
    Quantity("closure_in_range_fraction", "Contact in the range of the film law", "%", ".3g").defined_as(
        "Share of the samples under load in which the film law is inside its range of validity."
    ),
    Quantity("friction_in_range_fraction", "Contact in the range of the friction law", "%", ".3g").defined_as(
        "Share of the samples under load in which the friction law is inside its range of validity."
    ),
)
ENERGY = (
    Quantity("driving_gear", "Driving gear").defined_as(
        "The gear that puts power in, by the sign of the mean powers."
    ),
    Quantity("power_in_mean", "Power in, mean", "W", ",.1f").defined_as(
        "Mean power that the driving gear or shaft puts in, from its integrated work."
    ),
    Quantity("power_friction_mean", "Loss to friction, mean", "W", ".4g").defined_as(
        "Mean power of the friction forces of teeth or rolling elements, from their integrated work."
    ),
    Quantity("power_damping_mean", "Loss to damping of mesh and bearings, mean", "W", ".3g").defined_as(
        "Mean power of the damping forces of mesh and bearings, from their integrated work."
    ),
    Quantity(
        "friction_work_on_vibration", "Friction's work on the vibration, share of the loss", "%", ".2g"
    ).defined_as(
        "Work that friction does on the vibration over the loss that the rotation alone would have; positive "
        "where friction feeds the vibration."
    ),
    Quantity("efficiency", "Efficiency", "%", ".3f").defined_as(
        "Mean power out over mean power in, by energy over whole cycles; withheld outside 0 … 100 %."
    ),
    Quantity("load_sharing", "Load sharing of the samples").defined_as(
        "How the pairs share the load in the samples and in all lines above: operating or "
        "efficiency.load_sharing."
    ),
    Quantity("efficiency_elastic", "Efficiency, elastic load sharing", "%", ".3f").defined_as(
        "Mean power out over mean power in, loads shared by the pairs' stiffness."
    ),
    Quantity("efficiency_uniform", "Efficiency, equal loads", "%", ".3f").defined_as(
        "The same, the load divided equally among the pairs in contact."
    ),
    Quantity("efficiency_single_pair", "Efficiency, one pair at a time", "%", ".3f").defined_as(
        "The same, one pair at a time."
    ),
    Quantity("efficiency_torque_ratio", "Efficiency, torque ratio of one pair", "%", ".3f").defined_as(
        "Mean ratio of torques over the path of contact of one pair that carries the load alone."
    ),
    Quantity("efficiency_loss_factor", "Efficiency, loss factor integrated", "%", ".3f").defined_as(
        "1 − μ H_v of an involute pair with a constant coefficient, H_v integrated over the path of contact."
    ),
    Quantity("efficiency_hoehn", "Efficiency, Höhn's loss factor", "%", ".3f").defined_as(
        "The same with the closed form of H_v by Höhn, for contact ratios from 1 to 2."
    ),
    Quantity("loss_fraction", "Loss, share of the power in", "%", ".3f").defined_as(
        "One less the efficiency."
    ),
)
TEMPERATURE = (
    Quantity("bulk_temperature", "Bulk temperature of the teeth", "°C", ".1f").defined_as(
        "Mean of both gears, from the losses by [temperature]; film and friction are taken at it."
    ),
    Quantity("contact_temperature_max", "Maximum contact temperature", "°C", ".1f").defined_as(
        "Bulk temperature of the teeth, or that of the oil where [temperature] does not say otherwise, and "
        "the maximum flash temperature rise."
    ),
    Quantity("oil_temperature", "Temperature of the oil around the gears", "°C", ".1f").defined_as(
        "Given, or that of the network of [temperature]."
    ),
    Quantity("power_churning", "Loss to churning", "W", ".3g").defined_as(
        "By the formula of losses.churning."
    ),
    Quantity("power_windage", "Loss to windage", "W", ".3g").defined_as("By the formula of losses.windage."),
    Quantity("power_squeezing", "Loss to oil sprayed into the mesh", "W", ".3g").defined_as(
        "By the formula of losses.squeezing."
    ),
    Quantity("power_bearings_under_load", "Loss to bearings under load", "W", ".3g").defined_as(
        "What the load adds by the formula of losses.bearings, at the nominal load."
    ),
    Quantity("power_seals", "Loss to seals", "W", ".3g").defined_as("By the formula of losses.seals."),
    Quantity("power_carriers", "Loss to planet carriers in the oil", "W", ".3g").defined_as(
        "By the formula of losses.carrier."
    ),
    Quantity("power_pump", "Loss to the oil pump", "W", ".3g").defined_as(
        "Its pressure times its flow over its efficiency."
    ),
    Quantity("power_bearings", "Loss to bearings without load", "W", ".3g").defined_as(
        "By the formula of losses.bearings."
    ),
    Quantity("power_load_independent", "Load-independent losses", "W", ".3g").defined_as(
        "Losses without load by the formulas of [losses]; not in the lines above."
    ),
    Quantity("efficiency_with_losses", "Efficiency, all losses included", "%", ".3f").defined_as(
        "Power out over power in, to which all losses of [losses] are added."
    ),
)
SPECTRUM = (
    Quantity("spectrum_efficiency", "Efficiency over the load spectrum", "%", ".3f").defined_as(
        "Energy put out over energy put in, all duties with their shares of time."
    ),
    Quantity(
        "spectrum_power_friction_mean", "Loss to friction over the load spectrum", "W", ".3g"
    ).defined_as("Mean over time of the duties' losses."),
    Quantity("duty_share", "Share of time, by duty", "%", ".3g", listed=True).defined_as(
        "Shares of the duties, their sum 100 %."
    ),
    Quantity("duty_efficiency", "Efficiency, by duty", "%", ".3f", listed=True).defined_as(
        "Efficiency of each duty."
    ),
    Quantity("duty_power_friction_mean", "Loss to friction, by duty", "W", ".3g", listed=True).defined_as(
        "Mean loss during each duty."
    ),
    Quantity(
        "duty_film_parameter_min", "Minimum film parameter, by duty,", digits=".3g", symbol="λ", listed=True
    ).defined_as("Minimum of each duty."),
    Quantity(
        "duty_hertz_pressure_max", "Maximum Hertz pressure, by duty", "GPa", ".3g", listed=True
    ).defined_as("Maximum of each duty."),
)
QUANTITIES = (*CONTACTS, *ENERGY, *TEMPERATURE, *SPECTRUM)
