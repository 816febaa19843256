"""PNG files hold what they are given, as another program reads them."""

from io import BytesIO

import numpy as np
import pytest
from PIL import Image

from tribodyn.post.png import png


@pytest.mark.parametrize("size", [(1, 1), (3, 70), (200, 9)])
def test_another_program_reads_the_same_picture(size):
    pixels = np.random.default_rng(1).integers(0, 256, (*size, 4), dtype=np.uint8)
    with Image.open(BytesIO(png(pixels, 200.0))) as read:
        assert read.mode == "RGBA"
        assert read.info["dpi"] == pytest.approx((200.0, 200.0), abs=0.02)
        assert np.array_equal(np.asarray(read), pixels)
