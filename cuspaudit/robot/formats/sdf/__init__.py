"""SDF, the models of Gazebo: links, joints and frames of one file, as text."""
