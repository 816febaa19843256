"""Specific sliding of both flanks along the path of contact, by geometry alone."""

from tribodyn import Study

STUDY = Study(
    kind="specific-sliding",
    about="specific sliding of both flanks along the path of contact, by geometry alone",
    package=__name__,
    quantities="sliding of both flanks along the path of contact",
    compared=("Geometry", "Sliding"),
    has_gears=True,
)
