"""The dynamics of a gear pair."""

from tribodyn.studies.protocol.study import Study

STUDY = Study(
    kind="gear-pair",
    about="vibration, loads, film, friction and efficiency of a gear pair over time",
    package=__name__,
    quantities="loads, films and friction of pairs of teeth over time",
    compared=("Geometry", "Dynamics", "Tribology", "Energy"),
    has_gears=True,
    resolution="output.samples_per_cycle",
)
