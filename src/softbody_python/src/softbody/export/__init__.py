"""Writes the states of a result bag to files that other programs read: `rosrun softbody_bringup export`."""
