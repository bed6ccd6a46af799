"""The action recorder/record: whole bags under their names only, progress, cancel, and clear errors."""
import os
import tempfile
import threading
import unittest

import actionlib
import rosbag
import rospy
from actionlib_msgs.msg import GoalStatus
from softbody_msgs.msg import RecordAction, RecordGoal
from std_msgs.msg import String

from goals import send
from recorder import PATIENCE_S

RESULT = ["/softbody/status", "/softbody/surface/state", "/softbody/surface/topology", "/softbody/timing",
          "/softbody/volume/state", "/softbody/volume/topology", "/tf", "/tf_static"]


class Record(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.latched = rospy.Publisher("/softbody/latched", String, queue_size=1, latch=True)
        cls.latched.publish("once")
        cls.words = rospy.Publisher("/words", String, queue_size=1000)
        cls.stopped = threading.Event()
        threading.Thread(target=cls.speak, daemon=True).start()
        cls.addClassCleanup(cls.stopped.set)

    @classmethod
    def speak(cls):
        number = 0
        while not cls.stopped.wait(0.01):
            cls.words.publish(f"{number:06} " + "x" * 10000)
            number += 1

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder, self.file = folder.name, f"{folder.name}/out.bag"
        self.progress = []

    def start(self, goal, node="recorder"):
        client = actionlib.SimpleActionClient(f"/softbody/{node}/record", RecordAction)
        self.assertTrue(client.wait_for_server(rospy.Duration(PATIENCE_S)))
        send(client, goal, feedback_cb=self.progress.append)
        return client

    def end(self, client):
        """@return state and result of the goal."""
        self.assertTrue(client.wait_for_result(rospy.Duration(PATIENCE_S)))
        return client.get_state(), client.get_result()

    def wait_for_messages(self):
        wait = rospy.Time.now() + rospy.Duration(PATIENCE_S)
        while not self.progress or self.progress[-1].messages < 20:
            self.assertLess(rospy.Time.now(), wait)
            rospy.sleep(0.05)

    def expect_whole(self, result):
        """The bag has what the result says, in order, and is the only file."""
        self.assertEqual(os.listdir(self.folder), [os.path.basename(result.path)])
        with rosbag.Bag(result.path) as bag:
            read = list(bag.read_messages(return_connection_header=True))
        counts = {topic: sum(entry.topic == topic for entry in read) for topic in result.topics}
        self.assertEqual(list(result.counts), list(counts.values()))
        spoken = [int(entry.message.data.split()[0]) for entry in read if entry.topic == "/words"]
        self.assertEqual(spoken, list(range(spoken[0], spoken[0] + len(spoken))))
        return read

    def test_for_some_time(self):
        state, result = self.end(self.start(RecordGoal(topics=["latched", "/words"], file=self.file, duration=1.5)))
        self.assertEqual((state, result.message, result.path), (GoalStatus.SUCCEEDED, "", self.file))
        self.assertEqual(result.topics, ["/softbody/latched", "/words"])
        read = self.expect_whole(result)
        [once] = [entry for entry in read if entry.topic == "/softbody/latched"]
        self.assertEqual((once.message.data, once.connection_header["latching"]), ("once", b"1"))
        shown = [(p.seconds, p.messages, p.bytes) for p in self.progress]
        self.assertEqual(shown, sorted(shown))
        self.assertGreater(shown[-1][1], 0)
        self.assertGreaterEqual(shown[-1][2], 10000 * (shown[-1][1] - 1))

    def test_until_cancelled(self):
        client = self.start(RecordGoal(topics=["/words"], file=self.file))
        self.wait_for_messages()
        self.assertFalse(os.path.exists(self.file))
        client.cancel_goal()
        state, result = self.end(client)
        self.assertEqual((state, result.message, result.path), (GoalStatus.PREEMPTED, "", self.file))
        self.assertGreaterEqual(result.counts[0], 20)
        self.expect_whole(result)

    def test_without_topics_the_result_is_recorded(self):
        state, result = self.end(self.start(RecordGoal(file=self.file, duration=0.1)))
        self.assertEqual((state, result.topics), (GoalStatus.SUCCEEDED, RESULT))

    def test_a_new_goal_ends_the_one_before(self):
        first = self.start(RecordGoal(topics=["/words"], file=self.file))
        self.wait_for_messages()
        second = self.start(RecordGoal(topics=["/words"], file=f"{self.folder}/next.bag", duration=0.1))
        state, result = self.end(first)
        self.assertEqual((state, result.path), (GoalStatus.PREEMPTED, self.file))
        with rosbag.Bag(self.file) as bag:
            self.assertGreater(bag.get_message_count(), 0)
        self.assertEqual(self.end(second)[0], GoalStatus.SUCCEEDED)

    def test_what_cannot_be_recorded(self):
        exists = f"{self.folder}/exists.bag"
        with open(exists, "w", encoding="ascii") as file:
            file.write("mine")
        for goal, words in ((RecordGoal(file="relative.bag"), "allowed: an absolute path that ends in .bag"),
                            (RecordGoal(file=f"{self.folder}/out.txt"), "allowed: an absolute path that ends in .bag"),
                            (RecordGoal(file=exists), f"{exists} exists; choose another name"),
                            (RecordGoal(file=f"{self.folder}/none/out.bag"), f"{self.folder}/none"),
                            (RecordGoal(file="/proc/out.bag"), "/proc"),
                            (RecordGoal(file=self.file, duration=-1), "duration is -1"),
                            (RecordGoal(file=self.file, topics=["no topic"]), "no topic"),
                            (RecordGoal(file=self.file, topics=["/words", ""]), "a name in topics is empty; leave it out")):
            state, result = self.end(self.start(goal))
            self.assertEqual((state, result.path), (GoalStatus.ABORTED, ""), goal)
            self.assertIn(words, result.message)
            self.assertEqual(os.listdir(self.folder), ["exists.bag"])

    def test_a_disk_that_is_nearly_full_ends_it_early(self):
        state, result = self.end(self.start(RecordGoal(topics=["/words"], file=self.file), "careful_recorder"))
        self.assertEqual((state, result.path), (GoalStatus.ABORTED, self.file))
        self.assertIn(f"the disk of {self.folder} has less than 1000000000 MB left (min_free_mb)", result.message)
        self.assertEqual(os.listdir(self.folder), ["out.bag"])

    def test_a_full_disk_is_an_error(self):
        state, result = self.end(self.start(RecordGoal(topics=["/words"], file=self.file), "limited_recorder"))
        self.assertEqual((state, result.path), (GoalStatus.ABORTED, ""))
        self.assertIn(f"{self.file}: cannot be written: File too large", result.message)
        self.assertEqual(os.listdir(self.folder), [])
