"""Lévai's twelve types of epicyclic trains, and a Ravigneaux set, by numbers of teeth and of bodies."""

CARRIER, FIRST, LAST = 0, 1, 2
#: Lévai's twelve types: teeth of the gears in turn between the central gears, internal ones negative;
#: two gears on one planet in brackets. Twelve ways to go by one planet, by two that mesh, stepped or not.
TYPES = {
    "sun-planet-ring": (24, [30], -84),
    "sun-stepped-ring": (24, [36, 20], -80),
    "sun-stepped-sun": (24, [36, 28], 32),
    "ring-stepped-ring": (-90, [30, 24], -84),
    "sun-pair-sun": (24, [20], [26], 31),
    "sun-pair-ring": (30, [20], [26], -84),
    "ring-pair-ring": (-90, [20], [26], -84),
    "sun-pair-stepped-sun": (24, [20], [26, 18], 31),
    "sun-pair-stepped-ring": (30, [20], [26, 18], -84),
    "sun-stepped-pair-ring": (30, [25, 20], [26], -84),
    "ring-pair-stepped-ring": (-90, [20], [26, 18], -84),
    "sun-both-stepped-ring": (24, [20, 17], [26, 18], -83),
}

#: Bodies of a Ravigneaux set: carrier, small sun, large sun, ring, short and long planet.
SMALL, LARGE, RING, SHORT, LONG = range(1, 6)
TEETH = {SMALL: 28, LARGE: 36, RING: -84, SHORT: 20, LONG: 24}
