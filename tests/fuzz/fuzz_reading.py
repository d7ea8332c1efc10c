"""Coverage-guided fuzzing of the readers, on request.

    pip install atheris
    python tests/fuzz/fuzz_reading.py urdf [corpus folder] -max_total_time=300
    python tests/fuzz/fuzz_reading.py table [corpus folder] -max_total_time=300

Any error but the family of `CuspauditError`, in one line, is a find, and so is an input
that takes more than 5 s; atheris writes it to a file ``crash-...`` in the working
folder. A find becomes a test.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

ENDINGS = {"urdf": ".urdf", "table": ".yaml", "csv": ".csv", "json": ".json"}


def main() -> None:
    """Fuzz the reader named by the first argument."""
    import atheris

    with atheris.instrument_imports(include=["cuspaudit"]):
        from cuspaudit.errors import CuspauditError
        from cuspaudit.robot.formats.dh.write import table_text
        from cuspaudit.robot.formats.read_robot import read_robot
        from cuspaudit.robot.snapping import snap

    path = Path(tempfile.mkdtemp()) / f"arm{ENDINGS[sys.argv.pop(1)]}"

    def read(content: bytes) -> None:
        path.write_bytes(content)
        try:
            chain = read_robot(path, convention=None, angle_unit=None).chain
        except CuspauditError as error:
            assert "\n" not in str(error)
            return
        snapped = snap(chain)[0]
        table_text(snapped)
        table_text(snapped, convention="modified")

    atheris.Setup([*sys.argv, "-timeout=5"], read)
    atheris.Fuzz()


if __name__ == "__main__":
    main()
