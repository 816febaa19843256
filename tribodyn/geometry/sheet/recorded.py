"""The geometry of a gear pair in a record: every curve's dimensions, unit and meaning."""

from tribodyn.numerics.variable import Variable

#: Curves and radii.
GEOMETRY: dict[str, Variable] = {
    "pinion_outline": Variable(
        ("pinion_point", "axis"),
        "m",
        "outline of the pinion about its axis, turned as when a pair touches at the pitch point",
    ),
    "gear_outline": Variable(
        ("gear_point", "axis"),
        "m",
        "outline of the gear about its axis, turned as when a pair touches at the pitch point",
    ),
    "path_of_contact": Variable(
        ("path_point", "axis"), "m", "path of contact, origin at the pitch point, x along the pitch tangent"
    ),
    **{
        f"{side}_{circle}_radius": Variable((), "m", f"radius of the {side}'s {what}")
        for side in ("pinion", "gear")
        for circle, what in (
            ("tip", "tip circle"),
            ("root", "root circle"),
            ("pitch", "pitch circle"),
            ("bore", "bore"),
        )
    },
}
