"""Wear and running-in of a gear pair over millions of revolutions."""

from tribodyn.studies.protocol.study import Study

STUDY = Study(
    kind="wear",
    about="wear of a gear pair over millions of revolutions: loads, wear, flanks, loads again",
    package=__name__,
    quantities="worn flanks over revolutions of the pinion",
    compared=("Geometry", "Wear", "Load contact", "Tribology", "Energy"),
    has_gears=True,
    resumes=True,
    resolution="output.positions_per_cycle",
)
