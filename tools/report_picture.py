"""The picture of the report in README and docs: a screenshot by an installed browser.

python -m tools.report_picture
"""

from pathlib import Path
from tempfile import TemporaryDirectory

import tribodyn as td
from tools.marked_block import PICTURES
from tribodyn.post.page.document import run_browser


def main() -> None:
    """Run the pair of `make demo`, write its page, take a picture of its upper part."""
    with TemporaryDirectory() as folder:
        page = td.run("spur-25-51").report(Path(folder) / "pair.html")
        size = ("--window-size=1180,1080", "--hide-scrollbars")
        ended = run_browser(*size, f"--screenshot={PICTURES / 'report.png'}", f"{page.as_uri()}#at=11.7")
    if ended.returncode:
        raise SystemExit(ended.stderr)


if __name__ == "__main__":
    main()
