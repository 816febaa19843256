"""The page to design on within a notebook."""

from html import escape
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from tribodyn.errors import InputError
from tribodyn.numerics.processes import child

if TYPE_CHECKING:
    import subprocess

#: Seconds that the server may take to begin.
_BEGINS = 120.0
#: Of the frame in a notebook, in pixels.
FRAME = 900


class Explorer:
    """The page of a running server; a notebook shows it. It ends with `close`, or with Python.

    Attributes
    ----------
    url : str
        Address of the page, for a browser on this machine.
    """

    def __init__(self, url: str, process: "subprocess.Popen[bytes]") -> None:
        self.url, self._process = url, process

    def close(self) -> None:
        """End the server; what was saved stays."""
        child.end(self._process)

    def _repr_html_(self) -> str:
        return (
            f'<iframe src="{escape(self.url, quote=True)}" title="tribodyn: a page to design on" '
            f'style="width: 100%; height: {FRAME}px; border: 0"></iframe>'
        )

    def __repr__(self) -> str:
        return f"<tribodyn page at {self.url}>"


def explore(scenario: str | Path) -> Explorer:
    """Show a scenario as a form with teeth, curves and numbers that follow every value.

    The page is that of ``tribodyn app`` without files, jobs and tour; Save writes the file, a shipped
    scenario into the current folder. It needs the extra ``tribodyn[app]``, and a browser on this machine.

    Parameters
    ----------
    scenario
        A scenario file, or the name of a shipped scenario.

    Returns
    -------
    Explorer
        What a notebook shows; `url` is its address.

    Raises
    ------
    InputError
        Where the scenario cannot be read, or the extra is not installed.
    """
    if find_spec("nicegui") is None:
        raise InputError("explore", None, "NiceGUI is missing", 'install it: pip install "tribodyn[app]"')
    from tribodyn.app.server import started

    try:
        url, process = started(str(scenario), _BEGINS)
    except TimeoutError as error:
        rule = f"the page did not begin: {error}"
        raise InputError("explore", str(scenario), rule, "try tribodyn app") from None
    return Explorer(f"{url}?few=1", process)
