"""The gear with rolling elements as it stands at the start: cam, crown, elements and their loads."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Circle

from tribodyn.post.style import INK, PALETTE, QUIET
from tribodyn.record.reader import Record

CAM_FILL, CROWN_FILL, ELEMENT_FILL = "#dcebf5", "#f6e6da", "#ffffff"
MILLIMETRE = 1e-3
#: Length of the arrow of the maximum load, in element radii.
LONGEST_ARROW = 6.0


def draw_gear(axes: Axes, record: Record) -> None:
    """Draw the gear about the shaft's axis, the pitch point to the right; axes in mm.

    Arrows at the elements show the normal loads on the cam, to scale; their lines meet in the pitch point.
    """
    sizes = {name: value / MILLIMETRE for name, value in record.geometry.items()}
    offset = float(sizes["eccentricity"])
    crown, cam = sizes["crown_outline"], sizes["cam_outline"] + np.array([offset, 0.0])
    rim = 1.12 * float(np.hypot(*crown.T).max())
    axes.add_patch(Circle((0, 0), rim, facecolor=CROWN_FILL, edgecolor=PALETTE[1], linewidth=0.9))
    axes.fill(*crown.T, facecolor="white", edgecolor=PALETTE[1], linewidth=0.9)
    axes.fill(*cam.T, facecolor=CAM_FILL, edgecolor=PALETTE[0], linewidth=0.9)
    # the crown's pitch radius is the pitch point's distance from the axis
    pitch_point = float(sizes["crown_pitch_radius"])
    for centre, name, color in (
        (0.0, "crown_pitch_radius", PALETTE[1]),
        (offset / 2, "pitch_radius", QUIET),
        (offset, "cam_pitch_radius", PALETTE[0]),
    ):
        style = {"fill": False, "edgecolor": color, "linewidth": 0.6, "linestyle": "-."}
        axes.add_patch(Circle((centre, 0.0), sizes[name], **style))
    _draw_elements(axes, record, sizes, np.array([offset / 2, 0.0]), np.array([pitch_point, 0.0]))
    # beside the points, and the pitch point's name where no load points
    for place, name, shift in (
        (0.0, "O", (-10, 4)),
        (offset, "$O_c$", (4, 4)),
        (pitch_point, "P", (-10, -9)),
    ):
        axes.plot(
            place, 0.0, marker="o", markersize=3.5, markerfacecolor="white", markeredgecolor="black", zorder=4
        )
        axes.annotate(name, (place, 0.0), xytext=shift, textcoords="offset points", fontsize=8)
    label = "From the shaft's axis, through the pitch point (mm)"
    axes.set(
        xlim=(-1.02 * rim, 1.02 * rim), ylim=(-1.02 * rim, 1.02 * rim), xlabel=label, ylabel="Across (mm)"
    )
    axes.set_aspect("equal")
    axes.grid(False)
    axes.annotate("crown", (0.02, 0.97), xycoords="axes fraction", va="top", color=PALETTE[1])
    axes.annotate("cam", (0.02, 0.02), xycoords="axes fraction", color=PALETTE[0])


def _draw_elements(
    axes: Axes, record: Record, sizes: dict, cage: np.ndarray, pitch_point: np.ndarray
) -> None:
    """Draw all elements of the cage, also those that the paper's position leaves out, and the loads."""
    count = int(record.scenario["drive"]["elements"])
    for angle in 2 * np.pi * np.arange(count) / count:
        centre = cage + sizes["centre_circle_radius"] * np.array([np.cos(angle), np.sin(angle)])
        style = {"facecolor": ELEMENT_FILL, "edgecolor": INK, "linewidth": 0.8}
        axes.add_patch(Circle(tuple(centre), sizes["element_radius"], **style))
    load, angles = record["normal_load"][0], record["element_angle"][0]
    centres = cage + sizes["centre_circle_radius"] * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    normal = centres - pitch_point
    normal /= np.hypot(*normal.T)[:, None]
    contacts = centres - sizes["element_radius"] * normal
    lengths = LONGEST_ARROW * sizes["element_radius"] * load / load.max()
    for contact, along, length in zip(contacts, normal, lengths, strict=True):
        if length > 0.02 * sizes["element_radius"]:
            arrow = {"arrowstyle": "-|>", "color": PALETTE[2], "linewidth": 0.9, "mutation_scale": 6}
            axes.annotate("", tuple(contact - length * along), tuple(contact), arrowprops=arrow)
