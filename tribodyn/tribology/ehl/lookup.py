"""Values of a table of solved contacts, as laws read them: polynomials of four variables."""

import linecache

from tribodyn.numerics.elementary import absolute, exp, law, log, maximum, minimum

#: Powers of load and sliding together with twice those of speed and curvature, at most: along load and
#: sliding an oil goes from the Newtonian to the limiting stress.
DEGREE = 6
#: Powers of load, speed, curvature and sliding of each term, in the order of its coefficient.
TERMS = [
    (i, j, k, m)
    for i in range(DEGREE + 1)
    for j in range((DEGREE - i) // 2 + 1)
    for k in range((DEGREE - i) // 2 - j + 1)
    for m in range(DEGREE - i - 2 * j - 2 * k + 1)
]

#: What a table is made for, beyond which its values are those at its end.
RANGE = "0.25 to 1.5 times the load of a single pair, 0.8 to 1.2 times the nominal speeds"
LIMITS = (
    "load ≥ 0.25 of a single pair's",
    "load ≤ 1.5 of a single pair's",
    "entrainment ≥ 0.8 of the path's minimum",
    "entrainment ≤ 1.2 of the path's maximum",
)


@law
def clipped(value, middle, half):
    """Variable −1 … 1 of a logarithm, held at the ends of its range."""
    return maximum(minimum((value - middle) / half, 1.0), -1.0)


def _nested(powers: tuple[str, ...], terms: list[tuple[int, ...]], first: int) -> str:
    """Sum of table[n] over `terms`, sorted, by Horner's rule; the first of them is number `first`."""
    if not powers:
        return f"table[{first}]"
    last, text = terms[-1][0], ""
    for power in range(last, -1, -1):
        at = [number for number, term in enumerate(terms) if term[0] == power]
        part = _nested(powers[1:], [terms[number][1:] for number in at], first + at[0])
        text = f"({text} * {powers[0]} + {part})" if text else part
    return text


# written out: no compiler unrolls loops whose length changes, and the processor would wait for each step
_TEXT = f"def polynomial(table, x, y, z, s):\n    return {_nested(('x', 'y', 'z', 's'), TERMS, 0)}\n"
_FILE = "<polynomial of a table>"
linecache.cache[_FILE] = (
    len(_TEXT),
    None,
    _TEXT.splitlines(keepends=True),
    _FILE,
)  # for who asks for the source
exec(compile(_TEXT, _FILE, "exec"))
polynomial = law(globals()["polynomial"])
polynomial.__doc__ = "Sum of table[n] x^i y^j z^k s^m over the powers in the order of `TERMS`."


@law
def variables(contact, table):
    """The table's four variables at a contact: load, entrainment, curvature, slide-to-roll ratio."""
    ratio = maximum(absolute(contact.sliding) / contact.entrainment, 1e-9)
    return (
        clipped(log(contact.line_load), table.line_load, table.line_load_half),
        clipped(log(contact.entrainment), table.entrainment, table.entrainment_half),
        clipped(log(contact.curvature), table.curvature, table.curvature_half),
        clipped(log(ratio), table.slide_to_roll, table.slide_to_roll_half),
    )


@law
def asperity_share(table, x, y, z, s):
    """Share of the load that asperities carry, 0 … 1."""
    return maximum(minimum(polynomial(table.share, x, y, z, s), 1.0), 0.0)


@law
def most_of_film(line_load, half_width, limit, floor):
    """Friction coefficient that the film comes near to at its limiting stress τ_00 + Λ p, and stays below."""
    return 1.15 * limit + 3.0 * floor * half_width / line_load


@law
def mixed_friction(saturation, share, most, rubbing):
    """Friction coefficient of a film and of asperities that carry a share of the load.

    The film's is most e^saturation/(1 + e^saturation): the exponent goes on evenly, as the logarithm of
    viscosity and sliding does, where the coefficient itself bends towards the limit.
    """
    grown = exp(maximum(minimum(saturation, 30.0), -30.0))
    return (1.0 - share) * most * grown / (1.0 + grown) + rubbing * share


@law
def in_table(contact, surfaces, table):
    """Load and entrainment over the least, and the greatest over them, as `LIMITS` has them."""
    load, speed = contact.line_load, contact.entrainment
    return (
        load * exp(table.line_load_half - table.line_load),
        exp(table.line_load + table.line_load_half) / load,
        speed * exp(table.entrainment_half - table.entrainment),
        exp(table.entrainment + table.entrainment_half) / speed,
    )
