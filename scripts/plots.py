"""Plots with two logarithmic axes, as SVG."""
import matplotlib
from matplotlib.figure import Figure

matplotlib.rcParams.update({"svg.hashsalt": "softbody", "svg.fonttype": "none"})


def log_plot(path, labels, lines, size=(9.0, 3.4)):
    """@param labels of the two axes; @param lines: (name, points, how they are drawn as arguments of `plot`)."""
    figure = Figure(figsize=size, layout="constrained")
    axis = figure.subplots()
    for name, points, style in lines:
        axis.loglog(*zip(*points), label=name, **style)
    axis.set(xlabel=labels[0], ylabel=labels[1])
    axis.grid(color="#ddd")
    axis.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    figure.savefig(path, metadata={"Date": None})
