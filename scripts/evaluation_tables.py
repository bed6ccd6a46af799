"""The tables of docs/evaluation.md, each with its words, from the reports of `evaluate`."""
import statistics

from evaluation_figures import (WRONG_MATCH_SEEDS, fault_times, frames, get, moving_times, number, of_kind, percent,
                                tracking_share, worst)


def table(columns, rows):
    lines = [columns, ["---"] * len(columns), *rows]
    return ["| " + " | ".join(cells) + " |" for cells in lines] + [""]


def section(title, words, columns, rows):
    """A table with its words; nothing where there is no row."""
    return [f"## {title}", "", words, "", *table(columns, rows)] if rows else []


def accuracy(reports):
    rows = []
    for name, report in of_kind(reports, "scene").items():
        error = report["vertex_error"]
        lengths = [error["all"][key] for key in ("mean_mm", "rms_mm", "p95_mm", "max_mm")]
        rows.append([name, frames(report), percent(tracking_share(report), 0), *map(number, lengths),
                     number(error["visible"]["mean_mm"]), number(error["hidden"]["mean_mm"]),
                     percent(get(report, "silhouette", "mean_iou")), percent(get(report, "volume", "largest_error"))])
    return section("Every scene", "Distance of all vertices in all answered frames to where they truly are [mm].",
                   ["scene", "frames answered", "tracking [%]", "mean", "RMS", "p95", "max", "mean visible",
                    "mean hidden", "silhouette IoU [%]", "volume error at most [%]"], rows)


def noise(reports):
    rows = []
    for name, off in of_kind(reports, "noise off").items():
        on = reports.get(("scene", name))
        cells = [number(get(report, "vertex_error", part, key)) for part, key in
                 (("visible", "mean_mm"), ("hidden", "mean_mm"), ("all", "p95_mm")) for report in (off, on)]
        rows.append([name, *cells])
    return section("With and without noise", "[mm]",
                   ["scene", "mean visible, off", "on", "mean hidden, off", "on", "p95, off", "on"], rows)


def volumes(reports):
    rows = []
    for name in of_kind(reports, "exact"):
        cells = [number(get(reports.get((kind, name)), "vertex_error", *keys)) for keys in
                 (("all", "p95_mm"), ("hidden", "mean_mm")) for kind in ("scene", "exact", "fine", "fine exact")]
        rows.append([name, *cells])
    return section("What the volume allows",
                   "Tracked, and simulated with every visible vertex where it truly is (`simulate_truth`), with the paper's\n"
                   "300 tets and with those of a cage of 300 vertices (`prepare_model --cage-vertices 300`) [mm].",
                   ["scene", "p95, tracked", "exact", "finer, tracked", "finer, exact", "mean hidden, tracked", "exact",
                    "finer, tracked", "finer, exact"], rows)


def moving_camera(reports):
    rows, times = [], moving_times(reports)
    for name, moving in of_kind(reports, "moving camera").items():
        rest = reports.get(("scene", name))
        cells = [number(get(report, *keys)) for keys in
                 (("vertex_error", "all", "mean_mm"), ("vertex_error", "all", "p95_mm"),
                  ("vertex_error", "visible", "mean_mm"), ("jitter", "per_vertex", "rms_mm"))
                 for report in (rest, moving)]
        rows.append([name, frames(moving), *cells[:2], number(times[name]), *cells[2:]])
    return section("A camera that moves", "`--camera-motion orbit`, tracked with `--output-frame world` [mm].",
                   ["scene", "frames answered", "mean, at rest", "moving", "times", "p95, at rest", "moving",
                    "mean visible, at rest", "moving", "jitter while still, at rest", "moving"], rows)


def long_runs(reports):
    rows = []
    for name, report in of_kind(reports, "long").items():
        error = report["vertex_error"]
        rows.append([name, frames(report), number(error["all"]["mean_mm"]), number(error["drift_mm"], 3),
                     number(error["drift_ratio"]), number(get(report, "jitter", "per_vertex", "rms_mm"), 3)])
    return section("Over a minute", "Drift is the mean error of the last five seconds against that of the first five.",
                   ["scene", "frames answered", "mean [mm]", "drift [mm]", "drift [times]",
                    "jitter while still [mm RMS]"], rows)


def absences(reports):
    rows = []
    for name, report in of_kind(reports, "scene").items():
        for absence in report.get("absences", []):
            recoveries = [absence[key] for key in ("recovery_s", "recovery_to_before_s")]
            rows.append([name, f"{absence['begin_s']:.1f} to {absence['end_s']:.1f}",
                         percent(absence["covered_share"], 0), number(absence["covered"]["mean_mm"]),
                         number(absence["normal_mm"]),
                         *("never" if seconds is None else number(seconds) for seconds in recoveries)])
    return section("Hidden and back", "More than a quarter of what the camera saw at first is hidden, or out of view. "
                   "Normal is, in the scenes `occlude`, the\nerror of the same frame where the same motion is followed "
                   "without the hand; in the others, and for all in the last\ncolumn, the p95 of the frames before. "
                   "Back is an error of at most 1.2 times that.",
                   ["scene", "from, to [s]", "hidden at most [%]", "mean error of the hidden part [mm]",
                    "normal error [mm]", "back to normal after [s]", "back to the error before after [s]"], rows)


def cuts(reports):
    rows = []
    for name, report in of_kind(reports, "scene").items():
        cut, pieces, tool = report.get("cut_surface"), report.get("pieces"), report.get("tool")
        if cut is None:
            continue
        error = report["vertex_error"]
        rows.append([name, f"{pieces['result_pieces']} of {pieces['true_pieces']}", percent(pieces["frames_right"]),
                     percent(pieces["vertices_right"]),
                     ", ".join(number(piece["mean_mm"]) for piece in error["pieces"]) or "-",
                     number(error["near_cut"]["mean_mm"]), number(cut["distance"]["mean_mm"]),
                     number(worst([cut["distance"]["max_mm"], cut["missed"]["max_mm"]])), number(cut["tilt_deg"]),
                     percent(get(report, "volume", "cut_change"), 3),
                     f"{tool['answered']} of {tool['expected']}" if tool else "-",
                     number(get(tool, "position", "mean_mm")), number(get(tool, "rotation_deg", "mean"))])
    return section("Cuts", "Errors of the pieces and near the cut, and of the cut's surface in the rest body [mm].",
                   ["scene", "pieces at the end", "frames with the right number [%]", "vertices in the right piece [%]",
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
    return section("Faults", "What `inject` puts into a scene's recording, and other parameters.",
                   ["scene", "fault", "recorded frames answered", "tracking [%]", "mean [mm]", "times the error without",
                    "p95 [mm]"], rows)


def stage_times(reports):
    """Medians over the scenes of an object."""
    times = {}
    for name, report in of_kind(reports, "scene").items():
        body = name.rsplit("_", 1)[0] if "_" in name else "sponge"
        for stage in report.get("stages", []):
            words = stage["stage"] + (" (first frame)" if stage["initialization"] else "")
            times.setdefault(words, {}).setdefault(body, []).append(stage["median_ms"])
    bodies = sorted({body for of_body in times.values() for body in of_body},
                    key=lambda body: (body != "sponge", body))
    rows = [[words, *(number(statistics.median(of_body[body])) if body in of_body else "-" for body in bodies)]
            for words, of_body in times.items()]
    return section("Time", "Median of a stage's time a frame [ms], two replays side by side on this machine.",
                   ["stage", *bodies], rows)


def toys(reports):
    report = reports.get(("toys", "toys"))
    if report is None:  # not asked for
        return []
    if not report:
        return ["## A recorded plush toy", "", "Skipped: no ../shared/data/toys.", ""]
    rows = []
    for window in [*(get(report, "depth_residual", "windows") or []), get(report, "depth_residual", "all") or {}]:
        first, count = get(window, "first_frame"), get(window, "frames")
        rows.append(["-" if count is None else f"{first} to {first + count - 1}", number(get(window, "answered"), 0),
                     number(get(window, "residual", "median_mm")), number(get(window, "residual", "p95_mm")),
                     percent(get(window, "within_10mm")), percent(get(window, "within_15mm_of_measured"))])
    found = get(reports.get(("no pose", "toys")), "depth_residual", "all")
    text = ("Depth against the tracked surface; there is no other truth. "
            f"Found without a rough pose: median {number(get(found, 'residual', 'median_mm'))} mm, "
            f"{percent(get(found, 'within_10mm'))} % within 10 mm, "
            f"{percent(get(found, 'within_15mm_of_measured'))} % within 15 mm, occluded counted as misses.")
    return section("A recorded plush toy", text,
                   ["frames", "answered", "median [mm]", "p95 [mm]", "within 10 mm [%]",
                    "within 15 mm, occluded counted as misses [%]"], rows)
