"""What a person looks at: the animated scene, the figures."""
