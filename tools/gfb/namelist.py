"""Python values as a namelist writes them."""


def namelist_value(value):
    """A Python value as a namelist writes it."""
    if isinstance(value, str):
        return "'" + value.replace("'", "''") + "'"
    if isinstance(value, bool):
        return ".true." if value else ".false."
    if isinstance(value, float):
        return repr(float(value))  # NumPy's floats too
    if isinstance(value, int):
        return repr(value)
    return ", ".join(map(namelist_value, value))
