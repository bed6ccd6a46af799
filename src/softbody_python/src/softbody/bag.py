"""States of a result bag."""
import struct

import rosbag
from genpy import DeserializationError

from softbody.join import Joiner
from softbody.wire import WrongMessage, decode

PATIENCE = 30  # states for which a volume state may come late


class BagError(Exception):
    """A bag that cannot be read or has no states. The message is a sentence for the user."""


class ResultBag:
    """A bag of `replay`, or one recorded live. `for state in ResultBag(path): ...` gives its states in order."""

    def __init__(self, path, namespace="/softbody"):
        """@throw BagError if the file is no bag with surface states. @throw OSError if it cannot be opened."""
        self.path, self.namespace = str(path), namespace.rstrip("/")
        with self._open() as bag:
            topics = bag.get_type_and_topic_info().topics
        state, topology = self._topic("surface/state"), self._topic("surface/topology")
        missing = [topic for topic in (state, topology) if topic not in topics]
        if missing:
            raise BagError(f"{self.path}: has no messages on {' and '.join(missing)}; give a bag of replay, or the "
                           f"namespace of its topics. The bag has {', '.join(sorted(topics)) or 'no topics'}")
        self.state_count = topics[state].message_count
        self.has_volume = all(self._topic(name) in topics for name in ("volume/state", "volume/topology"))

    def __len__(self):
        """Number of surface states. States whose topology is not in the bag are not given."""
        return self.state_count

    def __iter__(self):
        joiner = Joiner(self.has_volume, PATIENCE)
        add = {self._topic("surface/topology"): joiner.add_topology, self._topic("surface/state"): joiner.add_surface,
               self._topic("volume/topology"): joiner.add_topology, self._topic("volume/state"): joiner.add_volume}
        for topic, raw in self._messages(list(add)):
            try:
                message = decode(raw[0], raw[2], raw[1])
            except WrongMessage as error:
                raise BagError(f"{self.path}: a message on {topic} is wrong: {error}") from error
            yield from add[topic](message)
        yield from joiner.finish()

    def _topic(self, name):
        return f"{self.namespace}/{name}"

    def _open(self):
        with open(self.path, "rb"):
            pass  # rosbag names no file that is missing
        try:
            return rosbag.Bag(self.path)
        except rosbag.ROSBagUnindexedException as error:
            raise BagError(f"{self.path}: its recording was not ended; repair it with `rosbag reindex`") from error
        except (rosbag.ROSBagException, struct.error, ValueError, EOFError) as error:
            raise BagError(f"{self.path}: is not a bag, or damaged ({error})") from error

    def _messages(self, topics):
        with self._open() as bag:
            messages = bag.read_messages(topics=topics, raw=True)
            while True:
                try:
                    topic, raw, _ = next(messages)
                except StopIteration:
                    return
                except (rosbag.ROSBagException, DeserializationError, RuntimeError, KeyError, ValueError, EOFError,
                        struct.error) as error:
                    raise BagError(f"{self.path}: is damaged ({error}); make it again") from error
                yield topic, raw


def read(path, namespace="/softbody"):
    """The states of a bag, in order. @throw BagError, OSError."""
    return iter(ResultBag(path, namespace))
