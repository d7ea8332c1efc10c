"""URDF files: joints, numbers, the tree, and the meshes."""
