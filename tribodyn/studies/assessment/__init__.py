"""One assessment of a gearbox: of a pair of gears in depth, of a train mesh by mesh."""

from tribodyn.studies.protocol.study import Study

TRAIN = Study(
    kind="train-assessment",
    about="a gearbox on one page: film, loss and margins of each mesh, planets' loads, vibration",
    package=__name__,
    apart="train",
    quantities="vibration, planets' loads and margins over the speed of an assessed train",
    verb="assess",
)
PAIR = Study(
    kind="assessment",
    about="a drive on one page: loads, vibration, film, temperatures, losses, margins by the standards",
    package=__name__,
    apart="pair",
    quantities="film, pressure and temperature along the path of contact of an assessed drive",
    has_gears=True,
    verb="assess",
    instead=("scenario", TRAIN.kind),
)
