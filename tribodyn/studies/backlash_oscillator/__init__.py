"""The oscillator with backlash."""

from tribodyn.studies.protocol.study import Study

STUDY = Study(
    kind="backlash-oscillator",
    about="an oscillator with backlash, without gears, followed up and down in frequency",
    package=__name__,
    quantities="response of an oscillator over frequency",
)
