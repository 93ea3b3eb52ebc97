"""rclpy: the simulator and the replay node; thin, with no physics in them."""
