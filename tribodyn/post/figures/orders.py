"""Order tracking: spectra of the transmission error over the orders of the mesh as the speed changes."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from tribodyn.errors import InputError
from tribodyn.post.cycles import last_cycles
from tribodyn.post.figures.panel import View, record_title
from tribodyn.post.style import PALETTE, PANEL_HEIGHT, WIDTH, mark_panel, new_figure
from tribodyn.record.reader import Record

NAME = "orders"
#: Mesh cycles in the window of one spectrum, and between two.
WINDOW, HOP = 16, 4
#: Spectra over a run, at least, where it is long enough.
MOST_HOPPED = 60
#: Orders of the mesh shown, and those followed in the lower panel.
SHOWN, FOLLOWED = 8.0, 4
#: Amplitudes below this part of the maximum are off the scale.
FLOOR = 1e-3
#: A speed that changes by more than this share is worth tracking.
CHANGING = 0.05


class Track(NamedTuple):
    """Spectra along a run."""

    speed: np.ndarray  # (n,); mean pinion speed in each window, rad/s
    time: np.ndarray  # (n,); at its middle, s
    orders: np.ndarray  # (m,); orders of the mesh
    amplitudes: np.ndarray  # (n, m); of the rotational transmission error, m


def worth_tracking(record: Record) -> bool:
    """Whether a run is long enough, and its speed changes enough, for its orders to be tracked."""
    whole = last_cycles(record, None) if record.samples > 1 else None
    if whole is None or whole.phase[-1] < 2 * WINDOW:
        return False
    speed = _pinion_speed(record)
    return float(np.ptp(speed)) > CHANGING * float(np.mean(speed))


def track(record: Record) -> Track:
    """Take spectra of windows of whole mesh cycles, tapered by Hann's window, along the whole run.

    Samples are uniform in the phase of the mesh, so that an order is a line whatever the speed does; a line's
    amplitude is that of the cosine, the window's mean taken out.

    Raises
    ------
    InputError
        For a run shorter than two windows.
    """
    whole = last_cycles(record, None)
    per_cycle = whole.samples_per_cycle
    count = round(whole.phase[-1]) - WINDOW
    size, step = WINDOW * per_cycle, min(HOP, max(1, count // MOST_HOPPED)) * per_cycle
    signal = record["transmission_error_rotational"][whole.part]
    if signal.size < 2 * size:
        raise InputError(
            "record",
            str(record.path),
            f"holds {signal.size // per_cycle} mesh cycles, too few to track orders",
            f"run at least {2 * WINDOW}: solver.cycles = 800",
        )
    starts = np.arange(0, signal.size - size, step)
    part = starts[:, None] + np.arange(size)
    taper = 0.5 - 0.5 * np.cos(2 * np.pi * np.arange(size) / size)
    windows = signal[part]
    windows = windows - windows.mean(axis=1, keepdims=True)
    amplitudes = 2 * np.abs(np.fft.rfft(windows * taper, axis=1)) / taper.sum()
    orders = np.arange(amplitudes.shape[1]) / WINDOW
    keep = orders <= SHOWN + 1e-9
    speed, time = _pinion_speed(record)[whole.part], record["time"][whole.part]
    return Track(speed[part].mean(axis=1), time[part].mean(axis=1), orders[keep], amplitudes[:, keep])


def orders_figure(records: Sequence[Record], view: View) -> Figure:
    """Draw the spectrogram of the first record over its speed, or time, and the orders of the mesh below.

    Over time too where the speed does not keep rising.
    """
    record = records[0]
    tracked = track(record)
    asked = view.asked and view.against == "time"
    over_time = asked or not np.all(np.diff(tracked.speed) > 0)
    x = tracked.time * 1e3 if over_time else tracked.speed * 30 / np.pi
    figure = new_figure(WIDTH, 2 * PANEL_HEIGHT + 0.6)
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(3, 2))
    _draw_map(figure, above, x, tracked)
    for order in range(1, FOLLOWED + 1):
        line = tracked.amplitudes[:, order * WINDOW] * 1e6
        below.plot(x, line, color=PALETTE[order - 1], label=f"order {order}")
    below.set_ylabel("Amplitude (µm)")
    below.set_ylim(bottom=0)
    below.set_xlabel("Time (ms)" if over_time else "Pinion speed (rpm)")
    below.legend(ncols=2)
    over = "time" if over_time else "the speed"
    mark_panel(above, "a", f"Amplitudes of the transmission error over its order and {over}")
    mark_panel(below, "b", f"Orders 1 to {FOLLOWED} of the mesh (1: the mesh frequency)")
    figure.suptitle(record_title(record), x=0.01, ha="left", fontsize=9)
    return figure


def _draw_map(figure: Figure, axes: Axes, x: np.ndarray, tracked: Track) -> None:
    maximum = float(tracked.amplitudes.max()) * 1e6
    norm = LogNorm(FLOOR * maximum, maximum) if maximum > 0 else None
    shown = np.maximum(tracked.amplitudes.T * 1e6, FLOOR * maximum)
    image = axes.pcolormesh(
        x, tracked.orders, shown, norm=norm, cmap="viridis", shading="nearest", rasterized=True
    )
    axes.set_ylabel("Order of the mesh (–)")
    axes.grid(False)
    figure.colorbar(image, ax=axes, label="Transmission error (µm)", pad=0.02)


def _pinion_speed(record: Record) -> np.ndarray:
    return record["velocity"][:, list(record["dof"]).index("theta_p")]
