"""Quantities of a gearbox's loss map."""

from tribodyn.quantities.quantity import Quantity

GRID = (
    Quantity("map_points", "Points of the map", "", ",d").defined_as(
        "Nodes of its grid: torques times speeds times temperatures of the oil."
    ),
    Quantity("map_points_evaluated", "Points evaluated", "", ",d").defined_as(
        "The same and the points between nodes, by which the grid was refined and checked."
    ),
    Quantity("map_error_max", "Interpolation misses by at most", "%", ".2g").defined_as(
        "Of the drag at points in between that the grid was not refined by; a drag below 2 % of the largest "
        "over the torque counts as that."
    ),
    Quantity("map_error_mean", "Interpolation misses by, mean", "%", ".2g").defined_as(
        "Mean of the same over points that lie evenly between the ends of all axes."
    ),
)
OWN_POINT = (
    Quantity("own_torque", "Torque of the loads", "N m", ".4g").defined_as(
        "At the output, of the gearbox's own scenario."
    ),
    Quantity("own_speed", "Speed of the input", "rpm", ".4g").defined_as("Of the gearbox's own scenario."),
    Quantity("own_power_loss", "Power lost", "W", ".4g").defined_as(
        "By all sources at the torque, speed and oil temperature of the gearbox's own scenario."
    ),
    Quantity("efficiency_own", "Efficiency", "%", ".3f").defined_as("Power out over power in at that point."),
)
EXTREMES = (
    Quantity("efficiency_max", "Highest efficiency", "%", ".3f").defined_as(
        "Of all nodes of the map, at a standstill its limit."
    ),
    Quantity("power_loss_max", "Largest loss", "W", ".4g").defined_as("Of all nodes of the map."),
    Quantity("stall_drag_max", "Largest drag at a standstill", "N m", ".4g").defined_as(
        "Torque at the input that friction takes as a motion begins, of all nodes at speed 0."
    ),
    Quantity("backlash_output", "Backlash at the output", "°", ".3g").defined_as(
        "Angle by which the output can turn with the input held."
    ),
)
QUANTITIES = (*GRID, *OWN_POINT, *EXTREMES)
