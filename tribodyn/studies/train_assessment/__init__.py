"""One assessment of a train: its motion at the duty and over the speed, and every mesh by the standards."""

from tribodyn.studies.protocol.study import Study

STUDY = Study(
    kind="train-assessment",
    about="a gearbox on one page: film, loss and margins of each mesh, planets' loads, vibration",
    package=__name__,
    quantities="vibration, planets' loads and margins over the speed of an assessed train",
    verb="assess",
)
