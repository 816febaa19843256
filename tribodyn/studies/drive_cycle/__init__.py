"""A gearbox over a drive cycle: losses by term and temperatures of all of its parts over time."""

from tribodyn.studies.protocol.study import Study

STUDY = Study(
    kind="drive-cycle",
    about="losses by term and temperatures of all parts of a gearbox over a cycle of speed and load",
    package=__name__,
    quantities="losses and temperatures of a gearbox over time",
    compared=("Energy", "Temperature"),
)
