"""Parts of the page that the browser draws by itself; each has its script beside this file."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from nicegui import ui
from nicegui.element import Element
from nicegui.events import GenericEventArguments

Told = Callable[[Mapping[str, Any]], Any]
#: Characters of a text that the browser may send: of 1 000 000 bytes at most.
MOST_TEXT = 300_000
#: How the page looks.
STYLE = Path(__file__).with_name("page.css")
# serves the script that the charts draw with
_ = ui.plotly


class PageDialog(ui.dialog):
    """A dialog that is open; it closes at once, whatever the server is at."""

    LOOPBACK = False

    def __init__(self, title: str) -> None:
        super().__init__(value=True)
        self.props(f'aria-label="{title}"')


class _PagePart(Element):
    """A part that says what happens in it, and is drawn anew only where it has changed."""

    def tell(self, **handlers: Told) -> None:
        """Call functions with what the part says."""
        for name, handler in handlers.items():
            self.on(name, lambda event, handler=handler: handler(_said(event)))

    def give(self, **props: Any) -> None:
        """Change properties; the browser hears of it if one differs."""
        changed = {name: value for name, value in props.items() if self.props.get(name) != value}
        if changed:
            self.props.update(changed)
            self.update()


def _said(event: GenericEventArguments) -> Mapping[str, Any]:
    return event.args if isinstance(event.args, Mapping) else {}


class BarPart(_PagePart, component="bar.js"):
    """The bar at the top, and its keys. Tells ``act`` with a name."""

    def __init__(self) -> None:
        super().__init__()
        self.props.update(name="", unsaved=False, undo=False, redo=False, few=False, busy=[], work="")


class FieldsPart(_PagePart, component="fields.js"):
    """The form; `groups` changes seldom, `take` gives values. Tells what to ``edit``, ``unset``, ``add``."""

    def __init__(self) -> None:
        super().__init__()
        self.props.update(groups=[], held=[])

    def take(self, values: Mapping[str, Any], errors: Mapping[str, str], ranges: Mapping[str, Any]) -> None:
        """Show values, messages and usual ranges by path."""
        self.run_method("take", values, errors, ranges)


class TeethPart(_PagePart, component="teeth.js", esm={"tribodyn-shapes": "shapes"}):
    """The teeth in mesh."""

    def __init__(self) -> None:
        super().__init__()
        self.props.update(
            picture=None, pinned=None, label="Teeth in mesh", empty="The teeth are being drawn …"
        )


class GearboxPart(_PagePart, component="gearbox.js"):
    """A gearbox along its axes. Tells ``choose``."""

    def __init__(self) -> None:
        super().__init__()
        self.props.update(bodies=[], meshes=[], chosen="")


class ChartsPart(_PagePart, component="charts.js"):
    """Charts by stage. Tells ``ready`` where they have to be given anew."""

    def take(self, stage: str, charts: list[dict[str, Any]], pinned: list[dict[str, Any]]) -> None:
        """Draw the charts of a stage, those of the pinned variant behind them."""
        self.run_method("take", stage, charts, pinned)

    def wait(self, late: Sequence[str]) -> None:
        """Mark charts of stages that are computed anew."""
        self.run_method("wait", list(late))


class NumbersPart(_PagePart, component="numbers.js"):
    """Numbers, and those of the pinned variant."""

    def __init__(self) -> None:
        super().__init__()
        self.props.update(caption="", groups=[], compared=False, words=[], tables=[])


class MessagesPart(_PagePart, component="messages.js"):
    """What is wrong, and warnings. Tells ``go``, ``mend``."""

    def __init__(self) -> None:
        super().__init__()
        self.props.update(errors=[], doubtful=False, warnings=[], remarks=[])


class TextPart(_PagePart, component="text.js"):
    """The scenario as text. Tells ``show``, ``text``."""

    def __init__(self) -> None:
        super().__init__()
        self.props.update(open=False, text="", taken=0, wrong=[], most=MOST_TEXT)


class VariantsPart(_PagePart, component="variants.js"):
    """Variants side by side. Tells ``restore``, ``compare``, ``forget``."""

    def __init__(self) -> None:
        super().__init__()
        self.props.update(names=[], chosen="", groups=[])


class BringPart(_PagePart, component="bring.js"):
    """A file of the browser's computer for the folder. Tells ``brought``, ``refused``."""

    def __init__(self, address: str, endings: Sequence[str]) -> None:
        super().__init__()
        self.props.update(address=address, endings=list(dict.fromkeys(endings)))


class JobsPart(_PagePart, component="jobs.js"):
    """Longer work with its progress. Tells ``cancel``, ``resume``, ``open``."""

    def __init__(self) -> None:
        super().__init__()
        self.props.update(jobs=[])


class TourPart(_PagePart, component="tour.js"):
    """Five steps for the first time; kept in the browser that they were seen."""
