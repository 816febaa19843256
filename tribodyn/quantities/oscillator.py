"""Quantities of the backlash oscillator, all of them dimensionless."""

from tribodyn.quantities.quantity import Quantity

QUANTITIES = (
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
