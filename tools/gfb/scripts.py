"""Commands of an installed package, `gfb-plot`, `gfb-report`, `gfb-coefficients`: those of tools/ with the same names."""

from gfb.tool import run


def plot():
    """Draws results."""
    from gfb.plot.main import main
    return run(main)


def report():
    """Makes a page of results."""
    from gfb.report.main import main
    return run(main)


def coefficients():
    """Writes stiffness and damping for other programs."""
    from gfb.coefficients import main
    return run(main)
