"""Quantities of one study alone: solved contact, rolling elements, oscillator, wear; and of computations."""

from tribodyn.quantities.quantity import Quantity

SOLVED_CONTACT = (
    Quantity("central_film_min", "Central film, minimum", "µm", ".3g").defined_as(
        "Minimum along the way of the solved mean gap on the line of centres."
    ),
    Quantity("minimum_film_min", "Minimum film, minimum", "µm", ".3g").defined_as(
        "Minimum along the way of the solved minimum gap."
    ),
    Quantity("asperity_load_ratio_max", "Load share of the asperities, maximum", "%", ".3g").defined_as(
        "Maximum along the way."
    ),
    Quantity("temperature_rise_max", "Temperature rise of the oil, maximum", "K", ".3g").defined_as(
        "Mean over the film, maximum over the contact and the way."
    ),
    Quantity("pressure_max", "Pressure, maximum", "GPa", ".3g").defined_as(
        "Of the solved contact, at the places recorded."
    ),
    Quantity("positions_solved", "Positions solved", digits="d").defined_as(
        "Positions at which the contact was solved."
    ),
    Quantity(
        "central_film_departure_max", "Departure of transient from steady film, maximum", "%", ".3g"
    ).defined_as(
        "Amount of the central film with squeeze over the steady one, less one; maximum along the way."
    ),
    Quantity(
        "central_film_departure_mean", "Departure of transient from steady film, mean", "%", ".3g"
    ).defined_as("Mean of the same."),
    Quantity(
        "minimum_film_departure_max", "Departure of transient from steady minimum film, maximum", "%", ".3g"
    ).defined_as("The same of the minimum film."),
    Quantity("transient_minimum_film_min", "Minimum film with squeeze, minimum", "µm", ".3g").defined_as(
        "Minimum along the way of the minimum gap with squeeze."
    ),
    Quantity(
        "transient_friction_coefficient_mean", "Friction coefficient with squeeze, mean", digits=".4f"
    ).defined_as("Mean along the way, weighted by load and sliding speed."),
    Quantity("transient_positions_solved", "Positions solved with squeeze", digits="d").defined_as(
        "Positions that the film was carried through."
    ),
)


ROLLING = (
    Quantity("ratio", "Ratio of input to cam, which turns the other way").defined_as(
        "Speed of the input over that of the cam."
    ),
    Quantity("eccentricity", "Eccentricity", "mm").defined_as(
        "Distance of the cage's axis from that of the shaft."
    ),
    Quantity("elements_loaded_min", "Loaded elements, at least", digits="d").defined_as(
        "Minimum over the run of the number of elements under load."
    ),
    Quantity("elements_loaded_max", "Loaded elements, at most", digits="d").defined_as(
        "Maximum over the run of the number of elements under load."
    ),
    Quantity("output_torque_mean", "Torque on the load, mean", "N m").defined_as(
        "Mean torque that the cam gives to the load."
    ),
    Quantity("output_torque_peak_to_peak", "Torque on the load, peak to peak", "N m", ".3g").defined_as(
        "Maximum less minimum of the same."
    ),
    Quantity("slip_speed_max", "Maximum slip over the cam", "mm/s").defined_as(
        "Maximum speed of an element's surface over that of the cam."
    ),
    Quantity("spin_speed_max", "Maximum rotation of an element in the cage", "rad/s").defined_as(
        "Maximum rotation of an element relative to the cage."
    ),
    Quantity("power_cam_mean", "Loss at the cam, mean", "W", ".3g", below="of it at the cam").defined_as(
        "Part of the loss that slip between elements and cam takes."
    ),
    Quantity(
        "power_crown_mean", "Loss at the crown, mean", "W", ".3g", below="of it at the crown"
    ).defined_as("Part of the loss that rolling on the crown takes."),
    Quantity("power_element_max", "Maximum loss of an element", "W", ".4g").defined_as(
        "Maximum power that one element loses at cam and crown together, N_S of the paper."
    ),
    Quantity("efficiency_by_energy", "Efficiency by energy", "%", ".3f").defined_as(
        "Power out over power in; in the mode as_published the efficiency itself is the product (23) of the "
        "paper."
    ),
)


OSCILLATOR = (
    Quantity("points", "Points, up and down", digits="d").defined_as(
        "Motions that were sought: every frequency on the way up and on the way down."
    ),
    Quantity(
        "points_of_longer_period",
        "Points with a longer period than the excitation's",
        digits="d",
        below="with a longer period than the excitation's",
    ).defined_as("Points whose motion repeats after several periods of the excitation."),
    Quantity(
        "points_not_periodic", "Points that are not periodic", digits="d", below="not periodic"
    ).defined_as("Points without a stable periodic motion of up to the longest period that is sought."),
    Quantity(
        "points_quasi_periodic", "Quasi-periodic points", digits="d", below="of these quasi-periodic"
    ).defined_as(
        "Points with a second frequency that no multiple of the excitation's meets; Lyapunov exponent zero."
    ),
    Quantity("points_chaotic", "Chaotic points", digits="d", below="of these chaotic").defined_as(
        "Points with a positive Lyapunov exponent."
    ),
    Quantity(
        "points_failed", "Points grown without bound", digits="d", below="grown without bound"
    ).defined_as("Points whose motion grew without bound."),
    Quantity("rms_max", "Maximum RMS about the mean, in half backlashes").defined_as(
        "Maximum over all points of the root mean square of the displacement about its mean."
    ),
    Quantity("rms_max_frequency", "Frequency of the maximum RMS", below="at the frequency").defined_as(
        "Frequency of that point over the natural frequency of the oscillator in contact."
    ),
    Quantity("contact_loss_from", "Contact is lost from the frequency").defined_as(
        "Lowest frequency at which contact is lost for part of the period."
    ),
    Quantity("contact_loss_to", "Contact is lost to the frequency", below="to the frequency").defined_as(
        "Highest frequency at which contact is lost for part of the period."
    ),
    Quantity(
        "contact_loss_fraction_max",
        "Maximum share of the time without contact",
        "%",
        ".3g",
        below="for at most this share of the time",
    ).defined_as("Maximum over all points of the share of the period without contact."),
    Quantity("back_contact_fraction_max", "Contact on the back side, at most", "%", ".3g").defined_as(
        "Maximum over all points of the share of the period in contact on the back side."
    ),
    Quantity("bistable_from", "Up and down differ from the frequency").defined_as(
        "Lowest frequency at which the ways up and down end in different motions."
    ),
    Quantity("bistable_to", "Up and down differ to the frequency", below="to the frequency").defined_as(
        "Highest frequency at which the ways up and down end in different motions."
    ),
)


COMPUTATION = (
    Quantity("solver", "Method").defined_as("Method of integration, chosen or by solver.method."),
    Quantity("steps", "Steps", digits=",d").defined_as("Steps of the integration."),
    Quantity("rhs_evaluations", "Right-hand sides", digits=",d").defined_as(
        "Evaluations of the equations of motion."
    ),
    Quantity("wall_time", "Wall time", "s", ".3g").defined_as(
        "Time that the computation took, without start and drawing."
    ),
    Quantity("objective_name", "Objective").defined_as("Quantity, or sum of quantities, that was sought."),
    Quantity("objective", "Objective at the best").defined_as("In SI units of its own."),
    Quantity("objective_start", "Objective at the start").defined_as("In SI units of its own."),
    Quantity("method", "Method").defined_as("Method of the search, see method_reason in the summary."),
    Quantity("evaluations", "Evaluations", digits=",d").defined_as(
        "Candidates that were evaluated on the scenario's own resolution: at most `design.evaluations`."
    ),
    Quantity(
        "evaluations_finer", "Evaluations on finer resolutions", digits=",d", below="besides, finer"
    ).defined_as("Evaluations of the last stage, on 2 to 47 times the resolution."),
    Quantity(
        "evaluations_about", "Evaluations about the best", digits=",d", below="besides, about the best"
    ).defined_as("Each key and each tolerance moved alone, and the confirmation of start and best."),
    Quantity("evaluations_total", "Evaluations in all", digits=",d").defined_as(
        "All of these, and the start on every resolution."
    ),
    Quantity(
        "evaluations_feasible", "Feasible evaluations", digits=",d", below="of these feasible"
    ).defined_as("Candidates that satisfy all constraints."),
    Quantity(
        "evaluations_without_quantities",
        "Evaluations without quantities",
        digits=",d",
        below="of these without quantities",
    ).defined_as("Candidates that cannot be made, or for which no state was found; `message` says why."),
)
QUANTITIES = (*SOLVED_CONTACT, *ROLLING, *OSCILLATOR, *COMPUTATION)
#: What is worn off, and what becomes of loads, errors and films.
WEAR = (
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
