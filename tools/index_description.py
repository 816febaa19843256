"""The README as the long description that a package index shows, and the addresses beside it.

An index shows the text without the folder around it: links into that folder and its pictures need addresses.
They come from the repository named in pyproject.toml. Without one, links are left as their texts and pictures
are left out.
"""

import re
from pathlib import Path
from typing import Any

from hatchling.metadata.plugin.interface import MetadataHookInterface

#: A link or picture of Markdown whose target is in this folder.
RELATIVE = re.compile(r"(?P<picture>!?)\[(?P<text>[^]]*)\]\((?!https?:|mailto:|#)(?P<path>[^)\s]+)\)")
#: Names of the addresses, and paths below the repository's.
ADDRESSES = {
    "Source": "",
    "Documentation": "/blob/main/docs/index.md",
    "Changelog": "/blob/main/CHANGELOG.md",
    "Issues": "/issues",
}


def long_description(readme: str, repository: str) -> str:
    """Return the README with relative links made absolute, or without them where there is no address.

    Files are below the repository's `/blob/main`, pictures below `/raw/main`.
    """

    def absolute(link: re.Match[str]) -> str:
        picture, text, path = link["picture"], link["text"], link["path"]
        if repository:
            return f"{picture}[{text}]({repository}/{'raw' if picture else 'blob'}/main/{path})"
        return "" if picture else text

    text = RELATIVE.sub(absolute, readme)
    return text if repository else f"{text.rstrip()}\n\nThe source distribution has all pages, in `docs/`.\n"


class LongDescription(MetadataHookInterface):
    """Hook of hatchling: fills `readme` and `urls`."""

    def update(self, metadata: dict[str, Any]) -> None:
        """Set both fields; hatchling calls it."""
        repository = str(self.config.get("repository", "")).rstrip("/")
        text = long_description((Path(self.root) / "README.md").read_text(encoding="utf-8"), repository)
        metadata["readme"] = {"content-type": "text/markdown", "text": text}
        metadata["urls"] = {name: repository + path for name, path in ADDRESSES.items()} if repository else {}
