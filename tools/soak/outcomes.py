"""Outcomes: on disk, a line of JSON each, so that a stopped soak goes on where it was; and as a table."""

import json
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from tools.marked_block import table as table_of
from tools.soak.cases import SORTS
from tools.soak.outcome import COMPLETE, FAULTY, REFUSED, STOPPED, Outcome
from tribodyn.numerics.files.sources import computing_digest, digest_of

#: Where outcomes are kept unless told otherwise.
FOLDER = Path(__file__).parents[2] / ".soak"
STATUSES = (COMPLETE, REFUSED, STOPPED, FAULTY)


def store(seed: int, short: bool = False) -> Path:
    """The file of a seed's outcomes: another one as soon as a line of the package or of this tool changes."""
    tool = digest_of("tools.soak.outcome", "tribodyn.cli.app").hex()
    return FOLDER / f"{tool[:6]}{computing_digest()[:6]}-{seed}{'-short' if short else ''}.jsonl"


def read(path: Path) -> Iterator[Outcome]:
    """Go through the outcomes in a file; a last line that was cut short is left out."""
    if not path.is_file():
        return
    for line in path.read_text(encoding="utf-8").splitlines():
        try:
            values = json.loads(line)
        except json.JSONDecodeError:
            continue
        yield Outcome(**{**values, "faults": tuple(values["faults"])})


def add(path: Path, outcome: Outcome) -> None:
    """Add an outcome to a file, in one write."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("a", encoding="utf-8") as file:
        file.write(json.dumps(outcome._asdict(), ensure_ascii=False) + "\n")


def table(outcomes: Sequence[Outcome]) -> str:
    """Lay out outcomes by sort of case and family, the reasons of what is not complete, and the energy."""
    groups = {sort: [o for o in outcomes if o.sort == sort] for sort in SORTS} | {"all": outcomes}
    for family in sorted({outcome.family for outcome in outcomes} - {""}):
        groups[f"of gears: {family}"] = [o for o in outcomes if o.family == family]
    rows = []
    for name, members in groups.items():
        count = Counter(outcome.status for outcome in members)
        rows.append([name, len(members), *(count[status] for status in STATUSES)])
    reasons = Counter(_plain(o.reason) for o in outcomes if o.status in (REFUSED, STOPPED))
    refused = sum(outcome.drives_refused for outcome in outcomes)
    text = (
        f"{table_of(['', 'cases', *STATUSES], rows)}\n\n"
        f"{table_of(['refused or stopped because', 'cases'], reasons.most_common())}\n\n"
        f"Drives drawn before those that can be made: {refused}, each refusal put to the test.\n"
    )
    compared = [o for o in outcomes if o.compared]
    text += f"Keys whose values were compared by runs: {len(compared)}; that changed nothing: "
    text += (", ".join(sorted({f"`{o.compared}`" for o in compared if o.idle})) or "none") + ".\n"
    residuals = np.array([o.residual for o in outcomes if o.sort == "gear-pair"])
    residuals = residuals[~np.isnan(residuals)]
    if residuals.size:
        parts = ", ".join(f"{np.quantile(residuals, q):.2g}" for q in (0.5, 0.9, 0.99, 1.0))
        text += f"Energy residual of complete runs over rtol; median, 90 %, 99 % and maximum: {parts}."
    return text


def _plain(reason: str) -> str:
    """A reason without files, values and numbers, cut where it goes into detail."""
    text = re.sub(r"^\S*/[^:]*: ", "", reason.splitlines()[0] if reason else "")
    text = re.sub(r"^stopped (at t = \S+ s|after \S+ mesh cycles): ", "", text)
    text = re.sub(r" = .*?: ", ": ", text, count=1)
    text = re.sub(r"-?\d[\d.]*(e[+-]?\d+)?", "#", text)
    return text.partition(";")[0].replace("|", "/")[:140]
