"""Quantities of a gear with rolling elements."""

from tribodyn.quantities.quantity import Quantity

QUANTITIES = (
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
