"""Messages of several topics, and waiting for conditions on them in wall-clock time."""
import threading
import time

import rospy
from rosgraph_msgs.msg import Log

PATIENCE_S = 120.0


class Recorder:
    def __init__(self, **types):
        """One keyword a topic: its name with "/" written as "__", its message type."""
        self.changed = threading.Condition()
        self.messages = {name.replace("__", "/"): [] for name in types}
        self.arrivals = {name: [] for name in self.messages}
        self.subscribers = [
            rospy.Subscriber("/" + name, types[name.replace("/", "__")], self._record, name, queue_size=1000)
            for name in self.messages
        ]

    def _record(self, message, name):
        with self.changed:
            self.messages[name].append(message)
            self.arrivals[name].append(rospy.Time.now())
            self.changed.notify_all()

    def wait(self, condition, what):
        """The first true value of condition(messages); an AssertionError that names `what` if none comes."""
        deadline = time.monotonic() + PATIENCE_S
        with self.changed:
            while True:
                value = condition(self.messages)
                if value:
                    return value
                left = deadline - time.monotonic()
                counts = {name: len(messages) for name, messages in self.messages.items()}
                assert left > 0, f"{what}: not within {PATIENCE_S:.0f} s; messages so far: {counts}"
                self.changed.wait(left)

    def wait_for(self, name, count=1):
        """At least `count` messages of a topic."""
        self.wait(lambda messages: len(messages[name]) >= count, f"{count} messages on /{name}")
        return list(self.messages[name])

    def first(self, name, condition, what, since=0):
        """The first message of a topic that meets the condition. @param since that number of messages of it."""
        return self.wait(lambda seen: next((m for m in seen[name][since:] if condition(m)), None), what)

    def wait_for_log(self, node, words, level=Log.WARN):
        """A message of a node that contains the words, of a level or worse. Needs rosout=Log."""
        return self.first("rosout", lambda log: log.level >= level and log.name == node and words in log.msg,
                          f"{node} to say: {words}")

    def wait_for_status(self, name, level, words):
        """Diagnostics from now on whose names end so, with the words. Needs diagnostics=DiagnosticArray."""
        before = len(self.messages["diagnostics"])
        return self.wait(lambda messages: next((status for message in messages["diagnostics"][before:]
                                                for status in message.status if status.name.endswith(name)
                                                and status.level == level and words in status.message), None),
                         f"diagnostics of {name} that say: {words}")

    def latched(self, name):
        """Whether the last message of a topic came from a latching publisher."""
        return self.wait_for(name)[-1]._connection_header["latching"] == "1"
