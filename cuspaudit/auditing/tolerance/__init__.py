"""What an arm turns into when its axes are a little elsewhere."""
