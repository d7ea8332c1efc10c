"""Sheets over the cells, joined where they meet over a wall."""
