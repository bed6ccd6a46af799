"""The command line: `rosrun softbody_bringup compress_bag IN.bag OUT.bag`."""
import argparse
import collections
import os
import pathlib
import struct
import sys
import tempfile
import zlib

import numpy as np
import rosbag
from sensor_msgs.msg import CompressedImage
from softbody.export.command import Help, Version

CHANNELS = {"rgb8": 3, "bgr8": 3, "mono8": 1}


def png(pixels):
    """A PNG of H x W (8 or 16 bits) or H x W x 3 values (8 bits, RGB)."""
    height, width = pixels.shape[:2]
    rows = pixels.astype(pixels.dtype.newbyteorder(">")).reshape(height, -1)
    data = b"".join(b"\0" + row.tobytes() for row in rows)

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    header = struct.pack(">IIBBBBB", width, height, 8 * pixels.itemsize, 0 if pixels.ndim == 2 else 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(data, 1)) + chunk(b"IEND", b"")


def pixels_of(image):
    """H x W, or H x W x 3 as RGB. @throw ValueError."""
    channels = CHANNELS.get(image.encoding, 1)
    values = np.dtype(np.uint8 if image.encoding in CHANNELS else np.uint16).newbyteorder(">" if image.is_bigendian else "<")
    used = image.width * channels * values.itemsize
    if image.step < used or len(image.data) != image.step * image.height:
        raise ValueError(f"the image has {len(image.data)} bytes, not {image.height} rows of {max(used, image.step)}")
    rows = np.frombuffer(image.data, np.uint8).reshape(image.height, image.step)[:, :used]
    pixels = np.ascontiguousarray(rows).view(values).reshape(image.height, image.width, channels)
    return pixels[..., 0] if channels == 1 else pixels[..., ::-1] if image.encoding == "bgr8" else pixels


def compress(topic, image):
    """The topic and the message that image_transport's plugins publish, as PNG, which loses nothing.

    Colour and grey images of 8 bits get `compressed`, depth in millimetres (16UC1) gets `compressedDepth`. Every other
    message stays as it is. @throw ValueError.
    """
    depth = getattr(image, "encoding", None) == "16UC1"
    if image._type != "sensor_msgs/Image" or not depth and image.encoding not in CHANNELS:
        return topic, image
    packed = CompressedImage(header=image.header)
    shown = "mono8" if image.encoding == "mono8" else "bgr8"
    packed.format = "16UC1; compressedDepth png" if depth else f"{image.encoding}; png compressed {shown}"
    packed.data = (struct.pack("<iff", 0, 0, 0) if depth else b"") + png(pixels_of(image))
    return topic + ("/compressedDepth" if depth else "/compressed"), packed


def compress_bag(source, target):
    """@return how many images are compressed, and the encodings of those that are not. @throw ValueError, OSError,
    rosbag.ROSBagException."""
    count, kept = 0, collections.Counter()
    with rosbag.Bag(str(source)) as read, rosbag.Bag(str(target), "w") as written:
        for topic, message, stamp in read:
            try:
                name, packed = compress(topic, message)
            except ValueError as error:
                raise ValueError(f"{topic} at {stamp.to_sec():.3f} s: {error}") from error
            count += name != topic
            if packed._type == "sensor_msgs/Image":
                kept[f"{topic} ({packed.encoding})"] += 1
            written.write(name, packed, stamp)
    return count, kept


def main():
    parser = argparse.ArgumentParser("compress_bag", formatter_class=Help, description="Copies a bag. Its images become "
                                     "compressed ones (PNG, nothing is lost), as those of image_transport's plugins")
    parser.add_argument("--version", action=Version, nargs=0, help="print package and version and exit")
    parser.add_argument("source", metavar="IN.bag", type=pathlib.Path)
    parser.add_argument("target", metavar="OUT.bag", type=pathlib.Path, help="a file that exists is refused")
    options = parser.parse_args()
    if options.target.exists():
        sys.exit(f"compress_bag: {options.target} exists; give another name or remove it")
    folder = None
    try:
        folder = tempfile.TemporaryDirectory(prefix=".compress_bag_", dir=options.target.parent)
        partial = pathlib.Path(folder.name) / "partial.bag"
        count, kept = compress_bag(options.source, partial)
        os.replace(partial, options.target)
    except (ValueError, OSError, rosbag.ROSBagException) as error:
        sys.exit(f"compress_bag: {options.source}: {error}")
    finally:
        if folder is not None:
            folder.cleanup()
    for images, number in kept.items():
        print(f"{images}: {number} images stay as they are; only {', '.join(CHANNELS)} and 16UC1 are compressed")
    print(f"{count} images are compressed: {options.source.stat().st_size / 1e6:.1f} MB, now "
          f"{options.target.stat().st_size / 1e6:.1f} MB in {options.target}")
