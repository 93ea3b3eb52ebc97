"""A run, from what it is asked for to what comes out of it; no ROS."""
