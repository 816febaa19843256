"""A reducer whose meshes heat one oil in a network: its keys, and temperatures in closed form."""

AMBIENT, GEARS, HOUSING, OUTSIDE = 293.15, (20.0, 40.0), 30.0, 12.0
NETWORK = {
    "temperature.model": "network",
    "temperature.pinion_oil": f"{GEARS[0]} W/K",
    "temperature.gear_oil": f"{GEARS[1]} W/K",
    "temperature.oil_housing": f"{HOUSING} W/K",
    "temperature.housing_ambient": f"{OUTSIDE} W/K",
    "temperature.ambient_temperature": f"{AMBIENT} K",
}


def temperatures_of(losses):
    """Oil by the heat of all, gears above it by half the loss of their own mesh."""
    total = sum(losses)
    oil = AMBIENT + total / OUTSIDE + total / HOUSING
    return oil, [[oil + 0.5 * lost / conductance for conductance in GEARS] for lost in losses]
