"""A scenario and its variants as a short text that an address may hold."""

import base64
import binascii
import json
import re
import zlib
from collections.abc import Mapping

from tribodyn.errors import InputError
from tribodyn.input.sources import MOST_TOML

#: What a link begins with: the form of what follows.
_FORM = "1."
#: Names of files that a link may hold: of one that is shipped or new, or of one in a folder.
_PART = r"(?!\.\.?(?:/|$))[^\\/:\x00-\x1f]+"
_NAME = re.compile(rf"{_PART}|\./{_PART}(?:/{_PART})*")


def packed(name: str, texts: Mapping[str, str]) -> str:
    """The name of a file and texts by name as characters that need no escape in an address."""
    content = json.dumps([name, dict(texts)], ensure_ascii=False).encode()
    return _FORM + base64.urlsafe_b64encode(zlib.compress(content, 9)).decode().rstrip("=")


def unpacked(link: str) -> tuple[str, dict[str, str]]:
    """What a link holds; raises InputError where it is none, was cut, or holds more than a file may."""
    try:
        code = link.strip().removeprefix(_FORM)
        if code == link.strip():
            raise ValueError("another form")
        pressed = base64.b64decode(code + "=" * (-len(code) % 4), altchars=b"-_", validate=True)
        opened = zlib.decompressobj()
        content = opened.decompress(pressed, MOST_TOML)
        if opened.unconsumed_tail or not opened.eof:
            raise ValueError("too long, or cut")
        name, texts = json.loads(content)
        if not (isinstance(name, str) and _NAME.fullmatch(name)):
            raise ValueError("no name of a file")
        if not (isinstance(texts, dict) and all(isinstance(text, str) for text in texts.values())):
            raise ValueError("no texts")
    except (ValueError, zlib.error, binascii.Error, RecursionError):
        rule = "not a link of this page, or cut off"
        raise InputError("link", None, rule, "copy the whole address, or open the file") from None
    return name, texts
