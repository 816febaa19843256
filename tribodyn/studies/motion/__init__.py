"""The motion of gears over time: of a pair of gears, of a train, of planetary sets."""

from tribodyn.studies.protocol.study import Study

_RESOLUTION = "output.samples_per_cycle"
PAIR = Study(
    kind="gear-pair",
    about="vibration, loads, film, friction and efficiency of a gear pair over time",
    package=__name__,
    apart="pair",
    quantities="loads, films and friction of pairs of teeth over time",
    compared=("Geometry", "Dynamics", "Tribology", "Energy"),
    has_gears=True,
    resolution=_RESOLUTION,
)
TRAIN = Study(
    kind="gear-train",
    about="vibration, loads, film, friction and efficiency of a train of gears over time",
    package=__name__,
    apart="train",
    quantities="loads, films and friction of pairs of teeth over time",
    compared=("Train", "Dynamics", "Tribology", "Energy"),
    resolution=_RESOLUTION,
)
