"""Exponents of growth."""
import math


def exponent(sizes, values):
    """Slope of log(value) over log(size) by least squares, and its standard error. None: too few values."""
    points = [(math.log(size), math.log(value)) for size, value in zip(sizes, values) if value > 0.0]
    count = len(points)
    if count < 3:
        return None
    mean_x, mean_y = (sum(coordinate) / count for coordinate in zip(*points))
    spread = sum((x - mean_x) ** 2 for x, _ in points)
    slope = sum((x - mean_x) * (y - mean_y) for x, y in points) / spread
    rest = sum((y - mean_y - slope * (x - mean_x)) ** 2 for x, y in points)
    return slope, math.sqrt(rest / (count - 2) / spread)


def exponents(series):
    """{quantity: exponent()} of a series."""
    rows = [row for row in series.rows if row[0] >= series.fitted_from]
    return {quantity: exponent([size for size, _ in rows], [values[quantity] for _, values in rows])
            for quantity in series.rows[0][1]}
