"""One assessment of a gearbox: of a pair of gears, or of every mesh of a train."""

from dataclasses import replace

from tribodyn.studies.protocol.study import Study

#: Of a file that names the scenario of a gearbox, under its older word.
OF_SCENARIO = Study(
    kind="train-assessment",
    about="a gearbox on one page: film, loss and margins of each mesh, planets' loads, vibration",
    package=__name__,
    quantities="vibration, planets' loads and margins over the speed of an assessed train",
    verb="assess",
)
STUDY = replace(
    OF_SCENARIO,
    kind="assessment",
    about="a drive on one page: loads, vibration, film, temperatures, losses, margins by the standards",
    quantities="film, pressure and temperature along the path of contact of an assessed drive",
    has_gears=True,
    instead=("scenario", OF_SCENARIO.kind),
)
