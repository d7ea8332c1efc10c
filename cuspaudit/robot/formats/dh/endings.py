"""The endings of tables that are lines of cells."""

__all__ = ["LINE_ENDINGS"]

LINE_ENDINGS = (".csv", ".tsv", ".txt", ".md", ".tex")
