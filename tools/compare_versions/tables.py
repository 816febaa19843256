"""The comparison as Markdown: one row per case and file, then words, then the shape of both packages."""

from collections import Counter
from collections.abc import Iterator, Sequence

from tools.compare_versions.difference import Compared, Explained
from tools.compare_versions.versions import Version
from tools.marked_block import table
from tools.package_shape import shape


def difference_table(
    results: Sequence[Compared], threshold: float, explained: Sequence[Explained]
) -> tuple[str, list[str]]:
    """Return the table of all files, and the names of what is neither below the threshold nor explained."""
    head = ["case", "file", "quantities in both", "largest relative difference", "of", "above the threshold"]
    rows, unexplained = [], []
    for file in results:
        above = [each for each in file.differences if each.how or each.relative > threshold]
        found = [(each.name, _short(each.how) or f"{each.relative:.1e}") for each in above]
        verdicts = []
        for name, what in [*found, *((name, "missing") for name in file.only_old)]:
            reason = next((e.reason for e in explained if e.covers(file.case, name)), None)
            if reason is None:
                unexplained.append(f"{file.case}:{name}")
            verdicts.append((reason or "not explained", f"`{name}` {what}"))
        worst = next((each for each in file.differences if not each.how), None)
        largest = (f"{worst.relative:.1e}", f"`{worst.name}`") if worst else ("0", "")
        verdicts += [("new", f"`{name}`") for name in file.only_new]
        remarks = "; ".join(_grouped(verdicts))
        rows.append([_cell(str(cell)) for cell in (file.case, file.file, file.common, *largest, remarks)])
    exact = sum(not file.differences and not file.only_old for file in results)
    total = sum(file.common for file in results)
    counts = (
        f"{len(results)} files with {total} quantities; {exact} files are equal to the last bit; "
        f"{len(unexplained)} quantities above {threshold:g} without an explanation."
    )
    return f"{table(head, rows, 'llrr')}\n\n{counts}", unexplained


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


def _short(text: str) -> str:
    text = " ".join(text.split())
    return text if len(text) <= 200 else f"{text[:200]} …"


def _grouped(verdicts: list[tuple[str, str]], most: int = 6) -> Iterator[str]:
    """Quantities by reason, no more than `most` of each."""
    for reason in dict.fromkeys(reason for reason, _ in verdicts):
        members = [what for own, what in verdicts if own == reason]
        rest = f" and {len(members) - most} more" if len(members) > most else ""
        yield f"{reason}: {', '.join(members[:most])}{rest}"


def words_table(results: Sequence[Compared]) -> str:
    """Return the units, long names and other words that changed, each once; "" if none did."""
    changed = Counter((word.name, _short(word.how)) for file in results for word in file.words)
    if not changed:
        return "No unit, long name or other word changed."
    rows = [(f"`{name}`", _cell(how), count) for (name, how), count in changed.items()]
    return table(["words of", "old → new", "files"], rows, "llr")


def shape_table(old: Version, new: Version) -> str:
    """Return the shape of both packages side by side."""
    before, after = shape(old.checkout), shape(new.checkout)
    return table(["", "before", "after"], [(title, before[title], after[title]) for title in before], "lrr")
