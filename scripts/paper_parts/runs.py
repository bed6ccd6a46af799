"""Records and tracks the scenes of `make paper`: a scene once with each texture, equal runs once."""
import json
import shutil
import typing

from evaluation.runs import object_of, tool_of
from pages import ROOT
from paper_parts.counts import counts, tear_times
from paper_parts.cut_quality import cut_quality
from paper_parts.methods import CUT_THROUGH, PAPER, TEAR
from tools import OUTPUT, evaluate, perform, tool

FOLDER = OUTPUT / "paper"
BOARD = "cut_board"  # scene cut; the marked board itself is the blade
BOARD_TOOL = ("--tool", ROOT / "config/board.yaml")
COARSE = "coarse"  # the doll with as many cage vertices as the paper's
COARSE_VERTICES = "128"


class Run(typing.NamedTuple):
    """One scene, tracked by one method."""

    scene: str
    text: str = ""     # of methods.py
    model: str = ""    # empty: the shipped object
    texture: str = ""  # of the recorded body; empty: that of the virtual camera

    @property
    def recorded(self):
        """Which recording it needs: runs with the same one share it."""
        return self.scene, self.texture


def measured(runs, timed, kept):
    """Reports by run: those of `evaluate`, with more that is read from the result. Runs in `timed` have the machine for
    themselves. The results of runs in `kept` and the recordings stay until clear_bags(); the reports name them.
    """
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    if any(run.model for run in runs):
        tool("prepare_model", ROOT / "config/doll.obj", "--cage-vertices", COARSE_VERTICES, "--output", FOLDER / COARSE,
             package="softbody_sim")
    needed = list(dict.fromkeys(run.recorded for run in runs))
    recordings = dict(zip(needed, perform([(f"{scene} {texture} recorded", record, scene, texture)
                                           for scene, texture in needed])))
    work = {run: (run.scene, measure, number, run, recordings[run.recorded], run in kept)
            for number, run in enumerate(runs)}
    beside, alone = ([run for run in runs if (run in timed) == is_timed] for is_timed in (False, True))
    return {**dict(zip(beside, perform([work[run] for run in beside]))),
            **dict(zip(alone, perform([work[run] for run in alone], jobs=1)))}


def clear_bags():
    for bag in FOLDER.glob("*.bag"):
        bag.unlink()


def record(scene, texture):
    path = FOLDER / f"{'_'.join(filter(None, (scene, texture)))}.bag"
    played = ("cut", *BOARD_TOOL) if scene == BOARD else (scene,)
    tool("virtual_camera", "--scene", *played, *(("--texture", texture) if texture else ()), "--output", path)
    return path


def measure(number, run, recording, keep):
    """The report of one run."""
    name = f"{run.scene}_{number}"
    result = FOLDER / f"{name}_result.bag"
    track(run, recording, FOLDER / f"{name}.yaml", result)
    report = {**evaluate(result, "--truth", recording), "recording": str(recording), "result": str(result),
              **counts(result)}
    if run.scene in CUT_THROUGH:
        report["quality"] = cut_quality(result)
    if run.scene == TEAR:
        report["times"] = tear_times(result, recording)
    (FOLDER / f"{name}.json").write_text(json.dumps(report))
    if not keep:
        result.unlink()
    return report


def track(run, recording, parameters, result):
    """Writes the result of a run, and its parameters."""
    config = FOLDER / COARSE / "object.yaml" if run.model else object_of(run.scene)
    files = recording, "--object", config, "--output", result
    if run.text.startswith(PAPER):
        program, *options = run.text.split()
        tool(program, *files, *options, package="development/softbody_evaluation")
        return
    parameters.write_text(run.text)
    knife = BOARD_TOOL if run.scene == BOARD else tool_of(run.scene)
    tool("replay", *files, "--timing", *knife, *(("--parameters", parameters) if run.text else ()))


def peer_runs():
    """{body: {simulator: error and time}}"""
    return json.loads(tool("compare_peers", package="development/softbody_sim"))
