"""Changes of single values in the text of a case file: all else in it, comments too, stays as it is."""

from gfb.case import TOKENS


class Places:
    """Where groups and values stand in a text."""

    def __init__(self, text):
        self.values = {}  # (group, key): where the key begins, where its value begins, where it ends
        self.groups = {}  # group: where it begins, where its '/' stands
        words = [word for word in TOKENS.finditer(text) if not word[0].startswith("!")]
        group = key = ""
        for i, word in enumerate(words):
            following = words[i + 1][0] if i + 1 < len(words) else ""
            if i > 0 and words[i - 1][0] == "&":
                group, key = word[0].lower(), ""
                self.groups[group] = [words[i - 1].start(), len(text)]
            elif word[0] == "/" and group:
                self.groups[group][1] = word.start()
                group = key = ""
            elif group and following == "=":
                key = word[0].lower()
                self.values[group, key] = [word.start(), words[i + 1].end(), words[i + 1].end()]
            elif group and key and word[0] not in "&=,":
                place = self.values[group, key]
                if place[1] == words[i - 1].end() and words[i - 1][0] == "=":
                    place[1] = word.start()
                place[2] = word.end()


def with_value(text, group, key, words):
    """The text in which a key has the value that these words are; None: in which it does not stand."""
    places = Places(text)
    if (group, key) in places.values:
        begin, value, end = places.values[group, key]
        return text[:value] + words + text[end:] if words is not None else without(text, begin, end)
    if words is None:
        return text
    if group in places.groups:
        slash = places.groups[group][1]
        line = text.rfind("\n", 0, slash) + 1
        if not text[line:slash].strip():
            return f"{text[:line]}  {key} = {words}\n{text[line:]}"
        return f"{text[:slash].rstrip()} {key} = {words} {text[slash:]}"
    return f"{text.rstrip()}\n\n&{group}\n  {key} = {words}\n/\n".lstrip()


def without(text, begin, end):
    """The text without a part of it, and without its line where nothing but a comment is left of that."""
    line, after = text.rfind("\n", 0, begin) + 1, text.find("\n", end)
    after = len(text) if after < 0 else after + 1
    rest = text[end:after].lstrip(" ,")
    if not text[line:begin].strip() and (not rest.strip() or rest.startswith("!")):
        return text[:line] + text[after:]
    return text[:begin].rstrip(" ") + " " + rest + text[after:]


def without_group(text, group):
    """The text without a group."""
    places = Places(text)
    if group not in places.groups:
        return text
    begin, slash = places.groups[group]
    return (text[:begin].rstrip() + "\n\n" + text[slash + 1:].lstrip()).lstrip()
