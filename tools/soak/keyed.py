"""Shipped scenarios of every kind, made short, with other values at keys of the schema: docs/soak.md."""

from collections.abc import Iterator
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

from typer.testing import CliRunner

from tools.by_schema.changes import Change, keys_of, opened, taken
from tools.by_schema.effects import differ, is_table, of_run, silent
from tools.by_schema.keys import SchemaKey
from tribodyn.cli.app import app

_TEETH = {"output.samples_per_cycle": 20}
_CYCLES = {"solver.cycles": 3, **_TEETH}
_TURNS = {"solver.revolutions": 1.5, **_TEETH}
#: Scenario -> what makes it short: kinds, planets, rings, idlers, damage, run-out, sensors, drawn shafts.
BASES: dict[str, dict[str, Any]] = {
    "planetary-24-84": _CYCLES,
    "crack-18-36": _TURNS,
    "efficiency-oil-18-36": {"output.samples_per_cycle": 20},
    "ring-36-93": _CYCLES,
    "wear-18-36": {"output.positions_per_cycle": 12, "output.every": 4e7, "mesh.slices": 5},
    "irefc": {"output.samples_per_cycle": 8},
    "two-pinions-bull-gear": _CYCLES,
    "run-out-25-51": _TURNS,
    "ehl-involute-23-47": {"output.positions": 4, "contact.step": 0.25},
    "idler-train": _CYCLES,
    "load-contact-shafts": {"output.positions_per_cycle": 8, "mesh.slices": 5},
    "backlash-oscillator": {"frequency.step": 0.2},
    "two-stage-reducer": _CYCLES,
    "sensors-18-36": {"solver.revolutions": 2, "output.samples_per_cycle": 100, "output.window": [0.0, 2.0]},
    "design-shift-23-47": {"design.evaluations": 2, "design.sensitivities": False},
    "cycloidal-ring-24-72": _CYCLES,
    "run-up": _CYCLES,
    "rattle": _CYCLES,
    "efficiency-helical-fzg-20-30": {"output.samples_per_cycle": 20, "mesh.slices": 5},
    "load-contact-misaligned": {"output.positions_per_cycle": 8, "mesh.slices": 5},
}
#: Keys that are changed, at most.
MOST_KEYS = 3
#: Draws of keys, of which those that are not taken are left out.
MOST_DRAWS = 40
VERBS = (["show", "--full"], ["report"], ["listen"], ["signals", "--wav"])
#: Where those that write put it.
_WRITTEN = {"report": "page.html", "listen": "sound.wav", "signals": "."}


class Keyed(NamedTuple):
    """A scenario with other values, and the last key that was changed."""

    base: str
    last: SchemaKey
    change: Change


def keyed(seed: int, number: int) -> Keyed:
    """Draw the case of a number: its scenario by turns, its keys at random."""
    random, name = Random(f"keys {seed}/{number}"), list(BASES)[number % len(BASES)]
    data, found = opened(name, BASES[name]), None
    wanted = random.randint(1, MOST_KEYS)
    for _ in range(MOST_DRAWS):
        key = random.choice([key for key in keys_of(data) if not is_table(key)])
        change = None if silent(key) else taken(random, data, key)
        if change is not None:
            found, data, wanted = Keyed(name, key, change), change.data, wanted - 1
        if found is not None and wanted == 0:
            break
    assert found is not None, f"no key of {name} was taken"
    return found


def changes(seed: int, number: int) -> tuple[str, bool]:
    """The last key of a case, and whether other values of it left the result as it is."""
    made = keyed(seed, number)
    found = differ(Random(number), made.change, made.last, of_run)
    return ("", False) if found is None else (".".join(made.last.pattern), not found)


def unread(record: Path) -> Iterator[str]:
    """Say which verbs do not read a record; those of sensors may refuse one without."""
    with TemporaryDirectory() as folder:  # of what the verbs write
        for verb, *options in VERBS:
            written = ["-o", str(Path(folder) / _WRITTEN[verb])] if verb in _WRITTEN else []
            ended = CliRunner().invoke(app, [verb, str(record), *options, *written])
            if ended.exit_code not in (0, 2) or (ended.exit_code and verb in ("show", "report")):
                yield f"{verb}: status {ended.exit_code}, {ended.exception!r} {ended.output[-300:]}"
