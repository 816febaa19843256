"""The mesh cycle in a record: every array's dimensions, unit and meaning."""

from tribodyn.numerics.variable import Variable

#: Arrays and numbers of the mesh cycle.
MESH_CYCLE: dict[str, Variable] = {
    "boundary": Variable(
        ("boundary",), "1", "phases, in mesh cycles, at which the set of contacting pairs changes"
    ),
    "phase": Variable(
        ("phase",),
        "1",
        "phase of the mesh in mesh cycles; boundaries of segments stand twice, before and after",
    ),
    "side": Variable(("pair",), "1", "+1 driving flanks, -1 back flanks"),
    "in_contact": Variable(
        ("phase", "pair"),
        "1",
        "1 where the pair is on the theoretical path of contact; elsewhere its values mean nothing",
    ),
    "pressure_angle": Variable(("phase", "pair"), "rad", "angle of the common normal to the pitch tangent"),
    "signed_distance": Variable(
        ("phase", "pair"), "m", "distance from pitch point to contact, negative in approach"
    ),
    "equivalent_radius": Variable(
        ("phase", "pair"), "m", "one over the sum of the flanks' curvatures, at the very point of contact"
    ),
    "pinion_speed": Variable(
        ("phase", "pair"), "m/rad", "speed of the contact along the pinion's flank per pinion speed"
    ),
    "gear_speed": Variable(
        ("phase", "pair"), "m/rad", "speed of the contact along the gear's flank per pinion speed"
    ),
    "compliance": Variable(
        ("phase", "pair"), "m/N", "deflection of one pair along its normal per normal load"
    ),
    "gap": Variable(
        ("phase", "pair"), "m", "static transmission error; for back flanks the backlash along the normal"
    ),
    "line_load_friction": Variable(
        ("phase", "pair"), "1", "line load at which friction acts as on the uneven face, over the mean"
    ),
    "line_load_peak": Variable(
        ("phase", "pair"), "1", "maximum line load along the face over the mean, K_Hbeta"
    ),
    "coupling": Variable(
        ("phase", "pair", "other_pair"),
        "m/N",
        "deflection of a pair per load on the other pair, through the gear bodies",
    ),
    "hertz_coefficient": Variable((), "m/N^0.9", "hertz coefficient"),
    "pinion_pitch_radius": Variable((), "m", "pinion pitch radius"),
    "gear_pitch_radius": Variable((), "m", "gear pitch radius"),
    "pinion_teeth": Variable((), "1", "pinion teeth"),
    "face_width": Variable((), "m", "face width"),
    "contact_ratio": Variable((), "1", "contact ratio"),
    "pitch_point_phase": Variable((), "1", "pitch point phase"),
    "roll_start": Variable((), "rad", "roll start"),
    "roll_end": Variable((), "rad", "roll end"),
    "pitch_point_length": Variable((), "m", "pitch point length"),
    "pitch_point_rate": Variable((), "1/rad", "pitch point rate"),
}
