"""What stands on the page: the case as a form and as text, runs, results."""

import asyncio
import contextlib
import dataclasses
import pathlib

from nicegui import app, background_tasks, ui
from nicegui import run as workers

from gfb.case import Case, CaseError
from gfb.look import HEADER
from gfb.namelist import namelist_value
from gfb.report.main import PAGE, svg_of
from gfb.report.machine import picture_of_case, sizes_of_files
from gfb.studio.checking import Judged, Message, check, without_use
from gfb.studio.form import Form
from gfb.studio.keys import read_keys
from gfb.studio.results import ResultsView
from gfb.studio.runs import CASE, Folder, Refused, Runs
from gfb.studio.templates import Templates
from gfb.studio.text import with_value, without_group

PAUSE = 0.3   # s without a change until what was typed is taken over and checked
TICK = 0.5    # s between two looks at the runs
MOST_SAID = 50  # messages that are shown
# A picture that is left while it is drawn has no size, which Plotly complains about and NiceGUI does not listen to.
LEFT = """<script>addEventListener("unhandledrejection", (event) => {
  if (String(event.reason).includes("Resize must be passed a displayed plot div")) event.preventDefault();
});</script>"""
# The group in whose field or lines the cursor stands is marked in the sketch.
MARKED = """<style id="marked"></style><script>
const mark = (group) => { document.getElementById("marked").textContent = /^\\w+$/.test(group || "") ?
  `.beside-form .of-${group} { stroke: var(--marked) !important; stroke-width: 2.2 !important; }` : ""; };
document.addEventListener("focusin", (event) => { const box = event.target.closest("[data-group]"); if (box) mark(box.dataset.group); });
document.addEventListener("selectionchange", () => setTimeout(() => {
  if (!document.activeElement?.closest(".cm-editor")) return;
  const begin = document.querySelector(".cm-activeLine");
  for (let line = begin; line; line = line.previousElementSibling) {
    const found = line.textContent.match(/^\\s*[&$](\\w+)/);
    if (found) return mark(found[1].toLowerCase());
    if (line !== begin && /^\\s*\\/\\s*(!.*)?$/.test(line.textContent)) break;
  }
  mark("");
}));</script>"""
EMPTY = "&scene\n  title = ''\n/\n"


def make_page(folder, gfb):
    """Prepares the page of a folder and a program."""
    place, keys = Folder(folder), read_keys(gfb)
    runs, templates = Runs(place, gfb), Templates(keys, gfb)

    @ui.page("/")
    async def page(case: str = ""):
        tab = Tab(place, keys, runs, templates, gfb)
        tab.build()
        with contextlib.suppress(TimeoutError):
            await ui.context.client.connected()
        if ui.context.client.has_socket_connection:  # otherwise somebody has fetched the page without opening it
            await tab.begin(app.storage.tab, case)


class Tab:
    """One tab of a browser; what is in it is its own, but for runs and files."""

    def __init__(self, folder, keys, runs, templates, gfb):
        self.folder, self.runs, self.templates, self.gfb = folder, runs, templates, gfb
        self.keys = keys
        self.text, self.known = "", None  # known: what the case file holds that was opened or saved here
        self.untouched = None             # the program's example as it came
        self.kept = {}                    # outlives a reload of the tab
        self.judged = None
        self.changes = 0
        self.rows = {}                    # of the runs

    # --- what is seen ---

    def build(self):
        """All of the page."""
        ui.add_head_html(LEFT + MARKED)
        ui.colors(primary=HEADER)
        ui.add_css(PAGE.get_template("look.css").render())
        ui.add_css(pathlib.Path(__file__).with_name("page.css"))
        with ui.header().classes("top"):
            ui.label("gfb studio").classes("brand")
            with ui.tabs() as tabs:
                case, runs, results = (ui.tab(name) for name in ("Case", "Runs", "Results"))
        self.tabs = tabs
        tabs.on_value_change(self.turned)
        with ui.tab_panels(tabs, value=case, animated=False, keep_alive=True).props("keep-alive-exclude=Results").classes("panels"):
            with ui.tab_panel(case):
                self.build_case()
            with ui.tab_panel(runs):
                self.nothing = ui.label("Nothing has run yet: press Run beside the case.")
                self.list = ui.column().classes("wide")
            with ui.tab_panel(results):
                self.results = ResultsView(self.folder)
                self.results.build()
        ui.timer(TICK, self.look_at_runs)

    def build_case(self):
        """Buttons, messages, form and text."""
        self.gallery = ui.dialog()
        with ui.row().classes("bar"):
            self.opening = ui.select([], label="open a case", on_change=self.open_chosen).classes("chooser").mark("open")
            self.name = ui.input("name", value="case").classes("name").mark("name")
            ui.button("New", on_click=self.begin_anew).props("outline").mark("new")
            ui.button("Save", on_click=self.save).props("outline")
            ui.button("Run", icon="play_arrow", on_click=self.run).mark("run")
        self.verdict = ui.label("").classes("verdict")
        self.said = ui.column().classes("said")
        with ui.element("div").classes("two"):
            with ui.column().classes("side"):
                self.form = Form(self.keys, self.set_value, self.leave_out)
                self.form.build()
            with ui.column().classes("side follows"):
                self.sketch = ui.html("", sanitize=False).classes("beside-form")
                self.editor = ui.codemirror("", language="Fortran", line_wrapping=False, on_change=self.text_typed).classes("text")
                with ui.expansion("what the scene needs").classes("wide"):
                    self.needs = ui.label("").classes("log")

    async def begin(self, kept, case):
        """Fills the page: with what this tab had before it was loaded again, a case of the folder, or the program's first example."""
        self.kept = kept
        await self.list_cases()
        await self.results.list()
        if case and kept.get("asked") != case:
            kept["asked"] = case
            await self.open(case)
        elif "text" in kept:
            self.known, self.name.value = kept["known"], kept["name"]
            self.take(kept["text"])
        else:
            await self.template("equilibrium")

    async def turned(self, event):
        """Another part of the page is looked at."""
        if event.value == "Results":
            await self.results.show_last()

    # --- files ---

    async def list_cases(self):
        """The case files of the folder."""
        self.opening.set_options(await workers.io_bound(self.folder.cases), value=None)

    async def open_chosen(self, event):
        """Opens what was chosen from the list."""
        if not event.value:
            return
        if await self.may_replace():
            await self.open(event.value)
        await self.list_cases()

    async def begin_anew(self):
        """Begins from one of the program's own cases."""
        try:
            if not self.gallery.default_slot.children:
                await self.templates.fill(self.gallery)
        except CaseError as error:
            return complain(error)
        name = await self.gallery
        if name and await self.may_replace():
            await self.template(name)

    async def may_replace(self):
        """Asks before what was not saved is lost."""
        if self.text in (self.known, self.untouched):
            return True
        with ui.dialog() as dialog, ui.card():
            ui.label(f"{self.name.value} has changes that are not saved.")
            with ui.row():
                ui.button("Keep it", on_click=lambda: dialog.submit(False))
                ui.button("Replace it", on_click=lambda: dialog.submit(True)).props("outline")
        return await dialog

    async def template(self, analysis):
        """A case of the program's own."""
        try:
            text, _ = (await self.templates.all())[analysis]
        except CaseError as error:
            return complain(error)
        self.known, self.untouched, self.name.value = None, text, analysis
        for name, content in self.templates.bearings(analysis).items():
            try:
                await workers.io_bound(self.folder.write, name.removesuffix(CASE), content, None)
                ui.notify(f"{name} is written: the machine's bearings", type="positive")
            except (Refused, OSError):
                ui.notify(f"the machine's bearings are {name} of this folder")
        self.take(text)

    async def open(self, name):
        """A case file of the folder."""
        try:
            text = await workers.io_bound(self.folder.read, name)
        except (Refused, OSError) as error:
            complain(error)
            return self.take(self.text or EMPTY)
        self.known, self.name.value = text, name.removesuffix(CASE)
        self.take(text)

    async def save(self):
        """Writes the case file."""
        name, text = self.name.value, self.text
        try:
            await workers.io_bound(self.folder.write, name, text, self.known)
        except (Refused, OSError) as error:
            return complain(error)
        self.known = text
        self.remember()
        await self.list_cases()
        ui.notify(f"{name}{CASE} is written", type="positive")

    def remember(self):
        """Keeps what would be lost where the tab is loaded again."""
        self.kept.update(text=self.text, known=self.known, name=self.name.value)

    # --- form and text ---

    def take(self, text):
        """A new text, from somewhere else than the editor."""
        self.text = text
        self.editor.set_value(text)
        self.follow()

    def text_typed(self, event):
        """The text was changed in the editor."""
        if event.value != self.text:
            self.text = event.value
            self.follow()

    def set_value(self, key, value):
        """A field was changed in the form."""
        self.take(with_value(self.text, key.group, key.name, None if value is None else namelist_value(value)))

    def leave_out(self, group):
        """A group was taken out in the form."""
        self.take(without_group(self.text, group))

    def follow(self):
        """Form and messages follow the text, once nothing more is typed."""
        self.changes += 1
        background_tasks.create(self.follow_soon(self.changes), name="check")

    async def follow_soon(self, change):
        await asyncio.sleep(PAUSE)
        if change != self.changes:
            return
        self.remember()
        try:
            case = Case.parse(self.text)
            self.form.show(case)
            self.draw(case)
        except CaseError:
            case = None  # the program says what is wrong with it
        judged, no_use = await asyncio.gather(self.judge(self.text), without_use(self.gfb, self.text))
        if change == self.changes:
            self.judged = dataclasses.replace(judged, messages=self.form.explain(judged.messages, case))
            self.show_judged(self.judged)
            self.form.show_uses(no_use)

    async def judge(self, text):
        """Has the program check a text; the files of a machine's bearings are those of the folder."""
        try:
            return await check(self.gfb, self.folder.whole(text))
        except Refused as error:
            return Judged((Message(str(error), group="bearings", key="files"),), "")

    def draw(self, case):
        """The sketch follows the case; half a number leaves the last one."""
        drawn = picture_of_case(case, sizes_of_files(case, self.folder.read))
        if drawn:
            self.sketch.set_content(svg_of(drawn))

    def show_judged(self, judged):
        """Messages: all of them above, each at its field, and at its line."""
        mistakes = sum(not one.is_warning for one in judged.messages)
        warnings = len(judged.messages) - mistakes
        words = [counted(mistakes, "mistake")]*bool(mistakes) + [counted(warnings, "warning")]*bool(warnings)
        self.verdict.set_text(", ".join(words) if mistakes else ": ".join(["in order", *words]))
        self.verdict.classes(replace="verdict " + ("bad" if mistakes else "good"))
        self.said.clear()
        with self.said:
            for one in judged.messages[:MOST_SAID]:
                ui.label(str(one)).classes("warning" if one.is_warning else "mistake")
            if len(judged.messages) > MOST_SAID:
                ui.label(f"... and {len(judged.messages) - MOST_SAID} more")
        self.form.show_messages(judged.messages)
        lines = len(self.text.splitlines())
        self.editor.decorations = [{"kind": "line", "line": one.line, "class": "warned" if one.is_warning else "wrong"}
                                   for one in judged.messages if 0 < one.line <= lines]
        self.needs.set_text(judged.needs or "the case has mistakes")

    # --- runs ---

    async def run(self):
        """Runs the case as it stands in the text."""
        text, name = self.text, self.name.value
        if not (await self.judge(text)).is_right:
            return complain("the case has mistakes: they stand above the form")
        try:
            await self.runs.start(name, text)
        except (Refused, OSError) as error:
            return complain(error)
        self.tabs.set_value("Runs")

    def look_at_runs(self):
        """Shows how runs stand; those of other tabs, too."""
        self.nothing.set_visibility(not self.runs.all)
        for run in self.runs.all:
            if run not in self.rows:
                with self.list:
                    self.rows[run] = Row(run, self.runs, self.show_result)
                self.rows[run].card.move(target_index=0)
            self.rows[run].follow()

    async def show_result(self, run):
        """Shows the results of a run beside those that are shown."""
        await self.results.find_last()  # which is not what is asked for
        self.tabs.set_value("Results")
        await self.results.add(str(run.stem.relative_to(self.folder.path)))


class Row:
    """What is shown of a run."""

    def __init__(self, run, runs, show_result):
        self.run, self.said, self.is_over = run, 0, False
        with ui.card().classes("wide") as self.card:
            with ui.row().classes("bar"):
                ui.label(run.folder.name).classes("brand")
                self.state = ui.label("").classes("state")
                self.stop = ui.button("Stop", icon="stop", on_click=lambda: runs.end(run)).props("outline")
                self.show = ui.button("Show results", on_click=lambda: show_result(run))
                self.show.set_visibility(False)
            self.bar = ui.linear_progress(show_value=False).props("indeterminate")
            self.last = ui.label("").classes("log")
            with ui.expansion("all that it said").classes("wide"):
                self.log = ui.log(max_lines=2000).classes("log")

    def follow(self):
        """Brings it up to date."""
        run = self.run
        if self.is_over:
            return
        self.is_over = run.status is not None
        self.state.set_text(f"{run.words}, {run.seconds:.1f} s")
        first = max(0, self.said - run.left_out)
        for line in run.lines[first:]:
            self.log.push(line)
        self.said = run.left_out + len(run.lines)
        self.last.set_text(next((line for line in reversed(run.lines) if line.strip()), ""))
        if run.part is not None:
            self.bar.props(remove="indeterminate")
            self.bar.set_value(run.part)
        if self.is_over:
            self.bar.set_visibility(False)
            self.stop.set_visibility(False)
            self.show.set_visibility(run.stem is not None)


def complain(error):
    """Says what went wrong."""
    ui.notify(str(error), type="negative", multi_line=True)


def counted(number, word):
    """So many of something."""
    return f"{number} {word}{'s' if number != 1 else ''}"
