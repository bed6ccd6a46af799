"""The plot of docs/growth.md."""
import math

COLORS = ("#1b6ca8", "#c1440e", "#3a7d44", "#7b4ea3", "#8a6d00")


def plot(all_series, path):
    """Time of a frame over size, both logarithmic and relative to the smallest size."""
    curves = [(series.size, [(math.log10(size / series.rows[0][0]), math.log10(values["frame"] / series.rows[0][1]["frame"]))
                             for size, values in series.rows]) for series in all_series]
    right = math.ceil(max(x for _, points in curves for x, _ in points))
    top = max(1, math.ceil(max(y for _, points in curves for _, y in points)))
    x = lambda value: 70 + 620 * value / right
    y = lambda value: 290 - 250 * value / top
    lines = ['<svg xmlns="http://www.w3.org/2000/svg" width="900" height="340" font-family="sans-serif" font-size="13">',
             '<rect width="900" height="340" fill="white"/>']
    for k in range(top + 1):
        lines.append(f'<line x1="70" x2="690" y1="{y(k):.1f}" y2="{y(k):.1f}" stroke="#ddd"/>'
                     f'<text x="62" y="{y(k) + 4:.1f}" text-anchor="end">{10**k:g}</text>')
    lines += [f'<text x="{x(k):.1f}" y="308" text-anchor="middle">{10**k:g}</text>' for k in range(right + 1)]
    lines.append('<text x="380" y="330" text-anchor="middle">size / smallest size</text>')
    lines.append('<text x="70" y="22">time of a frame / that of the smallest size</text>')
    end = min(right, top)
    lines.append(f'<line x1="{x(0):.1f}" y1="{y(0):.1f}" x2="{x(end):.1f}" y2="{y(end):.1f}" stroke="#999" '
                 'stroke-dasharray="4"/>')
    for i, (name, points) in enumerate(curves):
        color = COLORS[i % len(COLORS)]
        places = [(x(a), y(b)) for a, b in points]
        lines.append(f'<polyline fill="none" stroke="{color}" stroke-width="2" points="'
                     + " ".join(f"{a:.1f},{b:.1f}" for a, b in places) + '"/>')
        lines += [f'<circle cx="{a:.1f}" cy="{b:.1f}" r="4" fill="{color}"/>' for a, b in places]
        lines.append(f'<text x="710" y="{52 + 20 * i}" fill="{color}">{name}</text>')
    lines.append(f'<text x="710" y="{52 + 20 * len(curves)}" fill="#999">in proportion</text>')
    path.write_text("\n".join(lines) + "\n</svg>\n")
