"""Quantities of gear pairs: geometry, motion, stiffness, loads."""

from tribodyn.quantities.quantity import Quantity

GEOMETRY = (
    Quantity(
        "contact_ratio",
        "Contact ratio",
        digits=".4f",
        definition="Rotation of the pinion during which a pair touches over the pitch between two pairs; "
        "unloaded teeth.",
    ),
    Quantity(
        "contact_ratio_effective",
        "Contact ratio under load, corner contact included",
        digits=".4f",
        definition="The same under load, with elastic teeth: rotation during which a pair carries load.",
    ),
    Quantity(
        "normal_backlash",
        "Normal backlash",
        "mm",
        definition="Between the back flanks at the pitch point: of mesh.backlash, or of centre distance and "
        "tooth thickness.",
    ),
    Quantity(
        "specific_sliding_max",
        "Specific sliding, maximum",
        digits=".3f",
        definition="Largest magnitude along the path of contact of a flank's speed less its mate's, over the "
        "flank's own.",
    ),
    Quantity(
        "stiffness_single_pair_at_pitch_point",
        "Stiffness of one pair at the pitch point",
        "N/µm",
        definition="Load over deflection of one pair along its normal, the whole torque on this pair; with a "
        "load-dependent contact the tangent.",
    ),
)
MOTION = (
    Quantity(
        "mesh_frequency",
        "Mesh frequency",
        "Hz",
        definition="Pairs or elements that pass per second: of gears the pinion's teeth times its mean speed "
        "in revolutions per second.",
    ),
    Quantity(
        "transmission_error_mean",
        "Transmission error, mean",
        "µm",
        definition="Mean of r_p θ_p − r_g θ_g, the gears' rotations less the nominal ones at their pitch "
        "radii.",
    ),
    Quantity(
        "transmission_error_rms",
        "Transmission error, RMS",
        "µm",
        definition="Root mean square of the same about its mean.",
    ),
    Quantity(
        "transmission_error_peak_to_peak",
        "Transmission error, peak to peak",
        "µm",
        definition="Maximum less minimum of r_p θ_p − r_g θ_g, between the samples too.",
    ),
    Quantity(
        "transmission_error_harmonics",
        "Transmission error, orders 1 to 5 of the mesh",
        "µm",
        ".3g",
        "Amplitudes of the same at 1 to 5 times the mesh frequency.",
        listed=True,
    ),
    Quantity(
        "transmission_error_normal_mean",
        "Deflection along the normal, mean",
        "µm",
        definition="Mean of the newest pair's deflection along its normal, its gap not subtracted.",
    ),
    Quantity(
        "transmission_error_normal_peak_to_peak",
        "Deflection along the normal, peak to peak",
        "µm",
        definition="Maximum less minimum of the same, between the samples too.",
    ),
    Quantity(
        "mesh_stiffness_mean",
        "Mesh stiffness, mean",
        "N/µm",
        definition="Stiffness of all pairs along the pitch tangent: in motion Σ k cos² α over the loaded "
        "pairs with k along normals at the angle α; in slow rotation the load's derivative by the error.",
    ),
    Quantity(
        "mesh_stiffness_peak_to_peak",
        "Mesh stiffness, peak to peak",
        "N/µm",
        definition="Maximum less minimum of the same, in the samples.",
    ),
    Quantity(
        "normal_load_max",
        "Maximum normal load",
        "N",
        ",.0f",
        "Maximum of a single pair or rolling element, along its normal.",
    ),
    Quantity(
        "shared_load_max",
        "Maximum normal load of a pair among others",
        "N",
        ",.0f",
        "Maximum of a pair while two or more are on their path.",
    ),
    Quantity(
        "dynamic_factor",
        "Dynamic factor",
        digits=".3f",
        definition="Maximum of the loads' moment over that of the mean load, from the motion.",
        symbol="K_v",
    ),
    Quantity(
        "dynamic_factor_iso",
        "Dynamic factor by ISO 6336-1, method B,",
        digits=".3f",
        definition="From formulas for the deviations of the drive's quality, K_A = 1, no tip relief; "
        "involutes with a quality only.",
        symbol="K_v",
    ),
    Quantity(
        "resonance_ratio_iso",
        "Resonance ratio by ISO 6336-1",
        digits=".3f",
        definition="Speed over the resonance speed of the standard, rigid bearings; 0.85 to 1.15 is the main "
        "resonance.",
        symbol="N",
        below="at the resonance ratio",
    ),
    Quantity(
        "contact_loss_fraction",
        "Time without contact",
        "%",
        ".3g",
        "Share of the samples in which no pair carries load.",
    ),
)
QUANTITIES = (*GEOMETRY, *MOTION)
