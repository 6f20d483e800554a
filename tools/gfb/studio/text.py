"""Changes of single values in the text of a case file: all else in it, comments too, stays as it is."""

from gfb.namelist import Places


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
