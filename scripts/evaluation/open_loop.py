"""Scenes whose last fifth is predicted without images: the simulation goes on with what holds the body."""
import json

from evaluation.figures import get, number, of_kind, percent, tracking_share, worst
from evaluation.runs import OUTPUT, ROOT, bags, changed, tool, track
from markdown_lines import paragraph, table

SHARE = 0.2
CLAMP = "{name: clamp, frame: clamp, min: [-1, -1, -1], max: [-0.06, 1, 1]}"
GRIPPER = "{name: gripper, frame: gripper, min: [0.06, -1, -1], max: [1, 1, 1]}"
PLATE = "{name: plate, frame: plate, min: [0.095, -1, -1], max: [1, 1, 1]}"  # the body sticks to it
HELD = {"bend_held": (CLAMP, GRIPPER), "push_held": (CLAMP, PLATE), "twist_held": (CLAMP, GRIPPER),
        "press_held": (CLAMP, GRIPPER), "pull_held": (CLAMP, GRIPPER)}
# A box with the area of the round stamp.
STAMP = """simulator:
  obstacles:
    - {name: stamp, frame: stamp, shape: box, size_m: [0.044, 0.044, 0.02], rounding_m: 0.002,
       pose: [0, 0, 0.01, 0, 0, 0, 1], friction: 1}
"""
PARAMETERS = {"press_held": STAMP}


def open_loop_run(scene):
    """{("open loop", scene): report}. The tracker is told where the body begins, because both ends are hidden."""
    name = f"{scene}_open_loop"
    recording, parameters = OUTPUT / f"{name}.bag", OUTPUT / f"{name}_parameters.yaml"
    tool("virtual_camera", "--scene", scene, "--output", recording)
    pose = ", ".join(f"{part:.9f}" for part in bags("start", recording))
    config = changed(ROOT / "config/sponge.yaml", name, r"initial_pose:.*",
                     f"initial_pose: [{pose}]\n  pins: [{', '.join(HELD[scene])}]")
    parameters.write_text(PARAMETERS.get(scene, "simulator: {}\n"))
    result = track(name, recording, config, "--allow-outside", "--placed", "--open-loop", str(SHARE), "--parameters",
                   parameters)
    report = json.loads(tool("evaluate", result, "--truth", recording, "--open-loop", str(SHARE), "--json"))
    recording.unlink()
    return {("open loop", scene): report}


def open_loop_runs(scenes):
    """Pieces of work as (words, function)."""
    return [(f"{scene}, open loop", lambda scene=scene: open_loop_run(scene)) for scene in HELD if scene in scenes]


def open_loop_goals(reports):
    """As goals(); nothing if no such scene was measured."""
    found = of_kind(reports, "open loop")
    return [(f"last fifth predicted without images: mean error of all vertices, worst of {', '.join(found)}", "<= 1.0",
             "mm", worst(get(report, "open_loop", "all", "mean_mm") for report in found.values()))] if found else []


def open_loop(reports):
    rows = [[name, percent(tracking_share(report), 0), number(get(report, "vertex_error", "all", "mean_mm")),
             number(report["vertex_error"]["frame_mean_mm"][-1]), number(report["open_loop"]["duration_s"], 1),
             *(number(report["open_loop"]["all"][key]) for key in ("mean_mm", "p95_mm", "max_mm")),
             number(report["open_loop"]["last_mean_mm"])]
            for name, report in of_kind(reports, "open loop").items()]
    return ["## Open loop", "",
            *paragraph("The images of the last fifth of a scene are not used (`replay --open-loop 0.2`). The "
                       "simulation predicts it from the state before, and from the recorded motion of what holds the "
                       "body: pins at the clamp and the gripper (`push_held`: at the plate), and in `press_held` the "
                       "stamp as an obstacle. The truth comes from a "
                       "[solver](virtual_camera.md#an-elastic-body-as-the-truth) with a much finer mesh. The tracker "
                       "is told where the body begins, because both ends are hidden from the first frame on. Errors "
                       "are over all vertices, in mm."), "",
            *table(["scene", "tracking [%]", "mean, tracked", "in the last image", "predicted [s]", "mean, predicted",
                    "p95", "max", "in the last frame"], rows)] if rows else []
