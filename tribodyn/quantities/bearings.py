"""Quantities of shafts and their bearings under the mean load of the mesh."""

from tribodyn.quantities.quantity import Quantity

#: Of each bearing of a drawn shaft.
BEARINGS = (
    Quantity("radial_load", "Radial load", "N", ",.0f", symbol="F_r").defined_as(
        "Across the axis, on the bearing, under the mean load of the mesh."
    ),
    Quantity("axial_load", "Axial load", "N", ",.0f", symbol="F_a").defined_as(
        "Along the axis, on the bearing; of tapered roller bearings with what the other one pushes."
    ),
    Quantity("tilting_moment", "Tilting moment", "N m", ".3g").defined_as(
        "By which the tilted shaft loads the bearing besides."
    ),
    Quantity("equivalent_load", "Equivalent dynamic load", "N", ",.0f", symbol="P").defined_as(
        "P = X F_r + Y F_a of ISO 281."
    ),
    Quantity("rating_life", "Basic rating life", "h", ",.0f", symbol="L_10h").defined_as(
        "That 90 % of such bearings reach at the duty's speed: (C/P)^p 10⁶ revolutions, ISO 281."
    ),
    Quantity("viscosity_ratio", "Viscosity ratio", "", ".2f", symbol="κ").defined_as(
        "ν/ν_1: of the oil at its temperature over what the bearing needs at the duty's speed, ISO 281."
    ),
    Quantity("life_factor", "Life modification factor", "", ".2f", symbol="a_ISO").defined_as(
        "By lubrication, contamination and fatigue limit, ISO 281; at most 50."
    ),
    Quantity("modified_life", "Modified rating life", "h", ",.0f", symbol="L_10mh").defined_as(
        "a_ISO L_10h, ISO 281."
    ),
    Quantity("reference_life", "Basic reference rating life", "h", ",.0f", symbol="L_10rh").defined_as(
        "By the loads of all rolling elements, clearance and tilt included, ISO/TS 16281."
    ),
    Quantity("power_bearing", "Loss", "W", ",.1f").defined_as(
        "By Palmgren's friction moments: of the oil bath, and of the load."
    ),
)
TILTS = (
    Quantity(
        "shaft_misalignment", "Misalignment by shafts and bearings", "µm", ".3g", symbol="f_sh"
    ).defined_as(
        "By how much shafts and bearings open the flanks from one end of the common face to the other, in "
        "the plane of action, under the mean load of the mesh; positive where the end at larger z opens."
    ),
    Quantity("given_misalignment", "Misalignment of the scenario", "µm", ".3g").defined_as(
        "The same by mesh.misalignment, which adds to it."
    ),
)
QUANTITIES = (*BEARINGS, *TILTS)
