"""What may be written as a unit: names joined by * and /, small exponents, one pair of brackets.

Pint reads more than that, as Python's tokenizer does: `rad//s`, `rad/s!` and towers of powers among it.
"""

import re

#: Characters of a quantity, number and unit, at most.
LONGEST = 80
#: What is said of a unit that is none.
RULE = "not a unit: names joined by * and /, with exponents from -9 to 9"

_RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹"
_POWER = r"-?\d(?:\.\d{1,3})?"
_TOKEN = re.compile(
    rf"""(?P<blank>\s*)(?:
        (?P<operand>[^\W\d_{_RAISED}][^\W{_RAISED}]*|°[A-Za-z]?|[%‰]|1(?![\d.]))
        |(?P<power>(?:\*\*|\^)\s*(?:{_POWER}|\(\s*{_POWER}\s*\))|⁻?[{_RAISED}])
        |(?P<operator>[*/·])
        |(?P<opening>\()
        |(?P<closing>\))
    )""",
    re.VERBOSE,
)


def is_unit(text: str) -> bool:
    """Whether a text has the form of a unit; whether there is such a unit is another question."""
    if len(text) > LONGEST:
        return False
    before, depth, at = "operator", 0, 0
    text = text.strip()
    while at < len(text):
        token = _TOKEN.match(text, at)
        if token is None:
            return False
        kind = str(token.lastgroup)
        joined = before in _ENDS and kind in ("operand", "opening") and not token["blank"]
        if joined or before not in _AFTER[kind]:
            return False
        depth += (kind == "opening") - (kind == "closing")
        before, at = kind, token.end()
        if not 0 <= depth <= 1:
            return False
    return depth == 0 and before in _ENDS


_ENDS = ("operand", "power", "closing")
#: Token -> those that it may follow; a blank between two names multiplies them.
_AFTER = {
    "operand": ("operator", "opening", *_ENDS),
    "power": ("operand", "closing"),
    "operator": _ENDS,
    "opening": ("operator", "operand", "power"),
    "closing": _ENDS,
}
