"""What the figures and the page draw, computed."""
