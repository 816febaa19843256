"""Quantities of slow rotation under load, of an assessment, of the standards beside them, and of bearings."""

from tribodyn.quantities.quantity import Quantity

LOAD_CONTACT = (
    Quantity("gear_torque", "Torque on the gear", "N m").defined_as(
        "Torque at which everything but the Harris map is computed."
    ),
    Quantity("loaded_transmission_error_mean", "Loaded transmission error, mean", "µm").defined_as(
        "Mean over the mesh cycle of r_p θ_p − r_g θ_g in slow rotation under load."
    ),
    Quantity(
        "loaded_transmission_error_peak_to_peak", "Loaded transmission error, peak to peak", "µm"
    ).defined_as("Maximum less minimum of r_p θ_p − r_g θ_g in slow rotation under load."),
    Quantity(
        "unloaded_transmission_error_peak_to_peak",
        "Unloaded transmission error, peak to peak",
        "µm",
        ".3g",
        below="Unloaded, peak to peak",
    ).defined_as(
        "Maximum less minimum of r_p θ_p − r_g θ_g without load: that of modified or erroneous flanks."
    ),
    Quantity("least_peak_to_peak", "Minimum peak to peak of all torques", "µm").defined_as(
        "Minimum over the torques of the Harris map."
    ),
    Quantity(
        "least_peak_to_peak_torque",
        "Torque of the minimum peak to peak",
        "N m",
        below="at a torque on the gear of",
    ).defined_as("Torque on the gear at that minimum."),
    Quantity("line_load_max", "Maximum line load", "N/mm").defined_as(
        "Maximum normal load per length of the line of contact, over pairs, face and mesh cycle."
    ),
    Quantity("face_load_factor", "Face load factor", digits=".3f", symbol="K_Hβ").defined_as(
        "Maximum over mean line load along the face, where the line load is at its maximum; of helical pairs "
        "that of the mean over the mesh cycle. ISO 6336-1 estimates the same ratio."
    ),
    Quantity(
        "face_load_ratios", "Face load factors of the load spectrum's torques", digits=".3f", listed=True
    ).defined_as(
        "Over that of the duty, of the other torques of the duties that press these flanks, increasing."
    ),
    Quantity("face_load_factor_pitch_point", "Face load factor at the pitch point", digits=".3f").defined_as(
        "The same where a pair is at the pitch point."
    ),
    Quantity("pinion_root_tension_max", "Maximum root tension, pinion", "MPa").defined_as(
        "Maximum surface stress in the pinion's fillet on the loaded side, over face and mesh cycle in slow "
        "rotation."
    ),
    Quantity("gear_root_tension_max", "Maximum root tension, gear", "MPa").defined_as(
        "The same of the gear."
    ),
    Quantity("pinion_root_compression_max", "Maximum root compression, pinion", "MPa").defined_as(
        "Minimum surface stress in the pinion's fillet on the other side; negative: compression."
    ),
    Quantity("gear_root_compression_max", "Maximum root compression, gear", "MPa").defined_as(
        "The same of the gear."
    ),
    Quantity("torque_residual", "Residual of the torque", digits=".1e").defined_as(
        "Torque of the loads over the gear's torque, less 1; its largest magnitude."
    ),
)
ASSESSMENT = (
    Quantity("transverse_load_factor", "Transverse load factor", digits=".3f", symbol="K_Hα").defined_as(
        "Maximum load of a tooth while two pairs or more are on their path, with a base pitch deviation f_pb "
        "− y_α of one tooth, over the same of accurate teeth."
    ),
    Quantity(
        "transverse_load_factor_method_b",
        "Transverse load factor by ISO 6336-1, method B,",
        digits=".3f",
        symbol="K_Hα",
        below="by ISO 6336-1, method B",
    ).defined_as("By the formulas of the standard, with the same deviation."),
    Quantity(
        "dynamic_factor_max",
        "Maximum dynamic factor over the speeds",
        digits=".3f",
        below="Maximum over the speeds",
    ).defined_as("Maximum of the same over all speeds of the assessment."),
    Quantity(
        "dynamic_factor_max_speed",
        "Speed of the maximum dynamic factor",
        "rpm",
        ".4g",
        below="at a speed of",
    ).defined_as("Speed of the pinion, of a train of its input, at that maximum."),
    Quantity("contact_loss_speed_from", "Contact is lost from", "rpm", ".4g").defined_as(
        "Lowest speed of the pinion, of a train of its input, at which no pair of a mesh carries load for "
        "part of the time."
    ),
    Quantity("centre_distance", "Centre distance", "mm", ".6g").defined_as("Of a sample of an assessment."),
    Quantity("pin_error", "Error of a planet's pin along its circle", "µm", ".3g").defined_as(
        "Of a sample of an assessment."
    ),
    Quantity("input_speed", "Speed of the input", "rpm", ".5g").defined_as("Of the duty of a train."),
    Quantity("mesh_load_factor_max", "Maximum mesh load factor over the speeds", digits=".3f").defined_as(
        "Maximum over all speeds and planetary stages of an assessment."
    ),
    Quantity("contact_loss_speed_to", "Contact is lost up to", "rpm", ".4g").defined_as(
        "The highest of these speeds."
    ),
    Quantity("specific_film_min", "Minimum specific film", digits=".3g", symbol="λ_GF").defined_as(
        "Film over Ra by ISO/TS 6336-22, method A, with the simulation's pressures."
    ),
    Quantity(
        "efficiency_lowest",
        "Lowest efficiency of all friction laws",
        "%",
        ".3f",
        below="by the other friction laws, from",
    ).defined_as("Lowest of all friction laws of the assessment."),
    Quantity(
        "efficiency_highest", "Highest efficiency of all friction laws", "%", ".3f", below="to"
    ).defined_as("Highest of all of them."),
    Quantity("loss", "Loss to friction", "W", ".1f").defined_as("Mean power of tooth friction."),
    Quantity("loss_by_law", "Loss by friction law", "W", ".4g").defined_as(
        "Of every friction law of the assessment."
    ),
    Quantity("loss_lowest", "Lowest loss of all friction laws", "W", ".4g").defined_as("Minimum of them."),
    Quantity("loss_highest", "Highest loss of all friction laws", "W", ".4g").defined_as("Maximum of them."),
    Quantity("life", "Life", "h", ",.0f").defined_as(
        "Of pinion and gear at the required safeties, the shorter of the standard's (ISO 6336-2, -3, -6) and "
        "the simulation's; where the stress is endured without end, the larger of the required life and "
        "10^10 load cycles."
    ),
    Quantity("life_unlimited", "Life is a lower bound", digits=".0f").defined_as(
        "1 where the stress is endured without end: the life is at least the number that is printed."
    ),
    Quantity("pinion_speed", "Speed of the pinion", "rpm", ".5g").defined_as("Of the duty."),
    Quantity("point_angles", "Roll angles of the points A to E", "°").defined_as("From the pitch point."),
)
#: By ISO 6336-2, -3, -5 and -6; of each gear, but for the first ones.
CAPACITY = (
    Quantity("F_t", "Tangential load at the reference circle", "N", ".0f", symbol="F_t"),
    Quantity("Z_H", "Zone factor", digits=".3f", symbol="Z_H"),
    Quantity("Z_E", "Elasticity factor", "(N/mm²)**0.5", ".3f", symbol="Z_E"),
    Quantity("Z_epsilon", "Contact ratio factor", digits=".3f", symbol="Z_ε"),
    Quantity("Z_beta", "Helix angle factor, pitting,", digits=".3f", symbol="Z_β"),
    Quantity("Z_B", "Single pair contact factor of the pinion", digits=".3f", symbol="Z_B"),
    Quantity("Z_D", "Single pair contact factor of the gear", digits=".3f", symbol="Z_D"),
    Quantity("f_ZCa", "Auxiliary factor of unmodified flanks", digits=".2f", symbol="f_ZCa"),
    Quantity("Z_X", "Size factor, pitting,", digits=".3f", symbol="Z_X"),
    Quantity("sigma_H0", "Nominal contact stress", "MPa", ".1f", symbol="σ_H0"),
    Quantity("K_Fbeta", "Face load factor, bending,", digits=".3f", symbol="K_Fβ"),
    Quantity("K_Falpha", "Transverse load factor, bending,", digits=".3f", symbol="K_Fα"),
    Quantity("Y_ST", "Stress correction of the test gear", digits=".2f", symbol="Y_ST"),
    Quantity("A_v", "Accuracy by AGMA", digits=".0f", symbol="A_v"),
    Quantity("m_N", "Load sharing ratio by AGMA", digits=".3f", symbol="m_N"),
    Quantity("Z_I", "Geometry factor for pitting by AGMA", digits=".4f", symbol="Z_I"),
    Quantity("N_L", "Load cycles of the required life", digits=".4g", symbol="N_L"),
    Quantity("sigma_Hlim", "Allowable stress number, contact,", "MPa", ".0f", symbol="σ_Hlim"),
    Quantity("Z_L", "Lubricant factor", digits=".3f", symbol="Z_L"),
    Quantity("Z_v", "Velocity factor", digits=".3f", symbol="Z_v"),
    Quantity("Z_R", "Roughness factor", digits=".3f", symbol="Z_R"),
    Quantity("Z_W", "Work hardening factor", digits=".3f", symbol="Z_W"),
    Quantity("Z_NT", "Life factor, pitting,", digits=".3f", symbol="Z_NT"),
    Quantity("Z_N", "Life factor for pitting by AGMA", digits=".3f", symbol="Z_N"),
    Quantity("sigma_H", "Contact stress", "MPa", ".1f", symbol="σ_H"),
    Quantity("sigma_HG", "Pitting stress limit", "MPa", ".1f", symbol="σ_HG"),
    Quantity("sigma_HP", "Permissible contact stress", "MPa", ".1f", symbol="σ_HP"),
    Quantity("S_H", "Pitting", digits=".2f", symbol="S_H"),
    Quantity("damage_pitting", "Damage by pitting over the required life", digits=".3g", symbol="U_H"),
    Quantity("life_pitting", "Life until pitting", "h", ",.0f"),
    Quantity("sigma_Flim", "Nominal stress number, bending,", "MPa", ".0f", symbol="σ_Flim"),
    Quantity("h_F", "Bending moment arm", "mm", ".3f", symbol="h_Fe"),
    Quantity("s_Fn", "Root chord", "mm", ".3f", symbol="s_Fn"),
    Quantity("rho_F", "Notch radius", "mm", ".3f", symbol="ρ_F"),
    Quantity("Y_F", "Form factor", digits=".3f", symbol="Y_F"),
    Quantity("f_epsilon", "Load distribution factor", digits=".3f", symbol="f_ε"),
    Quantity("Y_S", "Stress correction factor", digits=".3f", symbol="Y_S"),
    Quantity("Y_beta", "Helix angle factor, bending,", digits=".3f", symbol="Y_β"),
    Quantity("Y_B", "Rim thickness factor", digits=".3f", symbol="Y_B"),
    Quantity("Y_DT", "Deep tooth factor", digits=".3f", symbol="Y_DT"),
    Quantity("Y_delta_relT", "Relative notch sensitivity factor", digits=".3f", symbol="Y_δrelT"),
    Quantity("Y_R_relT", "Relative surface factor", digits=".3f", symbol="Y_RrelT"),
    Quantity("Y_X", "Size factor, bending,", digits=".3f", symbol="Y_X"),
    Quantity("Y_M", "Mean stress influence factor", digits=".3f", symbol="Y_M"),
    Quantity("K_B", "Rim factor by AGMA", digits=".3f", symbol="K_B"),
    Quantity("Y_J", "Geometry factor for bending by AGMA", digits=".4f", symbol="Y_J"),
    Quantity("Y_N", "Life factor for bending by AGMA", digits=".3f", symbol="Y_N"),
    Quantity("Y_NT", "Life factor, bending,", digits=".3f", symbol="Y_NT"),
    Quantity("sigma_F0", "Nominal root stress", "MPa", ".1f", symbol="σ_F0"),
    Quantity("rho_F_formula", "Notch radius by the formula for rings", "mm", ".3f", symbol="ρ_F"),
    Quantity("sigma_F0_formula", "Nominal root stress by the formula for rings", "MPa", ".1f", symbol="σ_F0"),
    Quantity("rho_F_cut", "Notch radius of the fillet as cut", "mm", ".3f", symbol="ρ_F"),
    Quantity("sigma_F0_cut", "Nominal root stress of the fillet as cut", "MPa", ".1f", symbol="σ_F0"),
    Quantity("sigma_F", "Root stress", "MPa", ".1f", symbol="σ_F"),
    Quantity("sigma_FG", "Bending stress limit", "MPa", ".1f", symbol="σ_FG"),
    Quantity("sigma_FP", "Permissible root stress", "MPa", ".1f", symbol="σ_FP"),
    Quantity("S_F", "Tooth bending", digits=".2f", symbol="S_F"),
    Quantity("K_material", "Material factor, flank fracture,", digits=".3f", symbol="K_material"),
    Quantity("y_FF", "Depth of the greatest exposure", "mm", ".3f", symbol="y"),
    Quantity("tau_eff", "Occurring shear stress there", "MPa", ".1f", symbol="τ_eff"),
    Quantity("tau_per", "Permissible shear stress there", "MPa", ".1f", symbol="τ_per"),
    Quantity("A_FF_max", "Greatest exposure of the material", digits=".3f", symbol="A_FF,max"),
    Quantity("S_FF", "Tooth flank fracture", digits=".2f", symbol="S_FF"),
    Quantity("damage_bending", "Damage by bending over the required life", digits=".3g", symbol="U_F"),
    Quantity("life_bending", "Life until tooth breakage", "h", ",.0f"),
)
#: By the names of the standards; temperatures are in °C there.
STANDARDS = (
    *CAPACITY,
    Quantity("duty_number", "Duty of the load spectrum", digits="d"),
    Quantity("duty_n", "Load cycles of the duty", digits=".4g", symbol="n"),
    Quantity("duty_sigma_H", "Contact stress of the duty", "MPa", ".1f", symbol="σ_H"),
    Quantity("duty_U_H", "Damage by pitting of the duty", digits=".3g", symbol="U_H"),
    Quantity("duty_sigma_F", "Root stress of the duty", "MPa", ".1f", symbol="σ_F"),
    Quantity("duty_U_F", "Damage by bending of the duty", digits=".3g", symbol="U_F"),
    Quantity("theta_M", "Bulk temperature", "degC", ".1f", symbol="θ_M"),
    Quantity(
        "theta_M_flash", "Bulk temperature of the flash temperature method", "degC", ".1f", symbol="θ_M"
    ),
    Quantity("theta_B", "Contact temperature", "degC", ".1f", symbol="θ_B"),
    Quantity("theta_int", "Integral temperature", "degC", ".1f", symbol="θ_int"),
    Quantity("theta_S", "Scuffing temperature", "degC", ".1f", symbol="θ_S"),
    Quantity("theta_intS", "Scuffing integral temperature", "degC", ".1f", symbol="θ_intS"),
    Quantity("mu_m", "Mean friction", digits=".4f", symbol="μ_m"),
    Quantity("h_Y", "Minimum film", "µm", ".3f", symbol="h_Y"),
    Quantity("lambda_GF", "Specific film", digits=".3f", symbol="λ_GF"),
    Quantity("A_FF", "Exposure of the material", digits=".3f", symbol="A_FF"),
    Quantity("c_prime", "Stiffness of one pair", "N/(mm µm)", ".2f", symbol="c′"),
    Quantity("c_gamma_alpha", "Mesh stiffness", "N/(mm µm)", ".2f", symbol="c_γα"),
    Quantity("c_gamma_beta", "Mesh stiffness for the face load factor", "N/(mm µm)", ".2f", symbol="c_γβ"),
    Quantity("resonance_speed", "Resonance speed", "rpm", ".0f"),
    Quantity("resonance_speeds", "Resonance speeds", "rpm", ".0f"),
    Quantity("K_v", "Dynamic factor", digits=".3f", symbol="K_v"),
    Quantity("K_Halpha", "Transverse load factor", digits=".3f", symbol="K_Hα"),
    Quantity("K_Hbeta", "Face load factor", digits=".3f", symbol="K_Hβ"),
    Quantity("K_A", "Application factor", digits=".3f", symbol="K_A"),
    Quantity("K_gamma", "Mesh load factor", digits=".3f", symbol="K_γ"),
    Quantity("C_R", "Gear blank factor", digits=".3f", symbol="C_R"),
    Quantity("H_v", "Loss factor", digits=".4f", symbol="H_v"),
    Quantity("S_B", "Scuffing, flash temperature,", digits=".2f", symbol="S_B"),
    Quantity("S_intS", "Scuffing, integral temperature,", digits=".2f", symbol="S_intS"),
    Quantity("S_lambda", "Micropitting", digits=".2f", symbol="S_λ"),
)
QUANTITIES = (*LOAD_CONTACT, *ASSESSMENT, *STANDARDS)
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
    Quantity("static_safety", "Static safety", "", ".2f", symbol="S_0").defined_as(
        "C_0/P_0 with P_0 = max(X_0 F_r + Y_0 F_a, F_r) of ISO 76."
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
#: Of a mesh of a train on drawn shafts, in static equilibrium; z is that of the keys of its gears.
ALONG_FACE = (
    Quantity("deflected_misalignment", "Misalignment under load", "µm", ".3g").defined_as(
        "By how much the tilts of both gears open the flanks from one end of the common face to the other in "
        "the plane of action, in static equilibrium of the gearbox; positive where the end at larger z opens."
    ),
    Quantity("load_centre", "Centre of the load", "mm", ".3g").defined_as(
        "z at which the load along the face acts in the mean over the mesh cycle."
    ),
    Quantity("face_place", "Places along the face", "mm", ".4g", listed=True).defined_as(
        "z of the middles of the slices, from the middle of the face."
    ),
    Quantity("face_line_load", "Line load along the face", "N/mm", ".4g", listed=True).defined_as(
        "Of all pairs in contact together, per width of the face, mean over the mesh cycle, at these places."
    ),
    Quantity("face_pressure", "Maximum pressure along the face", "MPa", ".4g", listed=True).defined_as(
        "Over the path of contact, at these places: the contact pattern."
    ),
)
#: What makes the load of such a mesh more even, on its driving gear.
PROPOSED = (
    Quantity("proposed_helix_slope", "Helix slope that flattens the load", "µm", ".3g").defined_as(
        "helix_slope of the driving gear that undoes what tilts and misalignment open under a load in the "
        "middle of the face; its other modifications stay."
    ),
    Quantity(
        "face_load_factor_helix_slope", "Face load factor with it", digits=".3f", symbol="K_Hβ"
    ).defined_as("Of the gearbox computed again with this helix angle modification, of all meshes together."),
    Quantity("proposed_crowning", "Crowning that flattens the load", "µm", ".3g").defined_as(
        "crowning of the driving gear in place of a helix angle, by which both gears have √3/4 of what tilts "
        "and misalignment open."
    ),
    Quantity("face_load_factor_crowning", "Face load factor with it", digits=".3f", symbol="K_Hβ").defined_as(
        "Of the gearbox computed again with this crowning, of all meshes together."
    ),
)
#: Names of what tables say of such a mesh.
OF_FACE = ("deflected_misalignment", "face_load_factor", "load_centre", *(one.name for one in PROPOSED))
#: Of shafts and their bearings under the mean load of the mesh.
OF_SHAFTS = (*BEARINGS, *TILTS, *ALONG_FACE, *PROPOSED)
