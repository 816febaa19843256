"""One assessment of a drive: what the other studies find, and load capacity by the standards beside it."""

from tribodyn.studies.protocol.study import Study

STUDY = Study(
    kind="assessment",
    about="a drive on one page: loads, vibration, film, temperatures, losses, margins by the standards",
    package=__name__,
    quantities="film, pressure and temperature along the path of contact of an assessed drive",
    has_gears=True,
    verb="assess",
)
