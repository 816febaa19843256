"""Run two versions of the package on the same cases and compare every number of what they leave behind.

python -m tools.compare_versions 05aa37e .                       # a commit, and this folder
python -m tools.compare_versions HEAD~1 HEAD --keep /tmp/kept    # results stay: only what changed runs again
python -m tools.compare_versions 05aa37e . --only 'sweep*' 'validate*'
python -m tools.compare_versions 05aa37e . --explained "run load-step*: a defect mended: ..."

A version is a folder or a git revision. Both run with this Python, each with a cache of its own. Compared are
all records, what is printed as JSON, and exit statuses: numbers, NaN patterns, shapes, types. A difference is
relative to the largest magnitude of its dataset (in displacement and velocity: of its column; residuals
are shares already). Exit status 1 if one above the threshold is not explained, or something is missing.
"""

import argparse
from concurrent.futures import ThreadPoolExecutor
from fnmatch import fnmatchcase
from pathlib import Path
from tempfile import TemporaryDirectory

from tools.compare_versions.cases import Case, cases
from tools.compare_versions.difference import Compared, Explained, compare
from tools.compare_versions.results import read
from tools.compare_versions.tables import difference_table, shape_table, words_table
from tools.compare_versions.versions import Version, check_import, opened, run
from tools.marked_block import ROOT, parser_of

THRESHOLD = 1e-10


def options() -> argparse.Namespace:
    parser = parser_of(__doc__)
    parser.add_argument("old", help="revision or folder")
    parser.add_argument("new", nargs="?", help="revision or folder; absent: make the old one's results")
    parser.add_argument("--keep", type=Path, help="folder in which results stay")
    parser.add_argument("--repository", type=Path, default=ROOT, help="knows the revisions")
    parser.add_argument("--threshold", type=float, default=THRESHOLD)
    many = {"action": "append", "default": []}
    parser.add_argument("--explained", **many, metavar="NAME: REASON", type=Explained.parse)
    parser.add_argument("--only", nargs="+", default=["*"], metavar="CASE", help="cases, wildcards allowed")
    parser.add_argument("--jobs", type=int, default=1, help="cases that run at the same time")
    parser.add_argument("--renamed", **many, metavar="OLD=>NEW", help="word of the new version's commands")
    parser.add_argument("--into", type=Path, help="write the tables to this file, too")
    return parser.parse_args()


def prepare(version: Version, chosen: argparse.Namespace, words: dict[str, list[str]]) -> list[Case]:
    """Run a version's cases, as far as their results are not there already."""
    version.results.mkdir(parents=True, exist_ok=True)
    check_import(version)
    every = cases(version.checkout)
    wanted = [case for case in every if any(fnmatchcase(case.name, name) for name in chosen.only)]
    with ThreadPoolExecutor(chosen.jobs) as pool:
        list(pool.map(lambda case: run(version, case, words), wanted))
    return wanted


def compared(old: Version, new: Version, wanted: list[Case]) -> list[Compared]:
    """Compare all files of all cases; a file that one version lacks counts as empty there."""
    results = []
    for case in wanted:
        before = read(old.folder(case)) if old.folder(case).is_dir() else {}
        after = read(new.folder(case)) if new.folder(case).is_dir() else {}
        for file in [*before, *(file for file in after if file not in before)]:
            results.append(compare(case.name, file, before.get(file, {}), after.get(file, {})))
    return results


def main() -> int:
    chosen = options()
    with TemporaryDirectory(prefix="compare-versions-") as temporary:
        scratch = Path(temporary)
        keep = chosen.keep.resolve() if chosen.keep else scratch / "results"
        with opened(chosen.old, chosen.repository, keep, scratch) as old:
            wanted = {case.name: case for case in prepare(old, chosen, {})}
            if chosen.new is None:
                return 0
            words = {
                old: new.split() for old, _, new in (renamed.partition("=>") for renamed in chosen.renamed)
            }
            with opened(chosen.new, chosen.repository, keep, scratch) as new:
                wanted |= {case.name: case for case in prepare(new, chosen, words)}
                results = compared(old, new, list(wanted.values()))
                table, unexplained = difference_table(results, chosen.threshold, chosen.explained)
                parts = [table, words_table(results), shape_table(old, new)]
    text = "\n\n".join(part for part in parts if part)
    print(text)
    if chosen.into:
        chosen.into.write_text(text + "\n", encoding="utf-8")
    return 1 if unexplained else 0


if __name__ == "__main__":
    raise SystemExit(main())
