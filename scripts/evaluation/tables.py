"""The tables of docs/evaluation.md, each with its introduction, from the reports of `evaluate`."""
import statistics

from evaluation.figures import (WRONG_MATCH_SEEDS, cluttered_times, fault_times, frames, get,
                                moving_times, number, of_kind, percent, tracking_share, worst)
from markdown_lines import paragraph, table


def section(title, words, columns, rows):
    """A table with its introduction; nothing if there is no row."""
    return [f"## {title}", "", *paragraph(words), "", *table(columns, rows)] if rows else []


def accuracy(reports):
    rows = []
    for name, report in of_kind(reports, "scene").items():
        error = report["vertex_error"]
        lengths = [error["all"][key] for key in ("mean_mm", "rms_mm", "p95_mm", "max_mm")]
        rows.append([name, frames(report), percent(tracking_share(report), 0), *map(number, lengths),
                     number(error["visible"]["mean_mm"]), number(error["hidden"]["mean_mm"]),
                     percent(get(report, "silhouette", "mean_iou")), percent(get(report, "labels", "right")),
                     percent(get(report, "volume", "largest_error"))])
    return section("Every scene", "Distances of the vertices from their true positions [mm], over all answered "
                                  "frames. A frame is answered if the result has a surface with its stamp.",
                   ["scene", "frames answered", "tracking [%]", "mean", "RMS", "p95", "max", "mean visible",
                    "mean hidden", "silhouette IoU [%]", "labels right [%]", "volume error at most [%]"], rows)


def noise(reports):
    rows = []
    for name, off in of_kind(reports, "noise off").items():
        on = reports.get(("scene", name))
        cells = [number(get(report, "vertex_error", part, key)) for part, key in
                 (("visible", "mean_mm"), ("hidden", "mean_mm"), ("all", "p95_mm")) for report in (off, on)]
        rows.append([name, *cells])
    return section("With and without noise", "The same scenes with sensor noise switched off and on [mm].",
                   ["scene", "mean visible, off", "on", "mean hidden, off", "on", "p95, off", "on"], rows)


def volumes(reports):
    rows = []
    for name in of_kind(reports, "exact"):
        cells = [number(get(reports.get((kind, name)), "vertex_error", *keys)) for keys in
                 (("all", "p95_mm"), ("hidden", "mean_mm")) for kind in ("scene", "exact", "fine", "fine exact")]
        rows.append([name, *cells])
    return section("What the volume allows",
                   "Which part of the error comes from the volume (the tets) and its material? The columns \"exact\" "
                   "show a simulation that knows the exact position of every visible vertex (`simulate_truth`). "
                   "Even perfect tracking would leave about these errors. The columns \"finer\" use a cage of 300 "
                   "vertices (`prepare_model --cage-vertices 300`). The other columns use the shipped sponge with "
                   "300 tets, as in the paper. All errors are in mm.",
                   ["scene", "p95, tracked", "exact", "finer, tracked", "finer, exact", "mean hidden, tracked", "exact",
                    "finer, tracked", "finer, exact"], rows)


def cluttered(reports):
    rows = []
    for name, report in of_kind(reports, "cluttered").items():
        alone = reports[("uncluttered", name)]
        cells = [cell for part in ("all", "visible") for cell in
                 (*(number(get(each, "vertex_error", part, "mean_mm")) for each in (alone, report)),
                  number(cluttered_times(reports, name, part)))]
        rows.append([name, frames(report), percent(tracking_share(report), 0), *cells])
    return section("Other things",
                   "Scenes in which other things touch or hide the body, compared with the same motion without them. "
                   "The visible vertices are those that the other things do not hide, in both. All errors are in mm.",
                   ["scene", "frames answered", "tracking [%]", "mean, alone", "with other things", "ratio",
                    "mean visible, alone", "with other things", "ratio"], rows)


def moving_camera(reports):
    rows, times = [], moving_times(reports)
    for name, moving in of_kind(reports, "moving camera").items():
        rest = reports.get(("scene", name))
        cells = [number(get(report, *keys)) for keys in
                 (("vertex_error", "all", "mean_mm"), ("vertex_error", "all", "p95_mm"),
                  ("vertex_error", "visible", "mean_mm"), ("jitter", "per_vertex", "rms_mm"))
                 for report in (rest, moving)]
        rows.append([name, frames(moving), *cells[:2], number(times[name]), *cells[2:]])
    return section("Moving camera",
                   "Recorded with `--camera-motion orbit`, and tracked with `--output-frame world`. The columns "
                   "\"fixed\" show the same scene with a camera at rest. All errors are in mm.",
                   ["scene", "frames answered", "mean, fixed", "moving", "ratio", "p95, fixed", "moving",
                    "mean visible, fixed", "moving", "jitter while still, fixed", "moving"], rows)


def long_runs(reports):
    rows = []
    for name, report in of_kind(reports, "long").items():
        error = report["vertex_error"]
        rows.append([name, frames(report), number(error["all"]["mean_mm"]), number(error["drift_mm"], 3),
                     number(error["drift_ratio"]), number(get(report, "jitter", "per_vertex", "rms_mm"), 3)])
    return section("Over a minute",
                   "Drift compares the mean error of the last 5 s with that of the first 5 s, as a difference and as "
                   "a ratio.",
                   ["scene", "frames answered", "mean [mm]", "drift [mm]", "drift [ratio]",
                    "jitter while still [mm RMS]"], rows)


def forces(reports):
    rows = []
    for name, report in of_kind(reports, "scene").items():
        found = report.get("forces")
        if found is None:
            continue
        rows.append([name, number(found["frames"], 0), number(found["mean_n"]), number(found["p95_n"]),
                     percent(found["right"]), number(get(found, "place", "mean_mm")),
                     number(get(found, "place", "p95_mm")), percent(found["within_90"])])
    return section("Forces",
                   "The force of the stamp that `replay --forces` finds, compared with the true one, in frames with a "
                   "force of at least 0.1 N. The object says that Young's modulus is known within 1 %. `-`: no force "
                   "was found. The last column is of all forces: that of the stamp, and that of the table.",
                   ["scene", "frames", "error, mean [N]", "p95 [N]", "within 10 % or 0.1 N [%]",
                    "place, mean error [mm]", "p95 [mm]", "within their 90 % bound [%]"], rows)


def absences(reports):
    rows = []
    for name, report in of_kind(reports, "scene").items():
        for absence in report.get("absences", []):
            recoveries = [absence[key] for key in ("recovery_s", "recovery_to_before_s")]
            rows.append([name, f"{absence['begin_s']:.1f} to {absence['end_s']:.1f}",
                         percent(absence["covered_share"], 0), number(absence["covered"]["mean_mm"]),
                         number(absence["normal_mm"]),
                         *("never" if seconds is None else number(seconds) for seconds in recoveries)])
    return section("Hidden and visible again",
                   "The table lists the intervals in which more than a quarter of the vertices that were visible in "
                   "the first frame are hidden or out of view. For `occlude` and `doll_occlude`, the normal error is "
                   "that of the same frame without the hand. For the other scenes, and for the last column, it is "
                   "the p95 of the frames before the interval. A scene has recovered when its error is at most 1.2 "
                   "times the normal error.",
                   ["scene", "from, to [s]", "hidden at most [%]", "mean error of the hidden part [mm]",
                    "normal error [mm]", "recovered after [s]", "recovered to the error before after [s]"], rows)


def cuts(reports):
    rows = []
    for name, report in of_kind(reports, "scene").items():
        cut, pieces, tool = report.get("cut_surface"), report.get("pieces"), report.get("tool")
        if cut is None:
            continue
        error = report["vertex_error"]
        rows.append([name, f"{pieces['result_pieces']} of {pieces['true_pieces']}", percent(pieces["frames_right"]),
                     percent(pieces["vertices_right"]), number(pieces["delay_s"]),
                     ", ".join(number(piece["mean_mm"]) for piece in error["pieces"]) or "-",
                     number(error["near_cut"]["mean_mm"]), number(cut["distance"]["mean_mm"]),
                     number(worst([cut["distance"]["max_mm"], cut["missed"]["max_mm"]])), number(cut["tilt_deg"]),
                     percent(get(report, "volume", "cut_change"), 3),
                     f"{tool['answered']} of {tool['expected']}" if tool else "-",
                     number(get(tool, "position", "mean_mm")), number(get(tool, "rotation_deg", "mean"))])
    return section("Cuts", "Errors of the pieces, of the vertices near the cut, and of the cut surface in the rest "
                           "shape [mm].",
                   ["scene", "pieces at the end", "frames with the right number [%]", "vertices in the right piece [%]", "late by [s]",
                    "mean error by piece", "near the cut", "cut surface, mean", "at most", "tilt [deg]",
                    "volume changed by cuts [%]", "tool poses", "tool position [mm]", "tool angle [deg]"], rows)


def faults(reports):
    rows = []
    for scene in (name for name in WRONG_MATCH_SEEDS if ("scene", name) in reports):
        plain = reports[("scene", scene)]
        faulty = {name[1]: report for (kind, name), report in reports.items() if kind == "fault" and name[0] == scene}
        for fault, report in {"none": plain, **faulty}.items():
            error = report["vertex_error"]["all"]
            times = 1.0 if report is plain else fault_times(reports, scene, fault)
            rows.append([scene, fault, f"{report['frames']['answered']} of {report['frames'].get('recorded', '-')}",
                         percent(tracking_share(report), 0), number(error["mean_mm"]), number(times),
                         number(error["p95_mm"])])
    return section("Faults",
                   "These recordings were changed by `inject`, or tracked with another parameter. The error ratio is "
                   "the mean error divided by that of the same scene without a fault.",
                   ["scene", "fault", "recorded frames answered", "tracking [%]", "mean [mm]", "error ratio",
                    "p95 [mm]"], rows)


def body_of(scene):
    return scene.rsplit("_", 1)[0] if "_" in scene else "sponge"


def median_times(reports):
    """{stage: {body: ms}}: median over the scenes of a body of the stage's median time in a frame, as shown."""
    times = {}
    for name, report in of_kind(reports, "scene").items():
        for stage in report.get("stages", []):
            words = stage["stage"] + (" (initialization)" if stage["initialization"] else "")
            times.setdefault(words, {}).setdefault(body_of(name), []).append(stage["median_ms"])
    return {words: {body: round(statistics.median(values), 2) for body, values in of_body.items()}
            for words, of_body in times.items()}


def stage_times(reports):
    times = median_times(reports)
    bodies = sorted({body for of_body in times.values() for body in of_body},
                    key=lambda body: (body != "sponge", body))
    rows = [[words, *(number(of_body.get(body)) for body in bodies)] for words, of_body in times.items()]
    return section("Time with two replays side by side",
                   "Median time of each stage in a frame over all scenes [ms]. Two replays shared the machine, and also "
                   "said what each pixel shows. [Table 2](paper.md#table-2-times) has the times of a replay alone, "
                   "beside those of the paper.",
                   ["stage", *bodies], rows)


def toys(reports):
    report = reports.get(("toys", "toys"))
    if report is None:  # not asked for
        return []
    if not report:
        return ["## Recorded plush toy", "", "Skipped: ../shared/data/toys is missing.", ""]
    rows = []
    for window in [*(get(report, "depth_residual", "windows") or []), get(report, "depth_residual", "all") or {}]:
        first, count = get(window, "first_frame"), get(window, "frames")
        rows.append(["-" if count is None else f"{first} to {first + count - 1}", number(get(window, "answered"), 0),
                     number(get(window, "residual", "median_mm")), number(get(window, "residual", "p95_mm")),
                     percent(get(window, "within_10mm")), percent(get(window, "within_15mm_of_measured"))])
    found = get(reports.get(("no pose", "toys")), "depth_residual", "all")
    text = ("A recording from a real camera has no truth. So the tracked surface is compared with the measured "
            "depth. The recording is from A. Petit's RGBDTracking (Petit, Lippiello and Siciliano 2015, Real-time "
            "tracking of 3D elastic objects with an RGB-D sensor, IROS). \"Strict\" counts occluded pixels as misses. Without a rough pose: "
            f"median {number(get(found, 'residual', 'median_mm'))} mm, "
            f"{percent(get(found, 'within_10mm'))} % within 10 mm, "
            f"{percent(get(found, 'within_15mm_of_measured'))} % within 15 mm (strict).")
    return section("Recorded plush toy", text,
                   ["frames", "answered", "median [mm]", "p95 [mm]", "within 10 mm [%]",
                    "within 15 mm, strict [%]"], rows)
