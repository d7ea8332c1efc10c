"""The arms of the first checker's tests serve for the second one, too."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "certificate"))
