"""Values of a table of solved contacts, as laws read them: polynomials of four variables."""

from tribodyn.numerics.elementary import law, maximum, minimum

#: Powers of all four variables together, at most.
DEGREE = 4
#: Powers of each term, in the order of its coefficient.
TERMS = [
    (i, j, k, m)
    for i in range(DEGREE + 1)
    for j in range(DEGREE + 1 - i)
    for k in range(DEGREE + 1 - i - j)
    for m in range(DEGREE + 1 - i - j - k)
]

_LAST = len(TERMS) - 1


@law
def held(value, middle, half):
    """Variable −1 … 1 of a logarithm, held at the ends of its range."""
    return maximum(minimum((value - middle) / half, 1.0), -1.0)


@law
def polynomial(table, x, y, z, s):
    """Sum of table[n] x^i y^j z^k s^m over the powers in the order of `TERMS`, by Horner's rule."""
    n = _LAST
    whole = 0.0 * x
    for i in range(DEGREE, -1, -1):
        by_x = 0.0 * x
        for j in range(DEGREE - i, -1, -1):
            by_y = 0.0 * x
            for k in range(DEGREE - i - j, -1, -1):
                by_z = 0.0 * x
                for _ in range(DEGREE - i - j - k, -1, -1):
                    by_z = by_z * s + table[n]
                    n -= 1
                by_y = by_y * z + by_z
            by_x = by_x * y + by_y
        whole = whole * x + by_x
    return whole
