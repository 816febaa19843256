"""The documentation inside an FMU: what it is, its variables, its limits, as one HTML page."""

from collections.abc import Iterable
from html import escape

from tribodyn import __version__
from tribodyn.exchange.fmu.variables import UNLIMITED, FmuVariable, Role

_KINDS = {
    Role.TIME: "time",
    Role.INPUT: "input",
    Role.FIXED: "parameter, fixed",
    Role.TUNABLE: "parameter, tunable",
    Role.OUTPUT: "output",
}
_STYLE = (
    "body{font:16px/1.5 sans-serif;max-width:60em;margin:2em auto;padding:0 1em}"
    "table{border-collapse:collapse}td,th{border:1px solid #888;padding:.2em .6em;text-align:left}"
)
_LIMITS = (
    "Torques are constant over a communication step, speeds change linearly to the value given for its end.",
    "Steps inside a communication step are chosen by a Dormand-Prince pair of order 5(4) to the tolerance; "
    "any length of communication steps is allowed, and short ones cost more.",
    "Where the set of teeth in contact changes is found exactly, in both directions of rotation; gears may "
    "stand and turn back.",
    "Starts are in static equilibrium under the torques of the scenario; other torques at the start make the "
    "gears swing.",
    "There is no model exchange, no event mode, no derivative of outputs, and no reading of files.",
    "A step that fails returns an error, and the log says why; a state set or a reset takes the instance on.",
)


def page(
    title: str,
    scenario: str,
    variables: tuple[FmuVariable, ...],
    facts: Iterable[str],
    remarks: Iterable[str],
) -> str:
    """The page."""
    rows = "\n".join(_row(variable) for variable in variables)
    return f"""<!DOCTYPE html>
<html lang="en">
<head><meta charset="utf-8"><title>{escape(title)}</title><style>{_STYLE}</style></head>
<body>
<h1>{escape(title)}</h1>
<p>Dynamics of a gearbox with the contacts of its teeth, their friction and oil films in time, for
co-simulation. Written by tribodyn {escape(__version__)} from {escape(scenario)}. Units are SI; angles,
speeds and torques of input and output count positive as these nominally turn, the torque of the output
against that.</p>
{_list(facts)}
<h2>Variables</h2>
<table>
<tr><th>name</th><th>unit</th><th>what it is to the importer</th><th>start</th><th>limits</th><th></th></tr>
{rows}
</table>
<h2>Limits</h2>
{_list([*_LIMITS, *remarks])}
</body>
</html>
"""


def _list(items: Iterable[str]) -> str:
    return "<ul>\n" + "\n".join(f"<li>{escape(item)}</li>" for item in items) + "\n</ul>"


def _row(variable: FmuVariable) -> str:
    limited = abs(variable.minimum) < UNLIMITED or abs(variable.maximum) < UNLIMITED
    low, high = (
        f"{limit:.6g}" if abs(limit) < UNLIMITED else "" for limit in (variable.minimum, variable.maximum)
    )
    settable = variable.role not in (Role.TIME, Role.OUTPUT)
    cells = (
        variable.name,
        variable.unit,
        _KINDS[variable.role],
        f"{variable.start:.6g}" if settable else "",
        f"{low} … {high}" if limited else "",
        variable.about,
    )
    return "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in cells) + "</tr>"
