"""A group of lists as a table in the form: a row for each segment of a shaft, each disc, bearing, load or unbalance."""

from nicegui import ui

from gfb.studio.rows import cell, columns_of, row_count, shown_columns, with_cell, with_row, without_row

WAIT = 400  # ms without a key stroke until a cell is taken over


class Table:
    """The lists of a group; without a row it is not seen, and the group has fields alone."""

    def __init__(self, group, keys, change):
        self.group, self.keys, self.change = group, keys, change
        self.values, self.shape, self.cells = {}, ((), 0), {}
        self.box = ui.column().classes("wide rows-box")

    @property
    def columns(self):
        """The keys that are its columns."""
        return shown_columns(self.group, self.keys, self.values)

    def show(self, values):
        """The values of the case."""
        self.values = dict(values)
        shape = (tuple(self.columns), row_count(self.group, self.values))
        self.box.set_visibility(bool(self.columns))
        if shape != self.shape:
            self.shape = shape
            self.build()
        for (row, name), box in self.cells.items():
            value, is_for_all = cell(self.values, self.group, name, row)
            box.set_value(self.keys[name].shown(value))
            box.classes(add="unset" if is_for_all and row else None, remove=None if is_for_all and row else "unset")

    def build(self):
        """Makes its cells anew."""
        self.box.clear()
        self.cells = {}
        columns, rows = self.shape
        if not columns:
            return
        with self.box:
            with ui.element("div").classes("rows").style(f"grid-template-columns: 1.6em repeat({len(columns)}, minmax(6.5em, 1fr)) 2.2em"):
                ui.label("")
                for name in columns:
                    key = self.keys[name]
                    with ui.label(f"{name} [{key.unit}]" if key.unit not in ("", "1") else name).classes("column-name"):
                        ui.tooltip(key.meaning.replace("`", ""))
                ui.label("")
                for row in range(rows):
                    ui.label(str(row + 1)).classes("row-number")
                    for name in columns:
                        self.cells[row, name] = self.make_cell(row, name)
                    button = ui.button(icon="close", on_click=lambda row=row: self.change_all(
                        without_row(self.values, self.group, columns_of(self.group, self.keys), row))).props("flat dense size=sm").mark(f"{self.group} out {row + 1}")
                    button.set_visibility(rows > 1)
            ui.button("add a row", icon="add", on_click=lambda: self.change_all(with_row(self.values, self.group, columns_of(self.group, self.keys)))) \
                .props("flat dense no-caps").mark(f"{self.group} row")

    def make_cell(self, row, name):
        """One cell."""
        value, _ = cell(self.values, self.group, name, row)
        box = ui.input(value=self.keys[name].shown(value), on_change=lambda event: self.typed(row, name, event.value or ""))
        box.props(f"dense outlined hide-bottom-space debounce={WAIT}").classes("field").mark(f"{self.group}%{name}({row + 1})")
        box.props["data-key"] = f"{self.group}%{name}"
        return box

    def typed(self, row, name, words):
        """A cell was changed by hand."""
        key, (before, _) = self.keys[name], cell(self.values, self.group, name, row)
        if words == key.shown(before):
            return
        value = key.typed(words)
        if isinstance(value, tuple):
            value = words  # the program says what is wrong with it
        if value != before:
            self.change_all({name: with_cell(self.values, self.group, name, row, value)})

    def change_all(self, changed):
        """Takes new values of keys over."""
        for name, value in changed.items():
            self.values[name] = value
            self.change(self.keys[name], value)
