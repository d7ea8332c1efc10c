"""``python -m cuspaudit``."""

from cuspaudit.cli import main

main()
