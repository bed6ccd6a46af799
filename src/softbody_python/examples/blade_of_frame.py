#!/usr/bin/env python3
"""Cuts with a blade that is fixed to a frame of tf. No marker is needed. Usage: blade_of_frame.py TOOL.yaml FRAME"""
import rospy
import yaml
from geometry_msgs.msg import Point32, Polygon, PolygonStamped
from sensor_msgs.msg import CameraInfo

if len(rospy.myargv()) != 3:
    raise SystemExit(__doc__)
rospy.init_node("blade_of_frame")
with open(rospy.myargv()[1], encoding="utf-8") as file:
    corners = yaml.safe_load(file)["tool"]["blade"]
publisher = rospy.Publisher("/softbody/tool/blade", PolygonStamped, queue_size=10)
blade = PolygonStamped(polygon=Polygon([Point32(*corner) for corner in corners]))
blade.header.frame_id = rospy.myargv()[2]


def publish(info):  # a blade for each image, with its stamp
    blade.header.stamp = info.header.stamp
    publisher.publish(blade)


rospy.Subscriber("/camera/color/camera_info", CameraInfo, publish)
rospy.spin()
