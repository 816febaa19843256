"""The cycloid gear with intermediate rolling elements."""

from tribodyn.studies.protocol.study import Study

STUDY = Study(
    kind="irefc",
    about="a gear with rolling elements and a free cage",
    package=__name__,
    quantities="loads, slip and losses of rolling elements over time",
    compared=("Geometry", "Dynamics", "Tribology", "Energy"),
    resolution="output.samples_per_cycle",
)
