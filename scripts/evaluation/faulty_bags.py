"""Copies the camera's topics of a virtual recording, which has labels (virtual_camera --labels), with a fault."""
import os
import shutil

import numpy
import rosbag

COLOR, DEPTH, LABELS = "/camera/color/image_raw", "/camera/aligned_depth_to_color/image_raw", "/ground_truth/labels"
BODY = 3
FLICKER = 0.4  # largest change of the brightness
BLACK = 0.08  # of the brightness
HOLES, WRONG, BLOCK_PX, WRONG_MM = 0.3, 0.1, 24, 60  # of a shiny body: shares; blocks with wrong depth, largest error


def pixels(image):
    """A copy of the pixels, colour as (rows, columns, 3), depth in mm as (rows, columns)."""
    if image._type != "sensor_msgs/Image" or image.encoding not in ("rgb8", "bgr8", "16UC1", "mono8"):
        raise ValueError(f"{image._type} is not an image of the virtual camera")
    kind = "<u2" if image.encoding == "16UC1" else numpy.uint8
    channels = (3,) if image.encoding in ("rgb8", "bgr8") else ()
    return numpy.frombuffer(image.data, kind).reshape(image.height, image.width, *channels).copy()


def with_pixels(image, changed):
    image.data = changed.tobytes()
    return image


def brighter(image, factors):
    return with_pixels(image, numpy.clip(factors * pixels(image), 0, 255).astype(numpy.uint8))


def no_depth(topic, message, _frame):
    return None if "depth" in topic else message


def no_info(topic, message, _frame):
    return None if topic.endswith("camera_info") else message


def millimetres(topic, message, _frame):
    """The numbers of millimetres, in the encoding of metres."""
    if topic != DEPTH:
        return message
    message = with_pixels(message, pixels(message).astype("<f4"))
    message.encoding, message.step = "32FC1", 4 * message.width
    return message


def flicker(topic, message, frame):
    return brighter(message, 1.0 + FLICKER * frame.random.uniform(-1.0, 1.0)) if topic == COLOR else message


def black(topic, message, frame):
    if topic == COLOR:
        return brighter(message, numpy.where(frame.body(), BLACK, 1.0)[..., None])
    return with_pixels(message, numpy.where(frame.body(), 0, pixels(message))) if topic == DEPTH else message


def shiny(topic, message, frame):
    """Where the body is bright there is no depth. Other places have the depth of something that is mirrored."""
    if topic == COLOR:
        frame.kept["brightness"] = pixels(message).mean(axis=-1)
    if topic != DEPTH:
        return message
    depth, body, brightness = pixels(message), frame.body(), frame.kept["brightness"]
    blocks = [(side + BLOCK_PX - 1) // BLOCK_PX for side in depth.shape]

    def per_pixel(values):
        return numpy.kron(values, numpy.ones((BLOCK_PX, BLOCK_PX)))[:depth.shape[0], :depth.shape[1]]

    wrong = body & (depth > 0) & (per_pixel(frame.random.random(blocks)) < WRONG)
    depth[wrong] = (depth + per_pixel(frame.random.uniform(-WRONG_MM, WRONG_MM, blocks)))[wrong]
    if body.any():
        depth[body & (brightness > numpy.quantile(brightness[body], 1.0 - HOLES))] = 0
    return with_pixels(message, depth)


def half(_topic, message, frame):
    return message if frame.share < 0.5 else None


def hidden_sheet(topic, message, frame):
    """Only the body keeps its colour for the middle third of the time."""
    if topic != COLOR or not 1.0 / 3.0 <= frame.share < 2.0 / 3.0:
        return message
    return with_pixels(message, numpy.where(frame.body()[..., None], pixels(message), 128).astype(numpy.uint8))


class Frame:
    """What a fault may know of a message's frame."""

    def __init__(self, stamp, share, bodies, kept):
        self.stamp, self.share, self.bodies, self.kept = stamp, share, bodies, kept
        self.random = numpy.random.default_rng(stamp.to_nsec() // 1000)

    def body(self):
        """Which pixels show the body."""
        packed, shape = self.bodies[self.stamp]
        return numpy.unpackbits(packed, count=shape[0] * shape[1]).reshape(shape).astype(bool)


def bodies_of(bag):
    """Packed masks of the body, with their shape, by stamp."""
    found = {}
    for _, message, _ in bag.read_messages(topics=[LABELS]):
        mask = pixels(message) == BODY
        found[message.header.stamp] = numpy.packbits(mask), mask.shape
    return found


def cut_off(recording, output):
    """As if recording had ended in the middle of a write: rosbag writes the index last."""
    shutil.copyfile(recording, output)
    os.truncate(output, int(0.6 * os.path.getsize(output)))


FAULTS = {function.__name__: function
          for function in (no_depth, no_info, millimetres, flicker, black, shiny, half, hidden_sheet)}


def write(fault, recording, output):
    if fault == "cut_off":
        cut_off(recording, output)
        return
    with rosbag.Bag(str(recording)) as bag, rosbag.Bag(str(output), "w", compression="lz4") as changed:
        bodies, begin, end, kept = bodies_of(bag), bag.get_start_time(), bag.get_end_time(), {}
        for topic, message, time in bag.read_messages():
            if topic.startswith("/ground_truth"):
                continue
            stamp = message.header.stamp if topic.startswith("/camera") else time
            message = FAULTS[fault](topic, message, Frame(stamp, (time.to_sec() - begin) / (end - begin), bodies, kept))
            if message is not None:
                changed.write(topic, message, time)
