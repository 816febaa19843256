"""A helical pair 23/47 of whole overlap, β = 20°, as the tables that all studies of its contact have."""

import math

#: Face width of ε_β = 1, mm: π m_n/sin β.
WHOLE = math.pi * 3.0 / math.sin(math.radians(20.0))
HELICAL = f"""
title = "A helical pair"
lubricant = "iso-vg-220-mineral"

[drive]
family = "involute"
module = "3 mm"
pressure_angle = "20 deg"
helix_angle = "20 deg"
roughness = "0.4 um"
material = "16MnCr5"

[drive.pinion]
teeth = 23
face_width = "{WHOLE:.9f} mm"
bore_radius = "10 mm"

[drive.gear]
teeth = 47
face_width = "{WHOLE:.9f} mm"
bore_radius = "20 mm"

[operating]
pinion_speed = "1500 rpm"
gear_torque = "300 N*m"
oil_temperature = "80 degC"
"""
