"""The comparison as Markdown: one row per case and file, then words, then the shape of both packages."""

from collections.abc import Iterator, Sequence

from tools.compare_versions.difference import Compared, Difference, Explained
from tools.compare_versions.versions import Version
from tools.package_shape import shape


def difference_table(
    results: Sequence[Compared], threshold: float, explained: Sequence[Explained]
) -> tuple[str, list[str]]:
    """Return the table of all files, and the names of what is neither below the threshold nor explained."""
    lines = [
        "| case | file | quantities in both | largest relative difference | of | above the threshold |",
        "|---|---|--:|--:|---|---|",
    ]
    unexplained = []
    for one in results:
        above = [each for each in one.differences if each.how or each.relative > threshold]
        verdicts = []
        for name, what in [
            *((each.name, _said(each)) for each in above),
            *((n, "missing") for n in one.only_old),
        ]:
            reason = next((e.reason for e in explained if e.covers(one.case, name)), None)
            if reason is None:
                unexplained.append(f"{one.case}:{name}")
            verdicts.append((reason or "not explained", f"`{name}` {what}"))
        numbers = [each for each in one.differences if not each.how]
        worst = numbers[0] if numbers else None
        cells = [
            one.case,
            one.file,
            str(one.common),
            f"{worst.relative:.1e}" if worst else "0",
            f"`{worst.name}`" if worst else "",
            "; ".join([*_grouped(verdicts), *_new(one.only_new)]),
        ]
        lines.append(f"| {' | '.join(map(_cell, cells))} |")
    exact = sum(not one.differences and not one.only_old for one in results)
    total = sum(one.common for one in results)
    lines.append("")
    lines.append(
        f"{len(results)} files with {total} quantities; {exact} files are equal to the last bit; "
        f"{len(unexplained)} quantities above {threshold:g} without an explanation."
    )
    return "\n".join(lines), unexplained


def _said(one: Difference) -> str:
    return _short(one.how) if one.how else f"{one.relative:.1e}"


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


def _new(names: list[str], most: int = 6) -> Iterator[str]:
    if names:
        rest = f" and {len(names) - most} more" if len(names) > most else ""
        yield f"new: {', '.join(f'`{name}`' for name in names[:most])}{rest}"


def words_table(results: Sequence[Compared]) -> str:
    """Return the units, long names and other words that changed, each once; "" if none did."""
    changed: dict[tuple[str, str], int] = {}
    for one in results:
        for word in one.words:
            key = (word.name, _short(word.how))
            changed[key] = changed.get(key, 0) + 1
    if not changed:
        return "No unit, long name or other word changed."
    rows = [
        f"| `{name}` | {how.replace('|', chr(92) + '|')} | {count} |"
        for (name, how), count in changed.items()
    ]
    return "\n".join(["| words of | old → new | files |", "|---|---|--:|", *rows])


def shape_table(old: Version, new: Version) -> str:
    """Return the shape of both packages side by side."""
    before, after = shape(old.checkout), shape(new.checkout)
    lines = ["| | before | after |", "|---|--:|--:|"]
    return "\n".join([*lines, *(f"| {title} | {before[title]} | {after[title]} |" for title in before)])
