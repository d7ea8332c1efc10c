"""What an audit writes down for others to check."""
