"""The program's own cases to begin from, with a picture each."""

import asyncio

from nicegui import run as workers
from nicegui import ui

from gfb.case import Case
from gfb.report.main import svg_of
from gfb.report.machine import picture_of_case


MACHINE, BEARING = "machine", "bearing.nml"


class Templates:
    """The cases of `gfb --template`; asked for once."""

    def __init__(self, keys, gfb):
        self.names = [*keys["scene"]["analysis"].choices, *(word for word in keys["bearing"]["kind"].choices if word == "thrust"), *[MACHINE]*("shaft" in keys)]
        self.gfb, self.read, self.reading, self.beside = gfb, {}, asyncio.Lock(), {}

    async def all(self):
        """{name: (text, picture)}; raises CaseError where the program has none."""
        async with self.reading:
            if not self.read:
                cases = await asyncio.gather(*(workers.io_bound(Case.template, name, self.gfb) for name in self.names))
                for name, case in zip(self.names, cases):
                    if case.holds_bearings():
                        self.beside[name] = {BEARING: str(case.bearing(1))}
                        case["bearings%files"] = (BEARING,)*len(case.listed("bearings%files"))
                    self.read[name] = str(case), picture_of(case)
        return self.read

    def bearings(self, name):
        """{name: text} of the files that a template names."""
        return self.beside.get(name, {})

    async def fill(self, dialog):
        """Puts all of them into a dialog, which tells the name of the one that is chosen; raises CaseError where the program has none."""
        there = await self.all()
        with dialog, ui.card().classes("templates"):
            ui.label("Begin from").classes("brand")
            with ui.element("div").classes("cards"):
                for name, (_, picture) in there.items():
                    with ui.card().classes("template").on("click", lambda name=name: dialog.submit(name)):
                        ui.html(picture, sanitize=False).classes("wide")
                        ui.button(name.replace("_", " ")).props("flat dense no-caps").classes("wide")


def picture_of(case):
    """The sketch of a case without the words below it."""
    drawn = picture_of_case(case)
    return svg_of(drawn and drawn | {"texts": (), "height": drawn["texts"][0][1] - 10.0})
