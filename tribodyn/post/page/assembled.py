"""A page as one file: its parts and its data in the template, with the script that draws it."""

import json
from html import escape
from importlib import resources
from typing import Any


def assembled(title: str, payload: dict[str, Any], sections: dict[str, str], figures: bool = True) -> str:
    """Put a page together of its title, its data and the HTML of its sections."""
    payload["figures"] = figures
    parts = {
        "RESULT": "",
        "SENSED": "",
        **sections,
        "TITLE": escape(title),
        # no text of a record can end the element that holds it
        "DATA": json.dumps(payload, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c"),
        "PLOTLY": _file("package_data/plotly.min.js", "plotly") if figures else "",
        "SCRIPT": _file("page.js"),
    }
    # every other piece is a name: what stands in for one is not looked through again
    body = "".join(parts.get(piece, piece) for piece in _file("page.html").split("@"))
    policy = "script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; font-src data:"
    policy += "; media-src data:"
    return document(title, _file("page.css"), body, policy)


def document(title: str, style: str, body: str, policy: str) -> str:
    """Put a body (HTML) into a file that may load nothing but what the `policy` names."""
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; {policy}">
<meta name="generator" content="tribodyn">
<title>{escape(title)}</title>
<style>{style}</style>
</head>
<body>
{body}</body>
</html>
"""


def _file(name: str, package: str = __package__ or "") -> str:
    return resources.files(package).joinpath(name).read_text(encoding="utf-8")
