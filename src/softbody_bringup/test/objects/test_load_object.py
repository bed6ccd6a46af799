"""simulator/load_object: states, cuts and pins of the next object; what is refused changes nothing."""
import shutil
import tempfile
import unittest

import rospkg
import rospy
import softbody
from softbody_msgs.msg import CutHistory

from hand_made_frames import EndlessFrames
from recorder import Recorder

CONFIG = rospkg.RosPack().get_path("softbody_bringup") + "/config"
SPONGE, DOLL = f"{CONFIG}/sponge.yaml", f"{CONFIG}/doll.yaml"
VERTICES = {SPONGE: 522, DOLL: 18650}
PARAMETERS = ("/softbody/simulator/object", "/softbody/surface/object")


class LoadObject(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(softbody__volume__cuts=CutHistory, softbody__surface__cuts=CutHistory)
        cls.body = softbody.Body(service_timeout_s=60)
        cls.states = []
        cls.body.on_state(cls.states.append)
        cls.frames = EndlessFrames()
        cls.frames.start()
        cls.addClassCleanup(cls.frames.stopped.set)
        cls.body.wait(timeout_s=60)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def load(self, path):
        """@return the first state of the object."""
        before = self.body.latest()
        revision = self.body.load_object(path)
        self.assertGreater(revision, before.revision)
        state = self.body.wait(timeout_s=60, revision=revision)
        self.assertEqual((state.revision, len(state.vertices)), (revision, VERTICES[path]))
        self.assertEqual([rospy.get_param(name) for name in PARAMETERS], [path] * 2)
        return state

    def write(self, name, text):
        with open(f"{self.folder}/{name}", "w", encoding="utf-8") as file:
            file.write(text)
        return f"{self.folder}/{name}"

    def expect_refusal(self, path, words):
        """The object before goes on, with its cuts and its parameters."""
        before = self.body.wait(timeout_s=60)
        parameters = [rospy.get_param(name) for name in PARAMETERS]
        with self.assertRaisesRegex(softbody.Refused, words):
            self.body.load_object(path)
        state = self.body.wait(timeout_s=60, after=self.body.latest())
        self.assertEqual((state.revision, len(state.vertices)), (before.revision, len(before.vertices)))
        self.assertEqual([rospy.get_param(name) for name in PARAMETERS], parameters)
        self.body.wait(timeout_s=60, revision=self.body.cut([0, 0, 0], [1, 0.1, 0]))
        self.body.wait(timeout_s=60, revision=self.body.undo())

    def test_another_object_and_back(self):
        """The cuts of one object are not those of the other. No state is a mixture."""
        sponge = self.load(SPONGE)
        self.body.wait(timeout_s=60, revision=self.body.cut([0, 0, 0], [1, 0.1, 0]))
        doll = self.load(DOLL)
        self.assertEqual(doll.triangle_pieces.max(), 0)
        with self.assertRaisesRegex(softbody.Refused, "there is no cut to undo"):
            self.body.undo()
        middle = doll.rest_vertices.mean(axis=0)
        cut = self.body.wait(timeout_s=60, revision=self.body.cut(middle, [1, 0.1, 0]))
        self.assertEqual((cut.revision, cut.triangle_pieces.max()), (doll.revision + 1, 1))
        again = self.load(SPONGE)
        self.assertEqual(again.triangle_pieces.max(), 0)
        self.assertEqual(len(again.volume.vertices), len(sponge.volume.vertices))
        for state in list(self.states):
            self.assertEqual(state.vertices.shape, state.rest_vertices.shape)
            self.assertEqual({state.topology.revision, state.volume.topology.revision}, {state.revision})
        revisions = [state.revision for state in self.states]
        self.assertEqual(revisions, sorted(revisions))

    def test_the_same_object_again(self):
        """Its cuts are gone."""
        self.load(SPONGE)
        self.body.wait(timeout_s=60, revision=self.body.cut([0, 0, 0], [1, 0.1, 0]))
        self.assertEqual(self.load(SPONGE).triangle_pieces.max(), 0)

    def test_simulator_and_surface_agree_on_the_body(self):
        revision = self.load(DOLL).revision
        bodies = [self.recorder.wait(lambda seen, topic=topic: next(
            (m.body for m in seen[topic] if m.revision == revision), None), f"cuts of revision {revision} on {topic}")
                  for topic in ("softbody/volume/cuts", "softbody/surface/cuts")]
        self.assertEqual(bodies[0], bodies[1])
        self.assertNotEqual(bodies[0], 0)

    def test_pins_are_gone_and_obstacles_stay(self):
        self.load(SPONGE)
        self.body.pin("hand", [-1, -1, -1], [-0.07, 1, 1])
        self.body.set_obstacle("ball", "sphere", position=[0, 0, 1], radius=0.1)
        self.load(DOLL)
        with self.assertRaisesRegex(softbody.Refused, "hand"):
            self.body.release("hand")
        self.body.release("ball")

    def test_the_pins_of_the_file_hold(self):
        for name in ("sponge.obj", "sponge_cage.obj", "sponge_tets.vtu"):
            shutil.copy(f"{CONFIG}/{name}", self.folder)
        with open(SPONGE, encoding="utf-8") as file:
            text = file.read()
        pinned = self.write("object.yaml", text + "  pins: [{name: end, min: [-1, -1, -1], max: [-0.07, 1, 1]}]\n")
        VERTICES[pinned] = VERTICES[self.folder] = VERTICES[SPONGE]
        self.load(self.folder)
        self.body.release("end")
        self.load(pinned)
        self.load(SPONGE)
        with self.assertRaisesRegex(softbody.Refused, "end"):
            self.body.release("end")
        far = self.write("far.yaml", text + "  pins: [{name: end, min: [5, 5, 5], max: [6, 6, 6]}]\n")
        self.expect_refusal(far, "pin 'end'")

    def test_the_surface_can_refuse(self):
        """It reads only files of the object's folder; this simulator reads others, too."""
        self.load(SPONGE)
        with open(SPONGE, encoding="utf-8") as file:
            text = file.read().replace("sponge", f"{CONFIG}/sponge")
        self.expect_refusal(self.write("outside.yaml", text), "surface/prepare_object: .*outside")

    def test_what_cannot_be_used_changes_nothing(self):
        self.load(SPONGE)
        broken = self.write("broken.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n")
        for path, words in ((f"{self.folder}/none.yaml", "none.yaml"), (self.folder, self.folder),
                            (self.write("empty.yaml", ""), "empty.yaml"),
                            (self.write("broken.yaml", "object: {visual_mesh: broken.obj}\n"), broken)):
            self.expect_refusal(path, words)

    def test_a_relative_path_is_refused(self):
        with self.assertRaisesRegex(softbody.Refused, "allowed: an absolute path"):
            self.body._call("simulator/load_object", softbody.body.LoadObject, "sponge.yaml")  # pylint: disable=protected-access
