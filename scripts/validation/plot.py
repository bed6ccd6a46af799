"""The plot of docs/validation.md."""
import math


def plot(studies, path):
    """Relative error over cells across, both logarithmic."""
    colors = {"cantilever": "#1b6ca8", "Cook's membrane": "#c1440e", "twist": "#3a7d44"}
    x = lambda n: 70 + 130 * math.log2(n)
    y = lambda error: 30 + 75 * -math.log10(error)
    lines = ['<svg xmlns="http://www.w3.org/2000/svg" width="900" height="340" font-family="sans-serif" font-size="13">',
             '<rect width="900" height="340" fill="white"/>']
    for exponent in range(-3, 1):
        height = y(10.0**exponent)
        lines.append(f'<line x1="70" x2="850" y1="{height}" y2="{height}" stroke="#ddd"/>'
                     f'<text x="62" y="{height + 4}" text-anchor="end">{10.0**(exponent + 2):g} %</text>')
    for k in range(7):
        lines.append(f'<text x="{x(2**k)}" y="285" text-anchor="middle">{2**k}</text>')
    lines.append('<text x="460" y="310" text-anchor="middle">cells across</text>')
    lines.append('<text x="70" y="18">error of the result</text>')
    for i, (name, color) in enumerate(colors.items()):
        points = [(x(n), y(abs(ratio - 1.0))) for _, n, _, ratio, _ in studies[name]]
        lines.append(f'<polyline fill="none" stroke="{color}" stroke-width="2" points="'
                     + " ".join(f"{a:.1f},{b:.1f}" for a, b in points) + '"/>')
        lines += [f'<circle cx="{a:.1f}" cy="{b:.1f}" r="4" fill="{color}"/>' for a, b in points]
        lines.append(f'<text x="640" y="{52 + 18 * i}" fill="{color}">{name}</text>')
    path.write_text("\n".join(lines) + "\n</svg>\n")
