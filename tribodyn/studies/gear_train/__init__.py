"""The dynamics of a train of gears."""

from tribodyn.studies.protocol.study import Study

STUDY = Study(
    kind="gear-train",
    about="vibration, loads, film, friction and efficiency of a train of gears over time",
    package=__name__,
    quantities="loads, films and friction of several meshes over time",
    compared=("Train", "Dynamics", "Tribology", "Energy"),
    resolution="output.samples_per_cycle",
)
