"""The reader's files that the documentation names: my.bag, my_mesh.obj, my_sheet.obj, my_object/, my_tool.yaml and
my_images/. The virtual camera and the shipped sponge stand in for them."""
import os
import shutil
import struct
import subprocess
import zlib

import rosbag

# What a camera has to publish, and no more: no CameraInfo of depth, no truth.
CAMERA_TOPICS = ("/camera/color/image_raw", "/camera/color/camera_info", "/camera/aligned_depth_to_color/image_raw")


def make(folder, config):
    """Writes all of them into a folder. config is the folder of the shipped objects."""
    for tool, arguments in (("virtual_camera", "--scene cut --duration 2 --width 320 --height 240 --output truth.bag"),):
        subprocess.run(["rosrun", "softbody_bringup", tool, *arguments.split()], cwd=folder, check=True, capture_output=True)
    with rosbag.Bag(f"{folder}/truth.bag") as truth, rosbag.Bag(f"{folder}/my.bag", "w") as bag:
        for topic, message, time in truth.read_messages():
            if topic in CAMERA_TOPICS or topic == "/tf_static":
                bag.write(topic, message, time)
    os.remove(f"{folder}/truth.bag")
    _write_mesh_in_millimetres(f"{config}/sponge.obj", f"{folder}/my_mesh.obj")
    _write_sheet(f"{folder}/my_sheet.obj")
    subprocess.run("rosrun softbody_sim prepare_model my_mesh.obj --unit mm --output my_object".split(), cwd=folder, check=True,
                   capture_output=True)
    shutil.copy(f"{config}/knife.yaml", f"{folder}/my_tool.yaml")
    _write_images(f"{folder}/my.bag", f"{folder}/my_images")


def _write_mesh_in_millimetres(metres, millimetres):
    with open(metres, encoding="utf-8") as source, open(millimetres, "w", encoding="utf-8") as target:
        for line in source:
            words = line.split()
            if words and words[0] == "v":
                line = "v " + " ".join(str(1000 * float(word)) for word in words[1:4]) + "\n"
            target.write(line)


def _write_sheet(path):
    """A flat square of 200 mm."""
    with open(path, "w", encoding="utf-8") as target:
        for i in range(25):
            target.write(f"v {50 * (i // 5)} {50 * (i % 5)} 0\n")
        for i in range(1, 20):
            if i % 5:
                target.write(f"f {i} {i + 5} {i + 6} {i + 1}\n")


def _write_images(bag, folder):
    os.makedirs(f"{folder}/color")
    os.makedirs(f"{folder}/depth")
    for topic, kind in ((CAMERA_TOPICS[0], "color"), (CAMERA_TOPICS[2], "depth")):
        with rosbag.Bag(bag) as images:
            for number, (_, image, _) in enumerate(images.read_messages(topics=[topic])):
                if number < 3:
                    _write_png(f"{folder}/{kind}/{number:04}.png", image)


def _write_png(path, image):
    """bgr8 and rgb8 as colour with 8 bits, whose order of channels does not matter here; 16UC1 as grey with 16 bits."""
    depth = image.encoding == "16UC1"
    rows = bytearray()
    for row in range(image.height):
        data = image.data[row * image.step:row * image.step + image.width * (2 if depth else 3)]
        if depth and not image.is_bigendian:
            data = b"".join(data[k + 1:k + 2] + data[k:k + 1] for k in range(0, len(data), 2))
        rows += b"\0" + data

    def chunk(name, content):
        return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))

    header = struct.pack(">IIBBBBB", image.width, image.height, 16 if depth else 8, 0 if depth else 2, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(bytes(rows), 1)) + chunk(b"IEND", b""))
