"""A search whose evaluations take milliseconds: profile shifts of an involute pair for a small loss."""

#: What is searched; a table ``[design]`` has to follow.
SEARCHED = """
title = "shifts"
kind = "design"
[scenario]
title = "an efficiency"
kind = "efficiency"
drive = "liu-ni-involute-23-47"
lubricant = "liu-ni-2022"
operating = { pinion_speed = "10 rad/s", gear_torque = "500 N*m" }
mesh = { load_sharing = "uniform" }
friction = { law = "coulomb", coefficient = 0.05 }
output = { samples_per_cycle = 8 }
"""
#: One free key, and enough evaluations for processes beside the first.
SEARCH = f"""{SEARCHED}[design]
free = [{{ key = "drive.pinion.profile_shift", from = -0.2, to = 0.5 }}]
minimise = "loss"
evaluations = 48
sensitivities = false
"""
