"""`tribodyn design` and `td.design`: a search through any scenario, and what its runs offer in Python."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, Any

from tribodyn.studies.protocol.verb import Option, Verb

if TYPE_CHECKING:
    from tribodyn.studies.protocol.load import Loaded

EXAMPLES = (
    "\b\nValues of --free, the unit at least once, at the end:\n"
    '  KEY="0 um:40 um"   between these bounds\n'
    "  KEY=17:25          whole numbers, where the key takes those\n"
    "  KEY=linear,parabolic    one of these\n"
    "\b\nExamples:\n"
    "  tribodyn design load-contact-18-36 "
    '--free drive.pinion.modification.tip_relief="0 um:40 um" '
    '--free drive.pinion.modification.tip_relief_length="1 mm:6 mm" --minimise peak_to_peak\n'
    "  tribodyn design efficiency-involute-18-36 --free drive.pinion.profile_shift=-0.2:0.4 "
    '--minimise loss --subject-to "contact_ratio >= 1.4"\n'
    "  tribodyn design design-tip-relief-18-36 --method differential-evolution"
)
Texts = list[str] | None
Bounds = Sequence[Any] | Mapping[str, Any] | str
"""(from, to), a list of choices, {"from": …, "to": …} or {"choices": […]}."""


class Design:
    """A search that ran; `design` makes one. It is a `Run`, whose data are over the evaluations."""

    summary: dict[str, Any]

    @property
    def objective_start(self) -> Any:
        """The objective at the start, SI: a number, or a list of two; None where it has none."""
        return self.summary.get("objective_start")

    @property
    def objective(self) -> Any:
        """The objective at the best, SI: a number, or a list of two."""
        return self.summary.get("objective")

    @property
    def best(self) -> dict[str, Any]:
        """Best value by key, as a scenario has it: overrides of the scenario that was searched."""
        return dict(self.summary.get("best", {}))

    @property
    def evaluations(self) -> int:
        """Number of candidates that were evaluated."""
        return int(self.summary["evaluations"])


def design(
    source: Any,
    free: Annotated[
        Mapping[str, Bounds] | Sequence[Any] | None,
        Option("A key that the search may change, see below.", "KEY=FROM:TO", type=Texts),
    ] = None,
    minimise: Annotated[
        Any, Option("A quantity of the summary; two make a front.", "QUANTITY", type=Texts)
    ] = None,
    subject_to: Annotated[
        Sequence[str] | None,
        Option('What must hold: "contact_ratio >= 1.3", or "… >= start".', "CONSTRAINT", type=Texts),
    ] = None,
    *,
    maximise: Annotated[str | None, Option("A quantity, in place of --minimise.", "QUANTITY")] = None,
    part: Annotated[
        Mapping[str, Any] | Sequence[str] | None,
        Option("A further scenario; its quantities are NAME.QUANTITY.", "NAME=SCENARIO", type=Texts),
    ] = None,
    method: Annotated[str | None, Option("As design.method; default: chosen by the problem.")] = None,
    evaluations: Annotated[int | None, Option("At most; default: 200.", min=2, max=10**6)] = None,
    overrides: Mapping[str, Any] | None = None,
    **more: Any,
) -> "Loaded":
    """Search for the best values of a scenario's keys.

    Parameters
    ----------
    source : str, Path, mapping or case
        The scenario to search through, or a search (kind "design"), whose keys these replace.
    free : mapping or list, optional
        Key to bounds, ``{"drive.pinion.profile_shift": (-0.2, 0.4)}``, or to a list of texts to choose among;
        or entries as the scenario has them.
    minimise : str or list, optional
        Name of a quantity; two of them; or a list of ``{"quantity": …, "weight": …}``.
    subject_to : sequence of str
        ``"contact_ratio >= 1.3"``.
    maximise, part, method, evaluations, **more
        Further keys of ``[design]``; ``duty``, ``tolerance``, … among them.
    overrides : mapping, optional
        Dotted key to value, of the scenario to search through.
    output, force, resume, progress, allow_large, client
        As `run`; the workers of `client` (of Dask) evaluate the candidates; `resume`: go on from what an
        unfinished search left.

    Returns
    -------
    Design
        Its `status` is "failed", and `message` says why, where no candidate satisfies all constraints.

    Raises
    ------
    InputError
        Before anything is computed.
    """
    from tribodyn.studies.design.scenario import entries, loaded_search, parts_of

    keys = {
        "free": entries(free) if free is not None else None,
        "minimise": minimise[0] if isinstance(minimise, list) and len(minimise) == 1 else minimise,
        "maximise": maximise,
        "subject_to": subject_to,
        "part": part if part is None or isinstance(part, Mapping) else parts_of(part),
        "method": method,
        "evaluations": evaluations,
        **more,
    }
    tables = {key: value for key, value in keys.items() if value is not None and value != []}
    return loaded_search(source, tables, overrides or {})


RUN_PROPERTIES = Design
VERBS = {"design": Verb(design, EXAMPLES)}
