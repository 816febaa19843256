"""Tables of docs/summary.md: every quantity of every summary, from the catalogue and the studies.

python -m tools.summary_table            # writes them into the page
"""

from pathlib import Path

from tools.marked_block import put
from tribodyn.studies import STUDIES

PAGE = Path(__file__).parents[1] / "docs" / "summary.md"


def tables() -> str:
    """A heading and a table per kind of study of this package."""
    parts = []
    for kind in STUDIES:
        study = STUDIES[kind]
        if not study.package.startswith("tribodyn."):
            continue
        parts += [f"### `{kind}`", "", f"{study.about[:1].upper()}{study.about[1:]}.", ""]
        parts += ["| line | name in the record | unit | definition |", "|---|---|---|---|"]
        for heading, quantities in study.reported().items():
            for quantity in quantities:
                name = f"{heading}: {quantity.in_table} | `{quantity.name}`"
                definition = quantity.definition.replace("|", "\\|")
                parts.append(f"| {name} | {quantity.unit or '–'} | {definition} |")
        parts.append("")
    return "\n".join(parts)


if __name__ == "__main__":
    put(PAGE, "summary lines", tables())
