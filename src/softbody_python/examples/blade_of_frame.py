#!/usr/bin/env python3
"""Cuts with the blade of a tool YAML that is fixed to a frame of tf, e.g. a robot's hand. No marker is needed.

Usage: blade_of_frame.py TOOL.yaml FRAME
"""
import sys

import rospy
import yaml
from geometry_msgs.msg import Point32, PolygonStamped
from sensor_msgs.msg import CameraInfo

if len(rospy.myargv()) != 3:
    sys.exit(__doc__)
path, frame = rospy.myargv()[1:]
with open(path, encoding="utf-8") as file:
    corners = yaml.safe_load(file)["tool"]["blade"]
rospy.init_node("blade_of_frame")
blade = PolygonStamped()
blade.header.frame_id = frame
blade.polygon.points = [Point32(*corner) for corner in corners]
publisher = rospy.Publisher("/softbody/tool/blade", PolygonStamped, queue_size=10)


def publish(info):
    """A blade for each image, with its stamp."""
    blade.header.stamp = info.header.stamp
    publisher.publish(blade)


rospy.Subscriber("/camera/color/camera_info", CameraInfo, publish)
rospy.spin()
