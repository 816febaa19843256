"""Commented scenarios to begin with, by kind."""

_GEAR_PAIR = """\
# A scenario: what is done with a drive. `tribodyn schema` prints every key that may stand here;
# `tribodyn list` the names that may be used. A quantity is a string with its unit.
title = "TITLE"
kind = "gear-pair"

# Names of shipped models, paths to TOML files of your own, or the tables written out here.
drive = "liu-ni-crc-23-47"
lubricant = "liu-ni-2022"
bearings = "rigid-1e9"

[operating]
pinion_speed = "10 rad/s"             # or "100 rpm"
gear_torque = "500 N*m"
# gear_torque_harmonics = [{ amplitude = "50 N*m", frequency = "30 Hz", phase = "0 deg" }]
# gear_torque_table = "load.csv"      # columns: time [s],torque [N*m]; added to gear_torque
# source = "torque"                   # a motor instead of a prescribed speed, with
# drive_inertia = "0.02 kg*m**2"
# speed_regulation = "10 N*m*s/rad"   # how fast its torque falls with speed

[mesh]
compliance = "energy"                 # or "constant" with stiffness = "2.8e8 N/m", or "table"
damping_ratio = 0.05
# hertz = "load-dependent"
# backlash = "0.05 mm"                # normal backlash; without it back flanks never touch

# [mesh.transmission_error]           # of each pair of teeth, positive where material is missing
# harmonics = [{ order = 1, amplitude = "2 um", phase = "0 deg" }]

[friction]
law = "masjedi-khonsari"              # tribodyn list laws

[solver]
method = "auto"                       # tribodyn list solvers
rtol = 1e-6
cycles = 20                           # mesh cycles

[output]
samples_per_cycle = 200
"""

_LOAD_CONTACT = """\
# A load contact study: teeth in slow rotation under load, on finite elements, slice by slice of the face.
# `tribodyn schema` prints every key that may stand here. A quantity is a string with its unit.
title = "TITLE"
kind = "load-contact"

[drive]
like = "diez-ibarbia-18-36"           # name of a shipped drive or path of a file; what follows changes it

[drive.pinion.modification]           # what is taken off the driving flanks, along their normal
tip_relief = "10 um"
tip_relief_length = "4 mm"            # along the line of action
tip_relief_shape = "linear"           # or "parabolic"
crowning = "5 um"                     # or lead_relief_start, lead_relief_end, lead_unmodified
# profile_error = "error.csv"         # columns: roll_angle [deg],error [um]; positive: material missing
# pitch_errors = "pitch.csv"          # column: error [um], one a tooth; then also output.cycles

# [drive.gear.modification]           # the same for the gear

[operating]
gear_torque = "318 N*m"
# gear_torques = ["80 N*m", "160 N*m", "318 N*m", "480 N*m"]    # a Harris map

[mesh]
# slices = 21                         # of the face
# friction_coefficient = 0.05

[mesh.misalignment]
in_plane = "1 arcmin"
out_of_plane = "0 arcmin"

[output]
positions_per_cycle = 60
"""

TEMPLATES = {"gear-pair": _GEAR_PAIR, "load-contact": _LOAD_CONTACT}
