"""Tables of docs/summary.md: every quantity of every summary, from the catalogue and the studies.

python -m tools.summary_table            # writes them into the page
"""

from tools.marked_block import DOCS, put, table
from tribodyn.studies import STUDIES


def tables() -> str:
    """A heading and a table per kind of study of this package."""
    parts = []
    for kind in STUDIES:
        study = STUDIES[kind]
        if not study.package.startswith("tribodyn."):
            continue
        parts += [f"### `{kind}`", f"{study.about[:1].upper()}{study.about[1:]}."]
        rows = [
            [f"{heading}: {q.in_table}", f"`{q.name}`", q.unit or "–", q.definition.replace("|", "\\|")]
            for heading, quantities in study.reported().items()
            for q in quantities
        ]
        parts.append(table(["line", "name in the record", "unit", "definition"], rows))
    return "\n\n".join(parts)


if __name__ == "__main__":
    put(DOCS / "summary.md", "summary lines", tables())
