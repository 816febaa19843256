"""Quantities that one study alone reports: solved contact, rolling elements, oscillator; computations."""

from tribodyn.quantities.quantity import Quantity

SOLVED_CONTACT = (
    Quantity(
        "central_film_min",
        "Central film, minimum",
        "µm",
        ".3g",
        "Minimum along the way of the solved mean gap on the line of centres.",
    ),
    Quantity(
        "minimum_film_min",
        "Minimum film, minimum",
        "µm",
        ".3g",
        "Minimum along the way of the solved minimum gap.",
    ),
    Quantity(
        "asperity_load_ratio_max",
        "Load share of the asperities, maximum",
        "%",
        ".3g",
        "Maximum along the way.",
    ),
    Quantity(
        "temperature_rise_max",
        "Temperature rise of the oil, maximum",
        "K",
        ".3g",
        "Mean over the film, maximum over the contact and the way.",
    ),
    Quantity(
        "pressure_max", "Pressure, maximum", "GPa", ".3g", "Of the solved contact, at the places recorded."
    ),
    Quantity(
        "positions_solved",
        "Positions solved",
        digits="d",
        definition="Positions at which the contact was solved.",
    ),
    Quantity(
        "central_film_departure_max",
        "Departure of transient from steady film, maximum",
        "%",
        ".3g",
        "Amount of the central film with squeeze over the steady one, less one; maximum along the way.",
    ),
    Quantity(
        "central_film_departure_mean",
        "Departure of transient from steady film, mean",
        "%",
        ".3g",
        "Mean of the same.",
    ),
    Quantity(
        "minimum_film_departure_max",
        "Departure of transient from steady minimum film, maximum",
        "%",
        ".3g",
        "The same of the minimum film.",
    ),
    Quantity(
        "transient_minimum_film_min",
        "Minimum film with squeeze, minimum",
        "µm",
        ".3g",
        "Minimum along the way of the minimum gap with squeeze.",
    ),
    Quantity(
        "transient_friction_coefficient_mean",
        "Friction coefficient with squeeze, mean",
        digits=".4f",
        definition="Mean along the way, weighted by load and sliding speed.",
    ),
    Quantity(
        "transient_positions_solved",
        "Positions solved with squeeze",
        digits="d",
        definition="Positions that the film was carried through.",
    ),
)


ROLLING = (
    Quantity(
        "ratio",
        "Ratio of input to cam, which turns the other way",
        definition="Speed of the input over that of the cam.",
    ),
    Quantity(
        "eccentricity",
        "Eccentricity",
        "mm",
        definition="Distance of the cage's axis from that of the shaft.",
    ),
    Quantity(
        "elements_loaded_min",
        "Loaded elements, at least",
        digits="d",
        definition="Minimum over the run of the number of elements under load.",
    ),
    Quantity(
        "elements_loaded_max",
        "Loaded elements, at most",
        digits="d",
        definition="Maximum over the run of the number of elements under load.",
    ),
    Quantity(
        "output_torque_mean",
        "Torque on the load, mean",
        "N m",
        definition="Mean torque that the cam gives to the load.",
    ),
    Quantity(
        "output_torque_peak_to_peak",
        "Torque on the load, peak to peak",
        "N m",
        ".3g",
        "Maximum less minimum of the same.",
    ),
    Quantity(
        "slip_speed_max",
        "Maximum slip over the cam",
        "mm/s",
        definition="Maximum speed of an element's surface over that of the cam.",
    ),
    Quantity(
        "spin_speed_max",
        "Maximum rotation of an element in the cage",
        "rad/s",
        definition="Maximum rotation of an element relative to the cage.",
    ),
    Quantity(
        "power_cam_mean",
        "Loss at the cam, mean",
        "W",
        ".3g",
        "Part of the loss that slip between elements and cam takes.",
        below="of it at the cam",
    ),
    Quantity(
        "power_crown_mean",
        "Loss at the crown, mean",
        "W",
        ".3g",
        "Part of the loss that rolling on the crown takes.",
        below="of it at the crown",
    ),
    Quantity(
        "efficiency_by_energy",
        "Efficiency by energy",
        "%",
        ".3f",
        "Power out over power in; in the mode as_published the efficiency itself is the product (23) of the "
        "paper.",
    ),
)


OSCILLATOR = (
    Quantity(
        "points",
        "Points, up and down",
        digits="d",
        definition="Motions that were sought: every frequency on the way up and on the way down.",
    ),
    Quantity(
        "points_of_longer_period",
        "Points with a longer period than the excitation's",
        digits="d",
        definition="Points whose motion repeats after several periods of the excitation.",
        below="with a longer period than the excitation's",
    ),
    Quantity(
        "points_not_periodic",
        "Points that are not periodic",
        digits="d",
        definition="Points without a stable periodic motion of up to the longest period that is sought.",
        below="not periodic",
    ),
    Quantity(
        "points_quasi_periodic",
        "Quasi-periodic points",
        digits="d",
        definition="Points with a second frequency that no multiple of the excitation's meets; Lyapunov "
        "exponent zero.",
        below="of these quasi-periodic",
    ),
    Quantity(
        "points_chaotic",
        "Chaotic points",
        digits="d",
        definition="Points with a positive Lyapunov exponent.",
        below="of these chaotic",
    ),
    Quantity(
        "points_failed",
        "Points grown without bound",
        digits="d",
        definition="Points whose motion grew without bound.",
        below="grown without bound",
    ),
    Quantity(
        "rms_max",
        "Maximum RMS about the mean, in half backlashes",
        definition="Maximum over all points of the root mean square of the displacement about its mean.",
    ),
    Quantity(
        "rms_max_frequency",
        "Frequency of the maximum RMS",
        definition="Frequency of that point over the natural frequency of the oscillator in contact.",
        below="at the frequency",
    ),
    Quantity(
        "contact_loss_from",
        "Contact is lost from the frequency",
        definition="Lowest frequency at which contact is lost for part of the period.",
    ),
    Quantity(
        "contact_loss_to",
        "Contact is lost to the frequency",
        definition="Highest frequency at which contact is lost for part of the period.",
        below="to the frequency",
    ),
    Quantity(
        "contact_loss_fraction_max",
        "Maximum share of the time without contact",
        "%",
        ".3g",
        "Maximum over all points of the share of the period without contact.",
        below="for at most this share of the time",
    ),
    Quantity(
        "back_contact_fraction_max",
        "Contact on the back side, at most",
        "%",
        ".3g",
        "Maximum over all points of the share of the period in contact on the back side.",
    ),
    Quantity(
        "bistable_from",
        "Up and down differ from the frequency",
        definition="Lowest frequency at which the ways up and down end in different motions.",
    ),
    Quantity(
        "bistable_to",
        "Up and down differ to the frequency",
        definition="Highest frequency at which the ways up and down end in different motions.",
        below="to the frequency",
    ),
)


COMPUTATION = (
    Quantity("solver", "Method", definition="Method of integration, chosen or by solver.method."),
    Quantity("steps", "Steps", digits=",d", definition="Steps of the integration."),
    Quantity(
        "rhs_evaluations",
        "Right-hand sides",
        digits=",d",
        definition="Evaluations of the equations of motion.",
    ),
    Quantity(
        "wall_time",
        "Wall time",
        "s",
        ".3g",
        "Time that the computation took, without start and drawing.",
    ),
    Quantity("objective_name", "Objective", definition="Quantity, or sum of quantities, that was sought."),
    Quantity("objective", "Objective at the best", definition="In SI units of its own."),
    Quantity("objective_start", "Objective at the start", definition="In SI units of its own."),
    Quantity("method", "Method", definition="Method of the search, see method_reason in the summary."),
    Quantity("evaluations", "Evaluations", digits=",d", definition="Candidates that were evaluated."),
    Quantity(
        "evaluations_feasible",
        "Feasible evaluations",
        digits=",d",
        definition="Candidates that satisfy all constraints.",
        below="of these feasible",
    ),
    Quantity(
        "evaluations_without_figures",
        "Evaluations without quantities",
        digits=",d",
        definition="Candidates that cannot be made, or for which no state was found; `message` says why.",
        below="of these without quantities",
    ),
)
QUANTITIES = (*SOLVED_CONTACT, *ROLLING, *OSCILLATOR, *COMPUTATION)
