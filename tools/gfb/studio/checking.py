"""What `gfb --check` says of the text of a case, message by message."""

import asyncio
import dataclasses
import re

from gfb.program import table_rows

MESSAGE = re.compile(r"(?P<warning>warning: )?stdin:(?:(?P<line>\d+):)? (?:&(?P<group>\w+): )?(?P<words>.*)")
KEY = re.compile(r"(?:.* )?key '(\w+)'|(\w+)(?:\(\d+\))?(?: = |: )")
SECONDS = 60  # no check takes that long


@dataclasses.dataclass(frozen=True)
class Message:
    """One mistake, or warning, of a case."""

    words: str
    is_warning: bool = False
    line: int = 0   # 0: of the whole case
    group: str = ""
    key: str = ""

    def __str__(self):
        place = [f"line {self.line}"]*(self.line > 0) + [f"&{self.group}"]*bool(self.group)
        return ("warning: " if self.is_warning else "") + "".join(f"{one}: " for one in place) + self.words


@dataclasses.dataclass(frozen=True)
class Judged:
    """What the program says of a case."""

    messages: tuple
    needs: str  # what the scene needs; empty where it has mistakes

    @property
    def is_right(self):
        """Whether it can be run."""
        return all(one.is_warning for one in self.messages)


def read_messages(said):
    """The messages among the program's lines; other lines that it ends with are one each, too."""
    messages = []
    for line in said.splitlines():
        found = MESSAGE.fullmatch(line)
        if not found:
            messages += [Message(line)]*bool(line.strip())
            continue
        key = KEY.match(found["words"])
        messages.append(Message(found["words"], bool(found["warning"]), int(found["line"] or 0), found["group"] or "",
                                ((key[1] or key[2]) if key else "").lower()))
    return tuple(messages)


async def ask(gfb, option, text):
    """What the program says of a text: status, output, complaint; in the root, where nobody else leaves a file."""
    process = await asyncio.create_subprocess_exec(gfb, option, "-", stdin=asyncio.subprocess.PIPE, stdout=asyncio.subprocess.PIPE,
                                                   stderr=asyncio.subprocess.PIPE, cwd="/")
    try:
        said, complaint = await asyncio.wait_for(process.communicate(text.encode()), SECONDS)
    finally:
        if process.returncode is None:
            process.kill()
    return process.returncode, said.decode("utf-8", "replace"), complaint.decode("utf-8", "replace")


async def check(gfb, text):
    """Has the program check a text."""
    try:
        status, said, complaint = await ask(gfb, "--check", text)
    except asyncio.TimeoutError:
        return Judged((Message(f"the check took more than {SECONDS} s"),), "")
    messages = read_messages(complaint)
    if status == 0:
        messages = tuple(one for one in messages if one.is_warning)  # a library may complain of the machine
    if status and all(one.is_warning for one in messages):
        messages += (Message(f"gfb --check ended with status {status}"),)
    return Judged(messages, said.strip() if status == 0 else "")


async def without_use(gfb, text):
    """{(group, key): why it has no use} in the case of a text, as the program says; empty where it says nothing."""
    try:
        _, said, _ = await ask(gfb, "--keys", text)
    except asyncio.TimeoutError:
        return {}
    return {(group.strip("`&"), name.strip("`")): why for group, name, *_, why in table_rows(said) if why}
