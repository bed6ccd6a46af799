"""Messages that keep their bytes, and read their fields only when somebody asks for one.

All subscribers of a topic in one process share the message, of the type that the first one named. A subclass of the
type with the same fields therefore fits everybody. rospy.AnyMsg would not.
"""
import functools
import io


@functools.lru_cache(maxsize=None)
def lazy(kind):
    """A subclass of a message type. Its attribute `raw` holds the bytes, or None if it was not received."""

    class Lazy(kind):
        def __init__(self, *arguments, **fields):
            self.raw = None
            if arguments or fields:
                super().__init__(*arguments, **fields)

        def deserialize(self, data):
            self.raw = bytes(data)
            return self

        def __getattr__(self, name):  # only for attributes that have no value yet
            if name not in kind.__slots__:
                raise AttributeError(f"{kind._type} has no field {name}")
            super().__init__()
            if self.raw is not None:
                super().deserialize(self.raw)
            return getattr(self, name)

    Lazy.__name__ = Lazy.__qualname__ = kind.__name__
    return Lazy


def bytes_of(message):
    """The bytes of a message, lazy or not."""
    if getattr(message, "raw", None) is not None:
        return message.raw
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()
