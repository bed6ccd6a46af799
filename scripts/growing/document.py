"""The text of docs/growth.md."""
import datetime

from evaluation.document import commit, processor
from growing.fit import exponents
from growing.measurements import UNITS
from markdown_lines import paragraph, table


def number(value):
    return f"{value:,.0f}" if value >= 1000.0 else f"{value:.3g}"


def exponent_text(slope):
    """@param slope and its standard error; None: too few values."""
    return f"{slope[0]:.2f} +- {slope[1]:.2f}" if slope else "-"


def section(series):
    quantities = list(series.rows[0][1])
    rows = [(f"{size:,}", *(number(values[quantity]) for quantity in quantities)) for size, values in series.rows]
    slopes = exponents(series)
    rows.append(("exponent", *(exponent_text(slopes[quantity]) for quantity in quantities)))
    since = f" Exponents are those from {series.fitted_from:,.0f} on." if series.fitted_from else ""
    heads = [f"{quantity} [{UNITS.get(quantity, 'ms')}]" for quantity in quantities]
    return [f"## By {series.size}", "", *paragraph(series.words + since), "", *table([series.size, *heads], rows)]


def document(all_series, root, load):
    lines = ["# How time and memory grow", "",
             *paragraph(f"Written by `make growth` on {datetime.date.today()} at commit {commit(root)}, on {processor()}, "
                        f"with a load of {load:.1f} from others. Times are those of one thread. The last row of a table is "
                        "the exponent: the slope of the logarithm of the value over that of the size, by least squares, and "
                        "its standard error. 1 means that twice the size takes twice as long."), "",
             "![frame over size](measured/growth.svg)", ""]
    for series in all_series:
        lines += section(series)
    return "\n".join(lines)
