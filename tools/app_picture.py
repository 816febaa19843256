"""The animated picture of the README: a tip relief that is dragged on the page to design on.

::

    python -m tools.app_picture     # docs/pictures/app.webp; needs Chromium and the packages of the tests
"""

import tempfile
from io import BytesIO
from pathlib import Path
from typing import Any

from PIL import Image

from tests.support.design_page import RELIEF, UP_TO_DATE, browser, entry, opened, served
from tools.marked_block import DOCS

PICTURE = DOCS / "pictures" / "app.webp"
SCENARIO = "involute-18-36-tip-relief"
#: Reliefs of pinion and gear on the way, µm, and the time for which each is shown, ms.
RELIEFS = [0, 2, 4, 6, 8, 10, 12, 12.4]
SHOWN, HELD = 450, 1800
#: Of the page, and of the picture, pixels.
SIZE, SHRUNK = (1520, 880), (1140, 660)


def frames(page: Any) -> list[Image.Image]:
    """Pictures of the page: no relief is pinned, then both reliefs grow to what is best."""
    page.set_viewport_size({"width": SIZE[0], "height": SIZE[1]})
    taken = []
    for relief in RELIEFS:
        for key in (RELIEF, RELIEF.replace("pinion", "gear")):
            entry(page, key).fill(str(relief))
            page.wait_for_timeout(600)
        page.wait_for_selector(UP_TO_DATE)
        page.wait_for_timeout(300)
        if not taken:
            page.get_by_role("button", name="Pin", exact=True).click()
            page.wait_for_timeout(1500)
        page.locator(".tb-form").evaluate("one => one.scrollTo(0, 250)")
        taken.append(Image.open(BytesIO(page.screenshot())).convert("RGB").resize(SHRUNK))
    return taken


def main() -> None:
    """Write the picture."""
    with tempfile.TemporaryDirectory() as folder, served(Path(folder), SCENARIO) as (address, _):
        with browser() as started:
            first, *others = frames(opened(started, address))
    durations = [HELD, *[SHOWN] * (len(others) - 1), 2 * HELD]
    first.save(PICTURE, save_all=True, append_images=others, duration=durations, loop=0, quality=60, method=6)
    print(f"{PICTURE}: {PICTURE.stat().st_size / 1024:.0f} KiB")


if __name__ == "__main__":
    main()
