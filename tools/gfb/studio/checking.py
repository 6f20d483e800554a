"""What `gfb --check` says of the text of a case, message by message."""

import asyncio
import dataclasses
import re

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


async def check(gfb, text):
    """Has the program check a text; in the root, where nobody else leaves a file."""
    process = await asyncio.create_subprocess_exec(gfb, "--check", "-", stdin=asyncio.subprocess.PIPE, stdout=asyncio.subprocess.PIPE,
                                                   stderr=asyncio.subprocess.PIPE, cwd="/")
    try:
        said, complaint = await asyncio.wait_for(process.communicate(text.encode()), SECONDS)
    except asyncio.TimeoutError:
        return Judged((Message(f"the check took more than {SECONDS} s"),), "")
    finally:
        if process.returncode is None:
            process.kill()
    messages = read_messages(complaint.decode("utf-8", "replace"))
    if process.returncode == 0:
        messages = tuple(one for one in messages if one.is_warning)  # a library may complain of the machine
    if process.returncode and all(one.is_warning for one in messages):
        messages += (Message(f"gfb --check ended with status {process.returncode}"),)
    return Judged(messages, said.decode("utf-8", "replace").strip() if process.returncode == 0 else "")
