"""The losses of a gearbox as a map over torque, speed and temperature of the oil."""

from tribodyn.studies.protocol.study import Study

STUDY = Study(
    kind="map",
    about="losses by term, efficiency, film, stiffness over torque, speed and oil temperature, as a map",
    package=__name__,
    quantities="losses of a gearbox over torque, speed and temperature",
    compared=("Map", "Losses"),
    resumes=True,
    verb="map",
)
