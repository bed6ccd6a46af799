"""Scenes whose last fifth is predicted without images: the simulation goes on with what holds the body."""
from evaluation import bags
from evaluation.runs import OUTPUT, changed, recorded, track
from pages import ROOT
from tools import evaluate

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


def open_loop_run(scene):
    """{("open loop", scene): report}. The tracker is told where the body begins, because both ends are hidden."""
    name = f"{scene}_open_loop"
    parameters = OUTPUT / f"{name}_parameters.yaml"
    parameters.write_text(STAMP if scene == "press_held" else "simulator: {}\n")
    with recorded(name, scene) as bag:
        pose = ", ".join(f"{part:.9f}" for part in bags.start(bag))
        config = changed(ROOT / "config/sponge.yaml", name, r"initial_pose:.*",
                         f"initial_pose: [{pose}]\n  pins: [{', '.join(HELD[scene])}]")
        result = track(name, bag, config, "--allow-outside", "--placed", "--open-loop", SHARE, "--parameters",
                       parameters)
        return {("open loop", scene): evaluate(result, "--truth", bag, "--open-loop", SHARE)}


def open_loop_runs(scenes):
    """Pieces of work (words, function, arguments...)."""
    return [(f"{scene}, open loop", open_loop_run, scene) for scene in HELD if scene in scenes]
