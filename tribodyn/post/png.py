"""Pictures as PNG files; large areas of one colour need no filter and little search by the compression."""

import struct
import zlib

import numpy as np

from tribodyn.numerics.output_files import MARKS

#: zlib's, 0 to 9: from here on files hardly shrink, but take up to three times as long.
LEVEL = 3
INCH = 0.0254


def png(pixels: np.ndarray, dpi: float) -> bytes:
    """The bytes of a picture's file.

    Parameters
    ----------
    pixels : array of uint8, (rows, columns, 4)
        Red, green, blue and opacity.
    dpi : float
        Pixels per inch.
    """
    rows, columns, channels = pixels.shape
    lines = np.zeros((rows, 1 + columns * channels), np.uint8)  # each begins with its filter: none
    lines[:, 1:] = pixels.reshape(rows, -1)
    per_metre = round(dpi / INCH)
    chunks = (
        (b"IHDR", struct.pack(">2I5B", columns, rows, 8, 6, 0, 0, 0)),
        (MARKS[".png"][:4], MARKS[".png"][4:]),
        (b"pHYs", struct.pack(">2IB", per_metre, per_metre, 1)),
        (b"IDAT", zlib.compress(lines.data, LEVEL)),
        (b"IEND", b""),
    )
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
        for name, data in chunks
    )
