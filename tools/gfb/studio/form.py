"""The form: a field for every key that the program knows, in its groups; what has no use in the case is folded away."""

import dataclasses

from nicegui import ui

from gfb.studio.checking import Message
from gfb.studio.rows import COUNTED
from gfb.studio.table import Table
from gfb.tables import ALSO_TYPED, READABLE, TYPED

GIVEN, NOT_GIVEN = "", "not in the case"
WAIT = 400  # ms without a key stroke until a field is taken over
LONGEST = 22  # letters of a default that its field has room for; longer ones stand below


class Field:
    """One key."""

    def __init__(self, key, value, change):
        self.key, self.value, self.change = key, value, change
        self.messages: tuple[Message, ...] = ()
        self.no_use = ""
        if key.choices:
            self.input = ui.select(self.options(value), label=key.name, value=key.shown(value), on_change=self.typed)
        else:
            self.input = ui.input(f"{key.name} [{key.unit}]" if key.unit not in ("", "1") else key.name, value=key.shown(value),
                                  on_change=self.typed).props(f"debounce={WAIT}").on("blur", self.tidy)
        self.input.classes("field").mark(f"{key.group}%{key.name}")
        self.input.props("dense outlined stack-label hide-bottom-space")
        self.input.props["placeholder"] = self.default if len(self.default) <= LONGEST else "default: see below"
        self.input.props["data-key"] = f"{key.group}%{key.name}"
        self.show_messages(())
        self.mark_unset()

    @property
    def default(self):
        """The default, as the program has it."""
        return self.key.default.replace("`", "")

    def options(self, value):
        """The words there are, and one that is none where the case has it."""
        shown = self.key.shown(value)
        return {"": f"({self.default})"} | {word: word for word in (*self.key.choices, *[shown]*bool(shown))}

    def typed(self, event):
        """The user has changed it."""
        words = event.value or ""
        if words == self.key.shown(self.value):
            return
        value = self.key.typed(words)
        if value != self.value:
            self.value = value
            self.mark_unset()
            self.change(self.key, value)

    def mark_unset(self):
        """Shows whether this is the case's own value, or the default."""
        self.input.classes(add="unset" if self.value is None else None, remove=None if self.value is None else "unset")

    def tidy(self):
        """Writes the number as it is shown, once the field is left."""
        self.input.set_value(self.key.shown(self.value))

    def show(self, value):
        """The value of the case, unless it is what stands here."""
        if value != self.value:
            self.value = value
            self.mark_unset()
            if self.key.choices:
                self.input.set_options(self.options(value), value=self.key.shown(value))
            else:
                self.input.set_value(self.key.shown(value))

    def show_messages(self, messages):
        """What the program says of it, otherwise what it means."""
        self.messages = messages
        wrong = [one.words for one in messages if not one.is_warning]
        self.input.props["hint"] = "; ".join(f"warning: {one.words}" for one in messages) if messages and not wrong else self.remark()
        self.input.props["error"] = bool(wrong)
        self.input.props["error-message"] = "; ".join(wrong)
        self.input.classes(add="warned-field" if messages and not wrong else None,
                           remove=None if messages and not wrong else "warned-field")


    def remark(self):
        """What it means, where it has no room for it its default, and why it has no use."""
        words = [f"No use here: {self.no_use}"]*bool(self.no_use) + [self.key.meaning.replace("`", "")]
        return ". ".join(words + [f"Default: {self.default}"]*(len(self.default) > LONGEST))

    def show_use(self, why):
        """Why it has no use in the case; empty where it has one."""
        if why != self.no_use:
            self.no_use = why
            self.show_messages(self.messages)


class Group:
    """A group of keys; its fields are made when it is opened first."""

    def __init__(self, name, keys, change, leave_out):
        self.name, self.keys, self.change, self.leave_out = name, keys, change, leave_out
        self.fields, self.values, self.is_given = {}, {}, False
        self.table = None  # of a group of lists
        self.no_use, self.words_found, self.shows_all = {}, [], False
        self.messages: tuple[Message, ...] = ()
        self.box = ui.expansion(f"&{name}", caption=NOT_GIVEN, on_value_change=self.opened).classes("group").mark(f"group {name}")
        self.box.props["data-group"] = name

    def opened(self, event):
        """Makes the fields."""
        if event.value and not self.fields:
            with self.box:
                self.words = ui.column().classes("said")
                self.table = Table(self.name, self.keys, self.change) if self.name in COUNTED else None
                with ui.element("div").classes("fields"):
                    self.fields = {name: Field(key, self.values.get(name), self.change) for name, key in self.keys.items()}
                self.out = ui.button(f"leave &{self.name} out", on_click=lambda: self.leave_out(self.name)).props("flat dense no-caps")
                self.out.set_visibility(self.is_given)
            if self.table:
                self.table.show(self.values)
            self.show_messages(self.messages)
            self.fold()

    def show(self, values):
        """The values of the case; None: it has not got this group."""
        begins, self.is_given = values is not None and not self.is_given, values is not None
        self.values = values or {}
        for name, field in self.fields.items():
            field.show(self.values.get(name))
        if self.table:
            self.table.show(self.values)
        if self.fields:
            self.out.set_visibility(self.is_given)
        if begins:
            self.box.open()
        self.caption()
        self.fold()

    def caption(self):
        """What stands beside its name."""
        mistakes = sum(not one.is_warning for one in self.messages)
        words = f"{len(self.messages)} to look at" if self.messages else GIVEN if self.is_given else NOT_GIVEN
        self.box.props["caption"] = words
        self.box.props["header-class"] = "bad" if mistakes else "warning" if self.messages else "" if self.is_given else "absent"

    def show_messages(self, messages):
        """Those of this group: at their fields, otherwise above them."""
        self.messages = tuple(messages)
        self.caption()
        self.fold()
        if not self.fields:
            return
        for name, field in self.fields.items():
            own = tuple(one for one in self.messages if one.key == name)
            if own != field.messages:
                field.show_messages(own)
        self.words.clear()
        with self.words:
            for one in self.messages:
                if one.key not in self.fields or one.key in self.in_table():
                    ui.label(one.words).classes("warning" if one.is_warning else "mistake")

    def look_for(self, words):
        """Shows the fields that are looked for."""
        self.words_found = words
        if self.fold() and words:
            self.box.open()

    def in_table(self):
        """The keys that are columns of the table."""
        return self.table.columns if self.table else []

    def is_folded(self, name):
        """Whether a key has no use, is not there, and nobody asks for it."""
        return not self.shows_all and name in self.no_use and name not in self.values and all(one.key != name for one in self.messages)

    def fold(self):
        """Shows what is looked for, and otherwise what has a use; whether that is anything."""
        if self.words_found:
            seen = [name for name, key in self.keys.items() if all(one in f"{self.name} {name} {key.meaning}".lower() for one in self.words_found)]
        else:
            seen = [name for name in self.keys if not self.is_folded(name)]
        self.box.set_visibility(bool(seen) or self.is_given and not self.words_found)
        for name, field in self.fields.items():
            field.input.set_visibility(name in seen and name not in self.in_table())
            field.show_use(self.no_use.get(name, ""))
        return bool(seen)


class Form:
    """All groups."""

    def __init__(self, keys, change, leave_out):
        self.keys, self.change, self.leave_out, self.groups = keys, change, leave_out, {}

    def build(self):
        """Makes it."""
        ui.input("find a key", on_change=lambda event: self.look_for(event.value or "")).props(f"clearable dense debounce={WAIT}") \
            .classes("wide").mark("find")
        others = [*(unit for table in (TYPED, READABLE) for unit, _ in table.values()), *(unit for units in ALSO_TYPED.values() for unit in units)]
        ui.label(f"A number without a unit is in that of its label; also {', '.join(others)} may be typed.").classes("remark")
        self.folded = ui.switch("", on_change=lambda event: self.show_all(event.value)).props("dense").classes("remark").mark("folded")
        self.folded.set_visibility(False)
        for name, keys in self.keys.items():
            self.groups[name] = Group(name, keys, self.change, self.leave_out)

    def show(self, case):
        """The values of a case."""
        for name, group in self.groups.items():
            group.show(case.groups.get(name))

    def show_messages(self, messages):
        """What the program says of the case."""
        for name, group in self.groups.items():
            group.show_messages([one for one in messages if one.group == name])

    def explain(self, messages, case):
        """The messages, of which those of a number with an unknown unit say which units there are."""
        found = []
        for one in messages:
            key = self.keys.get(one.group, {}).get(one.key)
            value = case.get(f"{one.group}%{one.key}") if key and case is not None else None
            words = key.unknown_unit(value) if value is not None else ""
            found.append(dataclasses.replace(one, words=words) if words else one)
        return tuple(found)

    def show_uses(self, no_use):
        """Folds away what has no use in the case: {(group, key): why}."""
        for name, group in self.groups.items():
            group.no_use = {key: why for (of, key), why in no_use.items() if of == name}
            group.fold()
        self.folded.set_text(f"show the {len(no_use)} keys that have no use in this case, too")
        self.folded.set_visibility(bool(no_use))

    def show_all(self, shows):
        """Whether what has no use is shown, too."""
        for group in self.groups.values():
            group.shows_all = shows
            group.fold()

    def look_for(self, words):
        """Leaves what has these words in its name or meaning."""
        for group in self.groups.values():
            group.look_for(words.lower().split())
