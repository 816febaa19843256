"""The page of one window: its parts, and what they show of the window's state."""

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from typing import Any

from nicegui import Client, ui

from tribodyn.app.bar import Bar
from tribodyn.app.core.document import Document
from tribodyn.app.core.fields import converted
from tribodyn.app.core.form import FormField, HeldTables, form_of, written_as
from tribodyn.app.core.live import STAGES
from tribodyn.app.core.offers.tables import add_table, copy_table
from tribodyn.app.core.worker import Worker
from tribodyn.app.curves import CHARTED, charts_of
from tribodyn.app.folder import WorkFolder
from tribodyn.app.form_view import Sliders, groups_of, held_of, values_of
from tribodyn.app.kept import KeptWork
from tribodyn.app.numbers import compared, other_tables, side_by_side
from tribodyn.app.parts import (
    STYLE,
    ChartsPart,
    FieldsPart,
    GearboxPart,
    NumbersPart,
    TeethPart,
    TourPart,
    VariantsPart,
)
from tribodyn.app.picture import gearbox_picture, pair_picture
from tribodyn.app.text_view import TextView
from tribodyn.app.window import DesignWindow
from tribodyn.errors import InputError

# a browser may refuse storage to a frame of another page, such as a notebook's; the library stops without it
_WITHOUT_STORAGE = (
    "<script>try { sessionStorage.length; } catch (error) { "
    'Object.defineProperty(window, "sessionStorage", { value: {} }); }</script>'
)


class DesignPage:
    """Builds the page, and keeps it in step with its window.

    Parameters
    ----------
    folder
        Where files are opened and saved.
    document
        What is open at first.
    address
        Of the page.
    kept
        Documents that pages of this server go back to.
    few
        Whether it stands within another page, as in a notebook: without files, jobs and tour.
    as_text
        Whether the scenario is shown as text at first.
    worker
        A process that is warm already.
    """

    def __init__(
        self,
        folder: WorkFolder,
        document: Document,
        client: Client,
        address: str,
        kept: KeptWork,
        *,
        few: bool = False,
        as_text: bool = False,
        worker: Worker | None = None,
    ) -> None:
        self.client, self.few, self.address, self.kept = client, few, address, kept
        self.structure: Any = None
        self.fields: dict[str, FormField] = {}
        self.held: dict[str, HeldTables] = {}
        self.sliders = Sliders()
        self.problem: InputError | None = None
        self.problem_at = ""
        self.errors: list[tuple[str, str, str]] = []
        self.window = DesignWindow(folder, document, worker or Worker(), self.show)
        self.window.as_text = as_text
        client.on_delete(self.window.close)
        self._build()
        ui.timer(1.0, self._each_second)
        self.window.changed(["form", "pinned", "title"])
        self.window.compare()

    def _build(self) -> None:
        ui.add_css(STYLE)
        ui.add_head_html(_WITHOUT_STORAGE)
        with ui.element("div").classes("tb-page" + (" tb-few" if self.few else "")):
            with ui.element("header").classes("tb-bar"):
                self.bar = Bar(
                    self.window,
                    self.address,
                    self.kept,
                    few=self.few,
                    go=lambda field: self.form.run_method("go", field),
                )
            with ui.element("main").classes("tb-main-part").props('aria-label="Design"'):
                with _section("tb-picture", "Teeth in mesh"):
                    self.gearbox = GearboxPart()
                    self.gearbox.tell(choose=lambda said: self.window.choose(str(said["mesh"])))
                    self.teeth = TeethPart()
                with _section("tb-form", "Scenario"):
                    self.text = TextView(
                        self.window, lambda path: self.form.run_method("go", path), self._complain
                    )
                    self.form = FieldsPart()
                    self.form.tell(edit=self._edit, unset=self._unset, unit=self._unit, ready=self._fill)
                    self.form.tell(add=self._add, copy=self._copy, remove=self._remove)
                with _section("tb-results", "Numbers"):
                    self.numbers = NumbersPart()
                with _section("tb-curves", "Curves"):
                    self.charts = ChartsPart()
                    self.charts.tell(ready=self._show_all_charts)
                with _section("tb-beside", "Variants"):
                    self.variants = VariantsPart()
                    self.variants.tell(
                        restore=lambda said: self._restore(str(said["name"])),
                        compare=lambda said: self.window.compare(str(said["name"])),
                        forget=lambda said: self.window.unpin(str(said["name"])),
                    )
            if not self.few:
                self.bar.tour = TourPart()

    def _each_second(self) -> None:
        self.bar.at_work(self.window.at_work())
        self.bar.keep_state()

    def show(self, parts: Sequence[str]) -> None:
        """Bring parts of the page in step with the window."""
        if self.window.closed:
            return
        with self.client:
            if "form" in parts:
                self._show_form()
            if "title" in parts or "form" in parts:
                self.bar.show()
            if "text" in parts:
                self.text.bring_back()
            stages = STAGES if "pinned" in parts else tuple(stage for stage in STAGES if stage in parts)
            if {"geometry", "static"} & set(stages):
                self._show_teeth()
            for stage in stages:
                if stage in CHARTED:
                    self._show_charts(stage)
            if set(stages) - {"geometry"}:
                self._show_numbers()
            if {"busy", "late"} & set(parts):
                self.bar.busy(self.window.late)
                self.charts.wait(self.window.late)
            if "late" in parts and self._show_messages():
                self._fill()

    def _show_form(self) -> None:
        groups = form_of(self.window.document)
        self.fields = {field.path: field for group in groups for field in group.fields}
        self.held = {one.path: one for group in groups for one in group.holds}
        structure = groups_of(groups)
        if structure != self.structure:
            self.structure = structure
            self.form.give(groups=structure, held=held_of(groups))
        self._show_messages()
        self._fill()

    def _fill(self, _said: Mapping[str, Any] | None = None) -> None:
        """Give the form its values; it asks for them where it has been drawn anew."""
        by_field = {key: short for key, _, short in self.errors if key in self.fields}
        self.form.take(values_of(self.fields), by_field, self.sliders.of(self.fields))

    def _show_messages(self) -> bool:
        """Show what is wrong; whether that has changed."""
        before, self.errors = self.errors, self.window.errors()
        if (one := self.problem) is not None and self.problem_at == self.window.document.text:
            self.errors.append((one.key, str(one), f"{one.rule}; {one.remedy}".rstrip("; ")))
        self.text.say(self.errors, self.fields)
        return self.errors != before

    def _show_teeth(self) -> None:
        results = self.window.results
        geometry, old = results.get("geometry", {}), self.window.pinned.get("geometry", {})
        if "gears" in geometry:
            self.teeth.give(
                picture=pair_picture(geometry, results.get("static")),
                pinned=pair_picture(old) if "gears" in old else None,
                label=" ".join(
                    ["Teeth in mesh", *filter(None, [geometry["mesh"]]), "- drag or arrow keys roll"]
                ),
            )
        elif geometry:
            said = " ".join(["There are no teeth to draw.", *geometry.get("remarks", ())])
            self.teeth.give(picture=None, pinned=None, empty=said)
        train = geometry.get("train")
        box = gearbox_picture(train) if train else {"bodies": [], "meshes": []}
        self.gearbox.give(**box, chosen=str(geometry.get("mesh", "")))

    def _show_charts(self, stage: str) -> None:
        window = self.window
        result, old = window.results.get(stage, {}), window.pinned.get(stage, {})
        self.charts.take(stage, charts_of(stage, result), charts_of(stage, old))

    def _show_all_charts(self, _said: Mapping[str, Any]) -> None:
        for stage in CHARTED:
            self._show_charts(stage)

    def _show_numbers(self) -> None:
        window, name = self.window, self.window.pinned_name
        self.numbers.give(
            groups=compared(window.results, window.pinned),
            compared=bool(name),
            caption=f"Numbers beside {name}" if name else "Numbers of this scenario",
            words=window.results.get("motion", {}).get("verdict", []),
            tables=other_tables(window.results),
        )
        self.variants.give(
            names=[name for name, _ in window.columns()],
            chosen=name,
            groups=side_by_side([each for _, each in window.columns()]),
        )

    def _edit(self, said: Mapping[str, Any]) -> None:
        field = self.fields.get(str(said.get("path")))
        if field is None:
            return
        text = str(said.get("text", ""))
        if not text.strip():
            self._unset(said)
            return
        try:
            value = written_as(field, text, field.unit)
        except InputError as error:
            self._complain(error)
            return
        self._complain(self.window.change(field.path, value, drag=bool(said.get("dragging"))))
        if said.get("released"):  # the drag is one step of the history
            with suppress(InputError):
                self.window.document.set(field.path, value)

    def _unit(self, said: Mapping[str, Any]) -> None:
        field = self.fields.get(str(said.get("path")))
        unit = str(said.get("unit", ""))
        if field is None or unit not in field.units:
            return
        with suppress(ValueError, InputError):
            text = converted(field.shown, field.unit, unit) if field.shown else ""
            if text:
                self._complain(self.window.change(field.path, written_as(field, text, unit)))

    def _unset(self, said: Mapping[str, Any]) -> None:
        self.problem = None
        try:
            self.window.document.unset(str(said["path"]))
        except InputError as error:
            self._complain(error)
            return
        self.window.changed(["form", "title"])

    def _add(self, said: Mapping[str, Any]) -> None:
        path, document = str(said.get("path")), self.window.document
        if said.get("held"):
            self._with_tables(lambda: add_table(document, self.held[path], str(said.get("name", ""))))
        else:
            self._with_tables(lambda: document.set(path, {}) or path)

    def _copy(self, said: Mapping[str, Any]) -> None:
        self._with_tables(lambda: copy_table(self.window.document, str(said.get("path"))))

    def _remove(self, said: Mapping[str, Any]) -> None:
        self._with_tables(lambda: self.window.document.take_out(str(said.get("path"))) or "")

    def _with_tables(self, change: Callable[[], str]) -> None:
        """Add a table or take one out, and go to the first field of the one that it leads to."""
        try:
            path = change()
        except (InputError, LookupError) as error:
            self._complain(error if isinstance(error, InputError) else None)
            return
        self._complain(None)
        self.window.changed(["form", "title"])
        first = next((field for field in self.fields if field.startswith(f"{path}.")), "")
        if path and first:
            self.form.run_method("go", first)

    def _complain(self, error: InputError | None) -> None:
        before, self.problem = self.problem, error
        self.problem_at = self.window.document.text  # another state has other problems
        if error is not None or before is not None:
            self._show_messages()
            self._fill()

    def _restore(self, name: str) -> None:
        with suppress(InputError):
            self.window.document.restore(name)
            self.window.changed(["form", "title"])


def _section(name: str, title: str) -> ui.element:
    section = ui.element("section").classes(name).props(f'aria-label="{title}"')
    with section:
        ui.label(title).classes("tb-heading").props("role=heading aria-level=2")
    return section
