"""The two ways a run can end badly: bad input, and a simulation that could not go on."""

from dataclasses import dataclass


@dataclass
class InputError(Exception):
    """Input that cannot be used; the command line prints it and exits with status 2.

    Physics raises it without `file`; the scenario layer adds the file's name and the full key.

    Parameters
    ----------
    key : str
        Where the value stands, dotted: ``drive.pinion.profile_shift``.
    value : object
        What was given, or None where the key is missing.
    rule : str
        What is wrong with it, or which rule it breaks.
    remedy : str
        What to write instead.
    file : str
        The file that the key stands in.
    """

    key: str
    value: object = None
    rule: str = ""
    remedy: str = ""
    file: str = ""

    def __str__(self) -> str:
        place = f"{self.file}: " if self.file else ""
        given = f" = {self.value}" if self.value is not None else ""
        remedy = f"; {self.remedy}" if self.remedy else ""
        return f"{place}{self.key}{given}: {self.rule}{remedy}"


@dataclass
class SimulationError(Exception):
    """A simulation that could not go on; what it has is kept and the exit status is 3.

    Parameters
    ----------
    reason : str
        Why, in a sentence that the user can act on.
    time : float
        Simulated time reached, s.
    """

    reason: str
    time: float = 0.0

    def __str__(self) -> str:
        return f"stopped at t = {self.time:.6g} s: {self.reason}"
