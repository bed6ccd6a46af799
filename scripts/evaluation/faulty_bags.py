"""Copies the camera's topics of a virtual recording, which has labels (virtual_camera --labels), with a fault."""
import collections
import os
import shutil

import numpy
import rosbag

COLOR, DEPTH, LABELS = "/camera/color/image_raw", "/camera/aligned_depth_to_color/image_raw", "/ground_truth/labels"
BODY = 3
FLICKER = 0.4  # largest change of the brightness
BLACK = 0.08  # of the brightness
HOLES, WRONG, BLOCK_PX, WRONG_MM = 0.3, 0.1, 24, 60  # of a shiny body: shares; blocks with wrong depth, largest error

# What a fault may know of a message: the share of the time that is over, which pixels show the body, and what it keeps.
Frame = collections.namedtuple("Frame", "share body random kept")


def pixels(image):
    """A copy of the pixels, colour as (rows, columns, 3), depth in mm as (rows, columns)."""
    if image._type != "sensor_msgs/Image" or image.encoding not in ("rgb8", "bgr8", "16UC1", "mono8"):
        raise ValueError(f"{image._type} is not an image of the virtual camera")
    kind = "<u2" if image.encoding == "16UC1" else numpy.uint8
    channels = (3,) if image.encoding in ("rgb8", "bgr8") else ()
    return numpy.frombuffer(image.data, kind).reshape(image.height, image.width, *channels).copy()


def brighter(image, factors):
    return numpy.clip(factors * pixels(image), 0, 255).astype(numpy.uint8)


def millimetres(image, _frame):
    """The numbers of millimetres, in the encoding of metres."""
    depth = pixels(image).astype("<f4")
    image.encoding, image.step = "32FC1", 4 * image.width
    return depth


def shiny(image, frame):
    """Where the body is bright there is no depth. Other places have the depth of something that is mirrored."""
    depth, body, brightness = pixels(image), frame.body, frame.kept["brightness"]
    blocks = [(side + BLOCK_PX - 1) // BLOCK_PX for side in depth.shape]

    def per_pixel(values):
        return numpy.kron(values, numpy.ones((BLOCK_PX, BLOCK_PX)))[:depth.shape[0], :depth.shape[1]]

    wrong = body & (depth > 0) & (per_pixel(frame.random.random(blocks)) < WRONG)
    depth[wrong] = (depth + per_pixel(frame.random.uniform(-WRONG_MM, WRONG_MM, blocks)))[wrong]
    if body.any():
        depth[body & (brightness > numpy.quantile(brightness[body], 1.0 - HOLES))] = 0
    return depth


def kept_brightness(image, frame):
    frame.kept["brightness"] = pixels(image).mean(axis=-1)
    return pixels(image)


def hidden_sheet(image, frame):
    """Only the body keeps its colour for the middle third of the time."""
    hides = 1.0 / 3.0 <= frame.share < 2.0 / 3.0
    return numpy.where(frame.body[..., None] | (not hides), pixels(image), 128).astype(numpy.uint8)


# The other pixels of the images of a topic.
CHANGES = {
    "millimetres": {DEPTH: millimetres},
    "flicker": {COLOR: lambda image, frame: brighter(image, 1.0 + FLICKER * frame.random.uniform(-1.0, 1.0))},
    "black": {COLOR: lambda image, frame: brighter(image, numpy.where(frame.body, BLACK, 1.0)[..., None]),
              DEPTH: lambda image, frame: numpy.where(frame.body, 0, pixels(image))},
    "shiny": {COLOR: kept_brightness, DEPTH: shiny},
    "hidden_sheet": {COLOR: hidden_sheet}}
# Which messages are left out, by topic and share of the time.
MISSING = {"no_depth": lambda topic, _: "depth" in topic, "no_info": lambda topic, _: topic.endswith("camera_info"),
           "half": lambda _, share: share >= 0.5}


def write(fault, recording, output):
    """Writes the recording with a fault; `cut_off`: as if recording had ended in the middle of a write."""
    if fault == "cut_off":
        shutil.copyfile(recording, output)
        os.truncate(output, int(0.6 * os.path.getsize(output)))  # rosbag writes the index last
        return
    changes, missing = CHANGES.get(fault, {}), MISSING.get(fault, lambda topic, share: False)
    with rosbag.Bag(str(recording)) as bag, rosbag.Bag(str(output), "w", compression="lz4") as changed:
        bodies = {image.header.stamp: pixels(image) == BODY for _, image, _ in bag.read_messages(topics=[LABELS])}
        begin, end, kept = bag.get_start_time(), bag.get_end_time(), {}
        for topic, message, time in bag.read_messages():
            share = (time.to_sec() - begin) / (end - begin)
            if topic.startswith("/ground_truth") or missing(topic, share):
                continue
            if topic in changes:
                stamp = message.header.stamp
                frame = Frame(share, bodies[stamp], numpy.random.default_rng(stamp.to_nsec() // 1000), kept)
                message.data = changes[topic](message, frame).tobytes()
            changed.write(topic, message, time)
