"""What is drawn: an input for one of the targets, from a seed and a number."""

from collections.abc import Sequence
from functools import cache
from random import Random
from typing import Any, NamedTuple

import tomli_w

from tools.by_schema.changes import changed, keys_of, opened
from tools.by_schema.keys import SchemaKey
from tools.by_schema.values import Surroundings, drawn_value
from tools.fuzz import corpus
from tools.fuzz.records import FIXTURES, RUNS
from tribodyn.input.quantity import Reference
from tribodyn.input.schema import EACH, parts_of
from tribodyn.input.sources import shipped

#: Targets and how often each is drawn.
SHARES = {
    "toml": 30,
    "set": 18,
    "key": 15,
    "curve": 8,
    "vary": 5,
    "signals": 2,
    "record": 6,
    "run": 4,
    "cache": 10,
}
#: Between a scenario and the CSV file that it names.
CURVE = b"\n# curve.csv\n"
#: Texts that are formulas, by the end of their key.
FORMULAS = ("tooth_formula", "subject_to", "minimise", "maximise")
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
    formula = "drive.gear.modification.tooth_formula"
    found += [Input("set", "crack-18-36", f"{formula}={text}".encode()) for text in corpus.FORMULAS]
    found += [Input("signals", "sensors-18-36", text.encode()) for text in corpus.QUANTITIES]
    found += [Input("set", "crc-23-47", f"solver.cycles={text}".encode()) for text in corpus.NUMBERS]
    found += [Input("vary", "crc-23-47", f"operating.pinion_speed={text}".encode()) for text in corpus.RANGES]
    found += [Input("vary", name, text.encode()) for name, text in corpus.AXES]
    step = scenarios()["load-step"].replace(b"load-step.csv", b"curve.csv")
    found += [Input("curve", "load-step", step + CURVE + text.encode()) for text in corpus.CURVES]
    whole = scenarios()["crc-23-47"]
    for piece in corpus.PIECES:
        found += [Input("toml", "crc-23-47", before + piece.encode()) for before in (whole, b"")]
    return found


@cache
def scenarios() -> dict[str, bytes]:
    """Shipped scenarios by name."""
    return {path.stem: path.read_bytes() for path in sorted(shipped("scenarios").glob("*.toml"))}


@cache
def data_of(name: str) -> dict[str, Any]:
    """A shipped scenario with all that it names written out."""
    return opened(name)


@cache
def files_of(name: str) -> list[tuple[SchemaKey, Reference]]:
    """Keys of a shipped scenario that may name a CSV file."""
    marks = ((key, parts_of(key.field)) for key in keys_of(data_of(name)) if not key.owner)
    named = ((key, mark) for key, found in marks for mark in found if isinstance(mark, Reference))
    return [(key, mark) for key, mark in named if mark.columns]


def any_key(random: Random, name: str) -> str:
    """A dotted key that a shipped scenario may have, or one that there is none of."""
    if random.random() < 0.1:
        return random.choice(("nonsense", "mesh.nonsense.more", "a..b", "", "operating.0", "solver.cycles.1"))
    data: Any = data_of(name)
    parts = []
    for part in random.choice(keys_of(data)).pattern:
        inside = (
            list(data) if isinstance(data, dict) else list(range(len(data))) if isinstance(data, list) else []
        )
        parts.append(random.choice([*inside, 0, "a"]) if part == EACH else part)
        last = parts[-1]
        data = data.get(last) if isinstance(data, dict) else data[last] if last in inside else None
    return ".".join(map(str, parts))


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
    key = any_key(random, name)
    texts = list(corpus.FORMULAS if key.endswith(FORMULAS) else corpus.texts())
    value = random.choice(texts)
    if random.random() < 0.5:
        value = mutated(random, value.encode()[:400], _pieces()[-40:]).decode(errors="replace")
    equals = random.choice(("=", "=", "=", "=", " = ", ""))
    return Input("set", name, f"{key}{equals}{value}".encode())


def _key(random: Random) -> Input:
    """A value of its type at any key of any kind."""
    name = random.choice(list(scenarios()))
    data = data_of(name)
    for _ in range(random.choice((1, 1, 2, 4))):
        _, data = changed(random, data, random.choice(keys_of(data)))
    return Input("key", name, tomli_w.dumps(data).encode())


def _curve(random: Random) -> Input:
    """A CSV file at any key that may name one."""
    name = random.choice([name for name in scenarios() if files_of(name)])
    key, mark = random.choice(files_of(name))
    dotted, data = changed(random, data_of(name), key)
    *above, last = dotted.split(".")
    place: Any = data
    for part in above:
        place = place[int(part)] if isinstance(place, list) else place[part]
    content = _written(random, place[last], mark.columns)
    place[last] = "curve.csv"
    if random.random() < 0.2:
        content = random.choice(corpus.CURVES).encode()[:2000]
    if random.random() < 0.8:
        content = mutated(random, content, _pieces())
    return Input("curve", name, tomli_w.dumps(data).encode() + CURVE + content)


def _written(random: Random, value: Any, names: Sequence[str]) -> bytes:
    """Columns as a CSV file has them; of a list its one column."""
    if isinstance(value, list):
        pairs = [str(text).partition(" ") for text in value]
        head, rows = [f"{names[0]} [{pairs[0][2]}]" if pairs else names[0]], [[pair[0]] for pair in pairs]
    else:
        head = [f"{name} [{value[name]['unit']}]" for name in names]
        rows = zip(*(map(str, value[name]["values"]) for name in names), strict=False)
    separator = random.choice((",", ",", ",", ";", "\t"))
    return "\n".join(separator.join(row) for row in (head, *rows)).encode()


def _vary(random: Random) -> Input:
    text = random.choice(corpus.RANGES)
    if random.random() < 0.7:
        pieces = [b":", b",", b"/", b"e9", b" rpm"]
        text = mutated(random, text.encode()[:200], pieces).decode(errors="replace")
    name = random.choice(list(scenarios()))
    key = any_key(random, name)
    if random.random() < 0.3:  # values of its type
        keys = [key for key in keys_of(data_of(name)) if not key.owner and EACH not in key.pattern]
        chosen = random.choice(keys)
        values = [drawn_value(random, chosen, Surroundings()) for _ in range(random.randint(1, 3))]
        key, text = ".".join(chosen.pattern), ",".join(map(str, values))
    return Input("vary", name, f"{key}={text}".encode())


def _signals(random: Random) -> Input:
    """How long the signals of a data set are."""
    text = random.choice(("1s", "0.05 s", "3 rev", *corpus.QUANTITIES))
    pieces = [text.encode() for text in corpus.NUMBERS]
    given = text.encode()[:200]
    return Input(
        "signals", "sensors-18-36", mutated(random, given, pieces) if random.random() < 0.7 else given
    )


def _record(random: Random) -> Input:
    name = random.choice(list(FIXTURES))
    given = FIXTURES[name].read_bytes()
    if random.random() < 0.2:
        return Input("record", name, given[: random.randrange(len(given))])
    return Input("record", name, mutated(random, given, []))


def _run(random: Random) -> Input:
    """A record of this version whose parts are exchanged, and the verb that reads it."""
    return Input("run", random.choice(RUNS), random.randbytes(16))


def _cache(random: Random) -> Input:
    base = random.choice(("kernel", "gear", "table"))
    return Input("cache", base, random.randbytes(16))
