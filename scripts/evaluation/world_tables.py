"""The tables of docs/evaluation.md on bodies of one colour, predicted errors and wrong objects."""
import math

from evaluation.figures import (FALSE_AFTER_S, OWN_COLOUR, PLAIN, STARTS, TEXTURED, TEXTURES, calibration_bins,
                                false_tracking, frames, get, number, of_kind, percent, tracking_share)
from evaluation.tables import section

CALIBRATION_PLOT = "docs/images/calibration.svg"


def plain_bodies(reports):
    rows = []
    for name, report in of_kind(reports, "plain").items():
        if name not in (*PLAIN, *OWN_COLOUR):
            continue
        error, starts = report["vertex_error"], reports.get(("starts", name))
        rows.append([name, frames(report), percent(tracking_share(report), 0), number(error["all"]["mean_mm"]),
                     number(error["visible"]["mean_mm"]), number(error["hidden"]["mean_mm"]),
                     number(max(error["frame_mean_mm"])), number(get(report, "jitter", "per_vertex", "rms_mm")),
                     number(get(starts, "mean_mm")), number(get(starts, "max_mm"))])
    return section("Bodies of one colour",
                   "The sponge with `--texture plain` (`still` for 10 s). In `touch` and `squeeze` the hands have the "
                   f"body's own colour. Each other scene is also tracked from {STARTS} rough poses within 2 mm and "
                   "1 degree of each other. In each frame after 0.5 s, the mean distance of the vertices is computed "
                   "between the two results that are farthest apart. The last two columns give its mean over the "
                   "frames, and its value in the worst frame. All errors are in mm.",
                   ["scene", "frames answered", "tracking [%]", "mean", "mean visible", "mean hidden", "worst frame",
                    "jitter while still", f"between {STARTS} starts, mean", "worst frame"], rows)


def textures(reports):
    kinds = ("scene", *TEXTURES)
    rows = []
    for scene in TEXTURED:
        found = [reports.get((kind, scene)) for kind in kinds]
        if any(found[1:]):
            rows.append([scene, *(number(get(report, "vertex_error", part, "mean_mm"))
                                  for part in ("visible", "hidden") for report in found)])
    return section("Textures",
                   "The same scenes with the textures `rich` (as in all other tables), `weak` and `plain`. Mean errors "
                   "of the visible and of the hidden vertices, in mm.",
                   ["scene", *(f"{part}, {texture}" for part in ("visible", "hidden")
                               for texture in ("rich", *TEXTURES))], rows)


def predicted_errors(reports):
    rows = []
    words = {"scene": "", "plain": ", one colour", "weak": ", weak texture"}
    for kind in words:
        for name, report in of_kind(reports, kind).items():
            found = get(report, "calibration")
            rows.append([name + words[kind], percent(get(found, "within_90_visible")),
                         percent(get(found, "within_90_hidden")), number(get(found, "median_ratio"))])
    lines = section("Predicted errors",
                    "A state can give a standard deviation for each vertex: the predicted RMS of its distance from the "
                    "true position. If the three components of the error are independent and normal, 90 % of the "
                    "distances are at most 1.44 times as large. The table shows which share of the vertices is within "
                    "this bound, and the median of bound over error. `-`: the states have no standard deviations.",
                    ["scene", "visible vertices within the bound [%]", "hidden vertices [%]", "bound over error"], rows)
    if calibration_bins(reports):
        lines += ["![RMS error over the predicted standard deviation, all scenes](images/calibration.svg)", ""]
    return lines


def wrong_objects(reports):
    rows = []
    for what, report in of_kind(reports, "wrong").items():
        late = [state for time, state in report["states_by_time"] if time >= FALSE_AFTER_S]
        rows.append([what, late[0], f"{false_tracking(report)} of {len(late)}", "-"])
    for what, report in of_kind(reports, "placed").items():
        error = report["vertex_error"]
        late = [(state, largest) for time, state, largest in
                zip(error["frame_times_s"], report["frame_states"], error["frame_visible_max_mm"])
                if time >= FALSE_AFTER_S]
        rows.append([what, late[0][0], f"{sum(state == 'tracking' for state, _ in late)} of {len(late)}",
                     number(max(largest for _, largest in late if largest is not None))])
    return section("Wrong objects and poses",
                   "The scene `bend`. The tracker is told where the body is, and does not search (`replay --placed`): "
                   "first with the model of another object at the place of the true one, then with the true object "
                   "at a wrong pose. The tracker should not call this TRACKING, unless the pose is right again.",
                   ["object or pose", "state after 1 s", "frames called TRACKING after 1 s",
                    "largest error of a visible vertex after 1 s [mm]"], rows)


def plot_calibration(reports, path):
    """RMS error over predicted standard deviation [mm], both logarithmic; nothing without predictions."""
    points = [(math.sqrt(predicted / count), math.sqrt(error / count), count)
              for count, predicted, error in calibration_bins(reports).values()]
    if not points:
        return
    low, high = 0.01, 100.0
    x = lambda mm: 80 + 100 * math.log10(min(max(mm, low), high) / low)
    y = lambda mm: 430 - 100 * math.log10(min(max(mm, low), high) / low)
    most = max(count for _, _, count in points)
    lines = ['<svg xmlns="http://www.w3.org/2000/svg" width="560" height="500" font-family="sans-serif" '
             'font-size="13">',
             '<rect width="560" height="500" fill="white"/>']
    for exponent in range(-2, 3):
        mm = 10.0 ** exponent
        lines.append(f'<line x1="{x(mm)}" x2="{x(mm)}" y1="{y(low)}" y2="{y(high)}" stroke="#ddd"/>'
                     f'<line x1="{x(low)}" x2="{x(high)}" y1="{y(mm)}" y2="{y(mm)}" stroke="#ddd"/>'
                     f'<text x="{x(mm)}" y="450" text-anchor="middle">{mm:g}</text>'
                     f'<text x="72" y="{y(mm) + 4}" text-anchor="end">{mm:g}</text>')
    lines.append(f'<line x1="{x(low)}" y1="{y(low)}" x2="{x(high)}" y2="{y(high)}" stroke="#888"/>')
    lines.append('<text x="280" y="480" text-anchor="middle">predicted standard deviation [mm]</text>'
                 '<text x="80" y="20">RMS error [mm]; larger dots: more vertices</text>')
    lines += [f'<circle cx="{x(a):.1f}" cy="{y(b):.1f}" r="{2 + 6 * math.sqrt(count / most):.1f}" fill="#1b6ca8"/>'
              for a, b, count in points]
    path.write_text("\n".join(lines) + "\n</svg>\n")
