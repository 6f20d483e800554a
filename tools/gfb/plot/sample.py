"""The picture of a sample: how often a result has which value over random bumps."""

import numpy
from matplotlib import pyplot

from gfb.plot.film import readable
from gfb.plot.scene import case_name, named
from gfb.tool import stop

USUAL = ("minimum_gap", "loading_stiffness")


def draw(path, file, columns=()):
    """A histogram and the cumulative share of the members below a value, a row a result; mean and quantiles as lines."""
    history, sample = file["history"], file["sample"]
    columns = list(columns) or [name for name in USUAL if name in sample]
    if not columns:
        stop(f"{path}: no member has an answer")
    unknown = [name for name in columns if name not in sample or name == "quantiles"]
    if unknown:
        stop(f"{path}: no statistics of {', '.join(unknown)}; there are: {', '.join(set(sample) - {'quantiles'})}")
    figure, axes = pyplot.subplots(len(columns), 2, figsize=(10.0, 3.2*len(columns) + 0.5), squeeze=False, layout="constrained")
    for charts, name in zip(axes, columns):
        values, unit = readable(history[name])
        found = numpy.sort(values[numpy.isfinite(values)])
        largest = numpy.nanmax(abs(history[name][...]))
        scale = abs(found).max()/largest if largest > 0.0 else 1.0
        mean = float(sample[name]["mean"][...].ravel()[0])*scale
        quantiles = sample[name]["quantiles"][...].ravel()*scale
        charts[0].hist(found, bins=max(5, int(numpy.ceil(2.0*len(found)**(1.0/3.0)))), color="C0", alpha=0.6)
        charts[0].set_ylabel("members")
        charts[0].axvline(mean, color="C3", label="mean")
        charts[0].legend(fontsize=8)
        charts[1].step(found, numpy.arange(1, len(found) + 1)/len(found), where="post")
        for level, value in zip(sample["quantiles"][...].ravel(), quantiles):
            charts[1].plot([value], [level], "o", color="C1", markersize=4.0)
            charts[1].annotate(f"{100.0*level:.0f} %", (value, level), xytext=(-5, 3), textcoords="offset points", fontsize=8, ha="right")
        charts[1].set_ylabel("share of members below")
        charts[1].set_ylim(0.0, 1.06)
        charts[1].margins(x=0.12)
        for chart in charts:
            chart.set_xlabel(named(name, unit))
            chart.grid(alpha=0.3)
    figure.suptitle(f"{case_name(path)}: {len(found)} of {len(history['seed'])} members", fontsize=11)
    return figure
