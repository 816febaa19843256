"""The quasi-static efficiency of a gear pair."""

from tribodyn.studies.protocol.study import Study

STUDY = Study(
    kind="efficiency",
    about="quasi-static loads, friction and efficiency of a gear pair, without dynamics",
    package=__name__,
    quantities="loads, films and friction of pairs of teeth over time",
    compared=("Geometry", "Dynamics", "Tribology", "Energy"),
    has_gears=True,
    resolution="output.samples_per_cycle",
)
