"""Pages of records as data, and as a browser has them."""

import base64
import json
import re
from pathlib import Path

import numpy as np
import pytest

from tribodyn.post.page import pdf

needs_browser = pytest.mark.skipif(
    pdf.browser() is None, reason="no browser: install Chromium (apt-get install chromium)"
)


def data_of(page: Path) -> dict:
    """What the page's script reads."""
    text = page.read_text(encoding="utf-8")
    (data,) = re.findall(r'<script type="application/json" id="data">(.*?)</script>', text, re.DOTALL)
    return json.loads(data)


def unpacked(text: str, kind: str = "<f4") -> np.ndarray:
    """Numbers of an array of the page."""
    return np.frombuffer(base64.b64decode(text), kind)


def shown(address: str) -> str:
    """The document as the browser has it in the end; no error on its console."""
    ended = pdf.run_browser("--dump-dom", "--enable-logging=stderr", "--window-size=1200,1000", address)
    assert ended.returncode == 0
    complaints = [line for line in ended.stderr.splitlines() if "CONSOLE" in line]
    assert not complaints, complaints
    return ended.stdout
