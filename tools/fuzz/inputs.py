"""What is drawn: an input for one of the targets, from a seed and a number."""

import tomllib
from functools import cache
from pathlib import Path
from random import Random
from typing import NamedTuple

from tools.fuzz import corpus
from tribodyn.geometry.families import FAMILIES
from tribodyn.scenario.quantity import Table
from tribodyn.scenario.schema import references
from tribodyn.scenario.sources import shipped
from tribodyn.studies import STUDIES, study_of

ROOT = Path(__file__).parents[2]
FIXTURES = ROOT / "tests" / "fixtures"
CURVE = "load-step.csv"
#: Targets and how often each is drawn.
SHARES = {"toml": 45, "set": 17, "curve": 8, "vary": 5, "record": 6, "cache": 17, "check": 2}
#: What is checked: every family, and studies whose check needs no finite elements: those take too long.
CHECKED = (
    *("involute-23-47", "crc-23-47", "cycloidal-23-47", "parabolic-23-47", "s-gear-23-47", "points-23-47"),
    *("spline-23-47", "circular-arc-23-47", "efficiency-crc-23-47", "ehl-crc-23-47"),
)
#: What is swept: scenarios of every kind that can be.
SWEPT = ("crc-23-47", "efficiency-oil-18-36", "load-contact-18-36", "ehl-crc-23-47", "irefc", "spline-23-47")
#: Bytes that a mutation likes to put somewhere.
INTERESTING = (0, 1, 7, 8, 10, 13, 27, 34, 39, 46, 61, 91, 123, 127, 128, 194, 254, 255)
#: Changes of one input, at most.
MOST_CHANGES = 8


class Input(NamedTuple):
    """An input: its target, what it is based on, and what is handed over."""

    target: str  # of `SHARES`
    base: str  # name of a scenario or of a record
    content: bytes  # of a file, or a text for the command line


def drawn(seed: int, number: int) -> Input:
    """The input of that number."""
    random = Random(f"{seed}/{number}")
    target = random.choices(list(SHARES), list(SHARES.values()))[0]
    return globals()[f"_{target}"](random)


def of_corpus() -> list[Input]:
    """Everything of the corpus, each once."""
    found = [Input("set", "crc-23-47", f"operating.pinion_speed={text}".encode()) for text in corpus.texts()]
    found += [Input("set", "crc-23-47", f"drive={text}".encode()) for text in corpus.NAMES]
    found += [
        Input("set", "load-step", f"operating.gear_torque_table={text}".encode()) for text in corpus.NAMES
    ]
    found += [Input("set", "crc-23-47", f"solver.cycles={text}".encode()) for text in corpus.NUMBERS]
    found += [Input("vary", "crc-23-47", f"operating.pinion_speed={text}".encode()) for text in corpus.RANGES]
    found += [Input("vary", name, text.encode()) for name, text in corpus.AXES]
    found += [Input("curve", "load-step", text.encode()) for text in corpus.CURVES]
    whole = scenarios()["crc-23-47"]
    for piece in corpus.PIECES:
        found += [Input("toml", "crc-23-47", before + piece.encode()) for before in (whole, b"")]
    return found


@cache
def scenarios() -> dict[str, bytes]:
    """Shipped scenarios by name."""
    return {path.stem: path.read_bytes() for path in sorted(shipped("scenarios").glob("*.toml"))}


@cache
def records() -> dict[str, bytes]:
    """Records by name: one per kind of layout."""
    return {path.stem: path.read_bytes() for path in sorted(FIXTURES.glob("records-*/*.h5"))}


@cache
def keys(kind: str) -> tuple[str, ...]:
    """All dotted keys of the scenarios of a kind, and some that are none."""
    table = STUDIES[kind].table()
    named = (".".join(map(str, key)) for key in references(table))
    none = "nonsense", "mesh.nonsense.more", "a..b", "", "operating.0", "solver.cycles.1"
    return *keys_of(table), *named, *none


def keys_of(table: type[Table], above: str = "") -> list[str]:
    """Dotted keys of a schema, those of the tables inside it too."""
    found = []
    for name, field in table.model_fields.items():
        found.append(above + name)
        inner = field.annotation
        if isinstance(inner, type) and hasattr(inner, "model_fields"):
            found += keys_of(inner, f"{above}{name}.")
    return found


def mutated(random: Random, content: bytes, pieces: list[bytes]) -> bytes:
    """Content after a few changes: bits, bytes, cuts, copies, pieces from elsewhere."""
    changed = bytearray(content)
    for _ in range(random.randint(1, MOST_CHANGES)):
        at = random.randrange(len(changed) + 1)
        length = min(len(changed) - at, int(2 ** random.uniform(0, 9)))
        way = random.randrange(7)
        if way == 0 and at < len(changed):
            changed[at] ^= 1 << random.randrange(8)
        elif way == 1 and at < len(changed):
            changed[at] = random.choice(INTERESTING)
        elif way == 2:
            del changed[at : at + length]
        elif way == 3:
            changed[at:at] = changed[at : at + length]
        elif way == 4:
            changed[at:at] = bytes(random.choice(INTERESTING) for _ in range(random.randint(1, 8)))
        elif way == 5 and pieces:
            changed[at : at + random.choice((0, length))] = random.choice(pieces)
        elif way == 6:
            other = random.randrange(len(changed) + 1)
            changed[at : at + length] = changed[other : other + length]
    return bytes(changed)


def _pieces() -> list[bytes]:
    texts = (*corpus.PIECES, *corpus.NUMBERS, *corpus.NAMES, *(f'"{text}"' for text in corpus.QUANTITIES))
    return [text.encode() for text in texts]


def _toml(random: Random) -> Input:
    name = random.choice(list(scenarios()))
    return Input("toml", name, mutated(random, scenarios()[name], _pieces()))


def _set(random: Random) -> Input:
    name = random.choice(list(scenarios()))
    kind = random.choice(list(STUDIES))
    value = random.choice(list(corpus.texts()))
    if random.random() < 0.5:
        value = mutated(random, value.encode()[:400], _pieces()[-40:]).decode(errors="replace")
    equals = random.choice(("=", "=", "=", "=", " = ", ""))
    return Input("set", name, f"{random.choice(keys(kind))}{equals}{value}".encode())


def _curve(random: Random) -> Input:
    given = (shipped("scenarios") / CURVE).read_bytes()
    if random.random() < 0.3:
        given = random.choice(corpus.CURVES).encode()[:2000]
    return Input("curve", "load-step", mutated(random, given, _pieces()))


def _vary(random: Random) -> Input:
    text = random.choice(corpus.RANGES)
    if random.random() < 0.7:
        pieces = [b":", b",", b"/", b"e9", b" rpm"]
        text = mutated(random, text.encode()[:200], pieces).decode(errors="replace")
    name = random.choice(SWEPT)
    return Input("vary", name, f"{random.choice(keys(kind_of(name)))}={text}".encode())


def _record(random: Random) -> Input:
    name = random.choice(list(records()))
    given = records()[name]
    if random.random() < 0.2:
        return Input("record", name, given[: random.randrange(len(given))])
    return Input("record", name, mutated(random, given, []))


def _cache(random: Random) -> Input:
    base = random.choice(("kernel", "gear", "table"))
    return Input("cache", base, random.randbytes(16))


def _check(random: Random) -> Input:
    name = random.choice(CHECKED)
    key = random.choice([key for key in keys(kind_of(name)) if key.startswith("drive.")] + shapes())
    values = "0", "1", "-1", "0.5", "1e3", "1e-9", "7", "1e308", '"3 mm"', '"1e-9 m"', '"1 km"', '"20 deg"'
    value = random.choice(values)
    return Input("check", name, f"{key}={value}".encode())


@cache
def kind_of(name: str) -> str:
    """Kind of a shipped scenario."""
    return study_of(tomllib.loads(scenarios()[name].decode())).kind


@cache
def shapes() -> list[str]:
    """Keys of the paths of contact, of every family; of lists the first."""
    found = {key.name for family in FAMILIES for key in FAMILIES[family].parameters}
    return [key for name in sorted(found) for key in (f"drive.shape.{name}", f"drive.shape.{name}.0")]
