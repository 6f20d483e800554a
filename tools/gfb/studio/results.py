"""Results side by side: answers first, pictures that can be turned, all names, and the keys and answers that differ."""

from nicegui import run as workers
from nicegui import ui

from gfb.report.main import answer_rows, differences, key_rows, svg_of
from gfb.report.orifices import HEADS
from gfb.report.verdict import colour_of, total_power
from gfb.results import Unreadable
from gfb.studio import pictures
from gfb.studio.runs import Refused

MOST = 6  # results side by side


class ResultsView:
    """What is shown of the results that are chosen."""

    def __init__(self, folder):
        self.folder, self.shown, self.found, self.newest = folder, [], {}, None

    def build(self):
        """Chooser, and room for the rest."""
        with ui.row().classes("bar"):
            self.chooser = ui.select([], label="results, several side by side", multiple=True, on_change=self.chosen) \
                .props("use-chips").classes("chooser wide").mark("results").on("popup-show", self.list)
        self.room = ui.column().classes("wide")

    async def show_last(self):
        """Shows the last run, beside what is chosen, unless it was the last one before."""
        if name := await self.find_last():
            await self.add(name)

    async def find_last(self):
        """The last run; None where it was that before, or there is none."""
        there, before = await self.list(), self.newest
        self.newest = there[0] if there else None
        return self.newest if self.newest != before else None

    async def list(self):
        """The results that there are, the newest first."""
        there = await workers.io_bound(self.folder.results)
        options = list(dict.fromkeys([*there, *self.chooser.value]))
        if options != self.chooser.options:
            self.chooser.set_options(options)
        return there

    async def add(self, name):
        """Shows one more."""
        await self.list()
        if name in self.chooser.options and name not in self.chooser.value:
            self.chooser.set_value([*self.chooser.value, name][-MOST:])

    async def chosen(self, event):
        """Reads what was chosen and shows it."""
        names = list(event.value)
        if len(names) > MOST:
            return self.chooser.set_value(names[-MOST:])
        if names == self.shown:
            return
        self.shown, read = names, {}
        for name in names:
            try:
                read[name] = self.found.get(name) or await workers.io_bound(pictures.read_result, self.folder, name)
            except (Refused, Unreadable, OSError) as error:
                ui.notify(str(error), type="negative", multi_line=True)
        if names == self.shown:  # not chosen anew meanwhile
            self.found = read
            self.show()

    # --- what is shown ---

    def show(self):
        """All of it."""
        self.room.clear()
        if not self.found:
            return
        runs = list(self.found.values())
        with self.room:
            together = total_power(runs)
            if together:
                ui.label(together)
            with ui.element("div").classes("beside"):
                for run in runs:
                    show_answer(run)
            self.show_pictures(runs)
            if len(runs) > 1:
                ui.label("What of the cases differs").classes("brand")
                table_of([{"name": row["name"], "unit": "", "values": row["values"]} for row in key_rows(runs) if row["differs"]], runs, "key")
            if len(runs) == 2:
                show_differences(*runs)
            with ui.expansion("all results by name").classes("wide"):
                table_of(answer_rows(runs), runs, "name", meaning=True)

    def show_pictures(self, runs):
        """One kind of picture of all results, and the chooser of it."""
        there = list(dict.fromkeys(name for run in runs for name in run["pictures"]))
        if not there:
            return
        first = next((name for name in (pictures.POINTS_PICTURE, "film: pressure") if name in there), there[0])
        with ui.row().classes("bar"):
            kind = ui.select(there, label="picture", value=first, on_change=lambda event: self.draw(event.value)).classes("chooser").mark("picture")
        self.drawn = ui.element("div").classes("wide")
        self.kind = kind
        ui.timer(0.0, lambda: self.draw(kind.value), once=True)

    async def draw(self, name):
        """Draws it of all that have it."""
        runs = list(self.found.values())
        if name == pictures.POINTS_PICTURE:
            self.drawn.clear()
            with self.drawn:
                return show_points(runs)
        figures = []
        for run in runs:
            if name in run["pictures"]:
                try:
                    figures.append((run, await workers.io_bound(pictures.draw_result, self.folder, run["stem"], name)))
                except OSError as error:  # it may be another file by now
                    ui.notify(str(error), type="negative", multi_line=True)
        if name != self.kind.value:
            return
        pictures.same_colours([figure for _, figure in figures if figure])
        self.drawn.clear()
        with self.drawn, ui.element("div").classes("beside"):
            for run, figure in figures:
                with ui.card().classes("result"):
                    ui.label(run["name"]).classes("brand")
                    if figure:
                        ui.label(figure.pop("above")).classes("remark")
                        figure.pop("field", None)
                        ui.plotly(figure).classes("wide space")
                    else:
                        ui.label("cannot be drawn of this result")


def show_answer(run):
    """What one asks first."""
    with ui.card().classes("result"):
        ui.label(run["name"]).classes("brand")
        ui.label(str(run["title"]))
        ui.label(run["verdict"]).classes(f"sentence {colour_of(run['margins']) if run['converged'] else 'broken'}")
        if run["converged"]:
            if run["rows"]:
                ui.label("Of the last point or load step.")
            with ui.element("div").classes("margins"):
                for one in run["margins"]:
                    ui.label(f"{one.subject}: {one.value}{f' ({one.where})' if one.where else ''}")
                    ui.label(", ".join(filter(None, (one.limit, one.times))))
                    ui.label(one.sign).classes(f"sign {one.state}")
        with ui.element("div").classes("glance"):
            if run["sketch"]:
                ui.html(svg_of(run["sketch"]), sanitize=False)
            with ui.element("div").classes("answers"):
                for words, value, verdict, is_bad in run["glance"]:
                    ui.label(words)
                    with ui.element("div"):
                        ui.label(value).classes("value")
                        ui.label(verdict).classes("mistake" if is_bad else "verdict")
        if run["orifices"]:
            with ui.expansion("orifices"):
                ui.table(rows=[dict(zip(HEADS, row, strict=True)) for row in run["orifices"]], row_key=HEADS[0], pagination=0,
                         columns=[{"name": head, "label": head, "field": head, "align": "right"} for head in HEADS]).props("dense flat hide-bottom")


def table_of(rows, runs, first, meaning=False):
    """A table with a column a result, and a field that looks for rows."""
    if not rows:
        ui.label("nothing")
        return
    sides = [{"name": "name", "label": first, "field": "name", "align": "left", "sortable": True}]
    sides += [{"name": f"v{i}", "label": run["name"], "field": f"v{i}", "align": "right"} for i, run in enumerate(runs)]
    sides += [{"name": one, "label": one, "field": one, "align": "left"} for one in (("unit", "meaning") if meaning else ())]
    lines = [{"name": row["name"], "unit": row["unit"] if row["unit"] != "1" else "", "meaning": row.get("meaning", "")}
             | {f"v{i}": value for i, value in enumerate(row["values"])} for row in rows]
    looked_for = ui.input("find").props("dense clearable")
    ui.table(rows=lines, columns=sides, row_key="name", pagination=0).props("dense flat wrap-cells hide-bottom").classes("wide") \
        .bind_filter_from(looked_for, "value", lambda words: words or "")


def show_differences(first, second):
    """A table of what the second of two answers has otherwise than the first, in the units that people read."""
    ui.label("What of the answers differs").classes("brand")
    rows = differences(first, second)
    if not rows:
        ui.label("nothing")
        return
    heads = (("name", "name"), ("first", first["name"]), ("second", second["name"]), ("more", "difference"), ("percent", "in %"), ("meaning", "meaning"))
    columns = [{"name": key, "label": head, "field": key, "align": "left" if key in ("name", "meaning") else "right", "sortable": True} for key, head in heads]
    ui.table(rows=rows, columns=columns, row_key="name", pagination=0).props("dense flat wrap-cells hide-bottom").classes("wide differences")


def show_points(runs):
    """Values over each other, along points or time."""
    runs = [run for run in runs if pictures.POINTS_PICTURE in run["pictures"]]
    columns = list(dict.fromkeys(name for run in runs for name in run["columns"][0]))
    first = pictures.along_of(runs[0]["columns"][0], runs[0]["used"])
    others = [name for name in columns if name not in (first, pictures.POINT)]

    def redraw():
        shown.update_figure(pictures.curves([(run["name"], *run["columns"]) for run in runs], x.value, y.value))

    with ui.row().classes("bar"):
        y = ui.select(columns, label="up", value="minimum_gap" if "minimum_gap" in others else [*others, first][0],
                      on_change=redraw)
        x = ui.select(columns, label="across", value=first, on_change=redraw)
    shown = ui.plotly({"data": [], "layout": {}}).classes("wide")
    redraw()
