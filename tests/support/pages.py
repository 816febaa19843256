"""Pages of records as data, and as a browser has them."""

import base64
import json
import re
from pathlib import Path

import numpy as np
import pytest

from tribodyn.post.page import document

needs_browser = pytest.mark.skipif(
    document.browser() is None, reason="no browser: install Chromium (apt-get install chromium)"
)


def data_of(page: Path) -> dict:
    """What the page's script reads."""
    text = page.read_text(encoding="utf-8")
    (data,) = re.findall(r'<script type="application/json" id="data">(.*?)</script>', text, re.DOTALL)
    return json.loads(data)


def unpacked(text: str, kind: str = "<f4") -> np.ndarray:
    """Numbers of an array of the page."""
    return np.frombuffer(base64.b64decode(text), kind)


def shown(address: str, *options: str) -> str:
    """The document as the browser has it in the end; no error on its console."""
    ended = document.run_browser(
        "--dump-dom", "--enable-logging=stderr", "--window-size=1200,1000", *options, address
    )
    assert ended.returncode == 0
    # what a browser says of its own graphics is no complaint
    complaints = [line for line in ended.stderr.splitlines() if "CONSOLE" in line and "WebGL" not in line]
    assert not complaints, complaints
    return ended.stdout


#: Widths at which pages are measured, px: a phone, a tablet, a desk; A4 between the page's margins.
WIDTHS, PAPER = (400, 800, 1400), 703
#: Every page in a frame of its own, which opens as a phone and takes the other widths one after the other, in
#: light and dark, then becomes paper: what is for print alone holds, what is for screens does not.
_MEASURE = """
const onPaper = (sheet) => [...sheet.cssRules].filter((rule) => rule.media).forEach((rule) => {
  const text = rule.media.mediaText;
  if (text === "print") rule.media.mediaText = "all";
  else if (text.includes("screen")) rule.media.mediaText = "not all";
});
function measure(frame) {
  const page = frame.contentDocument, root = page.documentElement, found = {};
  const note = (name, width) => {
    frame.style.width = width + "px";
    frame.contentWindow.dispatchEvent(new Event("resize"));
    const colors = frame.contentWindow.getComputedStyle(page.body);
    found[name + " " + width] = [root.scrollWidth, colors.color, colors.backgroundColor];
  };
  for (const width of WIDTHS) note("light", width);
  frame.style.colorScheme = "dark";
  const button = page.getElementById("theme");
  if (button) button.click();
  for (const width of WIDTHS) note("dark", width);
  [...page.styleSheets].forEach(onPaper);
  frame.contentWindow.dispatchEvent(new Event("beforeprint"));
  note("print", PAPER);
  return found;
}
window.addEventListener("load", () => {
  const found = [...document.querySelectorAll("iframe")].map(measure);
  document.getElementById("found").textContent = JSON.stringify(found);
});
"""


def measured(pages: list[Path], folder: Path) -> list[dict[str, list]]:
    """Width that each page needs, px, its colour and its background, by theme and width; in one browser."""
    frames = "".join(f'<iframe src="{page.as_uri()}" style="height:900px"></iframe>' for page in pages)
    script = f"const WIDTHS = {list(WIDTHS)}, PAPER = {PAPER};{_MEASURE}"
    style = f"iframe {{ border: 0; width: {WIDTHS[0]}px; color-scheme: light; }}"
    (folder / "frames.html").write_text(
        f'<!DOCTYPE html><meta charset="utf-8"><style>{style}</style>'
        f'<body>{frames}<p id="found"></p><script>{script}</script></body>',
        encoding="utf-8",
    )
    options = "--allow-file-access-from-files", "--hide-scrollbars", "--virtual-time-budget=300"
    dom = shown((folder / "frames.html").as_uri(), *options)
    (found,) = re.findall(r'<p id="found">(.*?)</p>', dom)
    return json.loads(found)
