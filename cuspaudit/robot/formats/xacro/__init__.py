"""xacro files, expanded without ROS in a process of their own."""
