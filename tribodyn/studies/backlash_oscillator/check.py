"""What `check` says of an oscillator with backlash."""

from tribodyn.studies.backlash_oscillator.case import BacklashOscillatorCase
from tribodyn.studies.backlash_oscillator.linear import linear_figures
from tribodyn.studies.protocol.study import Checked, TextTable


def check(case: BacklashOscillatorCase) -> Checked:
    """Say what linear theory predicts."""
    figures = linear_figures(case)
    rows = [(name, "none" if value is None else f"{value:.6g}") for name, value in figures.items()]
    table = TextTable("Linear theory, while contact lasts", ("quantity", "value"), rows)
    return Checked({"linear": figures}, (table,))
