"""Quantities of gear pairs and of signals: geometry, motion, stiffness, loads, numbers of sensors."""

from tribodyn.quantities.quantity import Quantity

GEOMETRY = (
    Quantity("contact_ratio", "Contact ratio", digits=".4f").defined_as(
        "Rotation of the pinion during which a pair touches over the pitch between two pairs; unloaded teeth."
    ),
    Quantity("overlap_ratio", "Overlap ratio", digits=".4f", symbol="ε_β").defined_as(
        "Of helical gears: common face width times tan β over the pitch on the reference circles; the "
        "contact ratio is that of the transverse section."
    ),
    Quantity("total_contact_ratio", "Total contact ratio", digits=".4f", symbol="ε_γ").defined_as(
        "Of helical gears: contact ratio and overlap ratio together."
    ),
    Quantity("slices", "Slices along the face", digits="d").defined_as(
        "Number of slices into which the face of a helical pair is cut."
    ),
    Quantity(
        "contact_ratio_effective", "Contact ratio under load, corner contact included", digits=".4f"
    ).defined_as("The same under load, with elastic teeth: rotation during which a pair carries load."),
    Quantity("normal_backlash", "Normal backlash", "mm").defined_as(
        "Between the back flanks at the pitch point: of mesh.backlash, or of centre distance and tooth "
        "thickness."
    ),
    Quantity("specific_sliding_max", "Specific sliding, maximum", digits=".3f").defined_as(
        "Largest magnitude along the path of contact of a flank's speed less its mate's, over the flank's "
        "own."
    ),
    Quantity(
        "stiffness_single_pair_at_pitch_point", "Stiffness of one pair at the pitch point", "N/µm"
    ).defined_as(
        "Load over deflection of one pair along its normal, the whole torque on this pair; with a "
        "load-dependent contact the tangent."
    ),
)
MOTION = (
    Quantity("mesh_frequency", "Mesh frequency", "Hz").defined_as(
        "Pairs or elements that pass per second: of gears the pinion's teeth times its mean speed in "
        "revolutions per second."
    ),
    Quantity("transmission_error_mean", "Transmission error, mean", "µm").defined_as(
        "Mean of r_p θ_p − r_g θ_g, the gears' rotations less the nominal ones at their pitch radii."
    ),
    Quantity("transmission_error_rms", "Transmission error, RMS", "µm").defined_as(
        "Root mean square of the same about its mean."
    ),
    Quantity("transmission_error_peak_to_peak", "Transmission error, peak to peak", "µm").defined_as(
        "Maximum less minimum of r_p θ_p − r_g θ_g, between the samples too."
    ),
    Quantity(
        "transmission_error_harmonics",
        "Transmission error, orders 1 to 5 of the mesh",
        "µm",
        ".3g",
        listed=True,
    ).defined_as("Amplitudes of the same at 1 to 5 times the mesh frequency."),
    Quantity("transmission_error_normal_mean", "Deflection along the normal, mean", "µm").defined_as(
        "Mean of the newest pair's deflection along its normal, its gap not subtracted."
    ),
    Quantity(
        "transmission_error_normal_peak_to_peak", "Deflection along the normal, peak to peak", "µm"
    ).defined_as("Maximum less minimum of the same, between the samples too."),
    Quantity("mesh_stiffness_mean", "Mesh stiffness, mean", "N/µm").defined_as(
        "Stiffness of all pairs along the pitch tangent: in motion Σ k cos² α over the loaded pairs with k "
        "along normals at the angle α; in slow rotation the load's derivative by the error."
    ),
    Quantity("mesh_stiffness_peak_to_peak", "Mesh stiffness, peak to peak", "N/µm").defined_as(
        "Maximum less minimum of the same, in the samples."
    ),
    Quantity("normal_load_max", "Maximum normal load", "N", ",.0f").defined_as(
        "Maximum of a single pair or rolling element, along its normal."
    ),
    Quantity("axial_force_mean", "Axial force on the pinion, mean", "N", ",.0f").defined_as(
        "Of helical gears: mean force of the teeth on the pinion along +z, its axis; on the gear it is "
        "opposite."
    ),
    Quantity("shared_load_max", "Maximum normal load of a pair among others", "N", ",.0f").defined_as(
        "Maximum of a pair while two or more are on their path."
    ),
    Quantity("dynamic_factor", "Dynamic factor", digits=".3f", symbol="K_v").defined_as(
        "Maximum of the loads' moment over that of the mean load, from the motion."
    ),
    Quantity("mesh_load_factor", "Mesh load factor", digits=".3f", symbol="K_γ").defined_as(
        "Of a planetary stage: mean torque between sun and planet of the planet with most, over that of all; "
        "of two suns and a ring at the member with most torque."
    ),
    Quantity("planet_load_factor_max", "Maximum load of a planet over the mean", digits=".3f").defined_as(
        "Of a planetary stage: maximum torque between sun and planet over the mean in time of all planets."
    ),
    Quantity(
        "dynamic_factor_iso", "Dynamic factor by ISO 6336-1, method B,", digits=".3f", symbol="K_v"
    ).defined_as(
        "From formulas for the deviations of the drive's quality, K_A = 1, no tip relief; involutes with a "
        "quality only."
    ),
    Quantity(
        "resonance_ratio_iso",
        "Resonance ratio by ISO 6336-1",
        digits=".3f",
        symbol="N",
        below="at the resonance ratio",
    ).defined_as(
        "Speed over the resonance speed of the standard, rigid bearings; 0.85 to 1.15 is the main resonance."
    ),
    Quantity("contact_loss_fraction", "Time without contact", "%", ".3g").defined_as(
        "Share of the samples in which no pair carries load."
    ),
)
_OF_A_GEAR = {
    "undercut": "Minimum speed of the contact along the working flank per speed of the pinion: zero at a "
    "singular point, where the flank ends",
    "interference": "Depth of the flank below the lowest contact, from the form circle on",
    "tip_corner": "Gap between the fillet and the corner of the mate's tip, at most a module",
    "tip_thickness": "Tooth thickness on the tip circle",
    "clearance": "From the tip circle to the mate's root circle",
    "rack_tip": "Half width left at the tip of the rack between its rounded corners",
}
_OF_A_RING = {
    "trochoidal_clearance": "Room of the mate's tip beside the ring's flank after contact has ended, over "
    "the square of its share of the way to the ring's tip: negative with trochoidal interference",
    "tool_flank": "Minimum speed along the tools' flanks while they cut, per speed of the cutter (of the "
    "gear that a rack cuts): zero where such a flank ends",
    "base_circle": "From the tip out to the base circle of an involute",
}
TRAIN = (
    Quantity("train_ratio", "Ratio of the train", digits=".5g").defined_as(
        "Speed of the input over that of the output."
    ),
    Quantity("common_period", "Common period, cycles of the first mesh", digits=",d").defined_as(
        "Cycles of the first mesh after which all meshes are at their phases again."
    ),
)
#: Distances from the limits of existence, positive where gears exist, see `geometry.limits.limits`.
LIMITS = (
    *(
        Quantity(f"{name}_{side}", f"{name.capitalize().replace('_', ' ')}, {side}", "mm").defined_as(
            f"{about}, of the {side}."
        )
        for name, about in _OF_A_GEAR.items()
        for side in ("pinion", "gear")
    ),
    Quantity("contact_ratio_above_1", "Contact ratio above 1").defined_as("Contact ratio less 1."),
    *(
        Quantity(name, f"{name.capitalize().replace('_', ' ')}, internal gear", "mm").defined_as(
            f"{about}; of pairs with an internal gear, at most a module, and a module of others."
        )
        for name, about in _OF_A_RING.items()
    ),
)
QUANTITIES = (*GEOMETRY, *MOTION, *TRAIN, *LIMITS)
#: Of the signals of sensors, `sensors/NAME/…` in a summary: in the unit of the signal, or without one.
OF_SIGNAL = (
    Quantity("rms", "RMS").defined_as("Root mean square of a signal about its mean."),
    Quantity("peak_to_peak", "Peak to peak").defined_as("Maximum less minimum of a signal."),
    Quantity("crest_factor", "Crest factor", digits=".3g").defined_as(
        "Largest magnitude of a signal about its mean over its RMS: √2 of a sine."
    ),
    Quantity("kurtosis", "Kurtosis", digits=".3g").defined_as(
        "Fourth moment of a signal about its mean over the square of the second: 1.5 of a sine, 3 of noise."
    ),
)
#: Of a signal of the kind "sound" besides.
OF_SOUND = (
    Quantity("sound_power", "Sound power", "W", digits=".3g").defined_as(
        "Power of the sound that the housing radiates, of all lines up to 0.4 of the sensor's rate: by its "
        "radiation matrix, or ρ c σ ∫ v_n² dS."
    ),
    Quantity("sound_power_level", "Sound power level", "dB", digits=".1f").defined_as(
        "10 lg of the sound power over 1 pW."
    ),
)
#: Of the average of a signal over the turns of a shaft.
OF_SHAFT = (
    Quantity("turns", "Turns averaged", digits="d").defined_as(
        "Whole turns of a shaft in the signal, over which its synchronous average is taken."
    ),
    Quantity("fm0", "FM0", digits=".3g").defined_as(
        "Peak to peak of the synchronous average over the sum of the amplitudes of its mesh harmonics."
    ),
    Quantity("fm4", "FM4", digits=".3g").defined_as(
        "Kurtosis of the difference signal: the average without mesh harmonics and their first sidebands."
    ),
    Quantity("m6a", "M6A", digits=".3g").defined_as(
        "Sixth moment of the difference signal over the cube of the second: 15 of noise."
    ),
    Quantity("na4", "NA4", digits=".3g").defined_as(
        "Fourth moment of the residual, the average without mesh harmonics, over the square of the second; "
        "of one record alone."
    ),
    Quantity("energy_ratio", "Energy ratio", digits=".3g").defined_as(
        "RMS of the difference signal over that of the rest of the average."
    ),
    Quantity("sideband_level_factor", "Sideband level factor", digits=".3g").defined_as(
        "Amplitudes of the first sidebands of the mesh frequency over the RMS of the average."
    ),
    Quantity("sideband_energy_ratio", "Sideband energy ratio", digits=".3g").defined_as(
        "Amplitudes of six sidebands on either side of the mesh frequency over that of the mesh."
    ),
)
SIGNALS = (*OF_SIGNAL, *OF_SOUND, *OF_SHAFT)
